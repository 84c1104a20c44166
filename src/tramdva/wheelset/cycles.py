"""Limit cycles of the basic model (figures 3 and 6).

References
----------
Section "Numerical analysis of the Hopf bifurcation" of the paper.
"""

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tramdva.bifurcation import limit_cycle
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.limit_cycle import LimitCycleCurve
from tramdva.bifurcation.orbit import LimitCycle, extrema
from tramdva.wheelset.hopf import WheelsetHopfPoint, physical_values, rim_velocity, solve_hopf_point
from tramdva.wheelset.model import (
    WheelsetParameters,
    accelerations,
    dynamical_system,
    equilibrium,
    scaling,
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

    Examples
    --------
    From the Hopf point on stable cycles grow with the square root of the distance from it: their
    size squared over that distance is nearly constant.

    >>> from tramdva.wheelset.cycles import limit_cycle_branch, orbit_extremes
    >>> from tramdva.wheelset.hopf import solve_hopf_point
    >>> from tramdva.wheelset.published import paper_wheelset
    >>> wheelset = paper_wheelset(c_A=4.8e7)
    >>> start = solve_hopf_point(wheelset, False, "c_A")
    >>> numerics = {"mesh_intervals": 12, "degree": 3, "tolerance": 1e-8, "max_orbits": 4}
    >>> branch = limit_cycle_branch(start, "c_A", (2e7, 3e8), numerics)
    >>> unit = 1e6  # N/m, of the scaled stiffness
    >>> for cycle in branch.cycles[1:]:
    ...     size = orbit_extremes(cycle, wheelset, False)
    ...     across = 1e3 * (size.y_R_max - size.y_R_min)
    ...     away = cycle.parameters[branch.curve.index] - start.values.c_A / unit
    ...     print(f"{across:.2f} mm, {across**2 / away:.2f} mm^2 per MN/m, {cycle.stable}")
    0.05 mm, 0.45 mm^2 per MN/m, True
    0.10 mm, 0.45 mm^2 per MN/m, True
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
