"""The stage `critical_hopf_curve`: critical Hopf points of the absorber (figure 5)."""

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bifurcation import critical_hopf
from tramdva.bifurcation.hopf import HopfPoint
from tramdva.variables.arrays import table
from tramdva.variables.critical_hopf_curve import VARIABLES
from tramdva.wheelset.critical import MARGINAL_GROWTH, hopf_frequency, largest_growth, walk_critical
from tramdva.wheelset.hopf import physical_values
from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters

__all__ = ["VARIABLES", "compute"]

logger = logging.getLogger(__name__)


def compute(cfg: Mapping[str, Any], hopf_curves: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Critical Hopf points over (d_T, c_T) (figure 5).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``study`` (ranges of d_T and, for the global check, c_A) and
        ``numerics``.
    hopf_curves : mapping
        Variables of ``hopf_curves.nc``: extrema of c_T on the Hopf curves start the walk.

    Returns
    -------
    dict
        Variables of ``critical_hopf_curve.nc``: one connected curve from the smallest d_T of the
        upper branch, through the fold, along the lower branch. Only points with c_T > 0: ``piece``
        counts the parts between them, each of which ends at c_T = 1 kN/m. Equations (10) and (15)
        are local: ``stabilises_all_c_A`` says whether the growth rate over all c_A is nowhere
        positive.
    """
    baseline = wheelset_parameters(cfg)
    start = _critical_start(baseline, hopf_curves)
    rows: list[dict[str, Any]] = []
    special: list[dict[str, Any]] = []
    if start is not None:
        limits = (cfg["study"]["d_T"]["min"], cfg["study"]["d_T"]["max"])
        backward, forward = (
            walk_critical(start, limits, cfg["numerics"], direction) for direction in (-1, 1)
        )
        points = _in_order(backward, -1)[:0:-1] + _in_order(forward, 1)
        rows = _critical_rows(baseline, points, cfg)
        special = [
            _critical_special(baseline, kind, point)
            for curve in (backward, forward)
            for kind, _, point in curve.special
            if kind != "vanishing" and point.parameters[baseline._fields.index("c_T")] > 0.0
        ]
    return {
        **table(VARIABLES, "critical_point", rows),
        **table(VARIABLES, "special_point", special),
    }


def _critical_start(
    values: WheelsetParameters, curves: Mapping[str, Any]
) -> WheelsetParameters | None:
    """Critical point of the largest c_T found on the Hopf curves (the upper branch), or None."""
    found = np.flatnonzero(curves["special_kind"] == "critical")
    if found.size == 0:
        logger.warning("no Hopf curve has an extremum of c_T: no critical Hopf point")
        return None
    best = found[np.argmax(curves["special_c_T"][found])]
    return values._replace(
        d_T=float(curves["special_d_T"][best]),
        c_T=float(curves["special_c_T"][best]),
        c_A=float(curves["special_c_A"][best]),
    )


def _in_order(curve: critical_hopf.CriticalCurve, direction: int) -> list[tuple[HopfPoint, bool]]:
    """Points with those at vanishing c_T in between, and whether each is on the lower branch."""
    points = []
    for i, point in enumerate(curve.points):
        lower = bool(direction * curve.tangents[i, 2] < 0.0)
        points.append((point, lower))
        points += [(p, lower) for kind, k, p in curve.special if kind == "vanishing" and k == i]
    return points


def _critical_rows(
    values: WheelsetParameters, points: list[tuple[HopfPoint, bool]], cfg: Mapping[str, Any]
) -> list[dict[str, Any]]:
    limits = cfg["study"]["c_A"]
    c_A = np.geomspace(limits["min"], limits["max"], cfg["numerics"]["check_points"])
    rows: list[dict[str, Any]] = []
    piece, inside = 0, True
    for point, lower in points:
        own = physical_values(values, True, point.parameters)
        if own.c_T <= 0.0:
            inside = False
            continue
        piece, inside = piece + (not inside and bool(rows)), True
        rows.append(
            {
                "piece": piece,
                "branch": "lower" if lower else "upper",
                "d_T": own.d_T,
                "c_T": own.c_T,
                "c_A": own.c_A,
                "frequency": hopf_frequency(values, point),
                "residual": point.residual,
                "stabilises_all_c_A": largest_growth(own, c_A) <= MARGINAL_GROWTH,
            }
        )
    return rows


def _critical_special(values: WheelsetParameters, kind: str, point: HopfPoint) -> dict[str, Any]:
    own = physical_values(values, True, point.parameters)
    return {
        "special_kind": "largest_c_T" if kind == "largest" else "fold",
        "special_d_T": own.d_T,
        "special_c_T": own.c_T,
        "special_c_A": own.c_A,
    }
