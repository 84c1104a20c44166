"""What a run computes for a line, and about how long that takes.

Seconds are those of one core of a present-day processor, from the jobs of the paper's line with the
numerics of `config/config.yaml`; they scale with what a stage computes. An estimate: half or double
is usual, and each job takes a second more to start.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tramdva.configuration.line import Line
from tramdva.configuration.run import Run

# Parts of a run: what a reader knows them by, and their stages with the seconds of each job.
PARTS: dict[str, dict[str, float]] = {
    "basic model (figures 2 to 7)": {
        "stability_map": 6.0,
        "hopf_points": 1.0,
        "limit_cycles": 3.0,
        "hopf_curves": 2.0,
        "critical_hopf_curve": 3.0,
        "cycle_amplitudes": 3.0,
        "absorber_tuning": 3.0,
        "frequency_response": 1.0,
        "wheelset_designs": 15.0,
    },
    "bogie in its curve (figures 8, 9)": {
        "contact_geometry": 6.0,
        "basic_model": 2.0,
        "curving_equilibrium": 5.0,
        "bogie_modes": 11.0,
        "curve_entry": 10.0,
    },
    "orders of the wheels (figure 10)": {
        "bogie_linearisation": 3.0,
        "bogie_simulation": 2.5,
        "wear": 1.5,
        "evolution_tendency": 3.0,
    },
    "maps over speed, radius and absorbers": {"tendency_maps": 10.0, "bogie_designs": 12.0},
    "design sheet": {"robustness_sample": 7.0, "robust_tuning": 10.0},
}


def plan(run: Run, line: Line) -> list[dict[str, Any]]:
    """Jobs and seconds of the parts of a run.

    Returns
    -------
    A map for each part: its name, its stages, number of jobs, seconds of one core.
    """
    number, share = _jobs(run, line), _shares(run, line)
    return [
        {
            "part": part,
            "stages": list(stages),
            "jobs": sum(number.get(stage, 1) for stage in stages),
            "seconds": round(
                sum(
                    number.get(stage, 1) * seconds * share.get(stage, 1.0)
                    for stage, seconds in stages.items()
                ),
                1,
            ),
        }
        for part, stages in PARTS.items()
    ]


def _jobs(run: Run, line: Line) -> dict[str, int]:
    """Files of the stages that make several."""
    absorbers = len(line.study.evolution_tendency.absorbers)
    orders = len(run.numerics.evolution_tendency.orders.listed())
    return {
        "bogie_linearisation": absorbers,
        "bogie_simulation": absorbers * orders,
        "wear": absorbers * orders,
        "robustness_sample": run.numerics.robustness_sample.parts,
    }


def _shares(run: Run, line: Line) -> Mapping[str, float]:
    """Time of a job over that of the paper's line in full, where it differs."""
    n = run.numerics
    patch = 0.4 + 0.6 * n.bogie.cells_along * n.bogie.strips / 144
    sharpest = min(
        line.study.tendency_maps.radius.min,
        line.study.design_sheet.conditions.radius.min * line.track.radius,
    )
    yaw = line.bogie.half_wheelbase / sharpest
    nodes = 8.0 + (n.contact_geometry.yaw_nodes - 1) * (yaw / 0.045) ** 2
    sample = n.robustness_sample
    return {
        "stability_map": (n.stability_map.points / 201) ** 2,
        "wheelset_designs": n.wheelset_designs.c_T_points * n.wheelset_designs.d_T_points / 1325,
        "contact_geometry": 2.5e-5 / n.contact_geometry.shift_step * nodes / 29.0,
        "curving_equilibrium": patch,
        "bogie_modes": patch * n.bogie_modes.friction_points / 31,
        "curve_entry": patch * line.study.curve_entry.duration / 25.0,
        "bogie_simulation": patch * n.bogie_simulation.samples / 512,
        "wear": n.wear.wear_cells_along * n.wear.wear_strips / 1600,
        "tendency_maps": patch * (n.tendency_maps.speeds + n.tendency_maps.radii) / 50,
        "bogie_designs": n.bogie_designs.c_T_points * n.bogie_designs.d_T_points / 693,
        "robustness_sample": patch * (8.0 * sample.samples / sample.parts) / 128,
    }
