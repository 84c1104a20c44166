"""Balance of power in the curve: what pulls and turns the vehicle pays for friction, to 0.1 %.

Power at the rails counts twice: from the generalised forces and the motion of the wheels, and from
creepages and creep forces in the contact. What lies between is the work of the normal forces.
"""

from pathlib import Path

import numpy as np
import pytest
from curving_power import contact_power, steady_power

from tramdva.bogie import ride as rides
from tramdva.bogie.tram import changed, run_through, track_line
from tramdva.configuration.uses import used_values
from tramdva.contact import patch
from tramdva.stages import contact_geometry
from tramdva.stages.bogie_sections import bogie_line

CONFIG = Path(__file__).resolve().parents[2] / "config"
SHARE = 1e-3  # of the power of friction


@pytest.fixture(scope="module")
def worn(configuration):
    """Line with measured profiles in a canted curve, and its equilibria."""
    tables = contact_geometry.compute(
        used_values(configuration, "worn-40m", "contact_geometry"), lambda name: CONFIG / name
    )
    line = bogie_line(used_values(configuration, "worn-40m", "curving_equilibrium"), tables)
    return line, run_through(line)


@pytest.fixture(scope="module", params=["paper", "worn-40m"])
def curving(request, line, running):
    """Both shipped lines, in their curve."""
    known = (line, running) if request.param == "paper" else request.getfixturevalue("worn")
    assert known[1].equilibrium.status == "converged"
    return known


@pytest.fixture(scope="module")
def power(curving):
    line, run = curving
    support = line.bogie.car_support.yaw_stiffness
    return steady_power(run.curve, run.equilibrium.state, line.bogie.half_wheelbase, support)


def test_traction_and_support_pay_for_friction_and_joints(power):
    assert power.friction < -5e3
    assert power.traction > 0.9 * -power.friction
    assert abs(power.balance) < SHARE * -power.friction


def test_normal_forces_do_no_work_in_steady_running(power):
    assert np.abs(power.normal).sum() < SHARE * -power.friction


def test_slip_of_a_flange_is_the_attack_over_the_cosine(curving):
    """Of all loaded contacts: material that rolls slips along the contact plane alone."""
    _, run = curving
    system, results = run.curve, run.equilibrium.results
    local = system.local(run.equilibrium.state)
    places, wheel = system.contacts.places, local.reshape(4, -1)
    curvature, lead = system.curvatures[places.axle], results[..., patch.FORWARD_SHIFT]
    # Against the rail where it touches: ahead of the axle by the wheel's place and the lead.
    yaw = (wheel[:, 3] - curvature * wheel[:, 10])[:, None] - curvature[:, None] * lead
    # A wheel that leans moves sideways ahead of its axle.
    sideways = wheel[:, 2:3] * lead / results[..., patch.ROLLING_RADIUS] - yaw
    slip = results[..., patch.LATERAL_CREEPAGE] * np.cos(results[..., patch.CONTACT_ANGLE])
    loaded = results[..., patch.STATUS] == patch.CONTACT
    np.testing.assert_allclose((slip / sideways)[loaded], 1.0, atol=5e-3)
    assert loaded.sum() == 4


def test_normal_forces_do_no_work_over_a_period_of_the_limit_cycle(line, running):
    """Self-excited vibration at a steeper friction: friction alone takes what the rails give."""
    steep = line._replace(friction=(*line.friction[:2], 0.8))
    run = changed(steep, None, running)
    route = rides.Route(
        track_line(steep, 0.5 * steep.track.speed), steep.track.speed, steep.bogie.half_wheelbase,
        steep.track.gravity, (run.straight, run.curve),
        (run.straight_equilibrium, run.equilibrium),
    )  # fmt: skip
    ride = rides.ride(route, 14.0, 5e-4, 1, 1e-3)
    assert ride.status == "completed"
    velocity = rides.contact_point_velocity(0.3, ride.local)[1]
    mean = velocity[-2000:].mean()
    starts = np.flatnonzero((velocity[:-1] < mean) & (velocity[1:] >= mean))
    first, last = starts[-41], starts[-1]  # whole periods
    assert np.ptp(velocity[first:last]) > 5e-3
    rails, friction = np.array(
        [contact_power(run.curve, local) for local in ride.local[first:last]]
    ).mean(axis=0)
    assert abs((rails - friction).sum()) < SHARE * -friction.sum()
