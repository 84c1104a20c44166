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


def axis(limits: Mapping[str, float], points: int) -> np.ndarray:
    """Values (points,) at equal distances between ``min`` and ``max``."""
    return np.linspace(limits["min"], limits["max"], points)
