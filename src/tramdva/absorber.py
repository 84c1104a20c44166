"""Tuning of the absorber and frequency response of the wheelset (Table 2, figure 7).

A harmonic force acts on the rim at the wheel-rail contact, eq. (16); the response is linearised
about the steady state in the curve.

References
----------
J. P. Den Hartog, Mechanical Vibrations, 4th ed., 1956, section 3.3; section "Forced excitation due
to initial wheel OOR" of the paper.
"""

import logging
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from tramdva.critical_absorber import critical_point_at
from tramdva.stability import growth_rate
from tramdva.wheelset import WheelsetParameters, equilibrium, linearised, wheelset_parameters

logger = logging.getLogger(__name__)


class Response(NamedTuple):
    """Complex responses per unit force, in m/N: rim and stroke y_T - y_A of the absorber."""

    receptance: np.ndarray
    stroke: np.ndarray


def response(values: WheelsetParameters, with_absorber: bool, frequency: np.ndarray) -> Response:
    """Response of the rim to a lateral force on it.

    Parameters
    ----------
    values : WheelsetParameters
        Numbers or arrays that broadcast with the frequency; SI units.
    with_absorber : bool
        Whether the absorber is mounted.
    frequency : array
        In Hz.

    Returns
    -------
    Response
        Positive force and position point to the centre of the curve. The stroke is 0 without
        absorber.

    Notes
    -----
    With the dynamic stiffnesses A, T, R of the bodies and t, r of the couplings::

        y_R / F = 1 / (R - r^2 / (A - t^2 / T))
    """
    p = values
    s = 2j * np.pi * np.asarray(frequency)
    Omega2 = p.Omega**2
    shape = np.broadcast_shapes(*(np.shape(value) for value in values))
    kappa = linearised(values, with_absorber).kappa.reshape(shape)
    r = p.d_R * s + p.c_R
    A = p.m_A * (s**2 - Omega2) + p.d_A * s + p.c_A + r
    R = p.m_R * (s**2 - Omega2) + kappa * s + r
    transfer = np.zeros(np.broadcast_shapes(shape, s.shape))
    if with_absorber:
        t = p.d_T * s + p.c_T
        transfer = t / (p.m_T * (s**2 - Omega2) + t)  # y_T / y_A
        A = A + t - t * transfer
    receptance = 1.0 / (R - r**2 / A)
    stroke = (transfer - 1.0) * r / A * receptance if with_absorber else 0.0 * receptance
    return Response(receptance, stroke)


class Peak(NamedTuple):
    """Largest value of a response and its frequency in Hz."""

    amplitude: float
    frequency: float


