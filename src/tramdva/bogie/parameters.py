"""Parameters of the two-axle tram bogie, its track and its absorber."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from tramdva.quantities import GREATEST_LATERAL_ACCELERATION, Real, Section, quantity

HALF_WHEEL = 0.05  # m, half of what a wheel takes across the track
GREATEST_CHORD_ANGLE = 0.065  # rad, 15 m at the longest wheelbase; linear kinematics beyond 0.08


class Track(Section):
    """Straight track, then a left curve; with a transition and cant if they are not zero."""

    radius: Real = quantity("curve radius at the track centre", "m", 10, 5000, "text to figure 9")
    speed: Real = quantity("speed of the vehicle", "m/s", 0.5, 30, "text to figure 9")
    transition_length: Real = quantity("length of the clothoid", "m", 0, 200, "text to figure 9")
    cant: Real = quantity("cant angle, outer rail up", "rad", 0, 0.15, "ASSUME")
    gravity: Real = quantity("acceleration of gravity", "m/s^2", 9.7, 9.9, "ASSUME")

    @model_validator(mode="after")
    def _passable(self) -> Self:
        acceleration = self.speed**2 / self.radius - self.gravity * self.cant
        if abs(acceleration) > GREATEST_LATERAL_ACCELERATION:
            raise ValueError(
                f"speed^2/radius - gravity cant = {acceleration:.3g} m/s^2 must be at most "
                f"{GREATEST_LATERAL_ACCELERATION:g} m/s^2 (speed is in m/s, not km/h)"
            )
        return self


class Translations(Section):
    """Stiffness or damping along the three axes."""

    longitudinal: Real
    lateral: Real
    vertical: Real


class Stiffnesses(Translations):
    """Stiffness along the three axes."""

    longitudinal: Real = quantity("stiffness along the track", "N/m", 0, 1e11, "ASSUME")
    lateral: Real = quantity("stiffness across the track", "N/m", 0, 1e11, "ASSUME")
    vertical: Real = quantity("vertical stiffness", "N/m", 0, 1e11, "ASSUME")


class Dampings(Translations):
    """Damping along the three axes."""

    longitudinal: Real = quantity("damping along the track", "N s/m", 0, 1e7, "ASSUME")
    lateral: Real = quantity("damping across the track", "N s/m", 0, 1e7, "ASSUME")
    vertical: Real = quantity("vertical damping", "N s/m", 0, 1e7, "ASSUME")


class RigidBody(Section):
    """Mass, inertia and height of a rigid body."""

    mass: Real = quantity("mass", "kg", 1, 1e5, "ASSUME")
    roll_inertia: Real = quantity(
        "inertia about the longitudinal axis", "kg m^2", 0.01, 1e6, "ASSUME"
    )
    pitch_inertia: Real = quantity("inertia about the lateral axis", "kg m^2", 0.01, 1e6, "ASSUME")
    yaw_inertia: Real = quantity("inertia about the vertical axis", "kg m^2", 0.01, 1e6, "ASSUME")
    height: Real = quantity("height of the centre of mass over the rail", "m", 0.05, 4, "ASSUME")


class CarSupport(Section):
    """Support of the car body that stands for the omitted cars."""

    roll_stiffness: Real = quantity("roll stiffness", "N m/rad", 0, 1e9, "ASSUME")
    roll_damping: Real = quantity("roll damping", "N m s/rad", 0, 1e7, "ASSUME")
    pitch_stiffness: Real = quantity("pitch stiffness", "N m/rad", 0, 1e9, "ASSUME")
    pitch_damping: Real = quantity("pitch damping", "N m s/rad", 0, 1e7, "ASSUME")
    yaw_stiffness: Real = quantity("yaw stiffness", "N m/rad", 0, 1e9, "ASSUME")
    yaw_damping: Real = quantity("yaw damping", "N m s/rad", 0, 1e7, "ASSUME")


class Suspension(Section):
    """One bushing per side of a suspension stage."""

    stiffness: Stiffnesses
    damping: Dampings
    lateral_position: Real = quantity("distance from the track centre", "m", 0.05, 2, "ASSUME")
    height: Real = quantity("height over the rail", "m", 0.02, 3, "ASSUME")


class PrimarySuspension(Suspension):
    """Bushings between frame and axle bridge, one per side and axle."""

    pitch_stiffness: Real = quantity("pitch stiffness per side", "N m/rad", 0, 1e9, "ASSUME")
    pitch_damping: Real = quantity("pitch damping per side", "N m s/rad", 0, 1e7, "ASSUME")


class BeamSection(Section):
    """Section of the axle bridge."""

    vertical_bending_stiffness: Real = quantity("vertical EI", "N m^2", 1e3, 1e8, "ASSUME")
    mass_per_length: Real = quantity("mass per length", "kg/m", 1, 5e3, "ASSUME")


class AxleBridge(Section):
    """Flexible beam with dropped centre and the cranked arms to the wheel axis."""

    half_length: Real = quantity("half length of the flexible beam", "m", 0.2, 1.2, "ASSUME")
    drop: Real = quantity("beam below the wheel axis", "m", 0, 0.5, "ASSUME")
    middle_half_length: Real = quantity("half length of the middle section", "m", 0.05, 1, "ASSUME")
    middle: BeamSection
    outer: BeamSection
    lateral_bending_stiffness: Real = quantity("lateral EI", "N m^2", 1e3, 1e9, "ASSUME")
    torsional_stiffness: Real = quantity("torsional GJ", "N m^2", 1e3, 1e9, "ASSUME")
    axial_stiffness: Real = quantity("axial EA", "N", 1e6, 1e11, "ASSUME")
    polar_inertia_per_length: Real = quantity(
        "inertia about the beam's axis per length", "kg m", 1e-3, 100, "ASSUME"
    )
    damping_ratio: Real = quantity(
        "damping ratio of a free mode at the reference frequency", "-", 0, 0.06, "ASSUME"
    )
    damping_reference_frequency: Real = quantity("reference frequency", "Hz", 1, 1e3, "ASSUME")
    damping_exponent: Real = quantity(
        "exponent of damping ratio over frequency", "-", -1, 2, "ASSUME"
    )

    @model_validator(mode="after")
    def _middle_inside(self) -> Self:
        if self.middle_half_length >= self.half_length:
            raise ValueError("middle_half_length must be less than half_length")
        return self


class Stub(Section):
    """Stub axle with brake at each wheel; it does not rotate."""

    mass: Real = quantity("mass", "kg", 0, 2e3, "ASSUME")
    roll_inertia: Real = quantity("inertia about the longitudinal axis", "kg m^2", 0, 500, "ASSUME")
    pitch_inertia: Real = quantity("inertia about the lateral axis", "kg m^2", 0, 500, "ASSUME")
    yaw_inertia: Real = quantity("inertia about the vertical axis", "kg m^2", 0, 500, "ASSUME")
    lateral_position: Real = quantity("distance from the track centre", "m", 0.1, 1.5, "ASSUME")
    height: Real = quantity("height over the rail", "m", 0.05, 1, "ASSUME")


class Rotor(Section):
    """Rotating part of a wheel."""

    mass: Real = quantity("mass", "kg", 1, 2e3, "ASSUME")
    diametral_inertia: Real = quantity("inertia about a diameter", "kg m^2", 1e-3, 500, "ASSUME")
    spin_inertia: Real = quantity("inertia about the wheel's axis", "kg m^2", 1e-3, 500, "ASSUME")


class RubberLayer(Section):
    """Kelvin-Voigt layer between hub and rim."""

    radial_stiffness: Real = quantity("radial stiffness", "N/m", 1e6, 1e11, "ASSUME")
    axial_stiffness: Real = quantity("axial stiffness", "N/m", 1e6, 1e11, "ASSUME")
    radial_damping: Real = quantity("radial damping", "N s/m", 0, 2e4, "ASSUME")
    axial_damping: Real = quantity("axial damping", "N s/m", 0, 2e4, "ASSUME")
    tilting_stiffness: Real = quantity("stiffness about a diameter", "N m/rad", 1e4, 1e10, "ASSUME")
    torsional_stiffness: Real = quantity("stiffness about the axis", "N m/rad", 1e4, 1e10, "ASSUME")
    tilting_damping: Real = quantity("damping about a diameter", "N m s/rad", 0, 1e5, "ASSUME")
    torsional_damping: Real = quantity("damping about the axis", "N m s/rad", 0, 1e5, "ASSUME")


class Wheel(Section):
    """Resilient, independently rotating wheel."""

    radius: Real = quantity("rolling radius on the tape circle", "m", 0.15, 0.6, "ASSUME")
    half_distance: Real = quantity(
        "distance of a wheel's centre from the track centre, half of that of both wheels",
        "m",
        0.4,
        0.9,
        "ASSUME",
    )
    hub: Rotor
    rim: Rotor
    layer: RubberLayer
    bearing_damping: Real = quantity("damping of the bearing", "N m s/rad", 0, 100, "ASSUME")


class Direction(Section):
    """Direction in vehicle axes; its length does not matter."""

    x: Real = quantity("forward", "-", -1, 1, "text to figure 8")
    y: Real = quantity("to the left", "-", -1, 1, "text to figure 8")
    z: Real = quantity("upward", "-", -1, 1, "text to figure 8")

    @model_validator(mode="after")
    def _not_zero(self) -> Self:
        if self.x == self.y == self.z == 0.0:
            raise ValueError("a direction must not be zero")
        return self


class BogieAbsorber(Section):
    """Absorbers of the bogie: one on each side of each axle bridge."""

    motion: str = Field(pattern="^(rotation|translation)$", description="rotation or translation")
    direction: Direction
    lateral_position: Real = quantity(
        "distance from the track centre", "m", 0, 1.2, "text to figure 8"
    )
    height: Real = quantity("height over the rail, for the drawing", "m", 0, 1, "text to figure 8")
    I_T: Real = quantity(
        "inertia of the absorber (mass if translation)", "kg m^2", 0.01, 1e3, "Table 3"
    )
    c_T: Real = quantity("stiffness (N/m if translation)", "N m/rad", 1, 1e9, "Table 3")
    d_T: Real = quantity("damping (N s/m if translation)", "N m s/rad", 0, 1e7, "Table 3")


class BareBogie(Section):
    """The two-axle tram bogie with its share of the car body, without absorbers."""

    half_wheelbase: Real = quantity("half of the wheelbase", "m", 0.3, 2, "ASSUME")
    car_body: RigidBody
    car_support: CarSupport
    frame: RigidBody
    secondary: Suspension
    primary: PrimarySuspension
    axle: AxleBridge
    stub: Stub
    wheel: Wheel

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.axle.half_length > self.wheel.half_distance:
            raise ValueError("axle.half_length must be at most wheel.half_distance")
        if self.axle.drop >= self.wheel.radius:
            raise ValueError("axle.drop must be less than wheel.radius")
        return self

    @model_validator(mode="after")
    def _inside_the_wheels(self) -> Self:
        wheel = self.wheel.half_distance
        for name, part, most, where in (
            ("secondary", self.secondary, wheel - HALF_WHEEL, "between the wheels"),
            ("primary", self.primary, wheel - HALF_WHEEL, "between the wheels"),
            ("stub", self.stub, wheel + HALF_WHEEL, "within the outer face of the wheel"),
        ):
            if part.lateral_position > most + 1e-9:
                raise ValueError(
                    f"{name}.lateral_position = {part.lateral_position:g} m must be at most "
                    f"{most:g} m, {where}: wheel.half_distance = {wheel:g} m"
                )
        return self


class Bogie(BareBogie):
    """The two-axle tram bogie with its absorbers."""

    absorber: BogieAbsorber

    @model_validator(mode="after")
    def _absorber_on_the_axle(self) -> Self:
        if self.absorber.lateral_position > self.axle.half_length:
            raise ValueError(
                f"absorber.lateral_position = {self.absorber.lateral_position:g} m must be at most "
                f"axle.half_length = {self.axle.half_length:g} m: the absorber sits on the axle"
            )
        return self
