"""Growth of wheel orders over kilometres: exact for small waves.

An order of a wheel that turns by itself changes by exp(-H) in a revolution, H its complex wear
response. Over a distance the revolutions in every condition add up in the exponent, whatever their
sequence:

    R_n(s) = R_n(0) exp(gamma_n s),        gamma_n = - scale sum_i N_i H_n,i,

N_i revolutions per distance in condition i. The real part is the growth, the imaginary part the
drift of the wave around the wheel.
"""

from typing import NamedTuple

import numpy as np

from tramdva.evolution.out_of_roundness import REFERENCE
from tramdva.route.parameters import InitialSpectrum

ANGLES = 1024  # points of a profile at least, for its peak to peak value
PER_ORDER = 16  # points of the shortest wave
DISTANCE_STATUS = ("reached", "beyond_horizon", "beyond_at_once", "no_steady_answer")


def initial_amplitudes(orders: np.ndarray, spectrum: InitialSpectrum) -> np.ndarray:
    """Complex amplitudes (o,) in m of a wheel that was just turned.

    Parameters
    ----------
    orders : (o,)
    spectrum : level of order 1, its slope, seed of the phases

    Notes
    -----
    The phase of an order does not depend on which other orders are told.
    """
    level = spectrum.level_dB + spectrum.slope_dB_per_octave * np.log2(orders)
    size = np.sqrt(2.0) * REFERENCE * 10.0 ** (level / 20.0)
    phases = np.random.default_rng(spectrum.seed).uniform(-np.pi, np.pi, int(orders.max()))
    return size * np.exp(1j * phases[orders.astype(int) - 1])


def peak_to_peak(orders: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    """Peak to peak value (...) in m of profiles with complex amplitudes (..., o)."""
    count = max(ANGLES, PER_ORDER * int(orders.max()))
    spectrum = np.zeros((*amplitudes.shape[:-1], count // 2 + 1), complex)
    spectrum[..., orders.astype(int)] = amplitudes
    profile = np.fft.irfft(spectrum, count, axis=-1) * (count / 2.0)
    return np.ptp(profile, axis=-1)


class Distance(NamedTuple):
    """Distance in km to a limit (NaN where there is none), and its status."""

    km: float
    status: str


def grown(initial: np.ndarray, growth: np.ndarray, distance: np.ndarray) -> np.ndarray:
    """Amplitudes (k, o) after distances (k,) in km from those at first; growth (o,) per 1000 km."""
    with np.errstate(over="ignore"):
        exponent = growth * (distance[:, None] / 1000.0)
        return initial * np.exp(np.minimum(exponent.real, 300.0) + 1j * exponent.imag)


def distance_to_limit(
    orders: np.ndarray, initial: np.ndarray, growth: np.ndarray, limit: float, horizon: float
) -> Distance:
    """Distance at which a profile first is as rough as a limit.

    Parameters
    ----------
    orders : (o,); initial : (o,) complex, m
    growth : (o,) complex per 1000 km
    limit : m, peak to peak
    horizon : km, beyond which is not looked

    Notes
    -----
    Peak to peak need not rise steadily: it is bracketed in steps in which the fastest order grows
    by a tenth, then bisected.
    """
    if not np.isfinite(growth).all():
        return Distance(np.nan, "no_steady_answer")
    fastest = np.abs(growth).max()
    step = max(0.1 * 1000.0 / max(fastest, 1e-12), 1e-4 * horizon)

    def excess(km: np.ndarray) -> np.ndarray:
        return peak_to_peak(orders, grown(initial, growth, np.atleast_1d(km))) - limit

    if excess(np.zeros(1))[0] >= 0.0:
        return Distance(0.0, "beyond_at_once")
    start = 0.0
    while start < horizon:
        km = np.minimum(start + step * np.arange(1, 65), horizon)
        over = np.flatnonzero(excess(km) >= 0.0)
        if over.size:
            low = km[over[0] - 1] if over[0] else start
            return Distance(_bisected(excess, low, km[over[0]]), "reached")
        start = float(km[-1])
    return Distance(np.nan, "beyond_horizon")


def _bisected(excess, low: float, high: float) -> float:
    while high - low > 1e-6 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if excess(middle)[0] >= 0.0 else (middle, high)
    return float(high)


def wheel_life(interval: float, cut: float, wear: float, usable: float) -> float:
    """Kilometres of a wheel from new to worn out.

    Parameters
    ----------
    interval : km between turnings
    cut : m of radius per turning; wear : m of radius per km; usable : m of radius
    """
    return usable / (cut / interval + wear)
