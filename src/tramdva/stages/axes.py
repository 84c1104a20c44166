"""Axes of maps and diagrams, from the ranges of the configuration."""

from collections.abc import Mapping

import numpy as np


def design_axis(limits: Mapping[str, float], points: int, own: float) -> np.ndarray:
    """Values of stiffness or damping in equal ratios, of which one is the line's own.

    Parameters
    ----------
    limits : mapping
        ``min`` and ``max``, both positive.
    points : int
        Number of values.
    own : float
        Replaces the value next to it; beyond the limits it is one value more.

    Returns
    -------
    (points,) or (points + 1,) array
        Rising.
    """
    axis = np.geomspace(limits["min"], limits["max"], points)
    if not limits["min"] <= own <= limits["max"]:
        return np.sort(np.append(axis, own))
    axis[np.argmin(np.abs(np.log(axis / own)))] = own
    return axis


def best_design(aim: np.ndarray, c_T: np.ndarray, d_T: np.ndarray) -> tuple[float, float, float]:
    """Design of the smallest aim.

    Parameters
    ----------
    aim : (d_T, c_T) array
        What is to be small, NaN where there is none.
    c_T, d_T : (k,), (m,) arrays
        Stiffness and damping of the designs.

    Returns
    -------
    c_T, d_T, aim : float
        NaN where no design has an aim.
    """
    if not np.isfinite(aim).any():
        return np.nan, np.nan, np.nan
    i, j = np.unravel_index(np.nanargmin(aim), aim.shape)
    return float(c_T[j]), float(d_T[i]), float(aim[i, j])


def axis(limits: Mapping[str, float], points: int) -> np.ndarray:
    """Values (points,) at equal distances between ``min`` and ``max``."""
    return np.linspace(limits["min"], limits["max"], points)


def reaching(limits: Mapping[str, float], own: float) -> dict[str, float]:
    """Return limits of an axis, widened where the line's own value lies beyond their end."""
    beyond = own > limits["max"]
    return {"min": limits["min"], "max": 1.25 * own if beyond else limits["max"]}
