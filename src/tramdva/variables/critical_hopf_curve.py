"""Variables of `critical_hopf_curve.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, truth
from tramdva.variables.shared import AXLE_STIFFNESS

VARIABLES = Stage(
    "critical_hopf_curve",
    "Critical Hopf points: where the Hopf points merge (figures 4 to 6)",
    {
        "piece": real("critical_point", "1", "number of the piece, its points in order"),
        "branch": flag("critical_point", ("upper", "lower"), "branch of the curve"),
        "d_T": real("critical_point", "N s/m", "damping of the absorber"),
        "c_T": real("critical_point", "N/m", "stiffness of the absorber"),
        "c_A": real("critical_point", "N/m", AXLE_STIFFNESS),
        "frequency": real("critical_point", "Hz", "frequency"),
        "residual": real("critical_point", "1", "largest residual of eqs (10) and (15)"),
        "stabilises_all_c_A": truth(
            "critical_point", "whether every stiffness of the axle is stable or marginal"
        ),
        "special_kind": flag("special_point", ("largest_c_T", "fold"), "kind of special point"),
        "special_d_T": real("special_point", "N s/m", "damping of the absorber"),
        "special_c_T": real("special_point", "N/m", "stiffness of the absorber"),
        "special_c_A": real("special_point", "N/m", AXLE_STIFFNESS),
    },
)
