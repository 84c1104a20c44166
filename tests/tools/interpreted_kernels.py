"""Evaluate kernels, compiled or (NUMBA_DISABLE_JIT=1) as the Python that they are written in.

    python tests/tools/interpreted_kernels.py compiled FOLDER
    NUMBA_DISABLE_JIT=1 python tests/tools/interpreted_kernels.py interpreted FOLDER

The compiled run comes first: it also makes what takes too long in Python, which both start from.
"""

import pickle
import sys
from dataclasses import astuple
from pathlib import Path
from typing import Any

import numpy as np
from wheelset_lines import paper

from tramdva.bogie import wheel_forces
from tramdva.bogie.stored import stored_bogie
from tramdva.configuration.reading import load
from tramdva.configuration.uses import USES, used_values
from tramdva.contact import (
    creep_force,
    creep_table,
    fastsim,
    geometry,
    hertz,
    kalker,
    polach,
    profiles,
)
from tramdva.contact.tables import stored_tables
from tramdva.stages import bogie_linearisation, bogie_simulation, contact_geometry, wear
from tramdva.stages.wear_sections import chart_of
from tramdva.wear.chart import METHODS
from tramdva.wear.gradient import worn_area_gradient
from tramdva.wheelset import model
from tramdva.wheelset.cycles import limit_cycle_branch, orbit_extremes
from tramdva.wheelset.hopf import solve_hopf_point

CONFIG = Path(__file__).resolve().parents[2] / "config"
CHANGES = {
    "numerics": {
        "contact_geometry": {"shift_step": 4e-5, "yaw_nodes": 18},
        "bogie": {"cells_along": 8, "strips": 8},
        "bogie_simulation": {
            "samples": 128,
            "revolutions": 1,
            "longest_transient": 1,
            "tolerance": 1e-1,
        },
        "wear": {"wear_cells_along": 8, "wear_strips": 8},
    }
}
Values = dict[str, Any]


def inputs() -> Values:
    """What both runs start from: contact tables, a linearised vehicle, histories of contacts."""
    configuration = load(CONFIG, overrides=CHANGES)
    cfg = {name: used_values(configuration, "paper", name) for name in USES}
    tables = contact_geometry.compute(cfg["contact_geometry"])
    linear = bogie_linearisation.compute(cfg["bogie_linearisation_none"], "none", tables)
    simulated = bogie_simulation.compute(cfg["bogie_simulation"], 26, tables, linear)
    return {
        "cfg": cfg,
        "tables": tables,
        "linear": linear,
        "simulated": simulated,
    }


def outputs(given: Values) -> Values:
    """Results of all kernels by name."""
    return {**of_the_wheelset(), **of_the_contact(), **of_the_bogie(given)}


def of_the_wheelset() -> Values:
    """Creep force, accelerations, a Hopf point and the first limit cycles beyond it."""
    found: Values = {}
    law = (3.9, 35e3, 0.35, 0.36, 0.7, 5.35e6, 1.0, 1.0)
    for slip in (-0.3, -1e-4, 0.0, 0.15):
        found[f"creep_force {slip}"] = creep_force.creep_force_derivatives(slip, *law)
        found[f"friction {slip}"] = creep_force.friction_coefficient(slip, 0.35, 0.36, 0.7)
    numerics = {"mesh_intervals": 6, "degree": 4, "tolerance": 1e-8, "max_orbits": 2}
    for mounted, c_A in ((False, 4.7e7), (True, 6.2e7)):
        values = paper(c_A=c_A, c_T=2e7, d_T=7500.0)
        states = np.linspace(0.1, 1.0, 2 * (6 if mounted else 4)).reshape(2, -1)
        found[f"accelerations {mounted}"] = model.accelerations(states, np.array(values))
        found[f"jacobian {mounted}"] = model.jacobian(states, np.array(values))
        found[f"matrices {mounted}"] = model.linearised(values, mounted).matrices
        start = solve_hopf_point(values, mounted, "c_A")
        cycles = limit_cycle_branch(start, "c_A", (1e7, 4e8), numerics).cycles
        extremes = orbit_extremes(cycles[-1], values, mounted)
        found[f"cycles {mounted}"] = [cycles[-1].period, *astuple(extremes)]
    return found


