"""Energy of the nonlinear vehicle on straight track without damping, friction and bearing drag.

Kinetic energy, strain energy, height and Hertzian energy of the contacts are summed while the
integrator runs. Left over is what the contact model itself does not keep: a Hertzian spring whose
constant C in N = C d^(3/2) changes with the place of the contact takes 2/5 N d dC/C, because the
model's force acts along the normal alone. That work is counted, too.
"""

import numpy as np
import pytest

from tramdva.bogie import integration, ride, track
from tramdva.bogie.curving import equilibrium
from tramdva.bogie.modal import modal_basis, modal_state, vehicle_state
from tramdva.bogie.tram import run_through, track_line
from tramdva.bogie.vehicle import frame_loads
from tramdva.bogie.wheel_forces import contact_forces
from tramdva.contact import patch

DURATION = 0.2


@pytest.fixture(scope="module")
def conservative(line):
    """System without damping, friction and drag, and its equilibrium."""
    run = run_through(line._replace(friction=(0.0, 1.0, 0.0)))
    vehicle = run.straight.vehicle
    vehicle = vehicle._replace(
        damping=0.0 * vehicle.damping,
        constant_load=0.0 * vehicle.constant_load,
        stiffness=sum(vehicle.strain.values()),
    )
    straight = track_line(line)._replace(curvature=0.0, cant=0.0)
    frames = track.frame_motion(straight, 50.0, line.bogie.half_wheelbase, line.track.speed)
    load = frame_loads(vehicle, frames, line.track.gravity)
    system = run.straight._replace(vehicle=vehicle, load=load)
    return system, equilibrium(system, run.straight_equilibrium.state)


def energies(system, state):
    """Energy in J without the contacts; energy and ln of the Hertzian constant per contact.

    A zone that does not touch has no constant: NaN.
    """
    k, vehicle = system.size, system.vehicle
    q, v = state[:k], state[k:]
    _, results = contact_forces(system.contacts, system.curvatures, system.local(state))
    normal, penetration = results[..., patch.NORMAL_FORCE], results[..., patch.PENETRATION]
    assert (normal.sum(axis=1) > 0.0).all()
    depth = np.where(normal > 0.0, penetration, np.nan)
    smooth = 0.5 * v @ vehicle.mass @ v + 0.5 * q @ vehicle.stiffness[:k, :k] @ q
    return smooth - system.load[:k] @ q, 0.4 * normal * depth, np.log(normal / depth**1.5)


def energy_after_blow(conservative, direction, speed: float, interval: float):
    """Change of the energy over that of the blow, (k,): without and with the constant's work."""
    system, rest = conservative
    basis, contacts = modal_basis(system, rest), system.contacts
    start = rest.state.copy()
    start[system.size :] += speed * direction
    z, work = modal_state(basis, start), integration.workspace(contacts)
    tables = integration.step_table(basis.eigenvalue, interval)
    columns = np.array(integration.RECORDED)
    local, results = np.empty((1, 44)), np.empty((1, 4, len(contacts.tables), columns.size))
    found = [energies(system, start)]
    for _ in range(round(DURATION / interval)):
        integration.run(
            basis.contact, contacts, integration.steady(basis.eigenvalue.size, system.curvatures),
            ride.no_excitation(basis, contacts), tables, interval, 1e9, 0, 0.0, z, work,
            local, results, columns, 1,
        )  # fmt: skip
        found.append(energies(system, vehicle_state(basis, z)))
    smooth, contact, constant = map(np.array, zip(*found, strict=True))
    total = smooth + np.nansum(contact, axis=(1, 2))
    taken = 0.5 * (contact[1:] + contact[:-1]) * np.diff(constant, axis=0)
    counted = total - np.append(0.0, np.nansum(taken, axis=(1, 2)).cumsum())
    smooth, contact, _ = energies(system, rest.state)
    blow = total[0] - smooth - np.nansum(contact)
    return (total - total[0]) / blow, (counted - counted[0]) / blow


def test_energy_of_a_vertical_blow_is_kept(conservative):
    rise = conservative[0].vehicle.rise
    total, _ = energy_after_blow(conservative, rise, 0.03, 1.25e-4)
    assert np.abs(total).max() < 1e-4


def test_energy_of_a_lateral_blow_is_kept(conservative):
    """The contacts wander over the profiles: here the work of the constants shows."""
    total, counted = energy_after_blow(conservative, lateral(conservative), 0.03, 1.25e-4)
    assert np.abs(total).max() < 4e-3
    # Left over: a zone that begins to touch has no constant before; tables, not exact profiles.
    assert np.abs(counted).max() < 1e-4


def test_energy_converges_with_the_order_of_the_scheme(conservative):
    """Below 1 ms, where steps resolve a wheel that changes from tread to root and back."""
    steps = (5e-4, 2.5e-4, 1.25e-4, 3.125e-5)
    ends = [
        energy_after_blow(conservative, lateral(conservative), 0.03, step)[0][-1] for step in steps
    ]
    errors = np.abs(np.array(ends[:-1]) - ends[-1])
    assert errors[0] < 1e-4
    assert 0.5 * np.log2(errors[0] / errors[2]) > 3.5


def lateral(conservative) -> np.ndarray:
    """Motion of everything to the left."""
    return conservative[0].vehicle.frame_motion[:, track.LATERAL :: 3].sum(axis=1)
