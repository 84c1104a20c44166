"""The stage `growth_band`: how sure the growth rate of the bogie's vibration is."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tramdva.bogie import contact_theory
from tramdva.bogie.contact_theory import Growth
from tramdva.bogie.tram import run_through
from tramdva.stages.bogie_sections import bogie_line, frequency_limits
from tramdva.stages.contact_sections import line_tables
from tramdva.variables.growth_band import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Growth rate and critical friction decrease under other theories of contact, no absorber.

    Returns
    -------
    Variables of ``growth_band.nc``; a variation without an equilibrium has its status and NaN.
    """
    line = bogie_line(cfg, contact_geometry)
    geometry, step = cfg["contact_geometry"], cfg["numerics"]["shift_step"]
    reach = float(np.arctan(np.sqrt(line.tables[0].high[2])))

    def tables(gap_share: float, step_share: float):
        changed = {**geometry, "gap_scale": gap_share * geometry["gap_scale"]}
        numerics = {**cfg["numerics"], "shift_step": step_share * step}
        other = {**cfg, "contact_geometry": changed, "numerics": numerics}
        return line_tables(other, reach, file_of)

    decrease = np.linspace(0.0, cfg["study"]["B_max"], cfg["numerics"]["friction_points"])
    known = run_through(line)
    found = contact_theory.variations(line, tables)
    results = [Growth(np.nan, np.nan, np.nan, known.equilibrium.status)] * len(found)
    if known.equilibrium.status == "converged":
        limits = frequency_limits(cfg)
        results = [contact_theory.growth(one, known, limits, decrease) for one in found]
    band = contact_theory.band(found, results)
    return {
        "variation": np.array([one.name for one in found]),
        "kind": np.array([one.kind for one in found]),
        "growth_rate": np.array([one.rate for one in results]),
        "frequency": np.array([one.frequency for one in results]),
        "critical_friction_decrease": np.array([one.critical for one in results]),
        "status": np.array([one.status for one in results]),
        "largest_friction_decrease": np.array(decrease[-1]),
        **{name: np.array(value) for name, value in band._asdict().items()},
    }
