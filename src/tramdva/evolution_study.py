"""Parameters of out-of-roundness, wear and evolution tendency, and the numerics of their stages."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from tramdva.bogie_study import (
    AbsorberDampingInterval,
    AbsorberName,
    AbsorberStiffnessInterval,
    ModeFrequencyInterval,
)
from tramdva.quantities import (
    Interval,
    Real,
    Section,
    Whole,
    measured_file,
    quantity,
    unique,
)

WheelName = Annotated[
    str, Field(pattern="^(front|rear)_(outer|inner)$", description="front or rear, outer or inner")
]
GREATEST_ORDER = 400


class OutOfRoundness(Section):
    """Waves on the wheels: in phase, one order per simulation."""

    amplitude: Real = quantity("amplitude of an order", "m", 1e-8, 1e-4, "ASSUME")
    wheels: Annotated[
        tuple[WheelName, ...], Field(min_length=1, max_length=4), AfterValidator(unique)
    ] = Field(description="wheels that are out of round, their waves in phase (angle s/r_0)")
    measured: str = measured_file("a measured radius deviation, angle in degrees and um")


class Wear(Section):
    """KTH wear chart."""

    method: str = Field(
        pattern="^(chart|smoothed|constant)$",
        description="chart (sharp steps), smoothed (smooth steps) or constant (one coefficient)",
    )
    hardness: Real = quantity("hardness of the softer body", "N/m^2", 5e8, 2e10, "ASSUME")
    coefficient_mild: Real = quantity("wear coefficient, mild", "-", 1e-7, 1, "ASSUME")
    coefficient_severe: Real = quantity("wear coefficient, severe", "-", 1e-7, 1, "ASSUME")
    coefficient_mild_fast: Real = quantity("wear coefficient, mild, fast", "-", 1e-7, 1, "ASSUME")
    coefficient_seizure: Real = quantity("wear coefficient, seizure", "-", 1e-7, 1, "ASSUME")
    velocity_low: Real = quantity("slip velocity, mild to severe", "m/s", 0.01, 5, "KTH chart")
    velocity_high: Real = quantity("slip velocity, severe to fast", "m/s", 0.02, 20, "KTH chart")
    pressure_share: Real = quantity("seizure above this share of H", "-", 0.05, 5, "KTH chart")
    velocity_width: Real = quantity("half width of smooth steps", "m/s", 1e-4, 5, "ASSUME")
    pressure_width_share: Real = quantity("half width, share of H", "-", 1e-4, 5, "ASSUME")
    coefficient_constant: Real = quantity("the one coefficient", "-", 1e-7, 1, "ASSUME")

    @model_validator(mode="after")
    def _steps_apart(self) -> Self:
        if self.velocity_low + self.velocity_width > self.velocity_high - self.velocity_width:
            raise ValueError(
                "velocity_low + velocity_width must be at most velocity_high - velocity_width"
            )
        return self


class TendencyFrequencyInterval(Interval):
    """Frequencies of the linearised evolution tendency."""

    min: Real = quantity("lower end", "Hz", 0.1, 1e3)
    max: Real = quantity("upper end", "Hz", 1, 1e3)


class Peak(Interval):
    """Frequencies in which a positive peak of the tendency is sought."""

    name: str = Field(pattern="^[a-z][a-z0-9_]{0,40}$", description="name of the mode behind it")
    min: Real = quantity("lower end", "Hz", 0.1, 1e3)
    max: Real = quantity("upper end", "Hz", 0.1, 1e3)


class EvolutionTendencyStudy(Section):
    """Evolution tendency of figure 10."""

    absorbers: Annotated[
        tuple[AbsorberName, ...], Field(min_length=1, max_length=3), AfterValidator(unique)
    ] = Field(description="absorbers with which the bogie runs; none must be among them")
    frequency: TendencyFrequencyInterval
    revolutions: Real = quantity("revolutions of the predicted levels", "-", 1, 1e6, "ASSUME")
    peaks: Annotated[tuple[Peak, ...], Field(min_length=1, max_length=20)] = Field(
        description="peaks of the tendency"
    )

    @model_validator(mode="after")
    def _complete(self) -> Self:
        if "none" not in self.absorbers:
            raise ValueError("absorbers must name none: all curves are normalised by it")
        unique(tuple(peak.name for peak in self.peaks))
        return self


class SpeedInterval(Interval):
    """Speeds of the map."""

    min: Real = quantity("lower end", "m/s", 0.5, 30)
    max: Real = quantity("upper end", "m/s", 0.5, 30)


class RadiusInterval(Interval):
    """Curve radii of the map."""

    min: Real = quantity("lower end", "m", 10, 5000)
    max: Real = quantity("upper end", "m", 10, 5000)


class TendencyMapsStudy(Section):
    """Ranges of the tendency's maps."""

    speed: SpeedInterval
    radius: RadiusInterval
    design_band: TendencyFrequencyInterval
    c_T: AbsorberStiffnessInterval
    d_T: AbsorberDampingInterval


