"""Variables of `bogie_modes.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import BOGIE_ABSORBERS, CURVING_STATUS

VARIABLES = Stage(
    "bogie_modes",
    "Modes and self-excitation of the bogie in the curve",
    {
        **BOGIE_ABSORBERS,
        "status": flag("absorber", CURVING_STATUS, "status of the equilibrium"),
        "friction_decrease": real("friction_decrease", "s/m", "exponential decrease B"),
        "frequency": real("absorber friction_decrease mode", "Hz", "frequency"),
        "damping_ratio": real("absorber friction_decrease mode", "1", "damping ratio"),
        "growth_rate": real("absorber friction_decrease mode", "1/s", "growth rate"),
        "mode_name": text("absorber friction_decrease mode", "name by strain energy and axle"),
        "largest_growth_rate": real(
            "absorber friction_decrease", "1/s", "largest growth rate of the frequencies that count"
        ),
        "operating_growth_rate": real("absorber", "1/s", "largest growth rate at the line's B"),
        "operating_frequency": real("absorber", "Hz", "its frequency"),
        "critical_friction_decrease": real(
            "absorber", "s/m", "B where self-excitation begins, NaN where it does not"
        ),
        "map_d_T": real("map_d_T", "N m s/rad", "damping of the absorber"),
        "map_c_T": real("map_c_T", "N m/rad", "stiffness of the absorber"),
        "map_growth_rate": real("map_d_T map_c_T", "1/s", "largest growth rate at the line's B"),
        "map_status": flag("", CURVING_STATUS, "how the equilibrium behind the map ended"),
        "shape_mode": text("shape_mode", "mode of the front axle without absorber"),
        "shape_frequency": real("shape_mode", "Hz", "frequency"),
        "shape_damping_ratio": real("shape_mode", "1", "damping ratio"),
        "point_position": real("point axis", "m", "points of the axle; outer rim first"),
        "shape_real": real("shape_mode point motion", "1", "motion (x y z roll pitch yaw)"),
        "shape_imag": real("shape_mode point motion", "1", "its imaginary part"),
        "energy_class": text("energy_class", "class of strain energy"),
        "strain_energy_share": real("shape_mode energy_class", "1", "share of strain energy"),
        "straight_frequency": real("straight_mode", "Hz", "frequency on straight track"),
        "straight_damping_ratio": real("straight_mode", "1", "damping ratio"),
        "straight_mode_name": text("straight_mode", "name by strain energy and axle"),
    },
)
