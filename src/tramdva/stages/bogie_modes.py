"""The stage `bogie_modes`: modes and self-excitation of the bogie in its curve."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie import modes as modal
from tramdva.bogie.absorber_growth import least_stable, seen_by_absorbers
from tramdva.bogie.absorbers import absorber_family
from tramdva.bogie.modes import Modes
from tramdva.bogie.names import ENERGY_CLASSES
from tramdva.bogie.tram import BogieLine, Running
from tramdva.stages.bogie_sections import bogie_line, frequency_limits, known_runs
from tramdva.variables.bogie_modes import VARIABLES

__all__ = ["VARIABLES", "compute"]

SHAPES = ("first_bending", "second_bending", "third_bending", "resilient_wheel")  # shown


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    curving_equilibrium: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """Modes over the friction decrease, critical friction decrease, absorber map, mode shapes.

    Returns
    -------
    Variables of ``bogie_modes.nc``; NaN where there is no equilibrium to linearise about.
    """
    line = bogie_line(cfg, contact_geometry)
    runs = known_runs(cfg, line, curving_equilibrium)
    limits, shown = frequency_limits(cfg), (1.0, cfg["study"]["frequency"]["max"])
    decrease = np.linspace(0.0, cfg["study"]["B_max"], cfg["numerics"]["friction_points"])
    table = {}
    critical, operating = np.full(len(runs), np.nan), np.full((len(runs), 2), np.nan)
    growth = np.full((len(runs), decrease.size), np.nan)
    for i, run in enumerate(runs):
        if run.equilibrium.status != "converged":
            continue
        system, state = run.curve, run.equilibrium.state
        operating[i] = modal.critical_oscillation(system, state, limits)
        sweep = [modal.at_friction(system, state, B) for B in decrease]
        table |= {(i, j): modal.modes_of(system, step, shown) for j, step in enumerate(sweep)}
        growth[i] = [modal.critical_of(step, limits).growth_rate for step in sweep]
        critical[i] = modal.critical_friction_decrease(system, state, limits, decrease, growth[i])
    return {
        **{name: curving_equilibrium[name] for name in ("absorber", "m_T", "c_T", "d_T")},
        "status": curving_equilibrium["status"],
        "friction_decrease": decrease,
        **_mode_table(table, len(runs), len(decrease)),
        "largest_growth_rate": growth,
        "operating_growth_rate": operating[:, 0],
        "operating_frequency": operating[:, 1],
        "critical_friction_decrease": critical,
        **_absorber_map(cfg, line, runs[0], limits),
        **_shapes(runs[0], shown),
        **_straight(runs[0], shown),
    }


def _mode_table(table: Mapping[tuple[int, int], Modes], designs: int, points: int) -> dict:
    """Modes of all designs and friction decreases, NaN and empty names beyond the last."""
    count = max((entry.eigenvalue.size for entry in table.values()), default=1)
    numbers = {
        name: np.full((designs, points, count), np.nan)
        for name in ("frequency", "damping_ratio", "growth_rate")
    }
    names = np.full((designs, points, count), "", dtype="U40")
    for place, found in table.items():
        k = found.eigenvalue.size
        numbers["frequency"][place][:k] = found.frequency
        numbers["damping_ratio"][place][:k] = found.damping_ratio
        numbers["growth_rate"][place][:k] = found.eigenvalue.real
        names[place][:k] = found.name
    return {**numbers, "mode_name": names}


def _absorber_map(cfg, line: BogieLine, none: Running, limits) -> dict[str, np.ndarray]:
    study, points = cfg["study"], cfg["numerics"]["map_points"]
    d_T = np.linspace(study["d_T"]["min"], study["d_T"]["max"], points)
    c_T = np.linspace(study["c_T"]["min"], study["c_T"]["max"], points)
    growth = np.full((points, points), np.nan)
    if none.equilibrium.status == "converged":
        bare = seen_by_absorbers(absorber_family(line, none), none, limits)
        inertia = line.bogie.absorber.I_T
        for i, j in np.ndindex(points, points):
            top = least_stable(bare, inertia, c_T[j], d_T[i])
            growth[i, j] = np.nan if top is None else top.real
    return {
        "map_d_T": d_T,
        "map_c_T": c_T,
        "map_growth_rate": growth,
        "map_status": np.array(none.equilibrium.status),
    }


def _shapes(none: Running, shown) -> dict[str, np.ndarray]:
    """Motion of the front axle in the modes of `SHAPES` at the operating friction.

    A mode that is not there keeps its word as name, and NaN.
    """
    found = None
    if none.equilibrium.status == "converged":
        found = modal.modes(none.curve, none.equilibrium.state, shown)
    positions, motion = modal.axle_points(none.curve, "front")
    k, count = none.curve.size, len(SHAPES)
    names, numbers = list(SHAPES), np.full((2, count), np.nan)
    shape = np.full((count, *motion.shape[:2]), np.nan, dtype=complex)
    energy = np.full((count, len(ENERGY_CLASSES)), np.nan)
    for row, word in enumerate(SHAPES):
        mode = None if found is None else modal.of_front_axle(found, word)
        if mode is None:
            continue
        moved = motion[..., :k] @ found.shape[:, mode]
        names[row] = found.name[mode]
        numbers[:, row] = found.frequency[mode], found.damping_ratio[mode]
        shape[row] = moved / np.abs(moved[:, :3]).max()
        energy[row] = found.share[mode].sum(axis=1)
    return {
        "shape_mode": np.array(names),
        "shape_frequency": numbers[0],
        "shape_damping_ratio": numbers[1],
        "point_position": positions,
        "shape_real": shape.real,
        "shape_imag": shape.imag,
        "energy_class": np.array(ENERGY_CLASSES),
        "strain_energy_share": energy,
    }


def _straight(none: Running, shown) -> dict[str, np.ndarray]:
    names, numbers = [""], np.full((2, 1), np.nan)
    if none.straight_equilibrium.status == "converged":
        found = modal.modes(none.straight, none.straight_equilibrium.state, shown)
        names, numbers = found.name, np.array([found.frequency, found.damping_ratio])
    return {
        "straight_frequency": numbers[0],
        "straight_damping_ratio": numbers[1],
        "straight_mode_name": np.array(names),
    }
