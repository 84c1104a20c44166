"""Absorbers at the limit of self-excitation and beyond (figures 4-6).

References
----------
Section "Numerical analysis of the Hopf bifurcation" of the paper, equations (9)-(15).
"""

import logging
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar

from tramdva.bifurcation import critical_hopf, hopf
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.hopf import HopfCurve, HopfPoint
from tramdva.self_excitation import (
    WheelsetHopfPoint,
    columns,
    growth_along,
    hopf_points_along,
    physical_values,
    rim_velocity,
)
from tramdva.stability import growth_rate
from tramdva.wheelset import (
    WheelsetParameters,
    dynamical_system,
    equilibrium_state,
    scaling,
    wheelset_parameters,
)

logger = logging.getLogger(__name__)

# Growth rates (1/s) below this are rounding at the tangency, not instability.
_MARGINAL = 1e-6
_FREE = ("c_A", "c_T", "d_T")
# Absorber stiffness in kN/mm at which the critical curve is taken to reach zero.
_VANISHING = 1e-3


def hopf_curves(cfg: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Hopf curves in (c_A, c_T) for several d_T (figure 4).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``study`` (list d_T, ranges of c_A and c_T) and ``numerics`` (max_points,
        tolerance).

    Returns
    -------
    dict
        Variables of ``hopf_curves.nc``. The points of one curve (``curve``) stand in order.

    Notes
    -----
    Every curve that crosses one of the rows of constant c_T is found: the Hopf points of each row
    start a curve unless one already passes there.
    """
    baseline = wheelset_parameters(cfg)
    points: list[dict[str, Any]] = []
    special: list[dict[str, Any]] = []
    number = 0
    for d_T in cfg["study"]["d_T"]:
        for curve in _curves_at(baseline._replace(d_T=d_T), cfg["study"], cfg["numerics"]):
            points += _curve_rows(number, baseline, curve)
            special += _special_rows(baseline, curve)
            number += 1
        logger.info("d_T = %g N s/m: %d curves so far", d_T, number)
    return {
        **columns(points, _CURVE_COLUMNS),
        **columns(special, _SPECIAL_COLUMNS),
    }


_CURVE_COLUMNS = {
    "curve": int,
    "d_T": float,
    "c_A": float,
    "c_T": float,
    "frequency": float,
    "first_lyapunov_coefficient": float,
    "residual": float,
}
_SPECIAL_COLUMNS = {
    "special_kind": str,
    "special_d_T": float,
    "special_c_A": float,
    "special_c_T": float,
}
_ROWS = 24


def _curves_at(
    values: WheelsetParameters, study: Mapping[str, Any], numerics: Mapping[str, Any]
) -> Iterator[HopfCurve]:
    """Hopf curves at one d_T within the window."""
    c_A = np.geomspace(study["c_A"]["min"], study["c_A"]["max"], 201)
    rows = np.linspace(study["c_T"]["max"], study["c_T"]["min"], _ROWS)
    traced: list[HopfCurve] = []
    for c_T in rows:
        for start in hopf_points_along(values._replace(c_T=c_T), True, "c_A", c_A):
            if start.converged and not any(_passes(curve, start) for curve in traced):
                traced.append(_whole_curve(start, study, numerics))
                yield traced[-1]


def _passes(curve: HopfCurve, start: WheelsetHopfPoint) -> bool:
    """Whether a curve crosses the row c_T of a Hopf point at its c_A (within 2 %)."""
    index = [start.values._fields.index(name) for name in ("c_A", "c_T")]
    c_A, c_T = np.array([point.parameters[index] for point in curve.points]).T
    at = start.scaled.parameters[index]
    below, above = np.minimum(c_T[:-1], c_T[1:]), np.maximum(c_T[:-1], c_T[1:])
    segments = np.flatnonzero((below <= at[1]) & (at[1] <= above) & (above > below))
    share = (at[1] - c_T[segments]) / (c_T[segments + 1] - c_T[segments])
    crossings = c_A[segments] + share * (c_A[segments + 1] - c_A[segments])
    ends = np.hypot(c_A[[0, -1]] - at[0], c_T[[0, -1]] - at[1]) < 0.02 * at[0]
    return bool(np.any(np.abs(crossings - at[0]) < 0.02 * at[0]) or ends.any())


def _whole_curve(
    start: WheelsetHopfPoint, study: Mapping[str, Any], numerics: Mapping[str, Any]
) -> HopfCurve:
    """The curve through a Hopf point, both ways."""
    values = start.values
    unit = scaling(values, True).parameters[values._fields.index("c_A")]
    bounds = {
        name: (study[name]["min"] / unit, study[name]["max"] / unit) for name in ("c_A", "c_T")
    }
    size = (study["c_T"]["max"] - study["c_T"]["min"]) / unit
    control = StepControl(
        initial=0.002 * size,
        smallest=1e-6 * size,
        largest=0.02 * size,
        max_points=numerics["max_points"],
    )

    def walk(direction: int) -> HopfCurve:
        return hopf.hopf_curve(
            dynamical_system(values, True),
            start.scaled,
            ("c_A", "c_T"),
            bounds,
            control,
            direction=direction,
            component=rim_velocity(True),
            tolerance=numerics["tolerance"],
        )

    down = walk(-1)
    if down.ended == "closed":
        return down
    up = walk(1)
    return HopfCurve(
        points=up.points[:0:-1] + down.points,
        first_lyapunov_coefficients=np.append(
            up.first_lyapunov_coefficients[:0:-1], down.first_lyapunov_coefficients
        ),
        special=up.special + down.special,
        ended=down.ended,
    )


def _curve_rows(number: int, values: WheelsetParameters, curve: HopfCurve) -> list[dict[str, Any]]:
    rows = []
    for point, l_1 in zip(curve.points, curve.first_lyapunov_coefficients, strict=True):
        own = physical_values(values, True, point.parameters)
        rows.append(
            {
                "curve": number,
                "d_T": own.d_T,
                "c_A": own.c_A,
                "c_T": own.c_T,
                "frequency": _frequency(values, point),
                "first_lyapunov_coefficient": l_1,
                "residual": point.residual,
            }
        )
    return rows


def _special_rows(values: WheelsetParameters, curve: HopfCurve) -> list[dict[str, Any]]:
    rows = []
    for kind, point in curve.special:
        own = physical_values(values, True, point.parameters)
        rows.append(
            {
                "special_kind": kind,
                "special_d_T": own.d_T,
                "special_c_A": own.c_A,
                "special_c_T": own.c_T,
            }
        )
    return rows


def _frequency(values: WheelsetParameters, point: HopfPoint) -> float:
    return point.omega / (2.0 * np.pi * scaling(values, True).time)


def critical_hopf_curve(
    cfg: Mapping[str, Any], hopf_curves: Mapping[str, Any]
) -> dict[str, np.ndarray]:
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
            _walk_critical(start, limits, cfg["numerics"], direction) for direction in (-1, 1)
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
        **columns(rows, _CRITICAL_COLUMNS),
        **columns(special, _CRITICAL_SPECIAL_COLUMNS),
    }


_CRITICAL_COLUMNS = {
    "piece": int,
    "branch": str,
    "d_T": float,
    "c_T": float,
    "c_A": float,
    "frequency": float,
    "residual": float,
    "stabilises_all_c_A": bool,
}
_CRITICAL_SPECIAL_COLUMNS = {
    "special_kind": str,
    "special_d_T": float,
    "special_c_T": float,
    "special_c_A": float,
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


def leading_pair_at(values: WheelsetParameters) -> HopfPoint:
    """Equilibrium with its leading pair, to start Newton's method near a Hopf point."""
    units = scaling(values, True)
    system = dynamical_system(values, True)
    state = units.from_states(equilibrium_state(values, True))
    vector = np.array(values) / units.parameters
    eigenvalue, eigenvector = hopf.critical_pair(system, state, vector)
    return HopfPoint(state, eigenvector, eigenvalue.imag, vector, np.inf, False)


def _walk_critical(
    values: WheelsetParameters,
    d_T: tuple[float, float],
    numerics: Mapping[str, Any],
    direction: int,
) -> critical_hopf.CriticalCurve:
    unit = scaling(values, True).parameters[values._fields.index("d_T")]
    low, high = d_T[0] / unit, d_T[1] / unit

    def stop(free: np.ndarray) -> str | None:
        return None if low <= free[2] <= high else "window"

    control = StepControl(
        initial=0.2,
        smallest=1e-4,
        largest=1.0,
        max_points=numerics["max_points"],
        min_cosine=0.98,
    )
    return critical_hopf.critical_hopf_curve(
        dynamical_system(values, True),
        leading_pair_at(values),
        _FREE,
        control,
        stop,
        direction=direction,
        level=_VANISHING,
        tolerance=numerics["tolerance"],
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
                "frequency": _frequency(values, point),
                "residual": point.residual,
                "stabilises_all_c_A": largest_growth(own, c_A) <= _MARGINAL,
            }
        )
    return rows


