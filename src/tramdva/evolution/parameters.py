"""Parameters of the out-of-roundness of the wheels."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field

from tramdva.quantities import Real, Section, measured_file, quantity, unique

WheelName = Annotated[
    str, Field(pattern="^(front|rear)_(outer|inner)$", description="front or rear, outer or inner")
]


class OutOfRoundness(Section):
    """Waves on the wheels: in phase, one order per simulation."""

    amplitude: Real = quantity("amplitude of an order", "m", 1e-8, 1e-4, "ASSUME")
    wheels: Annotated[
        tuple[WheelName, ...], Field(min_length=1, max_length=4), AfterValidator(unique)
    ] = Field(description="wheels that are out of round, their waves in phase (angle s/r_0)")
    measured: str = measured_file("a measured radius deviation, angle in degrees and um")
