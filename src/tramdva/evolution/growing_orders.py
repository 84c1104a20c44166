"""Whole orders that grow over the speed, from the tendency over the frequency."""

from collections.abc import Mapping

import numpy as np

FAST = 0.1  # of the growth of the fastest order without absorbers


def order_tendency(
    order: np.ndarray, frequency: np.ndarray, tendency: np.ndarray, hertz: float
) -> np.ndarray:
    """Largest tendency (k,) of whole orders on any wheel; NaN outside the frequencies.

    Parameters
    ----------
    order : (k,)
    frequency : (f,) Hz, rising
    tendency : (wheels, f), growth per revolution
    hertz : Hz, of order 1
    """
    at = order * hertz
    values = np.array([np.interp(at, frequency, row) for row in tendency]).max(axis=0)
    return np.where((at >= frequency[0]) & (at <= frequency[-1]), values, np.nan)


def growing_orders(values: Mapping[str, np.ndarray], wheel_radius: float) -> dict[str, np.ndarray]:
    """Tendency of whole orders over the speed, and which of them grow, fast or fastest.

    Parameters
    ----------
    values : mapping
        ``absorber``, ``frequency`` (Hz), ``speed`` (m/s), ``speed_tendency`` (absorber, wheel,
        speed, frequency) and ``speed_status`` of ``tendency_maps``.
    wheel_radius : float
        m.

    Returns
    -------
    dict
        Variables of ``tendency_maps``. A fast order has at least the share `FAST` of the tendency
        of the fastest one without absorbers at this speed.
    """
    hertz, frequency = values["speed"] / (2.0 * np.pi * wheel_radius), values["frequency"]
    first = max(np.ceil(frequency[0] / hertz.max()), 1.0)
    order = np.arange(first, max(np.floor(frequency[-1] / hertz.min()), first) + 1.0)
    shape = *values["speed_status"].shape, order.size
    tendency = np.full(shape, np.nan)
    for absorber, k in np.argwhere(values["speed_status"] == "converged"):
        at_speed = values["speed_tendency"][absorber, :, k]
        tendency[absorber, k] = order_tendency(order, frequency, at_speed, hertz[k])
    bare = tendency[list(values["absorber"]).index("none")]
    height = np.where(np.isfinite(bare), bare, -np.inf).max(axis=1)
    grows = height > 0.0
    top = np.where(np.isfinite(bare), bare, -np.inf).argmax(axis=1)
    fastest = np.where(grows, order[top], np.nan)
    limit = np.where(grows, FAST * height, np.inf)
    return {
        "order": order,
        "speed_order_tendency": tendency,
        "order_grows": tendency > 0.0,
        "order_fast": tendency >= limit[:, None],
        "fast_share": np.float64(FAST),
        "fastest_order": fastest,
        "fastest_frequency": fastest * hertz,
    }