def largest_growth(values: WheelsetParameters, c_A: np.ndarray) -> float:
    """Largest growth rate (1/s) over the axle stiffness, samples refined at their maximum."""
    rates = growth_rate(values._replace(c_A=c_A), True)
    k = int(np.argmax(rates))
    if rates[k] > _MARGINAL:
        return float(rates[k])
    function = growth_along(values, True, "c_A")
    bounds = (c_A[max(k - 1, 0)], c_A[min(k + 1, len(c_A) - 1)])
    found = minimize_scalar(lambda x: -function(x), bounds=bounds, method="bounded")
    return float(max(rates[k], -found.fun))


def _critical_special(values: WheelsetParameters, kind: str, point: HopfPoint) -> dict[str, Any]:
    own = physical_values(values, True, point.parameters)
    return {
        "special_kind": "largest_c_T" if kind == "largest" else "fold",
        "special_d_T": own.d_T,
        "special_c_T": own.c_T,
        "special_c_A": own.c_A,
    }


def critical_point_at(values: WheelsetParameters) -> WheelsetParameters | None:
    """Critical Hopf point at the d_T of given values, near their c_A and c_T, or None."""
    point = critical_hopf.solve_critical_point(
        dynamical_system(values, True), leading_pair_at(values), _FREE
    )
    return None if point is None else physical_values(values, True, point.parameters)
