"""Variables of `tendency_maps.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
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
            "absorber speed", "s-1", "largest growth rate of an oscillation within the frequencies"
        ),
        "speed_status": flag("absorber speed", CURVING_STATUS, "status of the equilibrium"),
        "largest_speed_tendency": real(
            "wheel", "1", "largest absolute tendency over the speed without absorber"
        ),
        "order": real("order", "1", "waves around the wheel"),
        "speed_order_tendency": real(
            "absorber speed order", "1", "largest tendency of the order on any wheel, NaN: none"
        ),
        "order_grows": truth("absorber speed order", "whether this tendency is positive"),
        "order_fast": truth(
            "absorber speed order", "whether it is at least the fast share of the fastest"
        ),
        "fast_share": real("", "1", "share of the fastest tendency without absorber"),
        "fastest_order": real("speed", "1", "fastest growing order without absorber, NaN: none"),
        "fastest_frequency": real("speed", "Hz", "its frequency"),
        "radius": real("radius", "m", "curve radius"),
        "radius_tendency": real(
            "absorber wheel radius frequency", "1", "evolution tendency per revolution"
        ),
        "radius_growth_rate": real(
            "absorber radius", "s-1", "largest growth rate of an oscillation within the frequencies"
        ),
        "radius_status": flag("absorber radius", CURVING_STATUS, "status of the equilibrium"),
        "map_d_T": real("map_d_T", "N m s/rad", "damping of the absorber"),
        "map_c_T": real("map_c_T", "N m/rad", "stiffness of the absorber"),
        "map_factor": real(
            "wheel map_d_T map_c_T",
            "1",
            "largest tendency near the second bending mode over that without absorber",
        ),
        "map_worst_factor": real("map_d_T map_c_T", "1", "largest on any wheel over that without"),
        "best_c_T": real("wheel", "N m/rad", "stiffness of the smallest factor of the map"),
        "best_d_T": real("wheel", "N m s/rad", "damping of the smallest factor of the map"),
        "best_factor": real("wheel", "1", "smallest factor of the map"),
        "compromise_c_T": real("", "N m/rad", "stiffness of the smallest of the largest factors"),
        "compromise_d_T": real("", "N m s/rad", "its damping"),
        "compromise_factor": real("", "1", "smallest of the largest factors of the wheels"),
    },
)
