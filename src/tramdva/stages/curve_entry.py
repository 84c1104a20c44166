"""The stage `curve_entry`: ride of the bogie into the curve (figure 9)."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie import ride as entry
from tramdva.bogie.names import WHEELS
from tramdva.bogie.tram import track_line
from tramdva.stages.bogie_sections import DESIGNS, bogie_line, known_runs
from tramdva.variables.curve_entry import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    curving_equilibrium: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """Ride into the curve per absorber (figure 9).

    Returns
    -------
    Variables of ``curve_entry.nc``.
    """
    line, study, numerics = bogie_line(cfg, contact_geometry), cfg["study"], cfg["numerics"]
    known = dict(zip(curving_equilibrium["absorber"], range(len(DESIGNS)), strict=True))
    chosen = [known[name] for name in study["absorbers"]]
    designs = {name: curving_equilibrium[name][chosen] for name in ("m_T", "c_T", "d_T")}
    start = track_line(line, study["entry"] * line.track.speed)
    rides = []
    for run in known_runs(cfg, line, designs):
        route = entry.Route(
            start,
            line.track.speed,
            line.bogie.half_wheelbase,
            line.track.gravity,
            (run.straight, run.curve),
            (run.straight_equilibrium, run.equilibrium),
        )
        rides.append(
            entry.ride(
                route, study["duration"], numerics["interval"], numerics["every"],
                numerics["tolerance"],
            )
        )  # fmt: skip
    radius = line.bogie.wheel.radius
    normal = np.array([ride.results[..., 0].sum(axis=2).T for ride in rides])
    return {
        "absorber": np.array(study["absorbers"]),
        **designs,
        "wheel": np.array(WHEELS),
        "time": rides[0].time,
        "contact_point_lateral_velocity": np.array(
            [entry.contact_point_velocity(radius, ride.local) for ride in rides]
        ),
        "normal_force": normal,
        "evaluations": np.array([float(ride.evaluations) for ride in rides]),
        "status": np.array([ride.status for ride in rides]),
    }
