"""What the sampled conditions leave: shares, quantiles and worst loads of every design."""

from collections.abc import Mapping

import numpy as np

QUANTILES = (0.0, 0.05, 0.5, 0.95, 1.0)
LOADS = ("carrier_amplitude", "stroke_amplitude", "torque_amplitude", "dissipated_power")


def spread(values: Mapping[str, np.ndarray], outcomes: tuple[str, ...]) -> dict[str, np.ndarray]:
    """Count the cases, and tell what each design leaves of the peaks and bears at most.

    Parameters
    ----------
    values : mapping
        Variables of ``robust_tuning``: ``varied``, ``case_status``, ``counted``, ``growth_rate``
        (1/s) and ``peak_factor`` of all cases, `LOADS`, ``added_mass`` and ``unsprung_mass`` (kg).
    outcomes : texts
        All statuses that an equilibrium can have.

    Returns
    -------
    dict
        Variables of ``robust_tuning``. Quantiles are those of the drawn cases with a factor.
    """
    drawn, there = values["varied"] == "all", values["case_status"] == "converged"
    worse = largest_of_wheels(values["peak_factor"])
    mass, counted = values["added_mass"], values["counted"]
    return {
        "outcome": np.array(outcomes),
        "outcome_cases": np.array([np.sum(values["case_status"] == name) for name in outcomes]),
        "sampled_cases": np.sum(drawn),
        "sampled_steady_cases": np.sum(drawn & there),
        "counted_cases": np.sum(counted),
        "uncounted_cases": np.sum(there & ~counted),
        "self_excited_share": _share(values["growth_rate"][:, drawn & there, -1]),
        "quantile": np.array(QUANTILES),
        "peak_factor_quantile": quantiles(values["peak_factor"][:, drawn]),
        "worse_peak_factor": worse,
        "worse_peak_factor_quantile": quantiles(worse[:, drawn]),
        **{f"worst_{name}": _worst(values[name][:, counted]) for name in LOADS},
        "added_axle_mass": 2.0 * mass,
        "added_axle_share": mass * (2.0 / values["unsprung_mass"]),
    }


def largest_of_wheels(factor: np.ndarray) -> np.ndarray:
    """Largest factor (design, case, peak) of any wheel, of (design, case, wheel, peak)."""
    worse = np.where(np.isfinite(factor), factor, -np.inf).max(axis=2)
    return np.where(np.isfinite(worse), worse, np.nan)


def quantiles(factor: np.ndarray) -> np.ndarray:
    """`QUANTILES` (design, ..., q) of the finite factors (design, case, ...); NaN without any."""
    moved = np.moveaxis(factor, 1, -1)
    out = np.full((*moved.shape[:-1], len(QUANTILES)), np.nan)
    for place in np.ndindex(moved.shape[:-1]):
        known = moved[place][np.isfinite(moved[place])]
        if known.size:
            out[place] = np.quantile(known, QUANTILES)
    return out


def _share(growth: np.ndarray) -> np.ndarray:
    """Share (design,) of cases (design, case) that vibrate; NaN where no growth rate is known."""
    known = np.isfinite(growth).any(axis=1)
    vibrating = np.sum(growth >= 0.0, axis=1)
    return np.where(known, vibrating / max(growth.shape[1], 1), np.nan)


def _worst(load: np.ndarray) -> np.ndarray:
    """Largest load (design,) of cases (design, case); NaN without any."""
    worst = np.where(np.isfinite(load), load, -np.inf).max(axis=1, initial=-np.inf)
    return np.where(np.isfinite(worst), worst, np.nan)
