"""Parameter sets: every value of a configuration with its unit, range, meaning and origin.

A line (`Line`) holds the physics of one tram line, a run (`Run`) says which lines are computed
and how finely. Both are frozen, refuse unknown keys, NaN and infinity, and are the single source
of `config/schema.json` and of the table in `config/README.md`.
"""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import AfterValidator, Field, model_validator

from tramdva.bogie_parameters import GREATEST_CHORD_ANGLE, Bogie, ContactGeometry, Track
from tramdva.bogie_study import (
    BogieModesNumerics,
    BogieModesStudy,
    BogieNumerics,
    ContactGeometryNumerics,
    CurveEntryNumerics,
    CurveEntryStudy,
)
from tramdva.design_sheet_study import (
    DesignSheetStudy,
    RobustnessSampleNumerics,
    RobustTuningNumerics,
)
from tramdva.evolution_study import (
    BogieDesignsNumerics,
    BogieDesignsStudy,
    BogieSimulationNumerics,
    EvolutionTendencyNumerics,
    EvolutionTendencyStudy,
    OutOfRoundness,
    TendencyMapsNumerics,
    TendencyMapsStudy,
    Wear,
    WearNumerics,
)
from tramdva.quantities import Interval, Real, Section, Whole, printable, quantity, unique

LINE_NAME = r"[a-z0-9][a-z0-9_-]{0,40}"
VARIANT_NAME = r"[a-z][a-z0-9_]{0,40}"
GREATEST_LATERAL_ACCELERATION = 4.0  # m/s^2; trams in service stay near 1
DEVICES = {
    "con",
    "prn",
    "aux",
    "nul",
    *(f"{port}{n}" for port in ("com", "lpt") for n in range(10)),
}

Label = Annotated[str, AfterValidator(printable)]


class Curve(Section):
    """The curve and the attitude of the leading wheelset in it."""

    r_C: Real = quantity("curve radius at the outer wheel", "m", 10, 2000, "Table 1")
    gamma: Real = quantity("angle of attack, negative", "rad", -0.2, -0.001, "Table 1")
    outer_speed: Real = quantity(
        "running speed of the outer wheel, Omega r_C", "m/s", 0.5, 30, "Table 1"
    )

    @model_validator(mode="after")
    def _passable(self) -> Self:
        acceleration = self.outer_speed**2 / self.r_C
        if acceleration > GREATEST_LATERAL_ACCELERATION:
            raise ValueError(
                f"outer_speed^2/r_C = {acceleration:.3g} m/s^2 must be at most "
                f"{GREATEST_LATERAL_ACCELERATION:g} m/s^2 (outer_speed is in m/s, not km/h)"
            )
        return self


class CreepForce(Section):
    """Polach's creep force between wheel and rail with falling friction."""

    F_N: Real = quantity("normal force at the inner wheel", "N", 1e3, 3e5, "Table 1")
    mu_0: Real = quantity("largest coefficient of friction", "-", 0.02, 1.2, "Table 1")
    A: Real = quantity("ratio of friction coefficients, mu_inf/mu_0", "-", 0, 1, "Table 1")
    B: Real = quantity("exponential decrease of friction", "s/m", 0, 20, "Table 1")
    a: Real = quantity("semi-axis of the contact patch along the rail", "m", 3e-4, 0.03, "ASSUME")
    b: Real = quantity("semi-axis of the contact patch across the rail", "m", 3e-4, 0.03, "ASSUME")
    G: Real = quantity("shear modulus of wheel and rail", "N/m^2", 1e10, 3e11, "ASSUME")
    c_22: Real = quantity("Kalker's coefficient C22 of lateral creepage", "-", 0.5, 20, "ASSUME")
    k_A: Real = quantity("Polach's reduction in the area of adhesion", "-", 0.01, 1, "ASSUME")
    k_S: Real = quantity("Polach's reduction in the area of slip", "-", 0.01, 1, "ASSUME")


