"""Variables of `polygon_growth.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.shared import BOGIE_ABSORBERS

DISTANCE_STATUS = ("reached", "beyond_horizon", "beyond_at_once", "no_steady_answer")

_BY_WHEEL, _BY_ORDER = "wear_law absorber wheel", "wear_law absorber wheel order"

VARIABLES = Stage(
    "polygon_growth",
    "Growth of wheel orders over kilometres of the route, small waves",
    {
        "wear_law": text("wear_law", "law of wear"),
        **BOGIE_ABSORBERS,
        "wheel": text("wheel", "wheel of the vehicle, seen from its end A"),
        "order": real("order", "1", "waves around the wheel"),
        "growth_per_1000_km": real(_BY_ORDER, "1", "growth of the order in 1000 km, e-folds"),
        "drift_per_1000_km": real(_BY_ORDER, "rad", "drift of the wave in 1000 km"),
        "quadrature_error": real(
            _BY_ORDER, "1", "change of the growth by twice the step over the speeds"
        ),
        "section": text("section", "section of the route"),
        "section_share": real(
            f"{_BY_ORDER} section", "1", "share of the section in the growth of the order"
        ),
        "first_wheel": real(
            "wear_law absorber", "1", "number of the wheel with the fastest order, -1: no answer"
        ),
        "fastest_order": real(_BY_WHEEL, "1", "order that grows most"),
        "fastest_growth": real(_BY_WHEEL, "1", "its growth in 1000 km, e-folds"),
        "fastest_section": text(_BY_WHEEL, "section with the largest share in it"),
        "wave_growth_per_wear": real(
            _BY_WHEEL, "mm-1", "its e-folds per mm of mean wear of the same wheel"
        ),
        "distance": real("distance", "km", "distance since the wheel was turned"),
        "initial_level": real("order", "dB", "level of the turned wheel, re 1 um"),
        "level": real(f"{_BY_ORDER} distance", "dB", "level over the distance, re 1 um"),
        "peak_to_peak": real(
            f"{_BY_WHEEL} distance", "m", "out-of-roundness over the distance, peak to peak"
        ),
        "limit": real("", "m", "out-of-roundness at which wheels are turned, peak to peak"),
        "distance_to_limit": real(_BY_WHEEL, "km", "distance to the limit, NaN where none"),
        "distance_status": flag(_BY_WHEEL, DISTANCE_STATUS, "how the distance ended"),
        "turning_distance": real(
            "wear_law absorber", "km", "distance to the limit of the first wheel, NaN where none"
        ),
        "turning_status": flag("wear_law absorber", DISTANCE_STATUS, "of this distance"),
        "wheel_life": real("wear_law absorber", "km", "from new to worn out, turned in time"),
        "angle": real("angle", "rad", "angle around the wheel"),
        "turned_profile": real(
            "wear_law absorber wheel angle",
            "m",
            "radius deviation when the first wheel is at the limit (or at the horizon)",
        ),
        "distance_share": real("section", "1", "share of the section in the distance"),
        "section_x": real("plan_point", "m", "plan of the way there: along"),
        "section_y": real("plan_point", "m", "plan of the way there: to the left"),
        "plan_section": real("plan_point", "1", "number of the section there, from zero"),
        "hindrance": text("absorber", "where there is no steady answer, empty: nowhere"),
        "mean_wear_per_10000_km": real(
            "wear_law wheel surface", "mm", "mean loss of radius, as scaled"
        ),
        "surface": text("surface", "tread or flange with its root, by the contact angle"),
        "longest_absorber": text("wear_law", "absorber with the longest distance, empty: none"),
        "laws_agree": truth("", "whether all laws of wear name the same absorber"),
        "shown_wear_law": text("", "law that figures and sheet tell first"),
    },
)
