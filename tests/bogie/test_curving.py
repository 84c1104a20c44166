"""Equilibrium, linearisation, modes and self-excitation."""

import numpy as np
import pytest
from figure_scripts import script, texts
from strange_trams import unexplained

from tramdva.bogie import modes, track
from tramdva.bogie import wheel_forces as contact
from tramdva.bogie.absorbers import absorber_family, carried_over
from tramdva.bogie.curving import angle_of_attack, linearise, wheel_loads
from tramdva.bogie.tram import absorber, changed, run_through
from tramdva.bogie.vehicle import build_vehicle
from tramdva.configuration.uses import used_values
from tramdva.contact import patch
from tramdva.stages import bogie_modes, bogie_sections

LIMITS = (30.0, 200.0)


def test_no_acceleration_is_left(running):
    for system, state in (
        (running.straight, running.straight_equilibrium),
        (running.curve, running.equilibrium),
    ):
        rate = np.linalg.solve(system.vehicle.mass, system.forces(state.state))
        assert np.abs(rate).max() < 1e-7  # m/s^2; rounding of 1e5 N on few kg


def test_straight_track_is_symmetric(running):
    loads = np.array(list(wheel_loads(running.straight_equilibrium).values()))
    np.testing.assert_allclose(loads[::2], loads[1::2], rtol=1e-9)
    attack = angle_of_attack(running.straight, running.straight_equilibrium)
    assert np.abs(attack).max() < 1e-9


def test_contact_jacobian_does_not_depend_on_its_steps(running):
    system, local = running.curve, running.curve.local(running.equilibrium.state)
    fine, coarse = (
        contact.contact_jacobian(system.contacts, system.curvatures, local, scale)
        for scale in (1.0, 4.0)
    )
    # Cells of the patch switch between adhesion and sliding: slopes are steps of 1e-3.
    scale = np.abs(fine).reshape(4, 6, 4, 11).max(axis=(0, 1, 2), keepdims=True)
    difference = np.abs(coarse - fine).reshape(4, 6, 4, 11) / scale
    assert difference.max() < 5e-3


def test_without_damping_and_friction_energy_is_conserved(line):
    """Every eigenvalue of the straight run is imaginary."""
    smooth = line._replace(friction=(1e-9, 1.0, 0.0))
    run = run_through(smooth)
    vehicle = run.straight.vehicle
    vehicle = vehicle._replace(
        damping=0.0 * vehicle.damping, stiffness=sum(vehicle.strain.values())
    )
    system = run.straight._replace(vehicle=vehicle)
    values = np.linalg.eigvals(linearise(system, run.straight_equilibrium.state).matrix)
    # Double zeros (lateral and spin motions without restoring force) split by the root of rounding.
    vibrating = values[np.abs(values.imag) > 2.0 * np.pi]
    assert np.abs(vibrating.real / vibrating.imag).max() < 1e-5
    assert vibrating.size > 100


def test_second_bending_is_self_excited_and_absorbers_damp_it(line, running):
    found = modes.modes(running.curve, running.equilibrium.state, (1.0, 200.0))
    critical = int(np.argmax(np.where(found.frequency > 30.0, found.eigenvalue.real, -np.inf)))
    assert found.name[critical] == "second_bending_front"
    assert 54.0 < found.frequency[critical] < 56.0  # paper: near 55 Hz
    # The line's axle damping is set for this rate.
    np.testing.assert_allclose(found.eigenvalue[critical].real, 0.3, atol=0.01)
    gentle = modes.at_friction(running.curve, running.equilibrium.state, 0.4)
    at_gentle = modes.critical_of(gentle, LIMITS)
    damped = changed(line, absorber(line, 1.74e5, 300.0), running)
    with_absorber = modes.critical_oscillation(damped.curve, damped.equilibrium.state, LIMITS)
    assert at_gentle.growth_rate < -1.0
    # Paper: dies out very quickly; to a hundredth within a second.
    assert with_absorber.growth_rate < -np.log(100.0)


