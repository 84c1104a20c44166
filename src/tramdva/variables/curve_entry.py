"""Variables of `curve_entry.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import BOGIE_ABSORBERS

RIDE_STATUS = ("completed", "contact_lost", "outside_profile", "not_finite")

VARIABLES = Stage(
    "curve_entry",
    "Ride of the bogie into the curve (figure 9)",
    {
        **BOGIE_ABSORBERS,
        "wheel": text("wheel", "wheel"),
        "time": real("time", "s", "time"),
        "contact_point_lateral_velocity": real(
            "absorber wheel time", "m/s", "lateral velocity of the rim at the contact, left"
        ),
        "normal_force": real("absorber wheel time", "N", "normal force of all zones"),
        "evaluations": real("absorber", "1", "evaluations of the contacts"),
        "status": flag("absorber", RIDE_STATUS, "how the ride ended"),
    },
)
