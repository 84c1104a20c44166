"""Variables of `tendency_maps.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import BOGIE_ABSORBERS, CURVING_STATUS

VARIABLES = Stage(
    "tendency_maps",
    "Evolution tendency over speed, curve radius and absorber, linearised",
    {
        **BOGIE_ABSORBERS,
        "wheel": text("wheel", "wheel out of round"),
        "frequency": real("frequency", "Hz", "frequency"),
        "speed": real("speed", "m/s", "speed of the vehicle"),
        "speed_tendency": real(
            "absorber wheel speed frequency", "1", "evolution tendency per revolution"
        ),
        "speed_growth_rate": real(
            "absorber speed", "s-1", "largest growth rate in the band of design"
        ),
        "speed_status": flag("absorber speed", CURVING_STATUS, "status of the equilibrium"),
        "radius": real("radius", "m", "curve radius"),
        "radius_tendency": real(
            "absorber wheel radius frequency", "1", "evolution tendency per revolution"
        ),
        "radius_growth_rate": real(
            "absorber radius", "s-1", "largest growth rate in the band of design"
        ),
        "radius_status": flag("absorber radius", CURVING_STATUS, "status of the equilibrium"),
        "map_d_T": real("map_d_T", "N m s/rad", "damping of the absorber"),
        "map_c_T": real("map_c_T", "N m/rad", "stiffness of the absorber"),
        "map_factor": real(
            "wheel map_d_T map_c_T",
            "1",
            "largest tendency near the second bending mode over that without absorber",
        ),
        "map_worst_factor": real("map_d_T map_c_T", "1", "of the wheels, the largest factor"),
    },
)
