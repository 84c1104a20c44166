"""The track and the motion of the frames of reference that follow it.

Every axle and the centre of the bogie has a frame of its own on the track centre line: x along the
tangent, y to the left in the track plane, z up. The vehicle's coordinates are relative to them.
For small angles a frame's place relative to the tangent of the centre frame is a lateral offset, a
yaw angle and a roll angle (cant), all linear in the curvature.
"""

from typing import NamedTuple

import numpy as np

FRAMES = ("centre", "front", "rear")
LATERAL, YAW, ROLL = range(3)


class TrackLine(NamedTuple):
    """A left curve: curvature and cant grow from 0 at `start` to full at `start + transition`.

    start : m along the track; transition : m, 0 for a sudden curve
    curvature : 1/m; cant : rad, outer rail up (about x negative)
    """

    start: float
    transition: float
    curvature: float
    cant: float


def _ramp_integrals(line: TrackLine, s: float) -> tuple[float, float, float]:
    """Share of the full curve at s (m), its integral and the integral of that."""
    u = s - line.start
    if u <= 0.0:
        return 0.0, 0.0, 0.0
    length = line.transition
    if u < length:
        return u / length, u**2 / (2.0 * length), u**3 / (6.0 * length)
    beyond = u - length
    return 1.0, 0.5 * length + beyond, length**2 / 6.0 + 0.5 * length * beyond + 0.5 * beyond**2


def curvature(line: TrackLine, s: float) -> float:
    """Curvature at s in 1/m, to the left positive."""
    return line.curvature * _ramp_integrals(line, s)[0]


class FrameMotion(NamedTuple):
    """Place and motion of the three frames (`FRAMES`), each (3, 3): frame, (LATERAL, YAW, ROLL).

    offset : m, rad: relative to the centre frame
    rate : m/s, rad/s of the offset
    turning : absolute velocity: 0, yaw rate V kappa, roll rate
    acceleration : absolute: lateral V^2 kappa, yaw and roll rate of change
    gravity : (3,) roll angle of each frame to the horizontal, rad
    curvature : (3,) in 1/m
    """

    offset: np.ndarray
    rate: np.ndarray
    turning: np.ndarray
    acceleration: np.ndarray
    gravity: np.ndarray
    curvature: np.ndarray


def frame_motion(line: TrackLine, s: float, half_wheelbase: float, speed: float) -> FrameMotion:
    """Motion of the frames when the centre of the bogie is at s (m).

    Notes
    -----
    With tangent angle Theta(s) and lateral position Y(s) of the track, at distance x from the
    centre: yaw Theta(s + x) - Theta(s), lateral Y(s + x) - Y(s) - x Theta(s).
    """
    places = np.array([0.0, half_wheelbase, -half_wheelbase])
    share, angle, lateral = np.array([_ramp_integrals(line, s + x) for x in places]).T
    kappa, theta, y = line.curvature * share, line.curvature * angle, line.curvature * lateral
    roll = -line.cant * share
    on_ramp = (share > 0.0) & (share < 1.0)
    slope = np.where(on_ramp, 1.0 / max(line.transition, 1e-12), 0.0)
    zero = np.zeros(3)
    offset = np.column_stack([y - y[0] - places * theta[0], theta - theta[0], roll - roll[0]])
    roll_rate = -line.cant * slope * speed
    rate = speed * np.column_stack(
        [theta - theta[0] - places * kappa[0], kappa - kappa[0], (roll_rate - roll_rate[0]) / speed]
    )
    turning = np.column_stack([zero, speed * kappa, roll_rate])
    acceleration = np.column_stack([speed**2 * kappa, speed**2 * line.curvature * slope, zero])
    return FrameMotion(offset, rate, turning, acceleration, roll, kappa)


def corners(line: TrackLine, half_wheelbase: float) -> list[tuple[float, int]]:
    """Places (m) of the bogie's centre at which a frame passes an end of the transition.

    Returns
    -------
    Sorted pairs (place, frame): the turning of that frame jumps or its rate of change does.
    """
    ends = {line.start, line.start + line.transition}
    places = (0.0, half_wheelbase, -half_wheelbase)
    return sorted((end - x, frame) for end in ends for frame, x in enumerate(places))
