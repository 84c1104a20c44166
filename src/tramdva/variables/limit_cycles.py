"""Variables of `limit_cycles.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.shared import AXLE_STIFFNESS, STATUS

SPECIAL_CYCLES = ("hopf", "fold", "period_doubling", "torus")

BRANCH_ENDS = ("hopf_point", "window", "max_points", "no_convergence", "sharp_turn")

VARIABLES = Stage(
    "limit_cycles",
    "Limit cycles over the stiffness of the axle (figure 3)",
    {
        "absorber": text("cycle", "absorber"),
        "cycle_branch": real("cycle", "1", "position of its branch along the dimension branch"),
        "m_T": real("cycle", "kg", "mass of the absorber"),
        "c_T": real("cycle", "N/m", "stiffness of the absorber"),
        "d_T": real("cycle", "N s/m", "damping of the absorber"),
        "c_A": real("cycle", "N/m", AXLE_STIFFNESS),
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
        "equilibrium_c_A": real("equilibrium", "N/m", AXLE_STIFFNESS),
        "equilibrium_y_R": real("equilibrium", "m", "position of the rim"),
        "mean_equilibrium_y_R": real("", "m", "mean position of the rim in equilibrium"),
        "equilibrium_stable": truth("equilibrium", "whether the equilibrium is stable"),
        "special_kind": flag("special_point", SPECIAL_CYCLES, "kind of special point"),
        "special_absorber": text("special_point", "absorber"),
        "special_c_A": real("special_point", "N/m", AXLE_STIFFNESS),
        "branch_absorber": text("branch", "absorber"),
        "branch_c_A": real("branch", "N/m", f"{AXLE_STIFFNESS} where the branch starts"),
        "branch_ended": flag("branch", BRANCH_ENDS, "why the branch ends"),
    },
)
