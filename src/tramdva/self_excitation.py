"""Self-excited vibration of the basic model: Hopf points and limit cycles (figures 3 and 6).

References
----------
Section "Numerical analysis of the Hopf bifurcation" of the paper.
"""

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from tramdva.bifurcation import hopf, limit_cycle
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.hopf import HopfPoint
from tramdva.bifurcation.limit_cycle import LimitCycle, LimitCycleCurve
from tramdva.stability import absorber_variants, growth_rate
from tramdva.wheelset import (
    WheelsetParameters,
    accelerations,
    dynamical_system,
    equilibrium,
    equilibrium_state,
    scaling,
    wheelset_parameters,
)

logger = logging.getLogger(__name__)

# Changes of a stiffness (kN/mm) that count as much as a change of the orbit by 1 mm.
_STIFFNESS_SCALE = 100.0


@dataclass(frozen=True)
class WheelsetHopfPoint:
    """A Hopf point of the wheelset in SI units, and as the bifurcation package knows it."""

    values: WheelsetParameters
    with_absorber: bool
    scaled: HopfPoint
    frequency: float
    first_lyapunov_coefficient: float

    @property
    def converged(self) -> bool:
        """Whether Newton's method reached its tolerance."""
        return self.scaled.converged


def physical_values(
    values: WheelsetParameters, with_absorber: bool, scaled: np.ndarray
) -> WheelsetParameters:
    """Parameters in SI units from a scaled parameter vector."""
    return WheelsetParameters(*(scaled * scaling(values, with_absorber).parameters).tolist())


def rim_velocity(with_absorber: bool) -> int:
    """Index of y_R' in the state, which normalises the first Lyapunov coefficient."""
    return 5 if with_absorber else 3


def solve_hopf_point(
    values: WheelsetParameters,
    with_absorber: bool,
    parameter: str,
    tolerance: float = 1e-11,
    max_iterations: int = 20,
) -> WheelsetHopfPoint:
    """Hopf point of the wheelset near given values, eq. (10).

    Parameters
    ----------
    values : WheelsetParameters
        SI units; the free parameter near its Hopf value.
    with_absorber : bool
        Whether the absorber is mounted.
    parameter : {"c_A", "c_T", "d_T"}
        Parameter that is solved for.
    tolerance, max_iterations
        Newton's method on the scaled extended system.

    Returns
    -------
    WheelsetHopfPoint
        Frequency in Hz; first Lyapunov coefficient in (s/m)^2, for an eigenvector with the rim's
        velocity 1.
    """
    units = scaling(values, with_absorber)
    system = dynamical_system(values, with_absorber)
    state = units.from_states(equilibrium_state(values, with_absorber))
    vector = np.array(values) / units.parameters
    point = hopf.solve_hopf_point(
        system, state, vector, parameter, tolerance=tolerance, max_iterations=max_iterations
    )
    l_1 = np.nan
    if point.converged:
        l_1 = hopf.first_lyapunov_coefficient(system, point, rim_velocity(with_absorber))
    return WheelsetHopfPoint(
        values=physical_values(values, with_absorber, point.parameters),
        with_absorber=with_absorber,
        scaled=point,
        frequency=point.omega / (2.0 * np.pi * units.time),
        first_lyapunov_coefficient=l_1,
    )


def sign_changes(
    axis: np.ndarray, sampled: np.ndarray, function: Callable[[float], float]
) -> list[float]:
    """Zeros of a function between samples, and pairs of zeros hidden inside one interval.

    Parameters
    ----------
    axis, sampled : (k,) array
        Positions and values of the function there.
    function : callable
        The function itself, to look closer.

    Returns
    -------
    list of float
        Zeros in ascending order; a local maximum below zero that turns out to be above counts
        twice.
    """
    axis, sampled = np.array(axis), np.array(sampled)
    peaks = 1 + np.flatnonzero((sampled[1:-1] > sampled[:-2]) & (sampled[1:-1] >= sampled[2:]))
    extra = []
    for k in peaks[sampled[peaks] < 0.0]:
        bounds = (axis[k - 1], axis[k + 1])
        found = minimize_scalar(lambda x: -function(x), bounds=bounds, method="bounded")
        if found.fun < 0.0:
            extra.append((found.x, -found.fun))
    if extra:
        axis = np.append(axis, [x for x, _ in extra])
        sampled = np.append(sampled, [y for _, y in extra])
        order = np.argsort(axis)
        axis, sampled = axis[order], sampled[order]
    crossings = np.flatnonzero(np.sign(sampled[:-1]) * np.sign(sampled[1:]) < 0)
    return [brentq(function, axis[k], axis[k + 1], rtol=1e-10) for k in crossings]


