"""Variables of the result files of the basic model: wheelset, bifurcations, absorber."""

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
INSTABILITIES = ("stable", "oscillatory", "monotone", "no_equilibrium")
_AXLE = "stiffness of axle and primary suspension"

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
            "baseline_critical_B": real(
                "", "s/m", "B where self-excitation begins without absorber, NaN if nowhere"
            ),
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
}
