"""The stage `cycle_amplitudes`: limit cycles over the stiffness of the absorber (figure 6)."""

import logging
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from tramdva.variables.arrays import table
from tramdva.variables.cycle_amplitudes import VARIABLES
from tramdva.wheelset.critical import critical_point_at
from tramdva.wheelset.cycles import WheelsetBranch, cycle_at, limit_cycle_branch, orbit_extremes
from tramdva.wheelset.hopf import (
    WheelsetHopfPoint,
    growth_along,
    hopf_points_along,
    solve_hopf_point,
)
from tramdva.wheelset.model import WheelsetParameters, equilibrium, scaling, wheelset_parameters

__all__ = ["VARIABLES", "compute"]

logger = logging.getLogger(__name__)


def compute(
    cfg: Mapping[str, Any], critical_hopf_curve: Mapping[str, Any]
) -> dict[str, np.ndarray]:
    """Limit cycles over c_T at constant d_T (figure 6).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``study`` (list d_T, c_T_max) and ``numerics``.
    critical_hopf_curve : mapping
        Variables of ``critical_hopf_curve.nc``.

    Returns
    -------
    dict
        Variables of ``cycle_amplitudes.nc``: lines from the critical curve on, at its c_A (as in
        the paper), and lines at the baseline's c_A.
    """
    baseline = wheelset_parameters(cfg)
    rows: list[dict[str, Any]] = []
    for d_T in cfg["study"]["d_T"]:
        values = baseline._replace(d_T=d_T)
        for axle, start in _amplitude_starts(values, critical_hopf_curve, cfg["study"]["c_T_max"]):
            logger.info(
                "d_T = %g N s/m, %s c_A: onset at c_T = %.6g N/m", d_T, axle, start.values.c_T
            )
            rows += _amplitude_rows(axle, start, cfg)
    return table(VARIABLES, "cycle", rows)


def _amplitude_starts(
    values: WheelsetParameters, critical: Mapping[str, Any], c_T_max: float
) -> Iterator[tuple[str, WheelsetHopfPoint]]:
    """Hopf points in c_T: at the critical c_A of this d_T, and at the baseline's c_A."""
    upper = critical["branch"] == "upper"
    d_T, c_T, c_A = (critical[name][upper] for name in ("d_T", "c_T", "c_A"))
    if d_T.size and d_T.min() <= values.d_T <= d_T.max():
        order = np.argsort(d_T)
        guess = values._replace(
            c_A=float(np.interp(values.d_T, d_T[order], c_A[order])),
            c_T=float(np.interp(values.d_T, d_T[order], c_T[order])),
        )
        point = critical_point_at(guess)
        if point is not None:
            yield "critical", solve_hopf_point(point, True, "c_T")
    axis = np.geomspace(1e-3 * c_T_max, c_T_max, 101)
    for start in hopf_points_along(values, True, "c_T", axis):
        own = start.values
        grows = growth_along(own, True, "c_T")(1.001 * own.c_T) > 0.0
        if start.converged and grows:
            yield "baseline", start


def _amplitude_rows(
    axle: str, start: WheelsetHopfPoint, cfg: Mapping[str, Any]
) -> list[dict[str, Any]]:
    """Cycles at the values of c_T of a line, dense near its onset."""
    onset, end = start.values.c_T, cfg["study"]["c_T_max"]
    if onset >= end:
        return []
    numerics = {**cfg["numerics"], "max_orbits": 10_000}
    # A branch towards soft absorbers would approach c_T = 0 for ever, far from all values here.
    branch = limit_cycle_branch(start, "c_T", (0.01 * onset, 1.2 * end), numerics)
    share = np.linspace(0.0, 1.0, cfg["numerics"]["points"] + 1)[1:] ** 3
    values = onset + (end - onset) * share
    return [_onset_row(axle, start), *(_amplitude_row(axle, start, branch, c) for c in values)]


def _onset_row(axle: str, start: WheelsetHopfPoint) -> dict[str, Any]:
    """The Hopf point where a line begins, as a cycle of no amplitude."""
    return {
        "axle": axle,
        "d_T": start.values.d_T,
        "c_T": start.values.c_T,
        "c_A": start.values.c_A,
        "period": 1.0 / start.frequency,
        "y_R_deviation_max": abs(equilibrium(start.values, True).y_R - start.values.L),
        "a_R_max": 0.0,
        "stable": start.first_lyapunov_coefficient < 0.0,
        "status": "converged",
    }


def _amplitude_row(
    axle: str, start: WheelsetHopfPoint, branch: WheelsetBranch, c_T: float
) -> dict[str, Any]:
    cycle = cycle_at(branch, start.values, c_T)
    row = {
        "axle": axle,
        "d_T": start.values.d_T,
        "c_T": c_T,
        "c_A": start.values.c_A,
        "period": np.nan,
        "y_R_deviation_max": np.nan,
        "a_R_max": np.nan,
        "stable": False,
        "status": "not_converged",
    }
    if cycle is not None:
        extremes = orbit_extremes(cycle, start.values, True)
        L = start.values.L
        row["period"] = cycle.period * scaling(start.values, True).time
        row["y_R_deviation_max"] = max(abs(extremes.y_R_max - L), abs(extremes.y_R_min - L))
        row["a_R_max"] = extremes.a_R_max
        row["stable"] = cycle.stable
        row["status"] = "converged"
    return row
