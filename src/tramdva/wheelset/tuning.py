"""Tuning of the absorber of the basic model (Table 2).

References
----------
J. P. Den Hartog, Mechanical Vibrations, 4th ed., 1956, section 3.3; section "Forced excitation due
to initial wheel OOR" of the paper.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from tramdva.wheelset.model import WheelsetParameters
from tramdva.wheelset.response import peak_receptance, response
from tramdva.wheelset.stability import growth_rate


class Design(NamedTuple):
    """Stiffness (N/m) and damping coefficient (N s/m) of an absorber."""

    c_T: float
    d_T: float


def den_hartog(values: WheelsetParameters) -> Design:
    """Den Hartog's equal peaks for the 1-DOF primary system (m_A, c_A).

    Notes
    -----
    With ``mu = m_T / m_A`` and ``omega_n^2 = c_A / m_A``: ``c_T = m_T (omega_n / (1 + mu))^2``,
    ``d_T = 2 m_T omega_n sqrt(3 mu / (8 (1 + mu)^3))``.

    Examples
    --------
    For the wheelset of Table 1 this is the stiffness of the absorber in Table 2, 4.3 MN/m; its
    damping there, 6.85 kN s/m, is larger by the square root of two.

    >>> from tramdva.wheelset.published import paper_wheelset
    >>> from tramdva.wheelset.tuning import den_hartog
    >>> design = den_hartog(paper_wheelset())
    >>> print(f"{design.c_T / 1e6:.2f} MN/m, {design.d_T / 1e3:.2f} kN s/m")
    4.30 MN/m, 4.84 kN s/m
    >>> print(f"{2**0.5 * design.d_T / 1e3:.2f} kN s/m")
    6.85 kN s/m
    """
    mu = values.m_T / values.m_A
    omega_n = np.sqrt(values.c_A / values.m_A)
    c_T = values.m_T * (omega_n / (1.0 + mu)) ** 2
    d_T = 2.0 * values.m_T * omega_n * np.sqrt(3.0 * mu / (8.0 * (1.0 + mu) ** 3))
    return Design(float(c_T), float(d_T))


def den_hartog_sqrt2(values: WheelsetParameters) -> Design:
    """Den Hartog's stiffness with sqrt(2) times his damping, which comes to the d_T of Table 2.

    Notes
    -----
    ``d_T = 2 sqrt(c_T m_T) sqrt(3 mu / (4 (1 + mu)))``.
    """
    c_T, d_T = den_hartog(values)
    return Design(c_T, float(np.sqrt(2.0) * d_T))


# Tuned frequency (multiples of that of the axle mode) and damping ratio that optimisations search.
_FREQUENCY_RATIOS = np.geomspace(0.3, 3.0, 61)
_DAMPING_RATIOS = np.geomspace(0.01, 2.0, 41)


def _from_ratios(values: WheelsetParameters, ratio: Any, damping_ratio: Any) -> tuple[Any, Any]:
    """c_T and d_T of a tuned frequency over sqrt(c_A/m_A) and a damping ratio."""
    omega = ratio * np.sqrt(values.c_A / values.m_A)
    return values.m_T * omega**2, 2.0 * damping_ratio * values.m_T * omega


def _optimised(
    values: WheelsetParameters,
    coarse: Callable[[WheelsetParameters], np.ndarray],
    fine: Callable[[WheelsetParameters], float],
) -> Design | None:
    """Best frequency and damping ratios: a grid, then Nelder-Mead (the aims have kinks)."""
    c_T, d_T = _from_ratios(values, _FREQUENCY_RATIOS[:, None], _DAMPING_RATIOS[None, :])
    aims = coarse(values._replace(c_T=c_T, d_T=d_T))
    if not np.isfinite(aims).any():
        return None
    i, j = np.unravel_index(np.nanargmin(np.where(np.isfinite(aims), aims, np.inf)), aims.shape)

    def aim(logarithms: np.ndarray) -> float:
        c, d = _from_ratios(values, *np.exp(logarithms))
        return fine(values._replace(c_T=float(c), d_T=float(d)))

    start = np.log([_FREQUENCY_RATIOS[i], _DAMPING_RATIOS[j]])
    simplex = start + np.array([[0.0, 0.0], [0.03, 0.0], [0.0, 0.1]])
    options = {"xatol": 1e-10, "fatol": 1e-14 * abs(aims[i, j]), "maxfev": 2000}
    found = minimize(
        aim, start, method="Nelder-Mead", options={**options, "initial_simplex": simplex}
    )
    c, d = _from_ratios(values, *np.exp(found.x))
    return Design(float(c), float(d))


def minimal_spectral_abscissa(values: WheelsetParameters) -> Design:
    """Absorber of given mass (kg) with the smallest largest growth rate; N/m and N s/m."""

    def growth(candidates: WheelsetParameters) -> Any:
        return growth_rate(candidates, True)

    design = _optimised(values, growth, lambda candidate: float(growth(candidate)))
    assert design is not None  # growth rates are always finite
    return design


def minimal_abscissa_damping(values: WheelsetParameters) -> Design:
    """Damping (N s/m) with the smallest largest growth rate at the given stiffness c_T (N/m)."""

    def growth(logarithm: Any) -> np.ndarray:
        return growth_rate(values._replace(d_T=np.exp(logarithm)), True)

    critical = 2.0 * np.sqrt(values.c_T * values.m_T)
    samples = np.log(critical * _DAMPING_RATIOS)
    k = int(np.clip(np.argmin(growth(samples)), 1, len(samples) - 2))
    found = minimize_scalar(
        growth, bounds=(samples[k - 1], samples[k + 1]), method="bounded", options={"xatol": 1e-10}
    )
    return Design(values.c_T, float(np.exp(found.x)))


def h_infinity(
    values: WheelsetParameters, operating_B: float, frequency: np.ndarray
) -> Design | None:
    """Absorber of given mass with the smallest peak receptance and no self-excitation in operation.

    Parameters
    ----------
    values : WheelsetParameters
        At the friction decrease B of the forced excitation; SI units.
    operating_B : float
        Friction decrease in s/m at which the growth rate must be negative.
    frequency : (k,) array
        Samples of the frequency in Hz.

    Returns
    -------
    Design or None
        None if no absorber of this mass is free of self-excitation at both values of B.
    """

    def unstable(candidates: WheelsetParameters) -> np.ndarray:
        rates = (growth_rate(candidates._replace(B=B), True) for B in (values.B, operating_B))
        return np.maximum(*rates) >= 0.0

    def coarse(candidates: WheelsetParameters) -> np.ndarray:
        sparse = frequency[:: max(1, len(frequency) // 400)]
        stacked = WheelsetParameters(*(np.asarray(value)[..., None] for value in candidates))
        peaks = np.abs(response(stacked, True, sparse).receptance).max(axis=-1)
        return np.where(unstable(candidates), np.inf, peaks)

    def fine(candidate: WheelsetParameters) -> float:
        if unstable(candidate):
            return np.inf
        return peak_receptance(candidate, True, frequency).amplitude

    return _optimised(values, coarse, fine)
