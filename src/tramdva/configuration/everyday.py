"""What people know of a tram, in their units: the section `tram` of a line's file.

Each key spells its unit. The values become those of the other sections before a line is validated
(`tramdva.configuration.following`); no stage knows this section.
"""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from tramdva.quantities import Real, Section, quantity


class Tram(Section):
    """What people know of a tram, in their units; each key may be missing."""

    gauge_mm: Real | None = quantity("gauge of the track", "mm", 600, 1676)
    speed_km_h: Real | None = quantity("speed in the curve", "km/h", 1.8, 108)
    axle_load_t: Real | None = quantity("mass on an axle of the bogie", "t", 2, 20)
    wheel_load_t: Real | None = quantity("mass on a wheel of the bogie", "t", 1, 10)

    rail_inclination_1_to: Real | None = quantity(
        "inclination of the rails, 40 for 1:40", "-", 17, 1000
    )

    @model_validator(mode="after")
    def _one_load(self) -> Self:
        if self.axle_load_t is not None and self.wheel_load_t is not None:
            raise ValueError("axle_load_t and wheel_load_t say the same: give one of them")
        return self

    @property
    def bogie_mass(self) -> float | None:
        """Mass in kg on the four wheels of the bogie; None where nothing is said."""
        if self.axle_load_t is not None:
            return 2.0 * 1e3 * self.axle_load_t
        return None if self.wheel_load_t is None else 4.0 * 1e3 * self.wheel_load_t
