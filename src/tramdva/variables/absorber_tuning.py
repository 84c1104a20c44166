"""Variables of `absorber_tuning.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import STATUS

VARIABLES = Stage(
    "absorber_tuning",
    "Designs of the absorber (Table 2)",
    {
        "design": text("design", "design"),
        "m_T": real("design", "kg", "mass of the absorber"),
        "c_T": real("design", "N/m", "stiffness of the absorber"),
        "d_T": real("design", "N s/m", "damping of the absorber"),
        "peak_receptance": real("design", "m/N", "largest receptance"),
        "peak_frequency": real("design", "Hz", "frequency of the largest receptance"),
        "reduction": real("design", "1", "largest receptance without over with absorber"),
        "growth_rate": real("design", "1/s", "largest growth rate at the operating B"),
        "critical_c_T": real(
            "design", "N/m", "critical stiffness at this damping, NaN where there is none"
        ),
        "stroke_per_force": real("design", "m/N", "largest stroke of the absorber per force"),
        "status": flag("design", STATUS, "status"),
        "reference_peak_receptance": real("", "m/N", "largest receptance without absorber"),
        "reference_peak_frequency": real("", "Hz", "its frequency"),
        "reference_growth_rate": real(
            "", "1/s", "largest growth rate at the operating B without absorber"
        ),
    },
)
