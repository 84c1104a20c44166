"""Variables of `route_response.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import BOGIE_ABSORBERS, CURVING_STATUS

ROUTE_STATUS = (*CURVING_STATUS, "no_equilibrium", "self_excited")

VARIABLES = Stage(
    "route_response",
    "Wear of the wheels by their own waves in the running conditions of the route",
    {
        "wear_law": text("wear_law", "law of wear"),
        "class": text("class", "running condition: curve, speed, end of the vehicle that leads"),
        "radius": real("class", "m", "curve radius, NaN on straight track"),
        "turn": text("class", "left, right or straight, as the tram runs"),
        "leading": text("class", "end of the vehicle that leads"),
        "cant": real("class", "m", "outer rail above the inner one"),
        "mean_speed": real("class", "m/s", "mean speed"),
        "speed_scatter": real("class", "1", "standard deviation of the speed, share of the mean"),
        "mean_friction": real("class", "1", "largest friction coefficient mu_0"),
        "flange_wear_share": real("class", "1", "wear of flange contacts, share of dry ones"),
        "distance_share": real("class", "1", "share of the distance"),
        "section": text("section", "section of the route"),
        "section_share": real("section class", "1", "share of the distance"),
        **BOGIE_ABSORBERS,
        "wheel": text("wheel", "wheel of the vehicle, seen from its end A"),
        "order": real("order", "1", "waves around the wheel"),
        "speed": real("class speed_point", "m/s", "speed"),
        "speed_weight": real("class speed_point", "1", "share of the passages"),
        "coarse_speed_weight": real("class speed_point", "1", "the same with twice the step"),
        "revolutions_per_1000_km": real(
            "class speed_point wheel", "1", "revolutions of the wheel, by speed and distance"
        ),
        "wear_response_real": real(
            "wear_law class absorber wheel order speed_point",
            "1",
            "wear response per revolution of the own wheel, real part",
        ),
        "wear_response_imag": real(
            "wear_law class absorber wheel order speed_point", "1", "the same, imaginary part"
        ),
        "surface": text("surface", "tread or flange with its root, by the contact angle"),
        "mean_wear_depth": real(
            "wear_law class surface wheel speed_point", "m", "mean wear per revolution by the law"
        ),
        "status": flag("class absorber speed_point", ROUTE_STATUS, "of the vehicle there"),
        "wear_scale": real("wear_law", "1", "measured wear of the tread over that by the law"),
        "flange_wear_ratio": real(
            "wear_law", "1", "the same of the flange over that of the tread; in wear_response"
        ),
    },
)
