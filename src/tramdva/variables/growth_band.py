"""Variables of `growth_band.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import CURVING_STATUS

VARIABLES = Stage(
    "growth_band",
    "Growth rate of the bogie without absorbers under other theories of contact",
    {
        "variation": text("variation", "what is changed; the first is the line as configured"),
        "kind": text(
            "variation", "as configured, theory, discretisation, comparison (not counted)"
        ),
        "growth_rate": real("variation", "1/s", "largest growth rate at the B of the line"),
        "frequency": real("variation", "Hz", "its frequency"),
        "critical_friction_decrease": real(
            "variation", "s/m", "B where self-excitation begins, NaN where it does not"
        ),
        "status": flag("variation", CURVING_STATUS, "status of the equilibrium"),
        "largest_friction_decrease": real("", "s/m", "largest B that was looked at"),
        "growth_low": real("", "1/s", "lower end of the growth rate"),
        "growth_high": real("", "1/s", "upper end of the growth rate"),
        "critical_low": real("", "s/m", "lower end of the critical B, NaN where no theory has one"),
        "critical_high": real("", "s/m", "upper end, NaN where not all theories have one"),
    },
)
