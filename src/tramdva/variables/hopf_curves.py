"""Variables of `hopf_curves.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real
from tramdva.variables.shared import AXLE_STIFFNESS

SPECIAL_HOPF_POINTS = ("critical", "generalised_hopf", "zero_frequency")

VARIABLES = Stage(
    "hopf_curves",
    "Hopf points over the stiffnesses of axle and absorber (figure 4)",
    {
        "curve": real("curve_point", "1", "number of the curve, its points in order"),
        "d_T": real("curve_point", "N s/m", "damping of the absorber"),
        "c_A": real("curve_point", "N/m", AXLE_STIFFNESS),
        "c_T": real("curve_point", "N/m", "stiffness of the absorber"),
        "frequency": real("curve_point", "Hz", "frequency"),
        "first_lyapunov_coefficient": real(
            "curve_point", "s2 m-2", "first Lyapunov coefficient (negative: supercritical)"
        ),
        "residual": real("curve_point", "1", "largest scaled residual of eq. (10)"),
        "special_kind": flag("special_point", SPECIAL_HOPF_POINTS, "kind of special point"),
        "special_d_T": real("special_point", "N s/m", "damping of the absorber"),
        "special_c_A": real("special_point", "N/m", AXLE_STIFFNESS),
        "special_c_T": real("special_point", "N/m", "stiffness of the absorber"),
    },
)
