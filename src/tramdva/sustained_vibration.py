"""Sustained vibration of the basic model: limit cycles over the stiffnesses (figures 3 and 6).

References
----------
Section "Numerical analysis of the Hopf bifurcation" of the paper.
"""

import logging
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tramdva.bifurcation import limit_cycle
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.limit_cycle import LimitCycleCurve
from tramdva.bifurcation.orbit import LimitCycle, extrema
from tramdva.critical_absorber import critical_point_at
from tramdva.self_excitation import (
    WheelsetHopfPoint,
    columns,
    growth_along,
    hopf_points_along,
    physical_values,
    rim_velocity,
    solve_hopf_point,
)
from tramdva.stability import absorber_variants, growth_rate
from tramdva.wheelset import (
    WheelsetParameters,
    accelerations,
    dynamical_system,
    equilibrium,
    scaling,
    wheelset_parameters,
)

logger = logging.getLogger(__name__)

# Changes of a stiffness (kN/mm) that count as much as a change of the orbit by 1 mm.
_STIFFNESS_SCALE = 100.0


@dataclass(frozen=True)
class WheelsetBranch:
    """Limit cycles of one branch, special points and the reason of its end.

    ``start`` is the orbit of zero amplitude at the Hopf point, ``end`` the Hopf point where the
    amplitude vanishes again.
    """

    start: LimitCycle
    cycles: list[LimitCycle]
    special: list[tuple[str, float]]
    end: WheelsetHopfPoint | None
    ended: str
    curve: LimitCycleCurve


def limit_cycle_branch(
    start: WheelsetHopfPoint,
    parameter: str,
    bounds: tuple[float, float],
    numerics: Mapping[str, Any],
) -> WheelsetBranch:
    """Branch of limit cycles from a Hopf point to the next one or to the end of the window.

    Parameters
    ----------
    start : WheelsetHopfPoint
        Where the branch is born.
    parameter : {"c_A", "c_T"}
        Stiffness along the branch.
    bounds : (float, float)
        Window of the stiffness in N/m.
    numerics : mapping
        mesh_intervals, degree, tolerance, max_orbits.

    Returns
    -------
    WheelsetBranch
        Special points as (kind, stiffness in N/m).
    """
    system = dynamical_system(start.values, start.with_absorber)
    unit = scaling(start.values, start.with_absorber).parameters[system.index(parameter)]
    curve = LimitCycleCurve(
        system, parameter, parameter_scale=_STIFFNESS_SCALE, tolerance=numerics["tolerance"]
    )
    first = curve.start(start.scaled, numerics["mesh_intervals"], numerics["degree"])
    control = StepControl(
        initial=0.01,
        smallest=1e-5,
        largest=0.03,
        max_points=numerics["max_orbits"],
        comfortable_iterations=5,
    )
    branch = limit_cycle.follow(curve, first, control, (bounds[0] / unit, bounds[1] / unit))
    end = None
    if branch.ended == "hopf_point":
        near = branch.points[-1].parameters
        end = solve_hopf_point(
            physical_values(start.values, start.with_absorber, near), start.with_absorber, parameter
        )
    logger.info("%d orbits, ended: %s", len(branch.points), branch.ended)
    special = [(s.kind, s.point.parameters[curve.index] * unit) for s in branch.special]
    return WheelsetBranch(first, branch.points, special, end, branch.ended, curve)


@dataclass(frozen=True)
class OrbitExtremes:
    """Extremes over a limit cycle: rim position (m), slip (m/s), rim acceleration (m/s^2)."""

    y_R_min: float
    y_R_max: float
    slip_min: float
    a_R_max: float


def orbit_extremes(
    cycle: LimitCycle, values: WheelsetParameters, with_absorber: bool
) -> OrbitExtremes:
    """Extreme values of the rim's motion over the cycle.

    Parameters
    ----------
    cycle : LimitCycle
        In scaled variables.
    values : WheelsetParameters
        Any parameters of the same line (the cycle's own are taken from it).
    with_absorber : bool
        Whether the absorber is mounted.

    Returns
    -------
    OrbitExtremes
    """
    units = scaling(values, with_absorber)
    parameters = cycle.parameters * units.parameters
    own = WheelsetParameters(*parameters.tolist())
    creep_velocity = own.gamma * equilibrium(own, with_absorber).V_0
    v_R = rim_velocity(with_absorber)
    y_R = v_R // 2

    def observables(scaled: np.ndarray) -> np.ndarray:
        states = units.to_states(scaled)
        slip = np.abs(states[:, v_R] - creep_velocity)
        a_R = accelerations(states, parameters)[:, v_R]
        return np.column_stack([states[:, y_R], slip, a_R])

    low, high = extrema(cycle, observables)
    return OrbitExtremes(low[0], high[0], low[1], max(abs(low[2]), abs(high[2])))


