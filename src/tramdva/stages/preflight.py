"""The stage `preflight`: the line at a glance, before anything that takes long."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tramdva.bogie import modes as modal
from tramdva.bogie.curving import angle_of_attack, linearise, wheel_loads
from tramdva.bogie.names import AXLES, WHEELS
from tramdva.bogie.tram import BogieLine, Running, absorber, changed, run_through
from tramdva.contact import patch
from tramdva.contact.tables import zone_names
from tramdva.stages.bogie_sections import bogie_line, frequency_limits
from tramdva.stages.contact_sections import line_profile
from tramdva.variables.preflight import VARIABLES
from tramdva.variables.shared import CURVING_WORDS

__all__ = ["VARIABLES", "compute"]

ABSORBERS = ("none", "paper")  # without, and the line's own
FRICTIONS = ("operation", "forced_excitation")
CONTACT_VARIABLES = {
    "normal_force": patch.NORMAL_FORCE,
    "contact_angle": patch.CONTACT_ANGLE,
    "slip_velocity": patch.SLIP_VELOCITY,
    "wheel_position": patch.WHEEL_POSITION,
}
BASIC, WHEEL_ORDERS = "stability_map", "bogie_simulation"  # stages that tell their parts
CONTACT = "contact_geometry"
POINTS = 400  # of the wheel profile


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    basic_model: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Steady running, modes and growth without and with the line's absorber; what a run computes.

    Parameters
    ----------
    cfg : sections of the bogie, ``forced_excitation``, ``plan`` (parts of the run)
    contact_geometry, basic_model : variables of these files
    file_of : where a file lies that the configuration names: a measured profile

    Returns
    -------
    Variables of ``preflight.nc``.
    """
    line = bogie_line(cfg, contact_geometry)
    none = run_through(line)
    own = line.bogie.absorber
    designs = [(np.nan, np.nan), (own.c_T, own.d_T)]
    runs = [none, changed(line, absorber(line, *designs[1]), none)]
    values = _running(line, runs) | _growth(cfg, runs)
    return {
        "absorber": np.array(ABSORBERS),
        "m_T": np.array([np.nan, own.I_T]),
        "c_T": np.array([design[0] for design in designs]),
        "d_T": np.array([design[1] for design in designs]),
        "speed": np.float64(line.track.speed),
        "radius": np.float64(line.track.radius),
        **values,
        **_profile(cfg, file_of),
        **{f"critical_{name}": basic_model[f"critical_{name}"] for name in CRITICAL},
        **_parts(cfg, values, basic_model),
    }


CRITICAL = ("mode", "frequency", "growth_rate")


def _running(line: BogieLine, runs: list[Running]) -> dict[str, np.ndarray]:
    """Loads, angles and contacts; NaN where there is no equilibrium."""
    results = np.array([run.equilibrium.results for run in runs])
    touching = results[..., patch.STATUS] == patch.CONTACT
    known = np.array([run.equilibrium.status == "converged" for run in runs])
    shown = touching & known[:, None, None]
    straight = _loads([run.straight_equilibrium for run in runs])
    axles = straight[0].reshape(len(AXLES), -1).sum(axis=1) / line.track.gravity
    attack = np.array([angle_of_attack(run.curve, run.equilibrium) for run in runs])
    return {
        "wheel": np.array(WHEELS),
        "axle": np.array(AXLES),
        "zone": np.array(zone_names(results.shape[2])),
        "axle_mass": axles,
        "straight_wheel_load": straight,
        "wheel_load": _loads([run.equilibrium for run in runs]),
        "angle_of_attack": np.where(known[:, None], attack, np.nan),
        **{
            name: np.where(shown, results[..., column], np.nan)
            for name, column in CONTACT_VARIABLES.items()
        },
        "needed_yaw": np.array([run.equilibrium.needed_yaw for run in runs]),
        "table_yaw": np.float64(np.arctan(np.sqrt(line.tables[0].high[2]))),
        "status": np.array([run.equilibrium.status for run in runs]),
    }


