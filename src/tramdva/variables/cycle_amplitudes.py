"""Variables of `cycle_amplitudes.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, truth
from tramdva.variables.shared import AXLE_STIFFNESS, STATUS

VARIABLES = Stage(
    "cycle_amplitudes",
    "Limit cycles over the stiffness of the absorber (figure 6)",
    {
        "axle": flag("cycle", ("critical", "baseline"), "which axle stiffness"),
        "d_T": real("cycle", "N s/m", "damping of the absorber"),
        "c_T": real("cycle", "N/m", "stiffness of the absorber"),
        "c_A": real("cycle", "N/m", AXLE_STIFFNESS),
        "period": real("cycle", "s", "period"),
        "y_R_deviation_max": real("cycle", "m", "largest distance of the rim from L"),
        "a_R_max": real("cycle", "m/s^2", "largest acceleration of the rim"),
        "stable": truth("cycle", "whether the cycle is stable"),
        "status": flag("cycle", STATUS, "status"),
    },
)
