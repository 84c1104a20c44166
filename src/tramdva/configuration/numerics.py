"""Grids, orders and tolerances: the section `numerics` of a run."""

from __future__ import annotations

import itertools
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from tramdva.quantities import Real, Section, Whole, quantity

GREATEST_ORDER = 400
WaveAmplitude = Annotated[Real, quantity("amplitude of a single order", "m", 1e-8, 1e-3)]


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


class ContactGeometryNumerics(Section):
    """Nodes of the contact tables."""

    shift_step: Real = quantity("distance of the nodes of the lateral shift", "m", 5e-6, 2e-4)
    yaw_nodes: Whole = quantity("nodes of the yaw angle up to 0.045 rad", "-", 4, 50)


class BogieNumerics(Section):
    """Resolution of contact patch and axle bridge."""

    cells_along: Whole = quantity("cells of the contact patch along the rail", "-", 2, 100)
    strips: Whole = quantity("strips of the contact patch", "-", 2, 100)
    cutoff_frequency: Real = quantity("of the axle's elastic modes", "Hz", 50, 5e3)
    elements_per_section: Whole = quantity("beam elements per section of the axle", "-", 1, 50)


class BogieModesNumerics(Section):
    """Grids of the bogie's stability maps."""

    friction_points: Whole = quantity("friction decreases", "-", 2, 1000)
    map_points: Whole = quantity("grid points per axis of the absorber map", "-", 2, 500)


class CurveEntryNumerics(Section):
    """Time integration of the curve entry."""

    interval: Real = quantity("longest step", "s", 1e-5, 2e-3)
    every: Whole = quantity("steps per output", "-", 1, 100)
    tolerance: Real = quantity("difference of the orders per step", "m/s", 1e-8, 0.1)


class BogieSimulationNumerics(Section):
    """Simulation of one order."""

    samples: Whole = quantity("intervals per revolution", "-", 64, 16384)
    revolutions: Whole = quantity("revolutions that are kept", "-", 1, 50)
    longest_transient: Whole = quantity("revolutions before them at most", "-", 1, 1000)
    tolerance: Real = quantity("largest difference of a revolution", "-", 1e-8, 0.1)
    step_tolerance: Real = quantity("of the integration, share of the wave's speed", "-", 1e-6, 1)


class WearNumerics(Section):
    """Cells of the patch for wear."""

    wear_cells_along: Whole = quantity("cells of the worn patch along the rail", "-", 4, 200)
    wear_strips: Whole = quantity("strips of the worn patch", "-", 4, 200)


class Orders(Section):
    """Orders that are simulated."""

    first: Whole = quantity("first order", "-", 1, GREATEST_ORDER)
    last: Whole = quantity("last order", "-", 1, GREATEST_ORDER)
    step: Whole = quantity("step between orders", "-", 1, GREATEST_ORDER)

    @model_validator(mode="after")
    def _not_empty(self) -> Self:
        if self.first > self.last:
            raise ValueError("first must be at most last")
        return self

    def listed(self) -> list[int]:
        """All orders."""
        return list(range(self.first, self.last + 1, self.step))


class EvolutionTendencyNumerics(Section):
    """Orders and frequencies of the evolution tendency."""

    orders: Orders
    frequency_points: Whole = quantity("frequencies of the linearised vehicle", "-", 10, 100000)


class TendencyMapsNumerics(Section):
    """Grids of the tendency's maps."""

    speeds: Whole = quantity("speeds", "-", 2, 1000)
    radii: Whole = quantity("curve radii", "-", 2, 1000)
    frequency_points: Whole = quantity("frequencies", "-", 10, 10000)
    map_points: Whole = quantity("grid points per axis of the absorber map", "-", 2, 500)


class BogieDesignsNumerics(Section):
    """Grid of the bogie's absorber designs."""

    c_T_points: Whole = quantity("stiffnesses of the absorber", "-", 2, 200)
    d_T_points: Whole = quantity("dampings of the absorber", "-", 2, 200)
    frequency_points: Whole = quantity("frequencies", "-", 10, 10000)


class RobustnessSampleNumerics(Section):
    """Sample of the ranges, in parts that are parallel jobs."""

    samples: Whole = quantity("points of the sequence over all ranges", "-", 2, 65536)
    parts: Whole = quantity("parts of the sample", "-", 1, 1000)
    seed: Whole = quantity("seed of the sequence", "-", 0, 2147483647)
    frequency_step: Real = quantity("of the frequencies between the modes", "Hz", 0.05, 5)


class RobustTuningNumerics(Section):
    """Grid on which the search for the absorber starts."""

    map_points: Whole = quantity("grid points per axis", "-", 3, 500)


class RouteResponseNumerics(Section):
    """Orders and speeds on the route."""

    orders: Orders
    most_speed_points: Whole = quantity("speeds over the scatter at most", "-", 9, 1001)


class RouteTuningNumerics(Section):
    """Grid on which the search for the absorber of the route starts."""

    c_T_points: Whole = quantity("stiffnesses in equal ratios", "-", 3, 200)


class PolygonGrowthNumerics(Section):
    """Distances at which levels are told."""

    distances: Whole = quantity("distances from zero to the horizon", "-", 2, 1001)


class PolygonSimulationNumerics(Section):
    """Simulation of a wheel that wears on."""

    orders: Orders
    samples: Whole = quantity("intervals per revolution", "-", 64, 16384)
    longest_transient: Whole = quantity("revolutions until steady running at most", "-", 2, 1000)
    tolerance: Real = quantity("largest difference of a revolution", "-", 1e-8, 0.1)
    step_tolerance: Real = quantity("of the integration, share of the waves' speed", "-", 1e-6, 1)
    growth_tolerance: Real = quantity("of a step of the wear, share of an order", "-", 1e-6, 0.1)
    most_steps: Whole = quantity("steps of the wear at most", "-", 1, 10000)
    points: Whole = quantity("distances at which the profile is told", "-", 2, 1001)
    described_orders: Whole = quantity(
        "orders that grow fastest, whose response over the amplitude is computed", "-", 1, 400
    )
    wave_amplitudes: Annotated[tuple[WaveAmplitude, ...], Field(min_length=2, max_length=50)] = (
        Field(description="amplitudes of single orders in m, rising")
    )

    @model_validator(mode="after")
    def _rising(self) -> Self:
        if any(a >= b for a, b in itertools.pairwise(self.wave_amplitudes)):
            raise ValueError("wave_amplitudes must rise")
        return self


class Numerics(Section):
    """Grids, orders and tolerances."""

    orders_per_job: Whole = quantity("orders of the wheels that a job computes", "-", 1, 400)
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
    route_response: RouteResponseNumerics
    route_tuning: RouteTuningNumerics
    polygon_growth: PolygonGrowthNumerics
    polygon_simulation: PolygonSimulationNumerics
