"""Variables of the result files of the robustness sample and the robust tuning."""

from __future__ import annotations

from tramdva.bogie_variables import CURVING_STATUS
from tramdva.result_variables import Stage, Variable, flag, real, text, truth

CASE_STATUS = (*CURVING_STATUS, "not_finite")
TUNING_STATUS = ("converged", "self_excited", "nothing_grows", "no_equilibrium")


def _complex(name: str, dimensions: str, unit: str, long_name: str) -> dict[str, Variable]:
    """Describe a complex variable, kept as two."""
    return {
        f"{name}_real": real(dimensions, unit, long_name),
        f"{name}_imag": real(dimensions, unit, "its imaginary part"),
    }


CASES = {
    "case": real("case", "1", "number of the case; 0 is the line as configured"),
    "varied": text("case", "none, one range at its min or max, or all"),
    "range": text("range", "what has a range"),
    "share": real("case range", "1", "share of the line's own value"),
    "wheel": text("wheel", "wheel out of round"),
    "friction": text("friction", "decrease B of forced excitation, or of operation"),
}

STAGES: dict[str, Stage] = {
    "robustness_sample": Stage(
        "The bogie without absorbers under varied conditions, as its absorbers see it",
        {
            **CASES,
            "status": flag("case", CASE_STATUS, "status of the equilibria"),
            "speed": real("case", "m/s", "speed of the vehicle"),
            "unsprung_mass": real("", "kg", "axle with its wheels as configured"),
            "frequency": real("case node", "Hz", "frequency"),
            "bare_growth_rate": real(
                "case friction", "s-1", "largest growth rate without absorbers"
            ),
            **_complex("wear_by_wave", "case node wheel", "1", "wear response to waves"),
            **_complex(
                "wear_by_force",
                "case node wheel place",
                "(N m)-1 m",
                "wear by torques (forces) of the absorbers",
            ),
            **_complex(
                "place_by_wave", "case node place", "rad/m", "motion of their places by waves"
            ),
            **_complex(
                "place_by_force",
                "case node place other_place",
                "rad/(N m)",
                "motion of their places by torques (forces) there",
            ),
            **_complex(
                "eigenvalue", "case friction mode", "s-1", "eigenvalue, NaN beyond the last"
            ),
            **_complex(
                "mode_place", "case friction carrier mode", "1", "motion of the places per mode, SI"
            ),
            **_complex(
                "mode_forcing", "case friction mode carrier", "1", "forcing of the mode there, SI"
            ),
        },
    ),
    "robust_tuning": Stage(
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
            "load_order": real("design case", "1", "its order, not necessarily whole"),
        },
    ),
}
