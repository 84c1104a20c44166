"""Whether points of a profile are those of what they are said to be: in place, paired, smooth.

Points (n, 2) in mm as files hold them: y outwards, rising, and z downwards.
"""

from __future__ import annotations

import numpy as np

TOP_WIDTH_MM = 4.0  # over which depths are averaged: single points are noisy
FARTHEST_TOP_MM = 3.0
LEAST_RISE_MM = 0.01  # a flat head has no top to speak of
FLANGE_FROM_MM, LEVELS = 4.0, 20  # depths below the running surface where flanges guide
LARGEST_PLAY_MM = 7.0  # range of the contact tables to each side
NOISE_FACTOR = 3.0  # of the noise that is expected
ALWAYS_ALLOWED_MM, NEVER_ALLOWED_MM = 0.01, 0.05  # of good gauges; beyond, no curvature is left
_BESIDE = 8  # points between which the direction of the profile is taken
_OF_THIRD_DIFFERENCE = np.sqrt(20.0)  # standard deviation of white noise of one
_OF_MEDIAN = 1.4826  # standard deviation over the median of magnitudes, normal distribution


def top_of_rail(points: np.ndarray) -> tuple[float, float]:
    """Where the highest point of a rail lies, and how far above that at y = 0, in mm."""
    y, z = points.T
    places = np.append(y, 0.0)
    near = np.abs(y[:, None] - places) <= 0.5 * TOP_WIDTH_MM
    smooth = (z[:, None] * near).sum(axis=0) / np.maximum(near.sum(axis=0), 1)
    smooth[near.sum(axis=0) == 0] = np.inf
    lowest = int(smooth.argmin())
    return float(places[lowest]), float(smooth[-1] - smooth[lowest])


def noise_of(points: np.ndarray) -> float:
    """Standard deviation in mm of the points across the profile, from their third differences.

    What is smooth hardly counts in these, and corners do not count in their median.
    """
    place = np.arange(len(points))
    ahead, behind = np.clip([place + _BESIDE, place - _BESIDE], 0, len(points) - 1)
    along = points[ahead] - points[behind]  # noise must not turn it
    across = np.column_stack([-along[:, 1], along[:, 0]])
    across /= np.linalg.norm(across, axis=1)[:, None]
    third = np.diff(points, 3, axis=0)
    magnitude = np.abs((third * across[1:-2]).sum(axis=1))
    return float(_OF_MEDIAN * np.median(magnitude) / _OF_THIRD_DIFFERENCE)


def flange_play(wheel: np.ndarray, rail: np.ndarray, lateral_position: float) -> float:
    """Smallest distance in mm across the track of the flange from the gauge corner.

    Parameters
    ----------
    wheel, rail : (n, 2) points in mm, with the tape circle and the rail's top at y = 0
    lateral_position : mm, top of the rail outside the tape circle of the centred wheelset

    Returns
    -------
    float
        Negative where the flange would cut into the rail; infinity where they share no depth.
    """
    flange, corner = (part[part[:, 0] < 0.0] for part in (wheel, rail))
    depth = flange[:, 1] - np.interp(0.0, *wheel.T), corner[:, 1] - rail[:, 1].min()
    levels = np.linspace(FLANGE_FROM_MM, min(d.max() for d in depth), LEVELS)
    levels = levels[levels <= min(d.max() for d in depth)]
    play = [
        corner[depth[1] >= level, 0].max() + lateral_position - flange[depth[0] >= level, 0].max()
        for level in levels
    ]
    return float(min(play, default=np.inf))
