"""Variables of `preflight.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import BOGIE_ABSORBERS, CURVING_STATUS

VARIABLES = Stage(
    "preflight",
    "The line at a glance: running in its curve, modes, what will be computed",
    {
        **BOGIE_ABSORBERS,
        "speed": real("", "m/s", "speed of the vehicle"),
        "radius": real("", "m", "curve radius at the track centre"),
        "wheel": text("wheel", "wheel"),
        "axle": text("axle", "axle"),
        "zone": text("zone", "zone of the profile"),
        "axle_mass": real("axle", "kg", "mass that an axle carries on straight track"),
        "straight_wheel_load": real(
            "absorber wheel", "N", "vertical force of the rail on straight track"
        ),
        "wheel_load": real("absorber wheel", "N", "the same in the curve"),
        "angle_of_attack": real("absorber axle", "rad", "yaw against the rail, outwards"),
        "normal_force": real("absorber wheel zone", "N", "normal force, NaN where apart"),
        "contact_angle": real("absorber wheel zone", "rad", "angle of the contact plane"),
        "slip_velocity": real("absorber wheel zone", "m/s", "slip velocity"),
        "wheel_position": real(
            "absorber wheel zone", "m", "contact from the tape circle, outwards"
        ),
        "needed_yaw": real(
            "absorber", "rad", "yaw of a wheel that the contact tables do not reach, else NaN"
        ),
        "table_yaw": real("", "rad", "yaw of a wheel to which the contact tables reach"),
        "profile_position": real("profile_point", "m", "wheel profile from the tape circle"),
        "profile_depth": real("profile_point", "m", "its depth below the tape circle"),
        "friction": text("friction", "decrease B of operation, or of forced excitation"),
        "friction_decrease": real("friction", "s/m", "decrease B of friction"),
        "growth_rate": real("absorber friction", "s-1", "largest growth rate of an oscillation"),
        "growth_frequency": real("absorber friction", "Hz", "frequency of this oscillation"),
        "growth_mode": text("absorber friction", "name of this oscillation"),
        "mode_name": text("absorber mode", "mode in operation; empty beyond the last"),
        "mode_frequency": real("absorber mode", "Hz", "its frequency"),
        "mode_growth_rate": real("absorber mode", "s-1", "its growth rate"),
        "critical_mode": text("", "second bending that grows most without absorbers; else empty"),
        "critical_frequency": real("", "Hz", "its frequency"),
        "critical_growth_rate": real("", "s-1", "its growth rate"),
        "part": text("part", "part of the run"),
        "part_jobs": real("part", "1", "files that it makes"),
        "part_seconds": real("part", "s", "estimated time of one core"),
        "part_reason": text("part", "why it has no result, or only a part; empty where it has"),
        "status": flag("absorber", CURVING_STATUS, "status of the equilibrium"),
    },
)
