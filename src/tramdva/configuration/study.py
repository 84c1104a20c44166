"""Ranges of figures and maps: the section `study` of a line."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from tramdva.quantities import Interval, Real, Section, quantity, unique


class StiffnessInterval(Interval):
    """Range of a stiffness."""

    min: Real = quantity("lower end", "N/m", 0, 1e11)
    max: Real = quantity("upper end", "N/m", 1e4, 1e11)


class DampingInterval(Interval):
    """Range of a damping."""

    min: Real = quantity("lower end", "N s/m", 0, 1e7)
    max: Real = quantity("upper end", "N s/m", 10, 1e7)


class FrequencyInterval(Interval):
    """Range of a frequency."""

    min: Real = quantity("lower end", "Hz", 0.01, 1e4)
    max: Real = quantity("upper end", "Hz", 1, 1e4)


Damping = Annotated[
    Real, quantity("damping of the absorber, one curve each", "N s/m", 10, 1e6, "ASSUME")
]
Dampings = Annotated[
    tuple[Damping, ...], Field(min_length=1, max_length=50), AfterValidator(unique)
]


class StabilityMapStudy(Section):
    """Axes of figure 2."""

    c_A: StiffnessInterval
    c_R: StiffnessInterval
    d_T: DampingInterval
    c_T: StiffnessInterval


class LimitCyclesStudy(Section):
    """Range of figure 3."""

    c_A: StiffnessInterval


class HopfCurvesStudy(Section):
    """Damping values and ranges of figure 4."""

    d_T: Dampings = Field(description="damping values of the curves")
    c_A: StiffnessInterval
    c_T: StiffnessInterval


class CriticalHopfCurveStudy(Section):
    """Range of figure 5, and the axle stiffnesses that an absorber must stabilise."""

    d_T: DampingInterval
    c_A: StiffnessInterval


class CycleAmplitudesStudy(Section):
    """Lines of figure 6."""

    d_T: Dampings = Field(description="damping values of the lines")
    c_T_max: Real = quantity("stiffness at which the lines end", "N/m", 1e5, 1e11, "ASSUME")


class FrequencyResponseStudy(Section):
    """Range of figure 7."""

    frequency: FrequencyInterval


class DesignStiffnessInterval(Interval):
    """Stiffnesses of the absorber in equal ratios."""

    min: Real = quantity("lower end", "N/m", 1e3, 1e11)
    max: Real = quantity("upper end", "N/m", 1e3, 1e11)


class DesignDampingInterval(Interval):
    """Dampings of the absorber in equal ratios."""

    min: Real = quantity("lower end", "N s/m", 1, 1e7)
    max: Real = quantity("upper end", "N s/m", 1, 1e7)


class WheelsetDesignsStudy(Section):
    """Designs of the wheelset's absorber in the explorer."""

    c_T: DesignStiffnessInterval
    d_T: DesignDampingInterval


class AbsorberStiffnessInterval(Interval):
    """Range of the stiffness of the bogie's absorber."""

    min: Real = quantity("lower end", "N m/rad", 1, 1e9)
    max: Real = quantity("upper end", "N m/rad", 1, 1e9)


class AbsorberDampingInterval(Interval):
    """Range of the damping of the bogie's absorber."""

    min: Real = quantity("lower end", "N m s/rad", 0, 1e7)
    max: Real = quantity("upper end", "N m s/rad", 0, 1e7)


class ModeFrequencyInterval(Interval):
    """Frequencies in which self-excitation is sought."""

    min: Real = quantity("lower end", "Hz", 1, 1e3)
    max: Real = quantity("upper end", "Hz", 2, 1e3)


class BogieModesStudy(Section):
    """Ranges of the bogie's stability maps."""

    frequency: ModeFrequencyInterval
    B_max: Real = quantity("largest friction decrease", "s/m", 0.2, 20, "ASSUME")
    c_T: AbsorberStiffnessInterval
    d_T: AbsorberDampingInterval


AbsorberName = Annotated[
    str, Field(pattern="^(none|paper|tuned)$", description="none, paper or tuned")
]


class CurveEntryStudy(Section):
    """Ride of figure 9."""

    entry: Real = quantity("moment of the curve entry", "s", 0.5, 100, "text to figure 9")
    duration: Real = quantity("duration of the ride", "s", 1, 1000, "figure 9")
    absorbers: Annotated[
        tuple[AbsorberName, ...], Field(min_length=1, max_length=3), AfterValidator(unique)
    ] = Field(description="absorbers with which the bogie runs")


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


class BogieDesignStiffnessInterval(Interval):
    """Stiffnesses of the bogie's absorber in equal ratios."""

    min: Real = quantity("lower end", "N m/rad", 1, 1e9)
    max: Real = quantity("upper end", "N m/rad", 1, 1e9)


class BogieDesignDampingInterval(Interval):
    """Dampings of the bogie's absorber in equal ratios."""

    min: Real = quantity("lower end", "N m s/rad", 1e-3, 1e7)
    max: Real = quantity("upper end", "N m s/rad", 1e-3, 1e7)


class BogieDesignsStudy(Section):
    """Designs of the bogie's absorber in the explorer."""

    self_excitation: ModeFrequencyInterval
    c_T: BogieDesignStiffnessInterval
    d_T: BogieDesignDampingInterval


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


class Study(Section):
    """Ranges of the figures."""

    stability_map: StabilityMapStudy
    limit_cycles: LimitCyclesStudy
    hopf_curves: HopfCurvesStudy
    critical_hopf_curve: CriticalHopfCurveStudy
    cycle_amplitudes: CycleAmplitudesStudy
    frequency_response: FrequencyResponseStudy
    bogie_modes: BogieModesStudy
    curve_entry: CurveEntryStudy
    evolution_tendency: EvolutionTendencyStudy
    tendency_maps: TendencyMapsStudy
    wheelset_designs: WheelsetDesignsStudy
    bogie_designs: BogieDesignsStudy
    design_sheet: DesignSheetStudy

    @model_validator(mode="after")
    def _band_is_computed(self) -> Self:
        band, axis = self.tendency_maps.design_band, self.evolution_tendency.frequency
        if band.min < axis.min or band.max > axis.max:
            raise ValueError(
                f"tendency_maps.design_band = {band.min:g} to {band.max:g} Hz must lie within "
                f"evolution_tendency.frequency = {axis.min:g} to {axis.max:g} Hz: nothing is "
                "computed beyond"
            )
        return self