def of_the_contact() -> Values:
    """Geometry, Hertz, Kalker, creep forces and tractions of single patches."""
    zone, *_ = geometry.contact_tables(
        profiles.tram_wheel(), profiles.grooved_rail(), 0.3, shift_range=(0.0, 2e-4),
        roll_limit=1e-3, yaw_limit=1e-2, yaw_nodes=2,
    )  # fmt: skip
    found: Values = {"table": zone.coefficients}
    coefficients = kalker.creep_coefficients(kalker.kalker_table(0.27), 5.0 / 3.0)
    table = hertz.hertz_table()
    found["penetration"] = hertz.penetration_of_force(table, 3.3, 70.0, 1.1e11, 35e3)
    found["pressure"] = hertz.maximum_pressure(35e3, 5e-3, 3e-3)
    for creepages in ((1e-3, 0.0, 0.0), (0.0, 5e-2, 0.5), (0.0, 0.0, 0.0)):
        found[f"polach {creepages}"] = polach.polach_forces(
            5e-3, 3e-3, 35e3, 0.3, *creepages, np.array(coefficients), 8.2e10, 1.0, 1.0
        )
        found[f"saturated {creepages}"] = kalker.saturated_forces(
            5e-3, 3e-3, 35e3, 0.3, *creepages, np.array(coefficients), 8.2e10
        )
        if any(creepages):  # else the forces are nothing but rounding
            found[f"half_space {creepages}"] = creep_table.half_space_forces(
                5e-3, 3e-3, 35e3, 0.3, *creepages, 8.2e10, creep_table.creep_table(0.27)
            )
    return found


def of_the_bogie(given: Values) -> Values:
    """A simulated order, forces and derivatives of all contacts, wear by each coefficient."""
    cfg, linear = given["cfg"], given["linear"]
    short = {"samples": 16, "longest_transient": 1, "tolerance": 1.0}
    values = {**cfg["bogie_simulation"]}
    values["numerics"] = {**values["numerics"], **short}
    simulated = bogie_simulation.compute(values, 4, given["tables"], linear)
    del simulated["difference"]  # of nearly equal numbers: rounding
    found: Values = {"simulation": simulated}
    stored = stored_bogie(linear)
    contacts = wheel_forces.Contacts(stored_tables(given["tables"]), stored.law, stored.places)
    at_rest = (contacts, stored.bogie.curvatures, stored.bogie.modal.local)
    found["forces"], _ = wheel_forces.contact_forces(*at_rest)
    found["jacobian"] = wheel_forces.contact_jacobian(*at_rest)
    found["sensitivity"] = wheel_forces.radius_sensitivity(*at_rest)._asdict()
    for method in METHODS:
        values = {**cfg["wear"], "wear": {**cfg["wear"]["wear"], "method": method}}
        found[f"wear {method}"] = wear.compute(values, given["simulated"])
        found[f"gradient {method}"] = worn_area_gradient(
            np.array([4.5e-3, 3e-3, 36e3, 0.3, 0.01, 0.048, -1.2]), kalker.kalker_table(0.28),
            8.2e10, fastsim.patch_grid(6, 6), 4.0, chart_of(values),
        )[1]  # fmt: skip
    return found


if __name__ == "__main__":
    how, folder = sys.argv[1], Path(sys.argv[2])
    if how == "compiled":
        (folder / "inputs").write_bytes(pickle.dumps(inputs()))
    result = outputs(pickle.loads((folder / "inputs").read_bytes()))
    (folder / how).write_bytes(pickle.dumps(result))
