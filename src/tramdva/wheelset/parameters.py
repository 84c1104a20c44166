"""Parameters of the basic model: Tables 1 and 2 of the paper."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from tramdva.quantities import GREATEST_LATERAL_ACCELERATION, Label, Real, Section, quantity

VARIANT_NAME = r"[a-z][a-z0-9_]{0,40}"


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
