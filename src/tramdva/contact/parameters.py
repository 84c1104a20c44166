"""Parameters of the contact: profiles of wheel and rail, material."""

from __future__ import annotations

from pydantic import Field

from tramdva.quantities import Real, Section, measured_file, quantity


class WheelProfile(Section):
    """Measured or parametric tram wheel; of a measured one only `tape_circle_offset` counts."""

    measured: str = measured_file("a measured profile, y from the tape circle and z in mm")
    measured_noise: Real = quantity(
        "standard deviation of the measured points", "m", 0, 1e-4, "ASSUME"
    )
    flange_root_radius: Real = quantity("radius of the flange root", "m", 5e-3, 0.05, "ASSUME")
    flange_angle: Real = quantity("angle of the flank", "rad", 0.95, 1.3, "ASSUME")
    conicity: Real = quantity("slope of the tread", "-", 0, 0.15, "ASSUME")
    tread_inner: Real = quantity(
        "start of the flange root from the tape circle, negative", "m", -0.06, -0.005, "ASSUME"
    )
    tread_outer: Real = quantity("end of the tread from the tape circle", "m", 0.01, 0.1, "ASSUME")
    tape_circle_offset: Real = quantity(
        "tape circle outboard of the wheel centre", "m", -0.05, 0.05, "ASSUME"
    )


class RailProfile(Section):
    """Measured or parametric head of a rail; of a measured one the last two values count."""

    measured: str = measured_file("a measured profile, y from the top of the rail and z in mm")
    measured_noise: Real = quantity(
        "standard deviation of the measured points", "m", 0, 1e-4, "ASSUME"
    )
    crown_radius: Real = quantity("radius of the crown", "m", 0.05, 1, "ASSUME")
    corner_radius: Real = quantity("radius of the gauge corner", "m", 3e-3, 0.05, "ASSUME")
    corner_start: Real = quantity(
        "corner arc from the top of the crown", "m", 5e-3, 0.045, "ASSUME"
    )
    field_half_width: Real = quantity(
        "extent of the crown to the field side", "m", 0.01, 0.05, "ASSUME"
    )
    lateral_position: Real = quantity(
        "top of the crown outside the tape circle of the centred wheelset",
        "m",
        -0.02,
        0.02,
        "ASSUME",
    )
    inclination: Real = quantity(
        "inclination of the rail to the track centre, beyond that of its profile",
        "rad",
        0,
        0.06,
        "grooved rails stand upright",
    )


class ContactMaterial(Section):
    """Elasticity of wheel and rail."""

    youngs_modulus: Real = quantity("Young's modulus", "N/m^2", 1e10, 1e12, "ASSUME")
    poisson_ratio: Real = quantity("Poisson's ratio", "-", 0, 0.49, "ASSUME")


class ContactProfiles(Section):
    """Profiles of wheel and rail."""

    wheel: WheelProfile
    rail: RailProfile
    gap_scale: Real = quantity("gap over which contact is averaged", "m", 1e-7, 1e-4, "ASSUME")


class ContactGeometry(ContactProfiles):
    """Profiles and material of wheel and rail, and the law of their creep forces."""

    material: ContactMaterial
    creep_law: str = Field(
        pattern="^(half_space|fastsim)$",
        description="creep forces by half_space (table of the elastic half-space) or fastsim",
    )
