"""Variables of the result files of the bogie: contact tables, curving, modes, curve entry."""

from __future__ import annotations

from tramdva.result_variables import Stage, flag, real, text

CURVING_STATUS = ("converged", "not_converged", "wheel_lifted", "outside_profile")
RIDE_STATUS = ("completed", "contact_lost", "outside_profile", "not_finite")

BOGIE_ABSORBERS = {
    "absorber": text("absorber", "absorber of the bogie"),
    "m_T": real("absorber", "kg m^2", "inertia of the absorber (kg if it translates)"),
    "c_T": real("absorber", "N m/rad", "stiffness of the absorber (N/m if it translates)"),
    "d_T": real("absorber", "N m s/rad", "damping of the absorber (N s/m if it translates)"),
}

STAGES: dict[str, Stage] = {
    "contact_geometry": Stage(
        "Contact tables of wheel and rail profiles",
        {
            "coefficients": real("zone roll_node yaw_node shift_node column", "1", "B-splines"),
            "first": real("zone axis", "1", "first node of shift (m), roll (rad), tan(yaw)^2"),
            "step": real("zone axis", "1", "distance of the nodes"),
            "low": real("zone axis", "1", "lower end of the valid range"),
            "high": real("zone axis", "1", "upper end of the valid range"),
            "wheel_radius": real("zone", "m", "wheel radius at the tape circle"),
            "shear": real("zone", "m", "shift of the table per tan(yaw)^2"),
        },
        compressed=False,
    ),
    "curving_equilibrium": Stage(
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
            "wheel_position": real(
                "absorber contact", "m", "contact from the tape circle, outwards"
            ),
            "forward_shift": real("absorber contact", "m", "contact ahead of the wheel's centre"),
            "wheel_load": real("absorber wheel", "N", "vertical force of the rail in the curve"),
            "straight_wheel_load": real("absorber wheel", "N", "the same on the straight track"),
            "angle_of_attack": real("absorber axle", "rad", "yaw against the rail, outwards"),
            "residual": real("absorber", "m/s^2", "largest remaining acceleration"),
            "status": flag("absorber", CURVING_STATUS, "status"),
        },
    ),
    "bogie_modes": Stage(
        "Modes and self-excitation of the bogie in the curve",
        {
            **BOGIE_ABSORBERS,
            "status": flag("absorber", CURVING_STATUS, "status of the equilibrium"),
            "friction_decrease": real("friction_decrease", "s/m", "exponential decrease B"),
            "frequency": real("absorber friction_decrease mode", "Hz", "frequency"),
            "damping_ratio": real("absorber friction_decrease mode", "1", "damping ratio"),
            "growth_rate": real("absorber friction_decrease mode", "1/s", "growth rate"),
            "mode_name": text("absorber friction_decrease mode", "name by strain energy and axle"),
            "operating_growth_rate": real("absorber", "1/s", "largest growth rate at the line's B"),
            "operating_frequency": real("absorber", "Hz", "its frequency"),
            "critical_friction_decrease": real(
                "absorber", "s/m", "B where self-excitation begins, NaN where it does not"
            ),
            "map_d_T": real("map_d_T", "N m s/rad", "damping of the absorber"),
            "map_c_T": real("map_c_T", "N m/rad", "stiffness of the absorber"),
            "map_growth_rate": real(
                "map_d_T map_c_T", "1/s", "largest growth rate at the line's B"
            ),
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
    ),
    "curve_entry": Stage(
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
    ),
}