def test_modes_on_straight_track_are_pairs_of_both_axles(running):
    found = modes.modes(running.straight, running.straight_equilibrium.state, (1.0, 200.0))
    for word in ("first_bending", "third_bending", "axle_torsion"):
        names = sorted(name for name in found.name if name.startswith(word))
        assert names == [f"{word}_in_phase", f"{word}_opposed"], word
    # The wheels are so soft that their modes leave the frame at rest: 6e-6 apart, one per axle.
    wheels = [k for k, name in enumerate(found.name) if name.startswith("resilient_wheel")]
    np.testing.assert_allclose(*found.frequency[wheels], rtol=1e-4)


def test_names_of_modes_do_not_hang_on_rounding(running):
    """Eigenvectors of pairs 1e-4 apart turn easily; what they are called must not."""
    system, state = running.straight, running.straight_equilibrium.state
    linear = linearise(system, state)
    names = modes.modes_of(system, linear, (1.0, 200.0)).name
    noise = 1.0 + 1e-9 * np.random.default_rng(0).normal(size=linear.matrix.shape)
    other = linear._replace(matrix=linear.matrix * noise)
    assert modes.modes_of(system, other, (1.0, 200.0)).name == names


def test_in_the_curve_elastic_modes_belong_to_one_axle(running):
    found = modes.modes(running.curve, running.equilibrium.state, (1.0, 200.0))
    for word in ("second_bending", "third_bending"):
        names = [name for name in found.name if name.startswith(word)]
        assert sorted(names) == [f"{word}_front", f"{word}_rear"]
        assert found.name[modes.of_front_axle(found, word)] == f"{word}_front"


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_correlation_of_the_axles_tells_in_phase_from_opposed(running, sign):
    names = running.curve.vehicle.names[: running.curve.size]
    motion = np.random.default_rng(2).normal(size=(2, len(names)))
    shape = motion[0] + 1j * motion[1]
    for k, name in enumerate(names):
        if name.startswith("rear"):
            shape[k] = sign * shape[names.index(name.replace("rear", "front"))]
    np.testing.assert_allclose(modes.axle_correlation(running.curve, shape), sign)


def test_shares_of_strain_energy_sum_to_one(running):
    found = modes.modes(running.curve, running.equilibrium.state, (1.0, 200.0))
    np.testing.assert_allclose(found.share.sum(axis=(1, 2)), 1.0)
    assert found.share.min() > -1e-12


@pytest.mark.parametrize("motion", ["rotation", "translation"])
def test_family_of_absorbers_is_each_bogie_by_itself(line, running, motion):
    """One equilibrium for all stiffnesses and dampings, or one each: the same modes."""
    design = line.bogie.absorber.model_copy(update={"motion": motion})
    if motion == "translation":
        upwards = design.direction.model_copy(update={"x": 0.0, "z": 1.0})
        values = {"direction": upwards, "I_T": 10.0, "c_T": 1.2e6, "d_T": 500.0}
        design = design.model_copy(update=values)
    line = line._replace(bogie=line.bogie.model_copy(update={"absorber": design}))
    c_T, d_T = 0.7 * design.c_T, 2.5 * design.d_T
    system, linear = absorber_family(line, running).member(c_T, d_T)
    alone = changed(line, absorber(line, c_T, d_T), running)
    found = modes.modes_of(system, linear, (1.0, 200.0))
    expected = modes.modes(alone.curve, alone.equilibrium.state, (1.0, 200.0))
    # The contact Jacobian differs by the noise of differences at states 1e-10 apart.
    np.testing.assert_allclose(found.eigenvalue, expected.eigenvalue, rtol=1e-5)
    np.testing.assert_allclose(found.share, expected.share, atol=1e-4)


def test_critical_friction_decrease_has_no_growth(running):
    decrease = np.linspace(0.4, 1.0, 3)
    system, state = running.curve, running.equilibrium.state
    growth = np.array(
        [
            modes.critical_of(modes.at_friction(system, state, B), LIMITS).growth_rate
            for B in decrease
        ]
    )
    B = modes.critical_friction_decrease(system, state, LIMITS, decrease, growth)
    at_onset = modes.critical_of(modes.at_friction(system, state, B), LIMITS)
    # 1e-4 s/m times the slope of 15 1/s per s/m
    assert abs(at_onset.growth_rate) < 2e-3
    stable = modes.critical_friction_decrease(system, state, LIMITS, decrease, growth - 100.0)
    assert np.isnan(stable)