class Wheelset(Section):
    """Resilient wheel and axle of the leading wheelset."""

    m_A: Real = quantity("reduced mass of axle and wheel hub", "kg", 20, 1e4, "Table 1")
    m_R: Real = quantity("equivalent mass of the wheel rim", "kg", 5, 2e3, "Table 1")
    c_A: Real = quantity(
        "effective stiffness of axle and primary suspension", "N/m", 1e6, 1e10, "Table 1"
    )
    d_A: Real = quantity(
        "effective damping of axle and primary suspension", "N s/m", 50, 1e6, "Table 1"
    )
    c_R: Real = quantity("effective stiffness of the resilient wheel", "N/m", 1e6, 1e10, "Table 1")
    d_R: Real = quantity("effective damping of the resilient wheel", "N s/m", 50, 1e6, "Table 1")
    L: Real = quantity("lateral distance of the inner rail", "m", 0.5, 3, "text to figure 6")


class Absorber(Section):
    """The dynamic vibration absorber at the hub."""

    m_T: Real = quantity("mass of the absorber", "kg", 0.5, 1e3, "Table 2")
    c_T: Real = quantity("stiffness of the absorber", "N/m", 1e4, 1e9, "Table 2")
    d_T: Real = quantity("damping of the absorber", "N s/m", 10, 1e6, "Table 2")


class AbsorberVariant(Section):
    """Another stiffness and damping of the absorber, for the stability maps."""

    name: str = Field(
        pattern=f"^{VARIANT_NAME}$",
        description="a name of lower-case letters, digits and _, the first a letter",
    )
    label: Label = Field(
        min_length=1, max_length=80, description="a name for the figures, at most 80 letters"
    )
    c_T: Real = quantity("stiffness of the absorber", "N/m", 1e4, 1e9, "figures 2 and 3")
    d_T: Real = quantity("damping of the absorber", "N s/m", 10, 1e6, "figures 2 and 3")


class ForcedExcitation(Section):
    """Creep force without self-excitation, for the frequency response."""

    B: Real = quantity("exponential decrease of friction", "s/m", 0, 20, "text to eq. (16)")


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


def named_uniquely(variants: tuple[AbsorberVariant, ...]) -> tuple[AbsorberVariant, ...]:
    """Refuse two absorbers of one name, and the name of the wheelset without absorber."""
    names = tuple(variant.name for variant in variants)
    unique(names)
    if "none" in names:
        raise ValueError("'none' is the wheelset without absorber: choose another name")
    return variants


Variants = Annotated[
    tuple[AbsorberVariant, ...], Field(min_length=1, max_length=20), AfterValidator(named_uniquely)
]


class Line(Section):
    """A tram line: all physical values, in SI units."""

    label: Label = Field(
        min_length=1, max_length=80, description="a name for the figures, at most 80 letters"
    )
    curve: Curve
    creep_force: CreepForce
    wheelset: Wheelset
    absorber: Absorber
    forced_excitation: ForcedExcitation
    absorber_variants: Variants = Field(description="absorbers of the stability maps")
    track: Track
    bogie: Bogie
    contact_geometry: ContactGeometry
    out_of_roundness: OutOfRoundness
    wear: Wear
    study: Study

    @model_validator(mode="after")
    def _bogie_fits_the_curve(self) -> Self:
        chord = self.bogie.half_wheelbase / self.track.radius
        if chord > GREATEST_CHORD_ANGLE:
            raise ValueError(
                f"bogie.half_wheelbase/track.radius = {chord:.3g} must be at most "
                f"{GREATEST_CHORD_ANGLE:g} (small angles; the contact tables end beyond)"
            )
        return self

    @model_validator(mode="after")
    def _absorber_lighter_than_axle(self) -> Self:
        ratio = self.absorber.m_T / self.wheelset.m_A
        if ratio > 1:
            raise ValueError(
                f"absorber.m_T/wheelset.m_A = {ratio:.3g} must be at most 1 (mass ratio mu)"
            )
        return self


def tolerance() -> Any:
    """Describe the tolerance of a Newton iteration."""
    return quantity("largest scaled residual or step of Newton's method", "-", 1e-14, 1e-3)


def mesh_intervals() -> Any:
    """Describe the mesh of a periodic orbit."""
    return quantity("mesh intervals per period", "-", 5, 1000)


