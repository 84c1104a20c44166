"""Variables of `curving_equilibrium.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import BOGIE_ABSORBERS, CURVING_STATUS

VARIABLES = Stage(
    "curving_equilibrium",
    "Steady running of the bogie in the curve",
    {
        **BOGIE_ABSORBERS,
        "contact": text("contact", "wheel and zone of the profile"),
        "wheel": text("wheel", "wheel"),
        "axle": text("axle", "axle"),
        "normal_force": real("absorber contact", "N", "normal force, NaN where apart"),
        "contact_angle": real("absorber contact", "rad", "angle of the contact plane"),
        "longitudinal_creepage": real("absorber contact", "1", "longitudinal creepage"),
        "lateral_creepage": real("absorber contact", "1", "lateral creepage"),
        "spin_creepage": real("absorber contact", "m-1", "spin creepage"),
        "slip_velocity": real("absorber contact", "m/s", "slip velocity"),
        "semi_axis_longitudinal": real("absorber contact", "m", "semi-axis along the rail"),
        "semi_axis_lateral": real("absorber contact", "m", "semi-axis across the rail"),
        "wheel_position": real("absorber contact", "m", "contact from the tape circle, outwards"),
        "forward_shift": real("absorber contact", "m", "contact ahead of the wheel's centre"),
        "wheel_load": real("absorber wheel", "N", "vertical force of the rail in the curve"),
        "straight_wheel_load": real("absorber wheel", "N", "the same on the straight track"),
        "angle_of_attack": real("absorber axle", "rad", "yaw against the rail, outwards"),
        "needed_yaw": real(
            "absorber", "rad", "yaw of a wheel that the contact tables do not reach, else NaN"
        ),
        "residual": real("absorber", "m/s^2", "largest remaining acceleration"),
        "status": flag("absorber", CURVING_STATUS, "status"),
    },
)
