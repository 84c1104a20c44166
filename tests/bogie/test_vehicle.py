"""Mass, weight, momentum, frames of reference and absorbers of the vehicle."""

import numpy as np
import pytest
from pydantic import ValidationError

from tramdva.bogie import track
from tramdva.bogie.curving import angle_of_attack, wheel_loads
from tramdva.bogie.names import SIDE
from tramdva.bogie.tram import absorber, changed, systems
from tramdva.bogie.vehicle import build_vehicle, frame_loads
from tramdva.bogie.wheel_forces import contact_forces
from tramdva.contact import patch


def test_mass_is_symmetric_and_positive_definite(bogie):
    for design in (None, bogie.absorber):
        vehicle = build_vehicle(bogie, 4.0, 800.0, absorber=design)
        scale = np.sqrt(np.diag(vehicle.mass))
        mass = vehicle.mass / np.outer(scale, scale)
        np.testing.assert_allclose(mass, mass.T, atol=1e-14)
        assert np.linalg.eigvalsh(mass).min() > 1e-4
        np.testing.assert_allclose(vehicle.gyroscopic, -vehicle.gyroscopic.T)


def test_a_rigid_rise_lifts_the_whole_mass_and_strains_nothing(bogie):
    vehicle = build_vehicle(bogie, 4.0, 800.0)
    wheel, axle = bogie.wheel, bogie.axle
    outer = 2.0 * (axle.half_length - axle.middle_half_length) * axle.outer.mass_per_length
    middle = 2.0 * axle.middle_half_length * axle.middle.mass_per_length
    wheels = 2.0 * (wheel.hub.mass + wheel.rim.mass + bogie.stub.mass)
    total = bogie.car_body.mass + bogie.frame.mass + 2.0 * (outer + middle + wheels)
    np.testing.assert_allclose(vehicle.rise @ vehicle.mass @ vehicle.rise, total, rtol=1e-12)
    assert np.abs(vehicle.stiffness @ vehicle.rise).max() < 1e-3  # N/m, of 1e9


def test_wheel_loads_sum_to_the_weight(running):
    vehicle = running.straight.vehicle
    weight = 9.81 * vehicle.rise @ vehicle.mass @ vehicle.rise
    for state in (running.straight_equilibrium, running.equilibrium):
        assert state.status == "converged"
        # Longitudinal forces at yawed wheels have no vertical part: equality up to rounding.
        np.testing.assert_allclose(sum(wheel_loads(state).values()), weight, rtol=1e-6)


def test_lateral_rail_forces_hold_the_centripetal_force(running, line):
    results = running.equilibrium.results
    side = np.array(SIDE)[:, None]
    angle = results[..., patch.CONTACT_ANGLE]
    lateral = results[..., patch.LATERAL_FORCE] * np.cos(angle)
    lateral -= side * np.sin(angle) * results[..., patch.NORMAL_FORCE]
    along = results[..., patch.LONGITUDINAL_FORCE]
    vehicle = running.curve.vehicle
    mass = vehicle.rise @ vehicle.mass @ vehicle.rise
    expected = mass * line.track.speed**2 / line.track.radius
    # Axles are nearly parallel and yawed against the rails by what the frames of the track are not:
    # in their axes the forces of all wheels add.
    yaw = -np.repeat(angle_of_attack(running.curve, running.equilibrium), 2)
    lateral, along = lateral.sum(axis=1), along.sum(axis=1)
    in_the_axles = np.sum(lateral * np.cos(yaw) - along * np.sin(yaw))
    np.testing.assert_allclose(in_the_axles, expected, rtol=2e-3)  # rails turn by 1 mrad
    force = _contact_forces(running.curve, running.equilibrium.state).reshape(4, 6)
    np.testing.assert_allclose(force[:, 1].sum(), expected, rtol=1e-9)


def test_load_transfer_follows_the_overturning_moment(running, line):
    """Moments about the track centre against masses and heights of the parameters.

    The car body also leans on the support that stands for the omitted cars, and hubs and rims
    are turned as gyroscopes. Linear kinematics keep this balance to rounding; what they leave out
    is the weight of masses that move sideways over the wheels, 0.5 % of the moment.
    """
    system, state, bogie = running.curve, running.equilibrium.state, line.bogie
    vehicle, wheel, axle = running.curve.vehicle, bogie.wheel, bogie.axle
    roll = vehicle.frame_motion[:, track.ROLL :: 3].sum(axis=1)
    lean = vehicle.motion_of["car_body"][3, : system.size] @ state[: system.size]
    moment = roll @ vehicle.force_input @ _contact_forces(system, state)
    moment -= bogie.car_support.roll_stiffness * lean
    yaw_rate = line.track.speed / line.track.radius
    spins = 4.0 * (wheel.hub.spin_inertia + wheel.rim.spin_inertia) * vehicle.spin_rate
    outer = 2.0 * (axle.half_length - axle.middle_half_length) * axle.outer.mass_per_length
    beam = outer + 2.0 * axle.middle_half_length * axle.middle.mass_per_length
    heights = (
        bogie.car_body.mass * bogie.car_body.height
        + bogie.frame.mass * bogie.frame.height
        + 2.0 * beam * (wheel.radius - axle.drop)
        + 4.0 * bogie.stub.mass * bogie.stub.height
        + 4.0 * (wheel.hub.mass + wheel.rim.mass) * wheel.radius
    )
    expected = -heights * line.track.speed**2 / line.track.radius - spins * yaw_rate
    np.testing.assert_allclose(moment, expected, rtol=1e-9)


