"""The variables of every result file: name, dimensions, unit and meaning.

Others read the files by these names. A variable that bears the name of its only dimension is the
coordinate of this dimension. Texts are fixed-length strings, flags are int8 with `flag_values`
and `flag_meanings`; a truth is the flag `false true`.
"""

from __future__ import annotations

from tramdva.result_variables import Stage, flag, real, text, truth

STATUS = (
    "converged",
    "not_converged",
    "no_hopf_point",
    "no_critical_point",
    "self_excited",
    "limit_reached",
)
SPECIAL_CYCLES = ("hopf", "fold", "period_doubling", "torus")
BRANCH_ENDS = ("hopf_point", "window", "max_points", "no_convergence", "sharp_turn")
SPECIAL_HOPF_POINTS = ("critical", "generalised_hopf", "zero_frequency")
CURVING_STATUS = ("converged", "not_converged", "wheel_lifted", "outside_profile")
RIDE_STATUS = ("completed", "contact_lost", "outside_profile", "not_finite")
WAVE_STATUS = ("periodic", "not_periodic", "contact_lost", "outside_profile", "not_finite")
WEAR_REGIONS = ("mild", "severe", "mild_fast", "seizure", "adhesion")
PEAK_STATUS = ("found", "no_peak")
INSTABILITIES = ("stable", "oscillatory", "monotone", "no_equilibrium")
_AXLE = "stiffness of axle and primary suspension"


_BOGIE_ABSORBERS = {
    "absorber": text("absorber", "absorber of the bogie"),
    "m_T": real("absorber", "kg m^2", "inertia of the absorber (kg if it translates)"),
    "c_T": real("absorber", "N m/rad", "stiffness of the absorber (N/m if it translates)"),
    "d_T": real("absorber", "N m s/rad", "damping of the absorber (N s/m if it translates)"),
}

