"""The vehicle in its curve, linearised with its wheels out of round.

Apart from what follows from it: simulations of many orders need neither the vehicle's matrices
nor their assembly.
"""

from tramdva.bogie import wheel_forces
from tramdva.bogie.curving import Equilibrium, System
from tramdva.bogie.modal import modal_basis
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.contact import patch


def rough_bogie(system: System, equilibrium: Equilibrium) -> RoughBogie:
    """Linearise a vehicle at its equilibrium, radius deviations included."""
    places = system.contacts.places
    local = system.local(equilibrium.state)
    curvature = system.curvatures[places.axle]
    basis = modal_basis(system, equilibrium)
    return RoughBogie(
        basis.eigenvalue,
        basis.contact,
        system.curvatures,
        equilibrium.results[..., : patch.RESULTS],
        wheel_forces.radius_sensitivity(system.contacts, system.curvatures, local),
        places.speed * (1.0 - curvature * places.lateral_position),
    )
