"""The weight of absorbers on a vehicle that is described without them.

An absorber that translates hangs on its mounting with its weight, whatever its stiffness and
damping: wheels, contacts and their Jacobian feel that. One that rotates transmits nothing.
"""

import numpy as np

from tramdva.bogie.conditions import State, under
from tramdva.bogie.curving import System, near
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.tram import BogieLine, on_track
from tramdva.bogie.vehicle import absorber_carriers


def carrying(state: State) -> State:
    """Equilibrium of the vehicle without absorbers, with their weight on its axles.

    Parameters
    ----------
    state : of the vehicle without absorbers; its line says which they would be

    Returns
    -------
    The same vehicle, as far as it moves; `load` and equilibrium are those with the weight. What the
    absorbers add to its motion is in `absorber_ports`.
    """
    if state.line.bogie.absorber.motion == "rotation":
        return state
    line = under(state.line, state.conditions)
    system = weighed_down(line, state.system, line.bogie.absorber)
    return state._replace(system=system, equilibrium=near(system, state.equilibrium.state))


def weighed_down(line: BogieLine, system: System, absorber: BogieAbsorber) -> System:
    """System with the loads on a vehicle to whose axles the masses of absorbers are fixed.

    Parameters
    ----------
    line : of the track that `system` is on in full; system : of the vehicle without absorbers
    absorber : translating
    """
    vehicle = system.vehicle
    # Along and across the direction of each: together the whole motion of its mounting.
    mounting = np.vstack(absorber_carriers(vehicle, absorber))
    heavier = vehicle._replace(mass=vehicle.mass + absorber.I_T * mounting.T @ mounting)
    return system._replace(load=on_track(line, heavier, system.contacts, 1.0).load)
