"""Run a stage of every kind after the warm-up and print the kernels that it still compiled.

A process of its own: what earlier tests compiled does not count, whatever the cache holds.
"""

import importlib
import json
import pkgutil
import sys
from pathlib import Path

import numpy as np
from numba.core.dispatcher import Dispatcher
from wheelset_lines import paper

import tramdva
from tramdva.configuration.reading import load
from tramdva.configuration.uses import USES, used_values
from tramdva.stages import (
    bogie_linearisation,
    bogie_modes,
    bogie_simulation,
    contact_geometry,
    curve_entry,
    curving_equilibrium,
    evolution_tendency,
    robust_tuning,
    robustness_sample,
    warm_up,
    wear,
)
from tramdva.wheelset.cycles import limit_cycle_branch, orbit_extremes
from tramdva.wheelset.hopf import solve_hopf_point
from tramdva.wheelset.stability import growth_rate

CONFIG = Path(__file__).resolve().parents[2] / "config"
CHANGES = {
    "numerics": {
        "contact_geometry": {"shift_step": 4e-5, "yaw_nodes": 18},
        "bogie": {"cells_along": 8, "strips": 8},
        "bogie_modes": {"friction_points": 2, "map_points": 2},
        "bogie_simulation": {"samples": 128, "revolutions": 1},
        "wear": {"wear_cells_along": 8, "wear_strips": 8},
        "evolution_tendency": {"frequency_points": 50},
        "robustness_sample": {"samples": 2, "parts": 10},
        "robust_tuning": {"map_points": 3},
    }
}


def compiled() -> dict[str, int]:
    """Number of versions of every kernel of the package that this process uses."""
    modules = [
        importlib.import_module(found.name)
        for found in pkgutil.walk_packages(tramdva.__path__, "tramdva.")
    ]
    return {
        f"{module.__name__}.{name}": len(value.signatures)
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, Dispatcher) and value.py_func.__module__ == module.__name__
    }


def wheelset() -> None:
    """Stability, a Hopf point and limit cycles, without and with absorber."""
    numerics = {"mesh_intervals": 10, "degree": 4, "tolerance": 1e-8, "max_orbits": 3}
    for mounted, c_A in ((False, 4.7e7), (True, 6.2e7)):
        values = paper(c_A=c_A, c_T=2e7, d_T=7500.0)
        growth_rate(values, mounted)
        start = solve_hopf_point(values, mounted, "c_A")
        branch = limit_cycle_branch(start, "c_A", (1e7, 4e8), numerics)
        orbit_extremes(branch.cycles[-1], values, mounted)


def bogie() -> None:
    """Contact geometry, equilibria, modes and the ride into the curve."""
    configuration = load(CONFIG, overrides=CHANGES)
    tables = contact_geometry.compute(used_values(configuration, "paper", "contact_geometry"))
    tuning = {name: np.full(1, np.nan) for name in ("m_T", "c_T", "d_T")}
    tuning |= {"design": np.array(["h_infinity"]), "status": np.array(["no_solution"])}
    found = curving_equilibrium.compute(
        used_values(configuration, "paper", "curving_equilibrium"), tables, tuning
    )
    bogie_modes.compute(used_values(configuration, "paper", "bogie_modes"), tables, found)
    ride = used_values(configuration, "paper", "curve_entry")
    ride["study"] = {**ride["study"], "duration": 0.02, "entry": 0.01}
    curve_entry.compute(ride, tables, found)


def wheel_wear() -> None:
    """A simulated order, its wear and the tendency."""
    configuration = load(CONFIG, overrides=CHANGES)
    values = {name: used_values(configuration, "paper", name) for name in USES}
    tables = contact_geometry.compute(values["contact_geometry"])
    linear = bogie_linearisation.compute(values["bogie_linearisation_none"], "none", tables)
    simulated = bogie_simulation.compute(values["bogie_simulation"], 26, tables, linear)
    worn = wear.compute(values["wear"], simulated)
    cfg = values["evolution_tendency"]
    cfg["study"]["absorbers"] = ["none"]
    evolution_tendency.compute(cfg, [linear], [worn])
    part = robustness_sample.compute(values["robustness_sample"], tables, 0)
    robust_tuning.compute(values["robust_tuning"], [part])


if __name__ == "__main__":
    warm_up.compile_kernels()
    before = compiled()
    wheelset()
    bogie()
    wheel_wear()
    after = compiled()
    json.dump({"before": before, "after": after}, sys.stdout)
