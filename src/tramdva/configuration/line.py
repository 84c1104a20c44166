"""A tram line: all its physical values, with their origin.

Frozen, without unknown keys, NaN or infinity: with the run the single source of
`config/schema.json` and of the table in `config/README.md`.
"""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from tramdva.bogie.parameters import GREATEST_CHORD_ANGLE, Bogie, Track
from tramdva.configuration.study import Study
from tramdva.contact.parameters import ContactGeometry
from tramdva.evolution.parameters import OutOfRoundness
from tramdva.quantities import Label, Section, unique
from tramdva.route.parameters import Route
from tramdva.wear.parameters import Wear
from tramdva.wheelset.parameters import (
    Absorber,
    AbsorberVariant,
    CreepForce,
    Curve,
    ForcedExcitation,
    Wheelset,
)


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
    route: Route
    study: Study

    @model_validator(mode="after")
    def _bogie_fits_the_curve(self) -> Self:
        chord = self.bogie.half_wheelbase / self.track.radius
        if chord > GREATEST_CHORD_ANGLE:
            raise ValueError(
                f"bogie.half_wheelbase/track.radius = {chord:.3g} must be at most "
                f"{GREATEST_CHORD_ANGLE:g} (angles are small)"
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
