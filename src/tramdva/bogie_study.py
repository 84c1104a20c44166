"""Ranges of the bogie's figures and the numerics of its stages."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field

from tramdva.quantities import Interval, Real, Section, Whole, quantity, unique


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


class ContactGeometryNumerics(Section):
    """Nodes of the contact tables."""

    shift_step: Real = quantity("distance of the nodes of the lateral shift", "m", 5e-6, 2e-4)
    yaw_nodes: Whole = quantity("nodes of the yaw angle up to 0.045 rad", "-", 4, 50)


class BogieNumerics(Section):
    """Resolution of contact patch and axle bridge, way into the curve."""

    cells_along: Whole = quantity("cells of the contact patch along the rail", "-", 2, 100)
    strips: Whole = quantity("strips of the contact patch", "-", 2, 100)
    cutoff_frequency: Real = quantity("of the axle's elastic modes", "Hz", 50, 5e3)
    elements_per_section: Whole = quantity("beam elements per section of the axle", "-", 1, 50)
    curvature_steps: Whole = quantity("tracks on the way into the curve", "-", 1, 200)


class BogieModesNumerics(Section):
    """Grids of the bogie's stability maps."""

    friction_points: Whole = quantity("friction decreases", "-", 2, 1000)
    map_points: Whole = quantity("grid points per axis of the absorber map", "-", 2, 500)


class CurveEntryNumerics(Section):
    """Time integration of the curve entry."""

    interval: Real = quantity("longest step", "s", 1e-5, 2e-3)
    every: Whole = quantity("steps per output", "-", 1, 100)
    tolerance: Real = quantity("difference of the orders per step", "m/s", 1e-8, 0.1)