def test_carried_over_absorber_keeps_frequency_and_damping_ratio():
    c, d = carried_over(2.0, 40.0, 4.3e6, 6850.0)
    np.testing.assert_allclose(np.sqrt(c / 2.0), np.sqrt(4.3e6 / 40.0))
    np.testing.assert_allclose(d / np.sqrt(c * 2.0), 6850.0 / np.sqrt(4.3e6 * 40.0))


@pytest.mark.parametrize(
    ("share", "allowed"),
    [(0.7, {"converged"}), (1.1, {"wheel_lifted", "not_converged"}), (1.3, {"wheel_lifted"})],
)
def test_a_wheel_lifts_beyond_the_tipping_speed(line, share, allowed):
    """A high car body without support against the tipping speed of the same mass on a rigid axle.

    Springs let the car lean out, so that it tips earlier, but not below 0.7 of that speed.
    """
    bogie, track_ = line.bogie, line.track
    changes = {
        "car_body": bogie.car_body.model_copy(update={"height": 4.0}),
        "car_support": bogie.car_support.model_copy(update={"roll_stiffness": 0.0}),
    }
    high = bogie.model_copy(update=changes)
    vehicle = build_vehicle(high, track_.speed, 800.0)
    lateral, roll = (
        vehicle.frame_motion[:, column::3].sum(axis=1) for column in (track.LATERAL, track.ROLL)
    )
    centre = -(lateral @ vehicle.mass @ roll) / (lateral @ vehicle.mass @ lateral)
    tipping = np.sqrt(track_.gravity * bogie.wheel.half_distance * track_.radius / centre)
    fast = track_.model_copy(update={"speed": share * tipping})
    run = run_through(line._replace(bogie=high, track=fast))
    assert run.equilibrium.status in allowed


def test_attitude_in_the_curve_is_that_of_the_paper(running):
    attack = angle_of_attack(running.curve, running.equilibrium)
    loads = wheel_loads(running.equilibrium)
    assert 0.035 < attack[0] < 0.041  # paper: near 0.04
    assert 34e3 < loads["front_inner"] < 37.5e3  # paper: near 35 kN
    angle = running.equilibrium.results[0, :, patch.CONTACT_ANGLE]
    touching = running.equilibrium.results[0, :, patch.STATUS] == patch.CONTACT
    assert touching.sum() == 1  # the flange root alone
    assert 0.6 < angle[touching][0] < 0.8


def test_without_equilibrium_there_are_no_modes(configuration, tables, monkeypatch):
    """Numbers of a state that is no equilibrium would look like any others."""
    cfg = used_values(configuration, "paper", "bogie_modes")
    cfg["numerics"] |= {"friction_points": 2, "map_points": 2}
    designs = {
        "absorber": np.array(["none", "paper", "tuned"]),
        "m_T": np.array([np.nan, 2.0, 2.0]),
        "c_T": np.array([np.nan, 1.74e5, 1.8e5]),
        "d_T": np.array([np.nan, 300.0, 200.0]),
        "status": np.array(["not_converged", "converged", "not_converged"]),
    }

    def lost(line, design, known):
        run = changed(line, design, known)
        status = "not_converged" if design is None or design.c_T != 1.74e5 else "converged"
        return run._replace(
            equilibrium=run.equilibrium._replace(status=status),
            straight_equilibrium=run.straight_equilibrium._replace(status=status),
        )

    monkeypatch.setattr(bogie_sections, "changed", lost)
    values = bogie_modes.compute(cfg, tables, designs)
    found = np.isfinite(values["frequency"]).any(axis=(1, 2))
    np.testing.assert_array_equal(found, [False, True, False])
    for name in ("operating_growth_rate", "operating_frequency"):
        np.testing.assert_array_equal(np.isfinite(values[name]), [False, True, False])
    for name in ("map_growth_rate", "shape_frequency", "straight_frequency"):
        assert np.isnan(values[name]).all()
    assert values["map_status"] == "not_converged"
    assert unexplained("bogie_modes", values) == []
    drawn = script("bogie_stability").draw(values, 0.7)
    assert texts(drawn).count("not computed:\nno steady running was found") == 1
    shapes = texts(script("bogie_mode_shapes").draw(values, 0.3))
    assert shapes.count("no steady running was found") == 4
