"""Variables of `route_remedies.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text

REMEDY_STATUS = ("computed", "no_steady_answer")
KINDS = (
    "slower", "lubricated", "mixed_speeds", "softer_wheels", "harder_wheels", "turned_earlier",
)  # fmt: skip

VARIABLES = Stage(
    "route_remedies",
    "What changes of the route and the wheels buy, without absorbers",
    {
        "wear_law": text("", "law of wear"),
        "remedy": text("remedy", "what is done, the longest life of the wheels first"),
        "remedy_section": text("remedy", "section in which it is done, empty: everywhere"),
        "remedy_distance": real("remedy", "km", "distance between turnings, energy of the waves"),
        "remedy_gain": real("remedy", "1", "this distance over that of the route as it is"),
        "remedy_wheel_life": real("remedy", "km", "life of the wheels"),
        "remedy_status": flag("remedy", REMEDY_STATUS, "whether all conditions run steadily"),
        "bare_distance": real("", "km", "distance of the route as it is, energy of the waves"),
        "bare_wheel_life": real("", "km", "life of the wheels there"),
        "bare_status": flag("", REMEDY_STATUS, "whether all conditions run steadily"),
        "speed_scatter": real("speed_scatter", "1", "scatter of the speed in the line's own curve"),
        "excitation": text("excitation", "waves in phase as in figure 10, or each wheel's own"),
        "absorber": text("absorber", "absorber of the bogie"),
        "wheel": text("wheel", "wheel out of round"),
        "scatter_growth": real(
            "excitation speed_scatter absorber wheel",
            "1",
            "largest growth of an order in the band of design, per revolution",
        ),
        "scatter_order": real(
            "excitation speed_scatter absorber wheel", "1", "this order, NaN where none grows"
        ),
        "scatter_factor": real(
            "excitation speed_scatter absorber wheel", "1", "growth over that without absorbers"
        ),
        "scatter_all_growth": real(
            "excitation speed_scatter absorber wheel",
            "1",
            "largest growth of all orders, per revolution",
        ),
        "scatter_status": flag(
            "speed_scatter absorber", REMEDY_STATUS, "whether all speeds run steadily"
        ),
    },
)
