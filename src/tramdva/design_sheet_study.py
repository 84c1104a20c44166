"""Ranges and numerics of the robustness sample, the robust tuning and the design sheet."""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from tramdva.quantities import Real, Section, Whole, quantity


class ShareRange(Section):
    """Shares of the line's own value; the own value, 1, is among them."""

    min: Real = quantity("smallest share of the line's value", "-", 0.2, 1, "ASSUME")
    max: Real = quantity("largest share of the line's value", "-", 1, 5, "ASSUME")


class ConditionRanges(Section):
    """Ranges of what changes in service, as shares of the line's own values."""

    friction: ShareRange
    friction_decrease: ShareRange
    radius: ShareRange
    speed: ShareRange
    car_body_mass: ShareRange
    wheel_stiffness: ShareRange
    wheel_damping: ShareRange
    primary_stiffness: ShareRange
    primary_damping: ShareRange


class RubberRanges(Section):
    """Ranges of the absorber's own rubber, as shares of its values."""

    stiffness: ShareRange
    damping: ShareRange


class DesignSheetStudy(Section):
    """What the design of the absorber must bear, and what its sheet tells."""

    conditions: ConditionRanges
    rubber: RubberRanges
    tolerance: Real = quantity(
        "share by which the factor may exceed its best within the tolerance band",
        "-",
        0.01,
        10,
        "ASSUME",
    )
    wave_amplitude: Real = quantity(
        "amplitude of the wave for stroke and forces", "m", 1e-8, 1e-3, "ASSUME"
    )
    gyration_radius: Real = quantity(
        "radius of gyration of a rotating absorber, for its mass", "m", 0.01, 1, "ASSUME"
    )
    rim_radius: Real = quantity(
        "radius at which the stroke of a rotating absorber is told", "m", 0.01, 2, "ASSUME"
    )

    @model_validator(mode="after")
    def _rim_outside(self) -> Self:
        if self.rim_radius < self.gyration_radius:
            raise ValueError("rim_radius must be at least gyration_radius")
        return self


class RobustnessSampleNumerics(Section):
    """Sample of the ranges, in parts that are parallel jobs."""

    samples: Whole = quantity("points of the sequence over all ranges", "-", 2, 65536)
    parts: Whole = quantity("parts of the sample", "-", 1, 1000)
    seed: Whole = quantity("seed of the sequence", "-", 0, 2147483647)
    frequency_step: Real = quantity("of the frequencies between the modes", "Hz", 0.05, 5)


class RobustTuningNumerics(Section):
    """Grid on which the search for the absorber starts."""

    map_points: Whole = quantity("grid points per axis", "-", 3, 500)