STAGES: dict[str, Stage] = {
    "stability_map": Stage(
        "Stability maps of the wheelset with and without absorber (figure 2)",
        {
            "absorber": text("absorber", "absorber, none first"),
            "m_T": real("absorber", "kg", "mass of the absorber"),
            "absorber_c_T": real("absorber", "N/m", "stiffness of the absorber"),
            "absorber_d_T": real("absorber", "N s/m", "damping of the absorber"),
            "c_R": real("c_R", "N/m", "stiffness of the resilient wheel"),
            "c_A": real("c_A", "N/m", _AXLE),
            "d_T": real("d_T", "N s/m", "damping of the absorber"),
            "c_T": real("c_T", "N/m", "stiffness of the absorber"),
            "growth_rate": real("absorber c_R c_A", "1/s", "largest growth rate"),
            "frequency": real("absorber c_R c_A", "Hz", "frequency of the leading eigenvalue"),
            "hurwitz_h5": real(
                "absorber c_R c_A", "1", "Hurwitz determinant H5 (none: H3), time in ms"
            ),
            "coefficient_a6": real(
                "absorber c_R c_A", "1", "coefficient a6 (none: a4), time in ms"
            ),
            "instability": flag("absorber c_R c_A", INSTABILITIES, "kind of instability"),
            "routh_hurwitz_agrees": truth(
                "absorber c_R c_A", "whether Routh-Hurwitz and eigenvalues agree on stability"
            ),
            "absorber_growth_rate": real("d_T c_T", "1/s", "largest growth rate at the baseline"),
            "absorber_frequency": real("d_T c_T", "Hz", "frequency of the leading eigenvalue"),
            "absorber_hurwitz_h5": real("d_T c_T", "1", "Hurwitz determinant H5, time in ms"),
            "absorber_coefficient_a6": real("d_T c_T", "1", "coefficient a6, time in ms"),
            "absorber_instability": flag("d_T c_T", INSTABILITIES, "kind of instability"),
            "absorber_routh_hurwitz_agrees": truth(
                "d_T c_T", "whether Routh-Hurwitz and eigenvalues agree on stability"
            ),
            "baseline_growth_rate": real(
                "absorber c_A", "1/s", "largest growth rate at the baseline's c_R"
            ),
            "baseline_c_A": real("", "N/m", f"{_AXLE}, baseline"),
            "baseline_c_R": real("", "N/m", "stiffness of the resilient wheel, baseline"),
        },
    ),
    "hopf_points": Stage(
        "Hopf points over the stiffness of the axle (figure 3)",
        {
            "absorber": text("hopf_point", "absorber"),
            "m_T": real("hopf_point", "kg", "mass of the absorber"),
            "c_T": real("hopf_point", "N/m", "stiffness of the absorber"),
            "d_T": real("hopf_point", "N s/m", "damping of the absorber"),
            "c_A": real("hopf_point", "N/m", _AXLE),
            "frequency": real("hopf_point", "Hz", "frequency"),
            "first_lyapunov_coefficient": real(
                "hopf_point", "s2 m-2", "first Lyapunov coefficient (negative: supercritical)"
            ),
            "residual": real("hopf_point", "1", "largest scaled residual of eq. (10)"),
            "status": flag("hopf_point", STATUS, "status"),
        },
    ),
    "limit_cycles": Stage(
        "Limit cycles over the stiffness of the axle (figure 3)",
        {
            "absorber": text("cycle", "absorber"),
            "cycle_branch": real("cycle", "1", "position of its branch along the dimension branch"),
            "m_T": real("cycle", "kg", "mass of the absorber"),
            "c_T": real("cycle", "N/m", "stiffness of the absorber"),
            "d_T": real("cycle", "N s/m", "damping of the absorber"),
            "c_A": real("cycle", "N/m", _AXLE),
            "period": real("cycle", "s", "period"),
            "y_R_max": real("cycle", "m", "largest position of the rim"),
            "y_R_min": real("cycle", "m", "smallest position of the rim"),
            "y_R_equilibrium": real("cycle", "m", "position of the rim in equilibrium"),
            "slip_min": real("cycle", "m/s", "smallest slip velocity"),
            "a_R_max": real("cycle", "m/s^2", "largest acceleration of the rim"),
            "stable": truth("cycle", "whether the cycle is stable"),
            "residual": real("cycle", "1", "largest scaled residual of the collocation"),
            "status": flag("cycle", STATUS, "status"),
            "floquet_multiplier_real": real(
                "cycle multiplier", "1", "Floquet multiplier, real part, the trivial one first"
            ),
            "floquet_multiplier_imag": real(
                "cycle multiplier", "1", "Floquet multiplier, imaginary part"
            ),
            "equilibrium_absorber": text("equilibrium", "absorber"),
            "equilibrium_c_A": real("equilibrium", "N/m", _AXLE),
            "equilibrium_y_R": real("equilibrium", "m", "position of the rim"),
            "equilibrium_stable": truth("equilibrium", "whether the equilibrium is stable"),
            "special_kind": flag("special_point", SPECIAL_CYCLES, "kind of special point"),
            "special_absorber": text("special_point", "absorber"),
            "special_c_A": real("special_point", "N/m", _AXLE),
            "branch_absorber": text("branch", "absorber"),
            "branch_c_A": real("branch", "N/m", f"{_AXLE} where the branch starts"),
            "branch_ended": flag("branch", BRANCH_ENDS, "why the branch ends"),
        },
    ),
    "hopf_curves": Stage(
        "Hopf points over the stiffnesses of axle and absorber (figure 4)",
        {
            "curve": real("curve_point", "1", "number of the curve, its points in order"),
            "d_T": real("curve_point", "N s/m", "damping of the absorber"),
            "c_A": real("curve_point", "N/m", _AXLE),
            "c_T": real("curve_point", "N/m", "stiffness of the absorber"),
            "frequency": real("curve_point", "Hz", "frequency"),
            "first_lyapunov_coefficient": real(
                "curve_point", "s2 m-2", "first Lyapunov coefficient (negative: supercritical)"
            ),
            "residual": real("curve_point", "1", "largest scaled residual of eq. (10)"),
            "special_kind": flag("special_point", SPECIAL_HOPF_POINTS, "kind of special point"),
            "special_d_T": real("special_point", "N s/m", "damping of the absorber"),
            "special_c_A": real("special_point", "N/m", _AXLE),
            "special_c_T": real("special_point", "N/m", "stiffness of the absorber"),
        },
    ),
    "critical_hopf_curve": Stage(
        "Critical Hopf points: where the Hopf points merge (figures 4 to 6)",
        {
            "piece": real("critical_point", "1", "number of the piece, its points in order"),
            "branch": flag("critical_point", ("upper", "lower"), "branch of the curve"),
            "d_T": real("critical_point", "N s/m", "damping of the absorber"),
            "c_T": real("critical_point", "N/m", "stiffness of the absorber"),
            "c_A": real("critical_point", "N/m", _AXLE),
            "frequency": real("critical_point", "Hz", "frequency"),
            "residual": real("critical_point", "1", "largest residual of eqs (10) and (15)"),
            "stabilises_all_c_A": truth(
                "critical_point", "whether every stiffness of the axle is stable or marginal"
            ),
            "special_kind": flag("special_point", ("largest_c_T", "fold"), "kind of special point"),
            "special_d_T": real("special_point", "N s/m", "damping of the absorber"),
            "special_c_T": real("special_point", "N/m", "stiffness of the absorber"),
            "special_c_A": real("special_point", "N/m", _AXLE),
        },
    ),
    "cycle_amplitudes": Stage(
        "Limit cycles over the stiffness of the absorber (figure 6)",
        {
            "axle": flag("cycle", ("critical", "baseline"), "which axle stiffness"),
            "d_T": real("cycle", "N s/m", "damping of the absorber"),
            "c_T": real("cycle", "N/m", "stiffness of the absorber"),
            "c_A": real("cycle", "N/m", _AXLE),
            "period": real("cycle", "s", "period"),
            "y_R_deviation_max": real("cycle", "m", "largest distance of the rim from L"),
            "a_R_max": real("cycle", "m/s^2", "largest acceleration of the rim"),
            "stable": truth("cycle", "whether the cycle is stable"),
            "status": flag("cycle", STATUS, "status"),
        },
    ),
    "absorber_tuning": Stage(
        "Designs of the absorber (Table 2)",
        {
            "design": text("design", "design"),
            "m_T": real("design", "kg", "mass of the absorber"),
            "c_T": real("design", "N/m", "stiffness of the absorber"),
            "d_T": real("design", "N s/m", "damping of the absorber"),
            "peak_receptance": real("design", "m/N", "largest receptance"),
            "peak_frequency": real("design", "Hz", "frequency of the largest receptance"),
            "reduction": real("design", "1", "largest receptance without over with absorber"),
            "growth_rate": real("design", "1/s", "largest growth rate at the operating B"),
            "critical_c_T": real(
                "design", "N/m", "critical stiffness at this damping, NaN where there is none"
            ),
            "stroke_per_force": real("design", "m/N", "largest stroke of the absorber per force"),
            "status": flag("design", STATUS, "status"),
            "reference_peak_receptance": real("", "m/N", "largest receptance without absorber"),
            "reference_peak_frequency": real("", "Hz", "its frequency"),
            "reference_growth_rate": real(
                "", "1/s", "largest growth rate at the operating B without absorber"
            ),
        },
    ),
    "frequency_response": Stage(
        "Frequency response of the rim to a force at the contact (figure 7)",
        {
            "design": text("design", "design, none first"),
            "m_T": real("design", "kg", "mass of the absorber"),
            "c_T": real("design", "N/m", "stiffness of the absorber"),
            "d_T": real("design", "N s/m", "damping of the absorber"),
            "status": flag("design", STATUS, "status of the design; without solution all is NaN"),
            "frequency": real("frequency", "Hz", "frequency"),
            "receptance_amplitude": real("design frequency", "m/N", "amplitude of receptance"),
            "receptance_phase": real("design frequency", "rad", "phase of receptance"),
            "stroke_amplitude": real("design frequency", "m/N", "stroke of the absorber per force"),
            "y_R_equilibrium": real("", "m", "position of the rim in equilibrium"),
        },
    ),
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
            **_BOGIE_ABSORBERS,
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
            **_BOGIE_ABSORBERS,
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
            **_BOGIE_ABSORBERS,
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
    "bogie_linearisation": Stage(
        "The bogie linearised in its curve without self-excitation, wheels out of round included",
        {
            "m_T": real("", "kg m^2", "inertia of the absorber (kg if it translates)"),
            "c_T": real("", "N m/rad", "stiffness of the absorber (N/m if it translates)"),
            "d_T": real("", "N m s/rad", "damping of the absorber (N s/m if it translates)"),
            "wheel": text("wheel", "wheel"),
            "zone": text("zone", "zone of the profile"),
            "speed": real("", "m/s", "speed of the vehicle"),
            "wheel_radius": real("", "m", "rolling radius r_0"),
            "lateral_position": real("wheel", "m", "wheel centres from the track centre, left"),
            "tape_circle": real("", "m", "tape circle outboard of the wheel centre"),
            "rail": real("", "m", "top of the rail outside the tape circle"),
            "friction": real("friction_number", "1", "mu_0, A and B (s/m)"),
            "modulus": real("", "N/m^2", "E* of wheel and rail"),
            "shear_modulus": real("", "N/m^2", "shear modulus"),
            "hertz_table": real("hertz_node hertz_column", "1", "table of the Hertzian ellipse"),
            "kalker_table": real("kalker_node kalker_column", "1", "Kalker's creep coefficients"),
            "patch_cells": real("direction", "1", "cells of the patch along, strips across"),
            "rolling_speed": real("wheel", "m/s", "speed of the wheels along their rails"),
            "curvature": real("frame", "m-1", "curvature at bogie centre, front and rear axle"),
            "eigenvalue_real": real("mode", "s-1", "growth rate of the modes"),
            "eigenvalue_imag": real("mode", "s-1", "angular frequency of the modes"),
            "output": real("modal local", "1", "local variables of contacts per modal state"),
            "forcing": real("contact_force modal", "1", "modal forcing per contact force"),
            "local": real("local", "1", "local variables of the contacts in equilibrium, SI"),
            "force": real("contact_force", "1", "forces of the contacts in equilibrium, SI"),
            "jacobian": real("contact_force local", "1", "derivatives of these forces, SI"),
            "contact": real("wheel zone result", "1", "results of the contacts, SI"),
            "contact_per_local": real(
                "wheel zone result wheel_local", "1", "their derivatives in the wheel's variables"
            ),
            "contact_per_deviation": real(
                "wheel zone result deviation", "1", "and in radius deviation (m) and its rate (m/s)"
            ),
            "force_per_deviation": real(
                "wheel zone wheel_force deviation", "1", "derivatives of the forces in the same"
            ),
            "residual": real("", "m/s^2", "largest remaining acceleration of the equilibrium"),
            "status": flag("", CURVING_STATUS, "status of the equilibrium"),
        },
    ),
    "bogie_simulation": Stage(
        "Contacts of wheels with a wave of one order over whole revolutions",
        {
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
            "wheel_angle": real(
                "time", "rad", "angle of the material point below the wheel centre"
            ),
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
                )
            },
            "transient": real("", "1", "revolutions before the output"),
            "difference": real("", "1", "of the last revolution from its limit, over the response"),
            "status": flag("", WAVE_STATUS, "how the run ended"),
        },
    ),
    "wear": Stage(
        "KTH wear of the wheels by the contacts of one order",
        {
            "order": real("", "1", "waves around the wheel"),
            "frequency": real("", "Hz", "frequency of the waves"),
            "wheel": text("wheel", "wheel out of round"),
            "amplitude": real("", "m", "amplitude of the waves"),
            "angle": real("angle", "rad", "wheel angle of the material point"),
            "radius_deviation": real("wheel angle", "m", "radius deviation, crest positive"),
            "wear_depth": real("wheel angle", "m", "depth worn away per revolution, mean width"),
            "patch_width": real("wheel", "m", "mean width over which the wear is averaged"),
            "mean_wear_depth": real("wheel", "m", "mean depth per revolution"),
            "wear_amplitude": real("wheel", "m", "amplitude of the depth at the order"),
            "wear_phase": real("wheel", "rad", "its phase against the crest"),
            "harmonic_distortion": real(
                "wheel", "1", "effective value of twice, three ... times the order over its own"
            ),
            "region": text("region", "region of the wear chart, adhesion last"),
            "region_share": real("wheel region", "1", "share of time and patch in the region"),
            "region_share_range": real("wheel region", "1", "largest less smallest share of patch"),
            "region_changes": truth(
                "wheel", "whether the largest region of the sliding patch changes in a period"
            ),
            "status": flag("", WAVE_STATUS, "status of the simulation"),
        },
    ),
    "evolution_tendency": Stage(
        "Wear response and evolution tendency of wheel orders (figure 10)",
        {
            **_BOGIE_ABSORBERS,
            "wheel": text("wheel", "wheel out of round"),
            "order": real("order", "1", "waves around the wheel"),
            "frequency": real("order", "Hz", "frequency of the order"),
            **{
                name: real("absorber wheel order", unit, meaning)
                for name, unit, meaning in (
                    ("wear_response_amplitude", "1", "wear depth per revolution over deviation"),
                    ("wear_response_phase", "rad", "phase of the wear against the crest"),
                    ("evolution_tendency", "1", "-cos(phase) amplitude, growth per revolution"),
                    ("evolution_tendency_normalised", "1", "over the largest without absorber"),
                    ("mean_wear_depth", "m", "mean depth per revolution"),
                    ("harmonic_distortion", "1", "harmonics of the wear over the order's own"),
                )
            },
            "region_changes": truth("absorber wheel order", "whether the wear region changes"),
            "level": real("wheel order", "dB", "level of the radius deviation re 1 um"),
            "level_after": real(
                "absorber wheel order", "dB", "level after the study's number of revolutions"
            ),
            "status": flag("absorber order", WAVE_STATUS, "status of the simulation"),
            "frequency_axis": real("frequency_axis", "Hz", "frequency of the linearised vehicle"),
            "order_axis": real("frequency_axis", "1", "the order of this frequency"),
            "linearised_wear_response_real": real(
                "absorber wheel frequency_axis", "1", "wear response of the linearised vehicle"
            ),
            "linearised_wear_response_imag": real(
                "absorber wheel frequency_axis", "1", "its imaginary part"
            ),
            "linearised_evolution_tendency": real(
                "absorber wheel frequency_axis", "1", "evolution tendency, growth per revolution"
            ),
            "linearised_normalised": real(
                "absorber wheel frequency_axis", "1", "over the largest without absorber"
            ),
            "order_linearised_real": real(
                "absorber wheel order", "1", "linearised wear response at the orders"
            ),
            "order_linearised_imag": real("absorber wheel order", "1", "its imaginary part"),
            "linearised_mean_wear_depth": real("absorber wheel", "m", "mean depth in equilibrium"),
            "peak": text("peak", "positive peak, by the mode behind it"),
            "peak_frequency": real("absorber wheel peak", "Hz", "frequency of the peak"),
            "peak_tendency": real("absorber wheel peak", "1", "largest tendency near it"),
            "peak_order_tendency": real("absorber wheel peak", "1", "the same at whole orders"),
            "peak_factor": real("absorber wheel peak", "1", "tendency over that without absorber"),
            "peak_order_factor": real("absorber wheel peak", "1", "the same at whole orders"),
            "peak_status": flag("absorber wheel peak", PEAK_STATUS, "whether there is a peak"),
        },
    ),
    "tendency_maps": Stage(
        "Evolution tendency over speed, curve radius and absorber, linearised",
        {
            **_BOGIE_ABSORBERS,
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
    ),
}
