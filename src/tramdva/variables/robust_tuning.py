"""Variables of `robust_tuning.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.shared import CASE_STATUS, CASES

TUNING_STATUS = ("converged", "self_excited", "nothing_grows", "no_equilibrium")

VARIABLES = Stage(
    "robust_tuning",
    "Nominal and robust optimum of the absorber, and what designs leave in every case",
    {
        **CASES,
        "case_status": flag("case", CASE_STATUS, "status of the equilibria"),
        "counted": truth("case", "whether an absorber can keep it from vibrating by itself"),
        "design": text("design", "design of the absorber"),
        "status": flag("design", TUNING_STATUS, "how the search ended"),
        "I_T": real("design", "kg m^2", "inertia of the absorber (kg if it translates)"),
        "c_T": real("design", "N m/rad", "stiffness (N/m if it translates)"),
        "d_T": real("design", "N m s/rad", "damping (N s/m if it translates)"),
        "tuned_frequency": real("design", "Hz", "own frequency of the absorber"),
        "damping_ratio": real("design", "1", "own damping ratio of the absorber"),
        "added_mass": real("design", "kg", "mass of one absorber"),
        "unsprung_mass": real("", "kg", "axle with its wheels as configured"),
        "tolerance": real(
            "design axis end", "N m/rad, N m s/rad", "band of c_T and d_T, NaN where open"
        ),
        "map_c_T": real("map_c_T", "N m/rad", "stiffness of the absorber"),
        "map_d_T": real("map_d_T", "N m s/rad", "damping of the absorber"),
        "map_nominal_factor": real("map_d_T map_c_T", "1", "factor of the line as configured"),
        "map_worst_factor": real("map_d_T map_c_T", "1", "largest factor of the cases counted"),
        "nominal_factor": real("design", "1", "factor of the line as configured"),
        "worst_factor": real(
            "design", "1", "largest factor of the cases counted and the absorber's own ranges"
        ),
        "self_excited_cases": real("design", "1", "cases counted that vibrate by themselves"),
        "factor": real("design case", "1", "growth in the band over the reference"),
        "reference": real("case", "1", "growth without absorbers, of the case or nominal"),
        "rubber_end": text("rubber_end", "end of a range of the absorber's own"),
        "rubber_factor": real("design rubber_end", "1", "nominal factor at this end"),
        "peak": text("peak", "peak of the tendency, by the mode behind it"),
        "peak_frequency": real("case wheel peak", "Hz", "frequency of the peak, NaN if none"),
        "peak_factor": real("design case wheel peak", "1", "growth at the peak over reference"),
        "growth_rate": real("design case friction", "s-1", "largest growth rate"),
        "carrier_amplitude": real("design case", "rad", "motion of the place (m: translation)"),
        "stroke_amplitude": real("design case", "rad", "motion relative to it"),
        "torque_amplitude": real("design case", "N m", "torque on the mounting (N)"),
        "dissipated_power": real("design case", "W", "mean power that one absorber dissipates"),
        "load_frequency": real("design case", "Hz", "frequency of the largest torque"),
        # Of other masses, where none of the configured one is of use; NaN where none was tried.
        "tried_I_T": real("tried", "kg m^2", "inertia that was tried (kg if it translates)"),
        "tried_c_T": real("tried", "N m/rad", "stiffness of its robust optimum"),
        "tried_d_T": real("tried", "N m s/rad", "damping of its robust optimum"),
        "tried_nominal_factor": real("tried", "1", "its factor of the line as configured"),
        "tried_worst_factor": real("tried", "1", "its largest factor of the cases counted"),
        "tried_is_enough": truth("tried", "whether it leaves less than there was, and is quiet"),
        "outcome": text("outcome", "status that an equilibrium can have"),
        "outcome_cases": real("outcome", "1", "cases of this status"),
        "sampled_cases": real("", "1", "cases drawn from all ranges at once"),
        "sampled_steady_cases": real("", "1", "those of them that have an equilibrium"),
        "counted_cases": real("", "1", "cases that count in the worst case"),
        "uncounted_cases": real("", "1", "cases with an equilibrium that do not count"),
        "self_excited_share": real(
            "design", "1", "share of drawn cases with an equilibrium that vibrate by themselves"
        ),
        "quantile": real("quantile", "1", "share of drawn cases at or below"),
        "peak_factor_quantile": real("design wheel peak quantile", "1", "factor of drawn cases"),
        "worse_peak_factor": real("design case peak", "1", "factor at the peak, worse wheel"),
        "worse_peak_factor_quantile": real(
            "design peak quantile", "1", "factor of drawn cases, worse wheel"
        ),
        "worst_carrier_amplitude": real(
            "design", "rad", "largest motion of the place in cases counted (m: translation)"
        ),
        "worst_stroke_amplitude": real("design", "rad", "largest motion relative to it"),
        "worst_torque_amplitude": real("design", "N m", "largest torque on the mounting (N)"),
        "worst_dissipated_power": real("design", "W", "largest power that one dissipates"),
        "added_axle_mass": real("design", "kg", "mass of the absorbers of an axle"),
        "added_axle_share": real("design", "1", "the same over the unsprung mass"),
        "added_weight": real("design", "N", "weight of one absorber"),
        "load_order": real("design case", "1", "its order, not necessarily whole"),
    },
)
