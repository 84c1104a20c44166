"""What the variables of several result files have in common: states, absorbers, cases."""

from __future__ import annotations

from tramdva.variables.kinds import real, text

STATUS = (
    "converged",
    "not_converged",
    "no_hopf_point",
    "no_critical_point",
    "self_excited",
    "limit_reached",
)

INSTABILITIES = ("stable", "oscillatory", "monotone", "no_equilibrium")

AXLE_STIFFNESS = "stiffness of axle and primary suspension"

CURVING_STATUS = ("converged", "not_converged", "wheel_lifted", "outside_profile")
# Why there is no steady running, for readers: the same on all pages.
CURVING_WORDS = {
    "not_converged": "no steady running was found",
    "wheel_lifted": "a wheel lifts off",
    "outside_profile": "a wheel leaves its profile or table",
}

BOGIE_ABSORBERS = {
    "absorber": text("absorber", "absorber of the bogie"),
    "m_T": real("absorber", "kg m^2", "inertia of the absorber (kg if it translates)"),
    "c_T": real("absorber", "N m/rad", "stiffness of the absorber (N/m if it translates)"),
    "d_T": real("absorber", "N m s/rad", "damping of the absorber (N s/m if it translates)"),
}

WAVE_STATUS = (
    "periodic",
    "not_periodic",
    "contact_lost",
    "outside_profile",
    "not_finite",
    "no_equilibrium",
    "self_excited",
)

PEAK_STATUS = ("found", "no_peak")

CASE_STATUS = (*CURVING_STATUS, "not_finite")

CASES = {
    "case": real("case", "1", "number of the case; 0 is the line as configured"),
    "varied": text("case", "none, one range at its min or max, or all"),
    "range": text("range", "what has a range"),
    "share": real("case range", "1", "share of the line's own value"),
    "wheel": text("wheel", "wheel out of round"),
    "friction": text("friction", "decrease B of forced excitation, or of operation"),
}
