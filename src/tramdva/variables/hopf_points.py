"""Variables of `hopf_points.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import AXLE_STIFFNESS, STATUS

VARIABLES = Stage(
    "hopf_points",
    "Hopf points over the stiffness of the axle (figure 3)",
    {
        "absorber": text("hopf_point", "absorber"),
        "m_T": real("hopf_point", "kg", "mass of the absorber"),
        "c_T": real("hopf_point", "N/m", "stiffness of the absorber"),
        "d_T": real("hopf_point", "N s/m", "damping of the absorber"),
        "c_A": real("hopf_point", "N/m", AXLE_STIFFNESS),
        "frequency": real("hopf_point", "Hz", "frequency"),
        "first_lyapunov_coefficient": real(
            "hopf_point", "s2 m-2", "first Lyapunov coefficient (negative: supercritical)"
        ),
        "residual": real("hopf_point", "1", "largest scaled residual of eq. (10)"),
        "status": flag("hopf_point", STATUS, "status"),
    },
)