def limit_cycles(cfg: Mapping[str, Any], hopf_points: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Bifurcation diagram over c_A for each absorber variant (figure 3).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``absorber_variants``, ``study`` (range of c_A) and ``numerics``.
    hopf_points : mapping
        Variables of ``hopf_points.nc``.

    Returns
    -------
    dict
        Variables of ``limit_cycles.nc``.
    """
    baseline = wheelset_parameters(cfg)
    cycles: list[dict[str, Any]] = []
    specials: list[dict[str, Any]] = []
    equilibria: list[dict[str, Any]] = []
    ends: list[dict[str, Any]] = []
    limits = cfg["study"]["c_A"]
    axis = np.geomspace(limits["min"], limits["max"], cfg["numerics"]["equilibria"])
    for name, c_T, d_T in absorber_variants(cfg):
        mounted = not np.isnan(c_T)
        values = baseline._replace(c_T=c_T, d_T=d_T)
        here = hopf_points["absorber"] == name
        found = hopf_points["c_A"][here & (hopf_points["status"] == "converged")]
        equilibria += _equilibria(name, values, mounted, axis, found)
        specials += [_special_row("hopf", name, c_A) for c_A in found]
        reached: list[float] = []
        for c_A in found:
            if any(np.isclose(c_A, other, rtol=1e-6) for other in reached):
                continue
            logger.info("%s: limit cycles from c_A = %.6g N/m", name, c_A)
            start = solve_hopf_point(values._replace(c_A=c_A), mounted, "c_A")
            branch = limit_cycle_branch(start, "c_A", (axis[0], axis[-1]), cfg["numerics"])
            rows = [_cycle_row(name, values, mounted, cycle) for cycle in branch.cycles]
            cycles += [{**row, "cycle_branch": len(ends)} for row in rows]
            specials += [_special_row(kind, name, value) for kind, value in branch.special]
            ends.append({"branch_absorber": name, "branch_c_A": c_A, "branch_ended": branch.ended})
            reached += [c_A] + ([branch.end.values.c_A] if branch.end else [])
    table = columns(cycles, _CYCLE_COLUMNS)
    multipliers = np.full((len(cycles), 6), np.nan + 0j)
    for row, cycle in zip(multipliers, cycles, strict=True):
        row[: len(cycle["multipliers"])] = cycle["multipliers"]
    return {
        **table,
        "floquet_multiplier_real": multipliers.real,
        "floquet_multiplier_imag": multipliers.imag,
        **columns(equilibria, _EQUILIBRIUM_COLUMNS),
        **columns(specials, _SPECIAL_COLUMNS),
        **columns(ends, {"branch_absorber": str, "branch_c_A": float, "branch_ended": str}),
    }


_CYCLE_COLUMNS = {
    "absorber": str,
    "cycle_branch": int,
    "m_T": float,
    "c_T": float,
    "d_T": float,
    "c_A": float,
    "period": float,
    "y_R_max": float,
    "y_R_min": float,
    "y_R_equilibrium": float,
    "slip_min": float,
    "a_R_max": float,
    "stable": bool,
    "residual": float,
    "status": str,
}
_EQUILIBRIUM_COLUMNS = {
    "equilibrium_absorber": str,
    "equilibrium_c_A": float,
    "equilibrium_y_R": float,
    "equilibrium_stable": bool,
}
_SPECIAL_COLUMNS = {"special_kind": str, "special_absorber": str, "special_c_A": float}


def _special_row(kind: str, name: str, c_A: float) -> dict[str, Any]:
    return {"special_kind": kind, "special_absorber": name, "special_c_A": c_A}


def _equilibria(
    name: str, values: WheelsetParameters, mounted: bool, axis: np.ndarray, hopf_c_A: np.ndarray
) -> list[dict[str, Any]]:
    """Equilibrium branch with its stability, Hopf points included."""
    c_A = np.unique(np.concatenate([axis, hopf_c_A]))
    stable = growth_rate(values._replace(c_A=c_A), mounted) < 0.0
    return [
        {
            "equilibrium_absorber": name,
            "equilibrium_c_A": value,
            "equilibrium_y_R": equilibrium(values._replace(c_A=value), mounted).y_R,
            "equilibrium_stable": ok,
        }
        for value, ok in zip(c_A, stable, strict=True)
    ]


def _cycle_row(
    name: str, values: WheelsetParameters, mounted: bool, cycle: LimitCycle
) -> dict[str, Any]:
    own = physical_values(values, mounted, cycle.parameters)
    extremes = orbit_extremes(cycle, values, mounted)
    return {
        "absorber": name,
        "m_T": own.m_T if mounted else np.nan,
        "c_T": own.c_T,
        "d_T": own.d_T,
        "c_A": own.c_A,
        "period": cycle.period * scaling(values, mounted).time,
        "y_R_max": extremes.y_R_max,
        "y_R_min": extremes.y_R_min,
        "y_R_equilibrium": equilibrium(own, mounted).y_R,
        "slip_min": extremes.slip_min,
        "a_R_max": extremes.a_R_max,
        "y_R_deviation_max": max(abs(extremes.y_R_max - own.L), abs(extremes.y_R_min - own.L)),
        "stable": cycle.stable,
        "residual": cycle.residual,
        "status": "converged",
        "multipliers": cycle.multipliers,
    }


def cycle_amplitudes(
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
    return columns(rows, _AMPLITUDE_COLUMNS)


_AMPLITUDE_COLUMNS = {
    "axle": str,
    "d_T": float,
    "c_T": float,
    "c_A": float,
    "period": float,
    "y_R_deviation_max": float,
    "a_R_max": float,
    "stable": bool,
    "status": str,
}


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


def cycle_at(
    branch: WheelsetBranch, values: WheelsetParameters, stiffness: float
) -> LimitCycle | None:
    """Cycle of a branch at a stiffness in N/m; None beyond its end or without convergence."""
    curve = branch.curve
    orbits = [branch.start, *branch.cycles]
    target = stiffness / scaling(values, True).parameters[curve.index]
    distance = np.array([orbit.parameters[curve.index] for orbit in orbits]) - target
    nearest = 1 + int(np.argmin(np.abs(distance[1:]))) if branch.cycles else 0
    found = curve.at_parameter(orbits[nearest], target) if nearest else None
    if found is None:
        for k in np.flatnonzero(distance[:-1] * distance[1:] <= 0.0):
            found = found or curve.between(orbits[k], orbits[k + 1], target)
    return found
