"""Variables of `stability_map.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.shared import AXLE_STIFFNESS, INSTABILITIES

VARIABLES = Stage(
    "stability_map",
    "Stability maps of the wheelset with and without absorber (figure 2)",
    {
        "absorber": text("absorber", "absorber, none first"),
        "m_T": real("absorber", "kg", "mass of the absorber"),
        "absorber_c_T": real("absorber", "N/m", "stiffness of the absorber"),
        "absorber_d_T": real("absorber", "N s/m", "damping of the absorber"),
        "c_R": real("c_R", "N/m", "stiffness of the resilient wheel"),
        "c_A": real("c_A", "N/m", AXLE_STIFFNESS),
        "d_T": real("d_T", "N s/m", "damping of the absorber"),
        "c_T": real("c_T", "N/m", "stiffness of the absorber"),
        "growth_rate": real("absorber c_R c_A", "1/s", "largest growth rate"),
        "frequency": real("absorber c_R c_A", "Hz", "frequency of the leading eigenvalue"),
        "hurwitz_h5": real(
            "absorber c_R c_A", "1", "Hurwitz determinant H5 (none: H3), time in ms"
        ),
        "coefficient_a6": real("absorber c_R c_A", "1", "coefficient a6 (none: a4), time in ms"),
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
        "baseline_c_A": real("", "N/m", f"{AXLE_STIFFNESS}, baseline"),
        "baseline_c_R": real("", "N/m", "stiffness of the resilient wheel, baseline"),
        "baseline_critical_B": real(
            "", "s/m", "B where self-excitation begins without absorber, NaN if nowhere"
        ),
    },
)
