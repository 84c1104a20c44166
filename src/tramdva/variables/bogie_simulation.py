"""Variables of `bogie_simulation.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import WAVE_STATUS

VARIABLES = Stage(
    "bogie_simulation",
    "Contacts of wheels with a wave of one order over whole revolutions",
    {
        "absorber": text("", "absorber of the bogie"),
        "order": real("", "1", "waves around the wheel"),
        "frequency": real("", "Hz", "frequency of the waves"),
        "wheel": text("wheel", "wheel out of round"),
        "zone": text("zone", "zone of the profile"),
        "speed": real("", "m/s", "speed of the vehicle"),
        "wheel_radius": real("", "m", "rolling radius r_0"),
        "kalker_table": real("kalker_node kalker_column", "1", "Kalker's creep coefficients"),
        "shear_modulus": real("", "N/m^2", "shear modulus"),
        "amplitude_real": real("", "m", "complex amplitude of the waves"),
        "amplitude_imag": real("", "m", "its imaginary part"),
        "time": real("time", "s", "time"),
        "wheel_angle": real("time", "rad", "angle of the material point below the wheel centre"),
        "radius_deviation": real("wheel time", "m", "radius deviation at the wheel angle"),
        "rolling_speed": real("wheel", "m/s", "speed of the wheels along their rails"),
        **{
            name: real("wheel zone time", unit, meaning)
            for name, unit, meaning in (
                ("normal_force", "N", "normal force, zero when apart"),
                ("contact_angle", "rad", "angle of the contact plane"),
                ("longitudinal_creepage", "1", "longitudinal creepage"),
                ("lateral_creepage", "1", "lateral creepage"),
                ("spin_creepage", "m-1", "spin creepage"),
                ("friction", "1", "coefficient of friction"),
                ("semi_axis_longitudinal", "m", "semi-axis along the rail"),
                ("semi_axis_lateral", "m", "semi-axis across the rail"),
                ("forward_shift", "m", "contact ahead of the wheel's centre"),
                ("wheel_lead", "m", "contact ahead of its circle's lowest point"),
            )
        },
        "transient": real("", "1", "revolutions before the output"),
        "difference": real("", "1", "of the last revolution from its limit, over the response"),
        "status": flag("", WAVE_STATUS, "how the run ended"),
    },
)
