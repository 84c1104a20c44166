"""A line in curves of 25, 24, ... 15 m: contacts, loads, angles, growth, largest tendency.

    python benchmarks/radius_sweep.py [line] [file.csv] [--own-tables | --without-flank]

Contact tables are made once, for the sharpest of the curves, so that nothing but the radius changes
from row to row; with --own-tables each radius has those that a line of this radius would have.
Tendency and wear are those of the linearised vehicle, as in the stage `tendency_maps`: with the
friction of `forced_excitation`, in the band of design for each wheel out of round, and the highest
peak from there to `MODE_BAND`'s end, where the mode goes that the band is for.

What makes a jump stands beside it: the same tendency with a constant coefficient of wear (a step
of the chart), the sensitivity of wear to slip, the pressure of the flank over the hardness, the
least stable oscillation with the friction of the tendency, and, by --without-flank, what there
would be if the flank of a wheel could not touch.
"""

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tramdva.bogie import modes, tram
from tramdva.bogie.curving import angle_of_attack, wheel_loads
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.tram import BogieLine
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.contact import patch
from tramdva.contact.tables import zone_names
from tramdva.evolution.tendency import (
    WEAR_INPUTS,
    evolution_tendency,
    highest_peak,
    linear_wear_response,
    wear_sensitivity,
)
from tramdva.running.numba_cache import use_numba_cache
from tramdva.stages import contact_geometry
from tramdva.stages.bogie_sections import bogie_line, quiet_bogie_line
from tramdva.stages.wheels_out_of_round import wearing

CONFIG = Path(__file__).resolve().parents[1] / "config"
RADII = np.arange(25.0, 14.0, -1.0)
STEP = 0.25  # Hz, of the axis on which the largest tendency is looked for
MODE_BAND = (45.0, 90.0)  # Hz, through which the second bending mode goes
OSCILLATIONS = (30.0, 200.0)  # Hz


def settings(name: str, radius: float) -> tuple[dict[str, Any], dict[str, Any]]:
    """Values of a line for `tendency_maps`, and tables that reach a radius in m, not beyond."""
    configuration = load(CONFIG, overrides={"lines": [name]})
    geometry = used_values(configuration, name, "contact_geometry")
    geometry["track"]["radius"] = geometry["study"]["radius"]["min"] = radius
    geometry["study"]["conditions"]["radius"]["min"] = 1.0
    cfg = used_values(configuration, name, "tendency_maps")
    friction = used_values(configuration, name, "curving_equilibrium")["creep_force"]
    return cfg | {"creep_force": friction}, contact_geometry.compute(geometry)


def at_radius(line: BogieLine, radius: float) -> tram.Running:
    """The line's bogie in a curve of a radius in m."""
    track = line.track.model_copy(update={"radius": float(radius)})
    return tram.run_through(line._replace(track=track))


def contacts(running: tram.Running, hardness: float) -> dict[str, float]:
    """Contacts of the front outer wheel by zone; NaN for one that does not touch.

    Normal force (kN), angle (degrees), slip (m/s), Hertz pressure over the hardness (of the wear
    chart, Pa).
    """
    results, speed = running.equilibrium.results[0], running.curve.contacts.places.speed
    out = {}
    for zone, result in zip(zone_names(len(results)), results, strict=True):
        touches = result[patch.STATUS] == patch.CONTACT
        normal = result[patch.NORMAL_FORCE]
        creepage = np.hypot(result[patch.LONGITUDINAL_CREEPAGE], result[patch.LATERAL_CREEPAGE])
        area = np.pi * result[patch.SEMI_AXIS_LONGITUDINAL] * result[patch.SEMI_AXIS_LATERAL]
        values = {
            "kN": 1e-3 * normal,
            "degrees": np.degrees(result[patch.CONTACT_ANGLE]),
            "slip_m_s": speed * creepage,
            "pressure_share": 1.5 * normal / area / hardness if touches else np.nan,
        }
        out |= {f"{zone}_{word}": v if touches else np.nan for word, v in values.items()}
    return out


def least_stable(running: tram.Running) -> tuple[float, float, str]:
    """Frequency (Hz), growth rate (1/s) and name of the least stable oscillation."""
    found = modes.modes(running.curve, running.equilibrium.state, OSCILLATIONS)
    place = int(found.eigenvalue.real.argmax())
    return found.frequency[place], found.eigenvalue[place].real, found.name[place]


