"""The stage `limit_cycles`: limit cycles over the stiffness of the axle (figure 3)."""

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bifurcation.orbit import LimitCycle
from tramdva.stages.wheelset_sections import absorber_variants
from tramdva.variables.arrays import table
from tramdva.variables.limit_cycles import VARIABLES
from tramdva.wheelset.cycles import limit_cycle_branch, orbit_extremes
from tramdva.wheelset.hopf import physical_values, solve_hopf_point
from tramdva.wheelset.model import WheelsetParameters, equilibrium, scaling, wheelset_parameters
from tramdva.wheelset.stability import growth_rate

__all__ = ["VARIABLES", "compute"]

logger = logging.getLogger(__name__)


def compute(cfg: Mapping[str, Any], hopf_points: Mapping[str, Any]) -> dict[str, np.ndarray]:
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
    multipliers = np.full((len(cycles), 6), np.nan + 0j)
    for row, cycle in zip(multipliers, cycles, strict=True):
        row[: len(cycle["multipliers"])] = cycle["multipliers"]
    return {
        **table(VARIABLES, "cycle", cycles),
        "floquet_multiplier_real": multipliers.real,
        "floquet_multiplier_imag": multipliers.imag,
        **table(VARIABLES, "equilibrium", equilibria),
        "mean_equilibrium_y_R": np.mean([row["equilibrium_y_R"] for row in equilibria]),
        **table(VARIABLES, "special_point", specials),
        **table(VARIABLES, "branch", ends),
    }


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