def _loads(equilibria) -> np.ndarray:
    return np.array(
        [
            list(wheel_loads(one).values()) if one.status == "converged" else [np.nan] * len(WHEELS)
            for one in equilibria
        ]
    )


def _growth(cfg: Mapping[str, Any], runs: list[Running]) -> dict[str, np.ndarray]:
    """Modes in operation, and the oscillation that grows most in operation and when forced."""
    limits = frequency_limits(cfg)
    decrease = (cfg["creep_force"]["B"], cfg["forced_excitation"]["B"])
    growth = np.full((2, len(runs), len(decrease)), np.nan)
    names, tables = np.full((len(runs), len(decrease)), "", dtype="U40"), []
    for i, run in enumerate(runs):
        tables.append(None)
        if run.equilibrium.status != "converged":
            continue
        state = run.equilibrium.state
        for j, B in enumerate(decrease):
            linear = modal.at_friction(run.curve, state, B) if j else linearise(run.curve, state)
            found = modal.modes_of(run.curve, linear, limits)
            if not found.name:
                continue
            most = int(np.argmax(found.eigenvalue.real))
            growth[:, i, j] = found.eigenvalue.real[most], found.frequency[most]
            names[i, j] = found.name[most]
            tables[i] = found if j == 0 else tables[i]
    return {
        "friction": np.array(FRICTIONS),
        "friction_decrease": np.array(decrease),
        "growth_rate": growth[0],
        "growth_frequency": growth[1],
        "growth_mode": names,
        **_modes(tables),
    }


def _modes(tables) -> dict[str, np.ndarray]:
    count = max((len(found.name) for found in tables if found), default=0)
    names = np.full((len(tables), count), "", dtype="U40")
    numbers = np.full((2, len(tables), count), np.nan)
    for i, found in enumerate(tables):
        if found:
            names[i, : len(found.name)] = found.name
            numbers[:, i, : len(found.name)] = found.frequency, found.eigenvalue.real
    return {"mode_name": names, "mode_frequency": numbers[0], "mode_growth_rate": numbers[1]}


def _profile(cfg: Mapping[str, Any], file_of) -> dict[str, np.ndarray]:
    profile = line_profile(cfg, "wheel", file_of)
    rows = np.unique(np.linspace(0, profile.position.size - 1, POINTS).astype(int))
    return {
        "profile_position": profile.position[rows],
        "profile_depth": profile.depth[rows],
    }


def _parts(cfg: Mapping[str, Any], values, basic_model) -> dict[str, np.ndarray]:
    """Parts of the run with the reason where one of them cannot have its results."""
    lost = CURVING_WORDS.get(str(values["status"][0]), "")
    reasons = []
    for part in cfg["plan"]:
        reason = str(basic_model["reason"]) if BASIC in part["stages"] else lost
        if WHEEL_ORDERS in part["stages"] and not reason:
            reason = _self_excited(values)
        if CONTACT in part["stages"] and lost:
            reason = f"{lost}: statuses, no numbers"
        reasons.append(reason)
    return {
        "part": np.array([part["part"] for part in cfg["plan"]]),
        "part_jobs": np.array([float(part["jobs"]) for part in cfg["plan"]]),
        "part_seconds": np.array([float(part["seconds"]) for part in cfg["plan"]]),
        "part_reason": np.array(reasons),
    }


def _self_excited(values: Mapping[str, np.ndarray]) -> str:
    """Why orders are not simulated with some absorbers."""
    forced = values["growth_rate"][:, FRICTIONS.index("forced_excitation")]
    words = {"none": "without absorbers", "paper": "with the line's absorber"}
    growing = [words[name] for name, rate in zip(ABSORBERS, forced, strict=True) if rate > 0.0]
    if not growing:
        return ""
    return (
        f"vibrates by itself at the B of forced_excitation {' and '.join(growing)}: no orders there"
    )
