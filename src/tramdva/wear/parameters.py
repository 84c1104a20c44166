"""Parameters of the laws of wear."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from tramdva.quantities import Real, Section, quantity


class Wear(Section):
    """Laws of wear."""

    method: str = Field(
        pattern="^(chart|smoothed|constant|energy)$",
        description="chart (sharp steps), smoothed (smooth steps), constant (one coefficient) or "
        "energy (frictional work)",
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
    energy_mild: Real = quantity("mass worn per frictional work, mild", "kg/J", 1e-12, 1e-5, "USFD")
    energy_severe: Real = quantity(
        "mass worn per rolled metre and area, severe", "kg/m^3", 1e-5, 1e3, "USFD"
    )
    energy_limit: Real = quantity("catastrophic from this T-gamma/A", "N/m^2", 1e5, 1e10, "USFD")
    energy_catastrophic: Real = quantity(
        "mass worn per frictional work beyond it", "kg/J", 1e-12, 1e-5, "USFD"
    )
    density: Real = quantity("density of the wheel", "kg/m^3", 1000, 20000, "ASSUME")

    @model_validator(mode="after")
    def _steps_apart(self) -> Self:
        if self.velocity_low + self.velocity_width > self.velocity_high - self.velocity_width:
            raise ValueError(
                "velocity_low + velocity_width must be at most velocity_high - velocity_width"
            )
        if self.energy_severe > self.energy_mild * self.energy_limit:
            raise ValueError("energy_severe must be at most energy_mild times energy_limit")
        return self
