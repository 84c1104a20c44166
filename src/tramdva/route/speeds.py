"""Speeds at which a class is run: points and weights over the scatter between passages.

A whole order sweeps over a narrow mode when the speed scatters. The trapezoidal rule at equal steps
h converges geometrically for a smooth density: a mode whose half width is the share delta of its
frequency leaves an error like exp(-2 pi delta / h). So the step follows the narrowest mode.
"""

from typing import NamedTuple

import numpy as np

REACH = 3.0  # standard deviations on each side; what lies beyond is counted by the rest
STEP = 1.0  # of the narrowest mode's half width: leaves exp(-2 pi)
NODES = 4  # intervals between the speeds at which the vehicle is computed
SLOWEST, FASTEST = 10.0, 200.0  # Hz, of modes that waves of a wheel sweep over


class SpeedPoints(NamedTuple):
    """Points over the scatter of the speed.

    share : (p,) of the mean speed, rising; weight : (p,), their sum is 1
    node : (q,) places of the points at which the vehicle itself is computed
    """

    share: np.ndarray
    weight: np.ndarray
    node: np.ndarray

    def between(self) -> np.ndarray:
        """Shares (p, q) of the nodes in each point: linear interpolation."""
        if self.node.size == 1:
            return np.ones((self.share.size, 1))
        at = self.share[self.node]
        return np.array([np.interp(self.share, at, row) for row in np.eye(at.size)]).T


def narrowest(eigenvalue: np.ndarray) -> float:
    """Smallest half width of a mode over its frequency; 1 where there is none.

    Parameters
    ----------
    eigenvalue : (m,) complex, 1/s
    """
    turn = np.abs(eigenvalue.imag)
    swept = (turn > 2.0 * np.pi * SLOWEST) & (turn < 2.0 * np.pi * FASTEST)
    widths = np.abs(eigenvalue.real[swept]) / turn[swept]
    return float(widths.min(initial=1.0))


def intervals(scatter: float, width: float, most: int) -> int:
    """Steps over the scatter of the speed.

    Parameters
    ----------
    scatter : standard deviation, share of the mean
    width : of the narrowest mode, from `narrowest`
    most : points at most
    """
    if scatter == 0.0:
        return 0
    wanted = 2.0 * REACH * scatter / (STEP * max(width, 1e-6))
    return NODES * int(min(np.ceil(max(wanted / NODES, 2.0)), (most - 1) // NODES))


def speed_points(scatter: float, steps: int) -> SpeedPoints:
    """Points over a normal distribution of the speed.

    Parameters
    ----------
    scatter : standard deviation, share of the mean; without any all points are the mean
    steps : between the points, from `intervals`
    """
    if steps == 0:
        return SpeedPoints(np.ones(1), np.ones(1), np.zeros(1, int))
    if scatter == 0.0:
        weight = np.zeros(steps + 1)
        weight[steps // 2] = 1.0
        return SpeedPoints(np.ones(steps + 1), weight, np.array([steps // 2]))
    x = np.linspace(-REACH, REACH, steps + 1)
    weight = np.exp(-0.5 * x * x)
    weight[[0, -1]] *= 0.5
    node = np.arange(0, steps + 1, steps // NODES)
    return SpeedPoints(1.0 + scatter * x, weight / weight.sum(), node)


def halved(points: SpeedPoints) -> np.ndarray:
    """Weights (p,) of the rule with twice the step: zero at every other point."""
    if points.node.size == 1:
        return points.weight
    coarse = np.where(np.arange(points.share.size) % 2 == 0, points.weight, 0.0)
    return coarse / coarse.sum()