def growth_along(
    values: WheelsetParameters, with_absorber: bool, parameter: str
) -> Callable[[float], float]:
    """Growth rate in 1/s as a function of one parameter."""

    def function(value: float) -> float:
        return float(growth_rate(values._replace(**{parameter: value}), with_absorber))

    return function


def hopf_points_along(
    values: WheelsetParameters,
    with_absorber: bool,
    parameter: str,
    axis: np.ndarray,
    sampled: np.ndarray | None = None,
    **newton: Any,
) -> list[WheelsetHopfPoint]:
    """All Hopf points along one parameter that the samples or their maxima betray.

    Parameters
    ----------
    values, with_absorber, parameter
        As in `solve_hopf_point`.
    axis : (k,) array
        Samples of the parameter, ascending.
    sampled : (k,) array, optional
        Growth rates there, if known.
    **newton
        Tolerance and iterations.

    Returns
    -------
    list of WheelsetHopfPoint
        Oscillatory ones only: a zero growth rate at frequency zero is no Hopf point.
    """
    function = growth_along(values, with_absorber, parameter)
    if sampled is None:
        sampled = growth_rate(values._replace(**{parameter: axis}), with_absorber)
    points = []
    for zero in sign_changes(axis, sampled, function):
        try:
            points.append(
                solve_hopf_point(
                    values._replace(**{parameter: zero}), with_absorber, parameter, **newton
                )
            )
        except ArithmeticError:
            logger.info("%s = %.6g: the instability is monotone, no Hopf point", parameter, zero)
    return points


def hopf_points(cfg: Mapping[str, Any], stability_map: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Hopf points in c_A for each absorber variant (figure 3).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``absorber_variants`` and ``numerics`` (tolerance, max_iterations).
    stability_map : mapping
        Variables of ``stability_map.nc``: the growth rates over c_A at the baseline's c_R.

    Returns
    -------
    dict
        Variables of ``hopf_points.nc``.
    """
    baseline = wheelset_parameters(cfg)
    rows: list[dict[str, Any]] = []
    for k, (name, c_T, d_T) in enumerate(absorber_variants(cfg)):
        values = baseline._replace(c_T=c_T, d_T=d_T)
        found = hopf_points_along(
            values,
            not np.isnan(c_T),
            "c_A",
            stability_map["c_A"],
            stability_map["baseline_growth_rate"][k],
            **cfg["numerics"],
        )
        logger.info("%s: %d Hopf points", name, len(found))
        rows += [_hopf_row(name, values, point) for point in found]
    return columns(rows, _HOPF_COLUMNS)


_HOPF_COLUMNS = {
    "absorber": str,
    "m_T": float,
    "c_T": float,
    "d_T": float,
    "c_A": float,
    "frequency": float,
    "first_lyapunov_coefficient": float,
    "residual": float,
    "status": str,
}


def _hopf_row(name: str, values: WheelsetParameters, point: WheelsetHopfPoint) -> dict[str, Any]:
    return {
        "absorber": name,
        "m_T": values.m_T if point.with_absorber else np.nan,
        "c_T": values.c_T,
        "d_T": values.d_T,
        "c_A": point.values.c_A,
        "frequency": point.frequency,
        "first_lyapunov_coefficient": point.first_lyapunov_coefficient,
        "residual": point.scaled.residual,
        "status": "converged" if point.converged else "not_converged",
    }


def columns(rows: Iterable[Mapping[str, Any]], names: Mapping[str, type]) -> dict[str, np.ndarray]:
    """Table of rows as arrays by column, also without any row."""
    rows = list(rows)
    return {name: np.array([row[name] for row in rows], dtype=kind) for name, kind in names.items()}


@dataclass(frozen=True)
class WheelsetBranch:
    """Limit cycles of one branch, special points and the reason of its end."""

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
        largest=0.05,
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
    return WheelsetBranch(branch.points, special, end, branch.ended, curve)


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

    low, high = limit_cycle.extrema(cycle, observables)
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
            cycles += [_cycle_row(name, values, mounted, cycle) for cycle in branch.cycles]
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
