"""Out-of-roundness of a wheel: radius deviation over the wheel angle, its orders and levels.

The wheel angle counts material points against the rotation: the point at angle theta touches the
rail when the wheel has turned by theta. A crest is positive:

    r(theta) = sum over orders n of A_n cos(n theta + phi_n) = Re sum R_n exp(i n theta)
"""

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tramdva.contact.two_columns import Layout, read_columns

REFERENCE = 1e-6  # m, of levels
LARGEST_DEVIATION = 5e-3  # m; beyond, a file is in other units or of no wheel
SMALLEST_RANGE = 1e-6  # m; less than what gauges resolve and what turning leaves of a wheel
LARGEST_GAP = 15.0  # degrees between neighbours


class RoundnessError(ValueError):
    """A file is no measurement of a wheel's out-of-roundness."""


LAYOUT = Layout(
    "angle in degrees and deviation in um",
    RoundnessError,
    fewest=36,
    most=200_000,
    largest=10_000_000,
)


class Measurement(NamedTuple):
    """Measured radius deviation: angle (k,) in rad from 0 to below 2 pi, deviation (k,) in m."""

    angle: np.ndarray
    deviation: np.ndarray


def radius_deviation(orders: ArrayLike, amplitudes: ArrayLike, angle: ArrayLike) -> np.ndarray:
    """Radius deviation in m at wheel angles.

    Parameters
    ----------
    orders : (k,) waves around the wheel
    amplitudes : (k,) complex, R_n in m
    angle : (m,) in rad
    """
    waves = np.exp(1j * np.outer(np.asarray(angle, float), np.asarray(orders, float)))
    return (waves @ np.asarray(amplitudes, complex)).real


def order_amplitudes(angle: np.ndarray, values: np.ndarray, orders: Iterable[int]) -> np.ndarray:
    """Complex amplitudes of orders in a periodic function of the wheel angle.

    Parameters
    ----------
    angle : (k,) in rad, increasing over one turn, not necessarily uniform
    values : (k,)
    orders : (n,) integers; order 0 gives the mean

    Returns
    -------
    (n,) complex, such that the function is Re sum A_n exp(i n angle).

    Notes
    -----
    Between the points the function is taken as linear and integrated exactly with the waves, so
    that gaps do not count as zero. For k uniform points this is the discrete Fourier transform
    times sinc(n / k)^2.
    """
    angle, values = np.asarray(angle, float), np.asarray(values, float)
    start = np.append(angle, angle[0] + 2.0 * np.pi)
    width, left = np.diff(start), values
    rise = np.append(values[1:], values[0]) - values
    out = []
    for order in orders:
        if order == 0:
            out.append(np.sum(width * (left + 0.5 * rise)) / (2.0 * np.pi))
            continue
        # Integrals over a stretch of exp(-i n w u) and u exp(-i n w u), u = 0 .. 1.
        x = -1j * order * width
        whole = np.expm1(x) / x
        ramp = (np.exp(x) - whole) / x
        part = width * np.exp(-1j * order * angle) * (left * whole + rise * ramp)
        out.append(np.sum(part) / np.pi)
    return np.array(out)


def level(amplitude: np.ndarray) -> np.ndarray:
    """Level in dB re 1 um of the effective value of a wave with an amplitude in m."""
    with np.errstate(divide="ignore"):
        return 20.0 * np.log10(np.abs(amplitude) / np.sqrt(2.0) / REFERENCE)


def read_measurement(path: str | Path) -> Measurement:
    """Read a measured out-of-roundness.

    Parameters
    ----------
    path : text file of two columns, angle in degrees and deviation in um (crest positive), as
        `read_columns` reads them

    Raises
    ------
    RoundnessError
        With file, line and what is wrong.
    """
    points, _ = read_columns(path, LAYOUT)
    angle, deviation = points[:, 0], 1e-6 * points[:, 1]
    if np.any(np.diff(angle) <= 0.0):
        k = int(np.argmax(np.diff(angle) <= 0.0))
        raise RoundnessError(f"{path}: angle {angle[k + 1]:g} after {angle[k]:g} must be larger")
    if angle[0] < 0.0 or angle[-1] > 360.0:
        raise RoundnessError(
            f"{path}: angles {angle[0]:g} to {angle[-1]:g}; 0 to 360 degrees are allowed"
        )
    if angle[-1] - angle[0] == 360.0:  # the first point is given again at the end
        angle, deviation = angle[:-1], deviation[:-1]
    gaps = np.diff(np.append(angle, angle[0] + 360.0))
    if gaps.max() > LARGEST_GAP:
        k = int(np.argmax(gaps))
        raise RoundnessError(
            f"{path}: no point for {gaps[k]:g} degrees after {angle[k]:g}; at most "
            f"{LARGEST_GAP:g} degrees are allowed (a whole turn, angle in degrees)"
        )
    if np.abs(deviation).max() > LARGEST_DEVIATION:
        raise RoundnessError(
            f"{path}: deviation of {1e6 * np.abs(deviation).max():g} um; at most "
            f"{1e6 * LARGEST_DEVIATION:g} um are allowed (deviation in um, not the radius)"
        )
    if np.ptp(deviation) < SMALLEST_RANGE:
        raise RoundnessError(
            f"{path}: the deviation varies by {1e6 * np.ptp(deviation):.3g} um in all; at least "
            f"{1e6 * SMALLEST_RANGE:g} um are needed (deviation in um, not in mm or m)"
        )
    return Measurement(np.radians(angle), deviation - deviation.mean())