def largest_peak(amplitude: Callable[[np.ndarray], np.ndarray], frequency: np.ndarray) -> Peak:
    """Largest value of a function of the frequency, sampled and then refined.

    Parameters
    ----------
    amplitude : callable
        Function of the frequency (k,) in Hz.
    frequency : (k,) array
        Samples.

    Returns
    -------
    Peak
    """
    sampled = amplitude(frequency)
    k = int(np.argmax(sampled))
    if k in (0, len(frequency) - 1):
        return Peak(float(sampled[k]), float(frequency[k]))
    found = minimize_scalar(
        lambda f: -float(amplitude(np.array([f]))[0]),
        bounds=(frequency[k - 1], frequency[k + 1]),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return Peak(float(-found.fun), float(found.x))


def peak_receptance(values: WheelsetParameters, with_absorber: bool, frequency: np.ndarray) -> Peak:
    """Largest receptance in m/N over sampled frequencies (Hz), refined."""
    return largest_peak(lambda f: np.abs(response(values, with_absorber, f).receptance), frequency)


def peak_stroke(values: WheelsetParameters, frequency: np.ndarray) -> Peak:
    """Largest stroke of the absorber per force in m/N over sampled frequencies (Hz), refined."""
    return largest_peak(lambda f: np.abs(response(values, True, f).stroke), frequency)


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
    """Absorber of given mass with the smallest largest growth rate of the linearised wheelset."""

    def growth(candidates: WheelsetParameters) -> Any:
        return growth_rate(candidates, True)

    design = _optimised(values, growth, lambda candidate: float(growth(candidate)))
    assert design is not None  # growth rates are always finite
    return design


def minimal_abscissa_damping(values: WheelsetParameters) -> Design:
    """Damping with the smallest largest growth rate at the given stiffness c_T."""

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


def absorber_tuning(
    cfg: Mapping[str, Any], critical_hopf_curve: Mapping[str, Any]
) -> dict[str, np.ndarray]:
    """Absorber designs of given mass side by side (Table 2).

    Parameters
    ----------
    cfg : mapping
        Physical sections with the absorber of the line, ``forced_excitation`` (B), ``study``
        (frequency range) and ``numerics`` (frequency_points).
    critical_hopf_curve : mapping
        Variables of ``critical_hopf_curve.nc``.

    Returns
    -------
    dict
        Variables of ``absorber_tuning.nc``. Receptances and strokes hold at the B of the forced
        excitation, the growth rate and the critical stiffness at that of operation.
    """
    operating = wheelset_parameters(cfg)
    forced = operating._replace(B=cfg["forced_excitation"]["B"])
    frequency = _frequencies(cfg["study"]["frequency"], cfg["numerics"]["frequency_points"])
    stiffness = den_hartog(forced).c_T
    designs = {
        "paper": Design(operating.c_T, operating.d_T),
        "den_hartog": den_hartog(forced),
        "den_hartog_sqrt2": den_hartog_sqrt2(forced),
        "abscissa_damping": minimal_abscissa_damping(forced._replace(c_T=stiffness)),
        "spectral_abscissa": minimal_spectral_abscissa(forced),
        "h_infinity": h_infinity(forced, operating.B, frequency),
    }
    reference = peak_receptance(forced, False, frequency)
    rows = [_design_row(design, forced, operating.B, frequency) for design in designs.values()]
    critical = [_critical_c_T(operating, row["d_T"], critical_hopf_curve) for row in rows]
    return {
        "design": np.array(list(designs)),
        **{name: np.array([row[name] for row in rows]) for name in rows[0]},
        "critical_c_T": np.array(critical),
        "reduction": reference.amplitude / np.array([row["peak_receptance"] for row in rows]),
        "reference_peak_receptance": np.array(reference.amplitude),
        "reference_peak_frequency": np.array(reference.frequency),
        "reference_growth_rate": growth_rate(operating, False),
    }


def _design_row(
    design: Design | None, forced: WheelsetParameters, operating_B: float, frequency: np.ndarray
) -> dict[str, Any]:
    if design is None:
        names = (
            "c_T",
            "d_T",
            "peak_receptance",
            "peak_frequency",
            "growth_rate",
            "stroke_per_force",
        )
        return {"m_T": forced.m_T, **dict.fromkeys(names, np.nan), "status": "self_excited"}
    values = forced._replace(c_T=design.c_T, d_T=design.d_T)
    peak = peak_receptance(values, True, frequency)
    growth = float(growth_rate(values._replace(B=operating_B), True))
    return {
        "m_T": values.m_T,
        "c_T": design.c_T,
        "d_T": design.d_T,
        "peak_receptance": peak.amplitude,
        "peak_frequency": peak.frequency,
        "growth_rate": growth,
        "stroke_per_force": peak_stroke(values, frequency).amplitude,
        "status": "self_excited" if growth >= 0.0 else "converged",
    }


def _critical_c_T(operating: WheelsetParameters, d_T: float, critical: Mapping[str, Any]) -> float:
    """Critical stiffness (N/m) at a damping, solved from the nearest upper point; or NaN.

    Points that leave other axle stiffnesses unstable limit nothing.
    """
    upper = (critical["branch"] == "upper") & critical["stabilises_all_c_A"]
    known = critical["d_T"][upper]
    if not known.size or not known.min() <= d_T <= known.max():
        return np.nan
    k = int(np.argmin(np.abs(known - d_T)))
    guess = operating._replace(
        d_T=d_T, c_T=float(critical["c_T"][upper][k]), c_A=float(critical["c_A"][upper][k])
    )
    found = critical_point_at(guess)
    return np.nan if found is None else found.c_T


def _frequencies(limits: Mapping[str, float], points: int) -> np.ndarray:
    return np.linspace(limits["min"], limits["max"], points)


def frequency_response(
    cfg: Mapping[str, Any], absorber_tuning: Mapping[str, Any]
) -> dict[str, np.ndarray]:
    """Frequency response without absorber and with every design (figure 7).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``forced_excitation`` (B), ``study`` (frequency range) and ``numerics``
        (points).
    absorber_tuning : mapping
        Variables of ``absorber_tuning.nc``.

    Returns
    -------
    dict
        Variables of ``frequency_response.nc``; designs without a solution stay NaN.
    """
    values = wheelset_parameters(cfg)._replace(B=cfg["forced_excitation"]["B"])
    frequency = _frequencies(cfg["study"]["frequency"], cfg["numerics"]["points"])
    parameters = {name: np.append(np.nan, absorber_tuning[name]) for name in ("m_T", "c_T", "d_T")}
    responses = [response(values, False, frequency)]
    missing = np.full(frequency.size, np.nan)
    for m_T, c_T, d_T in zip(*(column[1:] for column in parameters.values()), strict=True):
        design = values._replace(m_T=m_T, c_T=c_T, d_T=d_T)
        solved = np.isfinite(c_T)
        responses.append(
            response(design, True, frequency) if solved else Response(missing, missing)
        )
    receptance = np.array([r.receptance for r in responses])
    stable = growth_rate(values, False) < 0.0
    if not stable:
        logger.warning(
            "without absorber the wheelset is unstable: its response is not a steady state"
        )
    return {
        "design": np.append("none", absorber_tuning["design"]),
        **parameters,
        "status": np.append("converged" if stable else "self_excited", absorber_tuning["status"]),
        "frequency": frequency,
        "receptance_amplitude": np.abs(receptance),
        "receptance_phase": np.angle(receptance),
        "stroke_amplitude": np.array([np.abs(r.stroke) for r in responses]),
        "y_R_equilibrium": np.array(equilibrium(values, False).y_R),
    }
