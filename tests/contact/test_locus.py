"""One column of a contact table beside an average over every point of the wheel."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tramdva.contact import geometry, locus, profiles

RADIUS, EPSILON = 0.3, 8e-6


def all_points(wheel, rail, shift, roll, yaw):
    """Height, positions on wheel and rail and log curvature, no point of the wheel left out."""
    curve, length, cosine = np.empty((2, wheel.shape[1])), *np.empty((2, wheel.shape[1]))
    locus.silhouette(*wheel[:3], RADIUS, np.tan(yaw) ** 2, roll, *curve)
    locus.arc_lengths(*curve, length, cosine)
    place = shift + curve[0]
    held = np.clip(place, rail.position[0], rail.position[-1])
    gap = rail.depth_at(held) + rail.slope_at(held) * (place - held) - curve[1]
    low = gap.min()
    exponent = (gap - low) * cosine / EPSILON
    exponent[(gap - low > locus.MARGIN) | (exponent > locus.CUT)] = np.inf
    heights = {}
    for scale in (1.0, 0.5):
        weight = length * np.exp(-exponent / scale)
        width = np.sqrt(2.0 * np.pi * scale * EPSILON / locus.REFERENCE_CURVATURE)
        slope = np.average(cosine, weights=weight)
        heights[scale] = low - scale * EPSILON / slope * np.log(weight.sum() / width)
    weight = length * np.exp(-exponent)
    mean = np.average(place, weights=weight)
    spacing = rail.position[1] - rail.position[0]
    variance = max(np.average((place - mean) ** 2, weights=weight), spacing**2)
    slope = np.average(cosine, weights=weight)
    return (
        2.0 * heights[0.5] - heights[1.0],
        np.average(wheel[0], weights=weight),
        mean,
        np.log(EPSILON * slope**2 / variance),
    )


def roughened(profile, height, length):
    """The profile with a wave on it, which makes several places touch at once."""
    turn = 2.0 * np.pi / length
    phase = turn * profile.position
    return profiles.Profile(
        profile.name,
        profile.kind,
        profile.position,
        profile.depth + height * np.sin(phase),
        profile.slope + height * turn * np.cos(phase),
    )


@pytest.mark.parametrize("wave", [(0.0, 1e-3), (20e-6, 3e-3), (60e-6, 1.3e-3)])
def test_no_point_that_matters_is_left_out(wave):
    wheel, rail = profiles.tram_wheel(), roughened(profiles.grooved_rail(), *wave)
    points = np.array(geometry._zone(wheel, None, None))[:, :: geometry.WHEEL_STRIDE].copy()
    grid = rail.position[0], rail.position[1] - rail.position[0]
    rng = np.random.default_rng(12)
    for _ in range(60):
        shift, roll, yaw = rng.uniform((-6e-3, -0.012, 0.0), (3e-3, 0.012, 0.05))
        out = np.zeros((1, 1, 1, locus.STRIDE))
        locus.fill_table(
            points, RADIUS, 0.0, grid, np.array([rail.depth, rail.slope]), np.array([shift]),
            np.array([roll]), np.array([np.tan(yaw) ** 2]), EPSILON, out,
        )  # fmt: skip
        found = out[0, 0, 0]
        height, on_wheel, on_rail, bend = all_points(points, rail, shift, roll, yaw)
        assert_allclose(found[locus.HEIGHT], height, atol=1e-12)
        assert_allclose(
            found[[locus.WHEEL_POSITION, locus.RAIL_POSITION]], [on_wheel, on_rail], atol=1e-12
        )
        assert_allclose(found[locus.LOG_CURVATURE], bend, atol=1e-6)
