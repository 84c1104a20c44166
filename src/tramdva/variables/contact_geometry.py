"""Variables of `contact_geometry.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, real

VARIABLES = Stage(
    "contact_geometry",
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
    by_plane=("coefficients",),
)
