"""Parameters of a route: its sections, what the operator measured, when wheels are turned."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from tramdva.quantities import Label, Real, Section, Whole, measured_file, quantity

TURNS = ("left", "right", "straight")
MOST_SECTIONS = 2000
# What a section that does not say it has; the scatter is one of city traffic.
SILENT: Mapping[str, float | None] = {
    "radius_m": None,
    "transition_m": 0.0,
    "cant_mm": 0.0,
    "speed_scatter_percent": 5.0,
    "friction": None,
    "flange_wear_share": 1.0,
    "passages_per_lap": 1.0,
}


class RouteSection(Section):
    """A stretch of track of one radius, run at one speed with its scatter."""

    name: Label = Field(
        min_length=1, max_length=60, description="a name for the tables, at most 60 letters"
    )
    length_m: Real = quantity("length of the section", "m", 0.1, 1e6)
    radius_m: Real | None = quantity("radius of the curve, nothing on straight track", "m", 10, 1e5)
    turn: str = Field(
        pattern=f"^({'|'.join(TURNS)})$", description="left, right or straight, as it is run"
    )
    transition_m: Real = quantity("length of each transition, outside of the length", "m", 0, 500)
    cant_mm: Real = quantity("outer rail above the inner one", "mm", 0, 200)
    speed_km_h: Real = quantity("mean speed", "km/h", 1.8, 108)
    speed_scatter_percent: Real = quantity(
        "standard deviation of the speed between passages", "% of the mean", 0, 20
    )
    friction: Real | None = quantity("mu_0 there; nothing: the line's", "-", 0.05, 1)
    flange_wear_share: Real = quantity(
        "wear of flange contacts, share of dry ones (lubrication)", "-", 0.01, 1
    )
    passages_per_lap: Real = quantity("passages in a lap", "-", 0, 1000)

    @model_validator(mode="before")
    @classmethod
    def _silent(cls, given: Any) -> Any:
        return {**SILENT, **given} if isinstance(given, Mapping) else given

    @model_validator(mode="after")
    def _curved_or_straight(self) -> Self:
        if (self.turn == "straight") != (self.radius_m is None):
            raise ValueError("a curve has turn left or right and a radius_m, a straight neither")
        return self


class MeasuredWear(Section):
    """Mean wear of the wheels as the workshop measures it."""

    tread_mm_per_10000_km: Real = quantity(
        "mean loss of radius at the tape circle", "mm per 10 000 km", 1e-3, 20, "ASSUME"
    )
    flange_mm_per_10000_km: Real | None = quantity(
        "mean loss of flange thickness; nothing: flanges as the tread",
        "mm per 10 000 km",
        1e-3,
        20,
        "ASSUME",
    )

    @model_validator(mode="before")
    @classmethod
    def _silent(cls, given: Any) -> Any:
        silent = {"flange_mm_per_10000_km": None}
        return {**silent, **given} if isinstance(given, Mapping) else given


class InitialSpectrum(Section):
    """Levels of the orders of a wheel that has just been turned."""

    level_dB: Real = quantity("level of order 1, effective value re 1 um", "dB", -60, 60, "ASSUME")
    slope_dB_per_octave: Real = quantity("change per doubled order", "dB", -30, 10, "ASSUME")
    seed: Whole = quantity("seed of the phases", "-", 0, 2147483647)


class Turning(Section):
    """When a wheel is turned on the lathe, and what that takes."""

    peak_to_peak_mm: Real = quantity(
        "largest out-of-roundness, peak to peak", "mm", 0.01, 10, "ASSUME"
    )
    cut_mm: Real = quantity("radius that a turning takes", "mm", 0.05, 10, "ASSUME")
    usable_radius_mm: Real = quantity("radius from new to worn out", "mm", 1, 100, "ASSUME")


class Material(Section):
    """A material of the absorber's spring, and what cold and heat make of it."""

    name: Label = Field(min_length=1, max_length=40, description="its name, at most 40 letters")
    loss_factor_min: Real = quantity("smallest loss factor", "-", 0.005, 10, "ASSUME")
    loss_factor_max: Real = quantity("largest loss factor", "-", 0.005, 10, "ASSUME")
    stiffness_cold: Real = quantity("stiffness in the cold over its own", "-", 0.2, 20, "ASSUME")
    stiffness_hot: Real = quantity("stiffness in the heat over its own", "-", 0.05, 5, "ASSUME")
    loss_cold: Real = quantity("loss factor in the cold over its own", "-", 0.1, 10, "ASSUME")
    loss_hot: Real = quantity("loss factor in the heat over its own", "-", 0.1, 10, "ASSUME")

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.loss_factor_min >= self.loss_factor_max:
            raise ValueError("loss_factor_min must be less than loss_factor_max")
        return self


class Route(Section):
    """The route of the tram and the wear that was measured on it."""

    file: str = measured_file("a table of sections; then it counts instead of `sections`")
    way: str = Field(
        pattern="^(there_and_back|lap)$",
        description="there_and_back (the sections are run both ways) or lap (they are a ring)",
    )
    ends: str = Field(
        pattern="^(reverse|loop)$",
        description="reverse (the other end leads on the way back) or loop",
    )
    sections: Annotated[tuple[RouteSection, ...], Field(min_length=1, max_length=MOST_SECTIONS)] = (
        Field(description="sections of the way there, in their order")
    )
    wear_law: str = Field(
        pattern="^(chart|smoothed|constant|energy)$",
        description="law that figures and sheet tell first: chart, smoothed, constant or energy",
    )
    measured_wear: MeasuredWear
    initial: InitialSpectrum
    turning: Turning
    materials: Annotated[tuple[Material, ...], Field(min_length=1, max_length=10)] = Field(
        description="materials among which the absorber for the route is sought"
    )
    horizon_km: Real = quantity("distance up to which levels are told", "km", 100, 1e6, "ASSUME")
