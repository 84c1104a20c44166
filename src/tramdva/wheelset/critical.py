"""Hopf curves and critical Hopf points of the basic model (figures 4 and 5).

References
----------
Section "Numerical analysis of the Hopf bifurcation" of the paper, equations (9)-(15).
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar

from tramdva.bifurcation import critical_hopf, hopf
from tramdva.bifurcation.continuation import StepControl
from tramdva.bifurcation.hopf import HopfCurve, HopfPoint
from tramdva.wheelset.hopf import (
    WheelsetHopfPoint,
    growth_along,
    hopf_points_along,
    physical_values,
    rim_velocity,
)
from tramdva.wheelset.model import WheelsetParameters, dynamical_system, equilibrium_state, scaling
from tramdva.wheelset.stability import growth_rate

# Growth rates (1/s) below this are rounding at the tangency, not instability.
MARGINAL_GROWTH = 1e-6
_FREE = ("c_A", "c_T", "d_T")
# Absorber stiffness in kN/mm at which the critical curve is taken to reach zero.
_VANISHING = 1e-3

_ROWS = 24


def curves_at(
    values: WheelsetParameters, study: Mapping[str, Any], numerics: Mapping[str, Any]
) -> Iterator[HopfCurve]:
    """Hopf curves at one d_T within the window."""
    c_A = np.geomspace(study["c_A"]["min"], study["c_A"]["max"], 201)
    rows = np.linspace(study["c_T"]["max"], study["c_T"]["min"], _ROWS)
    traced: list[HopfCurve] = []
    for c_T in rows:
        for start in hopf_points_along(values._replace(c_T=c_T), True, "c_A", c_A):
            if start.converged and not any(_passes(curve, start) for curve in traced):
                traced.append(_whole_curve(start, study, numerics))
                yield traced[-1]


def _passes(curve: HopfCurve, start: WheelsetHopfPoint) -> bool:
    """Whether a curve crosses the row c_T of a Hopf point at its c_A (within 2 %)."""
    index = [start.values._fields.index(name) for name in ("c_A", "c_T")]
    c_A, c_T = np.array([point.parameters[index] for point in curve.points]).T
    at = start.scaled.parameters[index]
    below, above = np.minimum(c_T[:-1], c_T[1:]), np.maximum(c_T[:-1], c_T[1:])
    segments = np.flatnonzero((below <= at[1]) & (at[1] <= above) & (above > below))
    share = (at[1] - c_T[segments]) / (c_T[segments + 1] - c_T[segments])
    crossings = c_A[segments] + share * (c_A[segments + 1] - c_A[segments])
    ends = np.hypot(c_A[[0, -1]] - at[0], c_T[[0, -1]] - at[1]) < 0.02 * at[0]
    return bool(np.any(np.abs(crossings - at[0]) < 0.02 * at[0]) or ends.any())


def _whole_curve(
    start: WheelsetHopfPoint, study: Mapping[str, Any], numerics: Mapping[str, Any]
) -> HopfCurve:
    """The curve through a Hopf point, both ways."""
    values = start.values
    unit = scaling(values, True).parameters[values._fields.index("c_A")]
    bounds = {
        name: (study[name]["min"] / unit, study[name]["max"] / unit) for name in ("c_A", "c_T")
    }
    size = (study["c_T"]["max"] - study["c_T"]["min"]) / unit
    control = StepControl(
        initial=0.002 * size,
        smallest=1e-6 * size,
        largest=0.02 * size,
        max_points=numerics["max_points"],
    )

    def walk(direction: int) -> HopfCurve:
        return hopf.hopf_curve(
            dynamical_system(values, True),
            start.scaled,
            ("c_A", "c_T"),
            bounds,
            control,
            direction=direction,
            component=rim_velocity(True),
            tolerance=numerics["tolerance"],
        )

    down = walk(-1)
    if down.ended == "closed":
        return down
    up = walk(1)
    return HopfCurve(
        points=up.points[:0:-1] + down.points,
        first_lyapunov_coefficients=np.append(
            up.first_lyapunov_coefficients[:0:-1], down.first_lyapunov_coefficients
        ),
        special=up.special + down.special,
        ended=down.ended,
    )


def hopf_frequency(values: WheelsetParameters, point: HopfPoint) -> float:
    """Frequency in Hz of a Hopf point that is known in scaled variables."""
    return point.omega / (2.0 * np.pi * scaling(values, True).time)


def leading_pair_at(values: WheelsetParameters) -> HopfPoint:
    """Equilibrium with its leading pair, to start Newton's method near a Hopf point."""
    units = scaling(values, True)
    system = dynamical_system(values, True)
    state = units.from_states(equilibrium_state(values, True))
    vector = np.array(values) / units.parameters
    eigenvalue, eigenvector = hopf.critical_pair(system, state, vector)
    return HopfPoint(state, eigenvector, eigenvalue.imag, vector, np.inf, False)


def walk_critical(
    values: WheelsetParameters,
    d_T: tuple[float, float],
    numerics: Mapping[str, Any],
    direction: int,
) -> critical_hopf.CriticalCurve:
    """Critical Hopf curve from given values in one direction (1 or -1), eq. (15).

    Parameters
    ----------
    values : WheelsetParameters
        Near a critical Hopf point.
    d_T : (float, float)
        Window of the damping in N s/m.
    numerics : mapping
        max_points, tolerance.
    direction : int
        1 towards larger damping, -1 towards smaller.
    """
    unit = scaling(values, True).parameters[values._fields.index("d_T")]
    low, high = d_T[0] / unit, d_T[1] / unit

    def stop(free: np.ndarray) -> str | None:
        return None if low <= free[2] <= high else "window"

    control = StepControl(
        initial=0.2,
        smallest=1e-4,
        largest=1.0,
        max_points=numerics["max_points"],
        min_cosine=0.98,
    )
    return critical_hopf.critical_hopf_curve(
        dynamical_system(values, True),
        leading_pair_at(values),
        _FREE,
        control,
        stop,
        direction=direction,
        level=_VANISHING,
        tolerance=numerics["tolerance"],
    )


def largest_growth(values: WheelsetParameters, c_A: np.ndarray) -> float:
    """Largest growth rate (1/s) over the axle stiffness, samples refined at their maximum."""
    rates = growth_rate(values._replace(c_A=c_A), True)
    k = int(np.argmax(rates))
    if rates[k] > MARGINAL_GROWTH:
        return float(rates[k])
    function = growth_along(values, True, "c_A")
    bounds = (c_A[max(k - 1, 0)], c_A[min(k + 1, len(c_A) - 1)])
    found = minimize_scalar(lambda x: -function(x), bounds=bounds, method="bounded")
    return float(max(rates[k], -found.fun))


def critical_point_at(values: WheelsetParameters) -> WheelsetParameters | None:
    """Critical Hopf point at the d_T (N s/m) of given values, near their c_A and c_T, or None."""
    point = critical_hopf.solve_critical_point(
        dynamical_system(values, True), leading_pair_at(values), _FREE
    )
    return None if point is None else physical_values(values, True, point.parameters)