def tendencies(cfg: Mapping[str, Any], line: BogieLine, running: tram.Running) -> dict[str, float]:
    """Tendency (per revolution) of every wheel out of round by the linearised vehicle.

    The largest in the band of design; the highest peak of `MODE_BAND` and its frequency (Hz); the
    same peak with a constant coefficient; wear (um per revolution); relative sensitivity of the
    wear to all slips of the wheel's contacts.
    """
    frequency = np.arange(MODE_BAND[0], MODE_BAND[1] + 0.5 * STEP, STEP)
    band = cfg["study"]["design_band"]
    inside = (frequency >= band["min"]) & (frequency <= band["max"])
    bogie, law = rough_bogie(running.curve, running.equilibrium), running.curve.contacts.law
    speed, wheel_radius = running.curve.contacts.places.speed, line.bogie.wheel.radius
    out = {}
    for method in ("chart", "constant"):
        worn_by = wearing({**cfg, "wear": {**cfg["wear"], "method": method}})
        worn = wear_sensitivity(bogie, law, worn_by)
        response = linear_wear_response(bogie, worn, frequency, speed, wheel_radius, worn_by.wheels)
        for name, place in zip(worn_by.wheels, worn_by.places, strict=True):
            curve = evolution_tendency(response[:, place])
            top, height = highest_peak(frequency, curve)
            if method == "constant":
                out[f"{name}_peak_constant"] = height
                continue
            slips = WEAR_INPUTS.index(patch.LATERAL_CREEPAGE)
            by_slip = (
                worn.gradient[place, :, slips] * bogie.results[place, :, patch.LATERAL_CREEPAGE]
            )
            out |= {
                f"{name}_tendency": curve[inside].max(),
                f"{name}_peak": height,
                f"{name}_peak_Hz": top,
                f"{name}_wear_um": 1e6 * worn.mean_depth()[place],
                f"{name}_slip_sensitivity": by_slip.sum() / worn.area[place].sum(),
            }
    return out


def row(
    cfg: Mapping[str, Any], lines: tuple[BogieLine, BogieLine], radius: float
) -> dict[str, Any]:
    """Everything about one radius; `lines` with the friction of self-excitation and without."""
    running, quiet = (at_radius(line, radius) for line in lines)
    found, hardness = running.equilibrium, cfg["wear"]["hardness"]
    out = {"radius": radius, "status": found.status, "quiet_status": quiet.equilibrium.status}
    if found.status == "converged":
        out["attack_mrad"] = 1e3 * angle_of_attack(running.curve, found)[0]
        out |= {f"{name}_load_kN": 1e-3 * load for name, load in wheel_loads(found).items()}
        out |= contacts(running, hardness)
        out |= dict(zip(("critical_Hz", "growth", "mode"), least_stable(running), strict=True))
    if quiet.equilibrium.status == "converged":
        out |= {f"quiet_{name}": value for name, value in contacts(quiet, hardness).items()}
        words = ("quiet_critical_Hz", "quiet_growth", "quiet_mode")
        out |= dict(zip(words, least_stable(quiet), strict=True))
        out |= tendencies(cfg, lines[1], quiet)
    return out


def sweep(name: str, radii: np.ndarray = RADII, kind: str = "") -> pd.DataFrame:
    """A row per radius in m; `kind` is an option of the command line."""
    cfg, tables = settings(name, float(radii.min()))
    rows = []
    for radius in radii.tolist():
        if kind == "--own-tables":
            tables = settings(name, radius)[1]
        lines = [made(cfg, tables) for made in (bogie_line, quiet_bogie_line)]
        if kind == "--without-flank":
            lines = [line._replace(tables=line.tables[:2]) for line in lines]
        rows.append(row(cfg, tuple(lines), radius))
    return pd.DataFrame(rows)


def main(arguments: list[str]) -> None:
    """Print the sweep, and write it where a file is named."""
    use_numba_cache()
    kind = next((word for word in arguments if word.startswith("--")), "")
    words = [word for word in arguments if not word.startswith("--")]
    found = sweep(words[0] if words else "paper", kind=kind)
    with pd.option_context("display.width", 220, "display.float_format", "{:.4g}".format):
        print(found.set_index("radius").T.to_string())
    if len(words) > 1:
        found.to_csv(words[1], index=False)


if __name__ == "__main__":
    main(sys.argv[1:])
