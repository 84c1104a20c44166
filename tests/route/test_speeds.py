"""Means over the scatter of the speed, beside their closed form."""

import numpy as np
import pytest
from scipy.special import wofz

from tramdva.route.speeds import halved, intervals, narrowest, speed_points


def mean_of_a_mode(turn: float, scatter: float, eigenvalue: complex) -> complex:
    """Mean of 1 / (i w x - lambda) over a normal x about 1: a Faddeeva function.

    With x = 1 + sigma t and z = (i w - lambda) / (i w sigma): E[1 / (t + z)] / (i w sigma), and
    E[1 / (t - u)] = i sqrt(pi/2) w(u / sqrt 2) for Im u > 0.
    """
    z = (1j * turn - eigenvalue) / (1j * turn * scatter)
    u = -z
    if u.imag > 0.0:
        mean = 1j * np.sqrt(np.pi / 2.0) * wofz(u / np.sqrt(2.0))
    else:
        mean = np.conj(1j * np.sqrt(np.pi / 2.0) * wofz(np.conj(u) / np.sqrt(2.0)))
    return mean / (1j * turn * scatter)


@pytest.mark.parametrize("scatter", [0.01, 0.05, 0.1])
@pytest.mark.parametrize("order_over_mode", [0.93, 1.0, 1.02])
def test_mean_over_a_narrow_mode(scatter, order_over_mode):
    eigenvalue = -4.0 + 1j * 2.0 * np.pi * 55.0
    turn = order_over_mode * eigenvalue.imag
    points = speed_points(scatter, intervals(scatter, narrowest(np.array([eigenvalue])), 401))
    found = points.weight @ (1.0 / (1j * turn * points.share - eigenvalue))
    wanted = mean_of_a_mode(turn, scatter, eigenvalue)
    # What lies beyond three standard deviations (0.27 %) and 2 exp(-2 pi) of the rule.
    assert abs(found - wanted) < 7e-3 * abs(mean_of_a_mode(eigenvalue.imag, scatter, eigenvalue))


def test_without_scatter_the_mean_speed_alone_counts():
    points = speed_points(0.0, 16)
    np.testing.assert_array_equal(points.share, 1.0)
    assert points.weight @ points.between()[:, 0] == 1.0
    assert speed_points(0.0, intervals(0.0, 0.01, 81)).share.size == 1


@pytest.mark.parametrize("steps", [8, 36])
def test_weights_of_both_rules_sum_to_one_and_nodes_interpolate_lines(steps):
    points = speed_points(0.05, steps)
    assert points.weight.sum() == pytest.approx(1.0)
    assert halved(points).sum() == pytest.approx(1.0)
    line = 3.0 - 2.0 * points.share
    np.testing.assert_allclose(points.between() @ line[points.node], line, rtol=1e-12)