def degree() -> Any:
    """Describe the degree of the collocation polynomials."""
    return quantity("collocation points per mesh interval", "-", 2, 7)


class StabilityMapNumerics(Section):
    """Grid of the stability maps."""

    points: Whole = quantity("grid points per axis", "-", 5, 5001)


class HopfPointsNumerics(Section):
    """Newton's method for the Hopf points."""

    tolerance: Real = tolerance()
    max_iterations: Whole = quantity("largest number of Newton steps", "-", 3, 1000)


class LimitCyclesNumerics(Section):
    """Collocation and continuation of the limit cycles."""

    mesh_intervals: Whole = mesh_intervals()
    degree: Whole = degree()
    tolerance: Real = tolerance()
    max_orbits: Whole = quantity("largest number of cycles per branch", "-", 5, 100000)
    equilibria: Whole = quantity("points of the equilibrium branch", "-", 10, 100000)


class HopfCurvesNumerics(Section):
    """Continuation of the Hopf curves."""

    max_points: Whole = quantity("largest number of points per curve", "-", 10, 1000000)
    tolerance: Real = tolerance()


class CriticalHopfCurveNumerics(HopfCurvesNumerics):
    """Continuation of the critical Hopf curve."""

    check_points: Whole = quantity(
        "axle stiffnesses at which the growth rate is checked", "-", 10, 100000
    )


class CycleAmplitudesNumerics(Section):
    """Collocation of the limit cycles over the absorber's stiffness."""

    mesh_intervals: Whole = mesh_intervals()
    degree: Whole = degree()
    tolerance: Real = tolerance()
    points: Whole = quantity("cycles per line", "-", 3, 10000)


class AbsorberTuningNumerics(Section):
    """Grid in which the peaks of the receptance are sought."""

    frequency_points: Whole = quantity("frequencies", "-", 50, 1000000)


class FrequencyResponseNumerics(Section):
    """Grid of the frequency response."""

    points: Whole = quantity("frequencies", "-", 10, 1000000)


class WheelsetDesignsNumerics(Section):
    """Grid of the wheelset's absorber designs."""

    c_T_points: Whole = quantity("stiffnesses of the absorber", "-", 2, 200)
    d_T_points: Whole = quantity("dampings of the absorber", "-", 2, 200)
    frequency_points: Whole = quantity("frequencies", "-", 10, 10000)
    map_points: Whole = quantity("grid points per axis of the stability maps", "-", 3, 201)


class Numerics(Section):
    """Grids, orders and tolerances."""

    stability_map: StabilityMapNumerics
    hopf_points: HopfPointsNumerics
    limit_cycles: LimitCyclesNumerics
    hopf_curves: HopfCurvesNumerics
    critical_hopf_curve: CriticalHopfCurveNumerics
    cycle_amplitudes: CycleAmplitudesNumerics
    absorber_tuning: AbsorberTuningNumerics
    frequency_response: FrequencyResponseNumerics
    contact_geometry: ContactGeometryNumerics
    bogie: BogieNumerics
    bogie_modes: BogieModesNumerics
    curve_entry: CurveEntryNumerics
    bogie_simulation: BogieSimulationNumerics
    wear: WearNumerics
    evolution_tendency: EvolutionTendencyNumerics
    tendency_maps: TendencyMapsNumerics
    wheelset_designs: WheelsetDesignsNumerics
    bogie_designs: BogieDesignsNumerics
    robustness_sample: RobustnessSampleNumerics
    robust_tuning: RobustTuningNumerics


def no_device(name: str) -> str:
    """Refuse names that cannot be a folder on every system, so that results can be handed on."""
    if name in DEVICES:
        raise ValueError("is the name of a device on Windows: choose another name")
    return name


LineName = Annotated[
    str,
    Field(
        pattern=f"^{LINE_NAME}$",
        description="a name of lower-case letters, digits, - and _, at most 41 of them",
    ),
    AfterValidator(no_device),
]


class Run(Section):
    """Which lines are computed, and how finely."""

    lines: Annotated[
        tuple[LineName, ...], Field(min_length=1, max_length=1000), AfterValidator(unique)
    ] = Field(description="names of files in config/lines, without .yaml")
    numerics: Numerics
