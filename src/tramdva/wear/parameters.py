"""Parameters of the KTH wear chart."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from tramdva.quantities import Real, Section, quantity


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
