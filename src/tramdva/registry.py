"""The variables of every result file: name, dimensions, unit and meaning.

Others read the files by these names. A variable that bears the name of its only dimension is the
coordinate of this dimension. Texts are fixed-length strings, flags are int8 with `flag_values`
and `flag_meanings`; a truth is the flag `false true`.
"""

from __future__ import annotations

from dataclasses import dataclass

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
INSTABILITIES = ("stable", "oscillatory", "monotone", "no_equilibrium")
_AXLE = "stiffness of axle and primary suspension"


@dataclass(frozen=True)
class Variable:
    """One variable of a result file."""

    kind: str  # real, flag, truth, text
    dimensions: tuple[str, ...]
    unit: str
    long_name: str
    meanings: tuple[str, ...] = ()  # of the values 0, 1, 2, ... of a flag


@dataclass(frozen=True)
class Stage:
    """One result file."""

    title: str
    variables: dict[str, Variable]


def real(dimensions: str, unit: str, long_name: str) -> Variable:
    """Describe a variable of float64."""
    return Variable("real", tuple(dimensions.split()), unit, long_name)


def flag(dimensions: str, meanings: tuple[str, ...], long_name: str) -> Variable:
    """Describe a variable that takes one of a few named values."""
    return Variable("flag", tuple(dimensions.split()), "1", long_name, meanings)


def truth(dimensions: str, long_name: str) -> Variable:
    """Describe a variable that is true or false."""
    return Variable("truth", tuple(dimensions.split()), "1", long_name, ("false", "true"))


def text(dimensions: str, long_name: str) -> Variable:
    """Describe a variable of texts."""
    return Variable("text", tuple(dimensions.split()), "1", long_name)


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
}
