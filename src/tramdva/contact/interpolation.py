"""Uniform tables read by compiled code: cubic Hermite in one variable.

A table row holds, for one node, the values of all columns followed by their slopes. Hermite
interpolation keeps values and first derivatives continuous across nodes.
"""

import numpy as np
import scipy  # its parts load when they are used: many short jobs need none
from numba import njit


def sample_spline(
    nodes: np.ndarray, values: np.ndarray, first: float, step: float, count: int
) -> np.ndarray:
    """Sample a cubic spline and its slope on a uniform grid.

    Parameters
    ----------
    nodes : (n,) array, increasing
    values : (n, m) array
    first, step : grid start and spacing, unit of `nodes`
    count : number of grid points

    Returns
    -------
    (count, 2 m) array: values, then slopes times `step`.
    """
    spline = scipy.interpolate.CubicSpline(nodes, values, axis=0)
    grid = first + step * np.arange(count)
    return np.ascontiguousarray(np.hstack([spline(grid), step * spline(grid, 1)]))


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def hermite(table, index, fraction, column):
    """Value at `fraction` in [0, 1] of cell `index`; slopes stand behind the values."""
    slope = column + table.shape[1] // 2
    t = fraction
    left, right = table[index, column], table[index + 1, column]
    return (
        left
        + t * table[index, slope]
        + t
        * t
        * (
            3.0 * (right - left)
            - 2.0 * table[index, slope]
            - table[index + 1, slope]
            + t * (2.0 * (left - right) + table[index, slope] + table[index + 1, slope])
        )
    )


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def locate(table, first, step, position):
    """Cell index and fraction of `position` (the unit of `first` and `step`), held at the ends.

    Also for NaN.
    """
    scaled, last = (position - first) / step, table.shape[0] - 1.000001
    scaled = scaled if scaled > 0.0 else 0.0
    scaled = scaled if scaled < last else last
    index = int(scaled)
    return index, scaled - index
