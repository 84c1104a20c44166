"""The way into sharp curves: one branch of equilibria, whatever the wheels touch on it."""

import numpy as np
import pytest

from tramdva.bogie.curve_following import enter_curve, on_the_way
from tramdva.bogie.curving import (
    angle_of_attack,
    corrected,
    equilibrium,
    resting_start,
    wheel_loads,
)
from tramdva.bogie.tram import run_through, systems
from tramdva.configuration.uses import used_values
from tramdva.contact import patch
from tramdva.contact.tables import stored_tables
from tramdva.stages import contact_geometry

RADII = np.arange(25.0, 14.0, -1.0)


@pytest.fixture(scope="module")
def sharp_line(configuration, line):
    """The paper's tram with tables that reach a curve of 15 m, and coarse axles."""
    cfg = used_values(configuration, "paper", "contact_geometry")
    cfg["track"]["radius"] = cfg["study"]["radius"]["min"] = 15.0
    cfg["numerics"] |= {"shift_step": 5e-5, "yaw_nodes": 14}
    return line._replace(tables=stored_tables(contact_geometry.compute(cfg)), cutoff_frequency=400)


@pytest.fixture(scope="module")
def sweep(sharp_line):
    """The tram in curves of 25 to 15 m."""
    return [
        run_through(
            sharp_line._replace(track=sharp_line.track.model_copy(update={"radius": radius}))
        )
        for radius in RADII
    ]


def test_every_radius_has_its_equilibrium(sweep):
    assert {run.equilibrium.status for run in sweep} == {"converged"}


def test_wheels_carry_the_tram_in_every_curve(sweep, sharp_line):
    """Vertical forces of the rails are the weight of all masses, on level track."""
    vehicle = sweep[0].straight.vehicle
    weight = sharp_line.track.gravity * float(vehicle.rise @ vehicle.mass @ vehicle.rise)
    for run in sweep:
        assert sum(wheel_loads(run.equilibrium).values()) == pytest.approx(weight, rel=1e-6)


def test_flank_takes_over_smoothly_as_the_curve_gets_sharper(sweep, sharp_line):
    """The flank of the front outer wheel comes in below 23 m and only takes more and more.

    At 15 m the tread carries beside the root.
    """
    normal = np.array([run.equilibrium.results[0, :, patch.NORMAL_FORCE] for run in sweep])
    flank, root = normal[:, 2], normal[:, 0] + normal[:, 1]
    touching = flank > 0.0
    np.testing.assert_array_equal(touching, RADII < 22.5)
    assert np.all(np.diff(flank[touching]) > 0.0)
    assert np.all(np.diff(root[touching]) < 0.0)
    # No jump: neighbours differ by about as much as theirs do.
    bend = np.diff(root[touching], 2)
    assert np.abs(bend).max() < 0.5 * np.median(np.abs(np.diff(root[touching])))
    attack = np.array([angle_of_attack(run.curve, run.equilibrium)[0] for run in sweep])
    chord = sharp_line.bogie.half_wheelbase / RADII
    # The flanges have a play of 3 mm with the tops of the rails 4 mm inside the tape circles.
    position = sharp_line.contact_geometry.rail.lateral_position
    play = (3e-3 + position + 4e-3) / sharp_line.bogie.half_wheelbase
    assert np.all((attack > chord) & (attack < chord + play))


def quantities(line, radius):
    """Angles of attack, wheel loads, and forces, angles and slips of the contacts that carry."""
    run = run_through(line._replace(track=line.track.model_copy(update={"radius": radius})))
    assert run.equilibrium.status == "converged"
    results = run.equilibrium.results
    carrying = results[..., patch.NORMAL_FORCE] > 0.0
    columns = [patch.NORMAL_FORCE, patch.CONTACT_ANGLE, patch.SLIP_VELOCITY]
    loads = np.array(list(wheel_loads(run.equilibrium).values()))
    contacts = np.where(carrying[..., None], results[..., columns], 0.0)
    return np.concatenate([angle_of_attack(run.curve, run.equilibrium), loads, contacts.ravel()])


@pytest.mark.parametrize("radius", [24.0, 20.0, 17.5])
def test_between_the_events_every_quantity_is_smooth_over_the_radius(sharp_line, radius):
    """Half the distance, half the difference; the events are flank (22 m) and tread (15.2 m)."""
    far, near = (
        quantities(sharp_line, radius + h) - quantities(sharp_line, radius - h)
        for h in (0.05, 0.025)
    )
    share = 0.1 / radius  # change of the radius; some quantities have an extremum nearby
    changing = np.abs(far) > 0.1 * share * np.abs(quantities(sharp_line, radius))
    assert changing.sum() >= 6
    np.testing.assert_allclose(far[changing], 2.0 * near[changing], rtol=0.1)


@pytest.mark.parametrize(("zone", "radii"), [(2, (23.0, 21.5)), (0, (15.6, 15.0))])
def test_a_second_contact_begins_without_force(sharp_line, zone, radii):
    """Flank or tread of the front outer wheel: no load jumps where it comes in."""

    def carries(radius):
        run = run_through(
            sharp_line._replace(track=sharp_line.track.model_copy(update={"radius": radius}))
        )
        return run.equilibrium.results[0, zone, patch.NORMAL_FORCE]

    free, touching = radii
    assert carries(free) == 0.0 < carries(touching)
    for _ in range(9):
        middle = 0.5 * (free + touching)
        free, touching = (free, middle) if carries(middle) > 0.0 else (middle, touching)
    beginning = carries(touching)
    assert 0.0 < beginning < 20.0  # N, beside 40 kN
    before, after = (quantities(sharp_line, radius)[:6] for radius in (free, touching))
    np.testing.assert_allclose(after, before, rtol=1e-3)


def test_only_the_front_outer_wheel_touches_twice(sweep):
    """The flanges of the inner wheels are millimetres from their rails: no force may come there."""
    for run in sweep:
        results = run.equilibrium.results
        touching = results[..., patch.STATUS] == patch.CONTACT
        np.testing.assert_array_equal(touching.sum(axis=1)[1:], 1)


def test_newton_and_the_implicit_steps_end_in_the_same_state(sharp_line):
    """Two searches that share no step: pseudo-time from the track before, Newton's method."""
    line = sharp_line._replace(track=sharp_line.track.model_copy(update={"radius": 23.0}))
    straight, curve = systems(line, None, (0.0, 1.0))
    resting = equilibrium(straight, resting_start(straight))
    followed = enter_curve(straight, curve, resting.state)
    state = resting.state
    for share in np.linspace(0.1, 1.0, 10):
        stepped = equilibrium(on_the_way(straight, curve, share), state)
        state = stepped.state
    assert followed.status == stepped.status == "converged"
    np.testing.assert_allclose(
        curve.local(followed.state), curve.local(stepped.state), rtol=1e-6, atol=1e-9
    )


def test_newton_far_from_a_solution_says_so(sharp_line):
    """No start of a tram in the air is near."""
    (curve,) = systems(sharp_line, None, (1.0,))
    assert corrected(curve, resting_start(curve, -0.02)) is None