class DesignStiffnessInterval(Interval):
    """Stiffnesses of the bogie's absorber in equal ratios."""

    min: Real = quantity("lower end", "N m/rad", 1, 1e9)
    max: Real = quantity("upper end", "N m/rad", 1, 1e9)


class DesignDampingInterval(Interval):
    """Dampings of the bogie's absorber in equal ratios."""

    min: Real = quantity("lower end", "N m s/rad", 1e-3, 1e7)
    max: Real = quantity("upper end", "N m s/rad", 1e-3, 1e7)


class BogieDesignsStudy(Section):
    """Designs of the bogie's absorber in the explorer."""

    self_excitation: ModeFrequencyInterval
    c_T: DesignStiffnessInterval
    d_T: DesignDampingInterval


class BogieSimulationNumerics(Section):
    """Simulation of one order."""

    samples: Whole = quantity("intervals per revolution", "-", 64, 16384)
    revolutions: Whole = quantity("revolutions that are kept", "-", 1, 50)
    longest_transient: Whole = quantity("revolutions before them at most", "-", 1, 1000)
    tolerance: Real = quantity("largest difference of a revolution", "-", 1e-8, 0.1)
    step_tolerance: Real = quantity("of the integration, share of the wave's speed", "-", 1e-6, 1)


class WearNumerics(Section):
    """Cells of the patch for wear."""

    wear_cells_along: Whole = quantity("cells of the worn patch along the rail", "-", 4, 200)
    wear_strips: Whole = quantity("strips of the worn patch", "-", 4, 200)


class Orders(Section):
    """Orders that are simulated."""

    first: Whole = quantity("first order", "-", 1, GREATEST_ORDER)
    last: Whole = quantity("last order", "-", 1, GREATEST_ORDER)
    step: Whole = quantity("step between orders", "-", 1, GREATEST_ORDER)

    @model_validator(mode="after")
    def _not_empty(self) -> Self:
        if self.first > self.last:
            raise ValueError("first must be at most last")
        return self

    def listed(self) -> list[int]:
        """All orders."""
        return list(range(self.first, self.last + 1, self.step))


class EvolutionTendencyNumerics(Section):
    """Orders and frequencies of the evolution tendency."""

    orders: Orders
    frequency_points: Whole = quantity("frequencies of the linearised vehicle", "-", 10, 100000)


class TendencyMapsNumerics(Section):
    """Grids of the tendency's maps."""

    speeds: Whole = quantity("speeds", "-", 2, 1000)
    radii: Whole = quantity("curve radii", "-", 2, 1000)
    frequency_points: Whole = quantity("frequencies", "-", 10, 10000)
    map_points: Whole = quantity("grid points per axis of the absorber map", "-", 2, 500)


class BogieDesignsNumerics(Section):
    """Grid of the bogie's absorber designs."""

    c_T_points: Whole = quantity("stiffnesses of the absorber", "-", 2, 200)
    d_T_points: Whole = quantity("dampings of the absorber", "-", 2, 200)
    frequency_points: Whole = quantity("frequencies", "-", 10, 10000)