def _contact_forces(system, state):
    return contact_forces(system.contacts, system.curvatures, system.local(state))[0]


def test_the_vehicle_in_a_curve_is_unstrained_if_it_follows_rigidly(bogie):
    """Relative coordinates of a straight vehicle in a curve: offsets of the frames, undone."""
    vehicle = build_vehicle(bogie, 4.0, 800.0)
    frames = track.frame_motion(track.TrackLine(0.0, 0.0, 0.04, 0.0), 100.0, 0.85, 4.0)
    straight = -vehicle.frame_motion @ frames.offset.ravel()
    load = frame_loads(vehicle, frames, 0.0)
    inertia = vehicle.mass @ (vehicle.frame_motion @ frames.acceleration.ravel())
    gyroscopic = vehicle.gyroscopic @ (vehicle.frame_motion @ frames.turning.ravel())
    elastic = load + inertia + gyroscopic - vehicle.constant_load - vehicle.stiffness @ straight
    assert np.abs(elastic).max() < 1e-6 * np.abs(load).max()


def test_offset_of_the_frames_is_the_chord_of_the_curve():
    line, a, radius = track.TrackLine(0.0, 0.0, 1.0 / 25.0, 0.0), 0.85, 25.0
    frames = track.frame_motion(line, 50.0, a, 4.0)
    np.testing.assert_allclose(frames.offset[1:, track.YAW], [a / radius, -a / radius])
    exact = radius * (1.0 - np.cos(a / radius))
    np.testing.assert_allclose(frames.offset[1:, track.LATERAL], exact, rtol=1e-3)


@pytest.mark.parametrize("transition", [0.0, 6.0])
def test_rates_of_the_frames_are_the_derivatives_of_their_offsets(transition):
    line, speed, step = track.TrackLine(10.0, transition, 0.04, 0.05), 4.0, 1e-5
    for place in (9.5, 10.3, 12.0, 16.2, 30.0):
        frames = track.frame_motion(line, place, 0.85, speed)
        ahead, behind = (
            track.frame_motion(line, place + s * speed * step, 0.85, speed).offset
            for s in (1.0, -1.0)
        )
        np.testing.assert_allclose(frames.rate, (ahead - behind) / (2 * step), atol=1e-7)


def test_cant_that_balances_the_curve_equals_the_straight_track(line):
    """At V^2/R = g phi the lateral loads vanish."""
    vehicle = build_vehicle(line.bogie, 4.0, 800.0)
    balanced = track.TrackLine(0.0, 0.0, 0.04, 16.0 * 0.04 / 9.81)
    frames = track.frame_motion(balanced, 100.0, 0.85, 4.0)
    load = frame_loads(vehicle, frames, 9.81)
    lateral = vehicle.frame_motion[:, track.LATERAL :: 3].sum(axis=1)
    assert abs(load @ lateral) < 1e-6


def test_absorber_rotation_and_translation_load_the_axle_alike(line, running):
    """A translating absorber adds its mass to the weight, a rotating one does not."""
    design = line.bogie.absorber
    moving = design.model_copy(
        update={
            "motion": "translation",
            "direction": design.direction.model_copy(update={"x": 0.0, "z": 1.0}),
            "I_T": 10.0,
            "c_T": 1.2e6,
            "d_T": 500.0,
        }
    )
    with_mass = systems(line, moving, (0.0,))[0].vehicle
    without = running.straight.vehicle
    added = (
        with_mass.rise @ with_mass.mass @ with_mass.rise
        - without.rise @ without.mass @ without.rise
    )
    np.testing.assert_allclose(added, 40.0, rtol=1e-9)
    run = changed(line, moving, running)
    np.testing.assert_allclose(
        sum(wheel_loads(run.equilibrium).values()) - sum(wheel_loads(running.equilibrium).values()),
        40.0 * 9.81,
        rtol=1e-4,
    )


def test_rotating_absorbers_leave_the_equilibrium_alone(line, running):
    run = changed(line, absorber(line, 1.74e5, 300.0), running)
    for before, after in zip(
        wheel_loads(running.equilibrium).values(),
        wheel_loads(run.equilibrium).values(),
        strict=True,
    ):
        np.testing.assert_allclose(after, before, rtol=1e-6)


def test_an_absorber_outside_the_axle_is_refused(bogie):
    values = bogie.model_dump()
    values["absorber"]["lateral_position"] = 0.7
    with pytest.raises(ValidationError, match="absorber sits on the axle"):
        type(bogie).model_validate(values)


def test_a_negative_mass_is_refused(bogie):
    values = bogie.model_dump()
    values["frame"]["mass"] = -1600.0
    with pytest.raises(ValidationError, match="greater than or equal to 1"):
        type(bogie).model_validate(values)


def test_a_wheelbase_too_long_for_the_curve_is_refused(configuration):
    paper = configuration.lines["paper"]
    values = paper.model_dump()
    values["track"]["radius"] = 13.0  # 0.067 rad
    values["track"]["speed"] = 2.0
    with pytest.raises(ValidationError, match=r"half_wheelbase/track\.radius"):
        type(paper).model_validate(values)
