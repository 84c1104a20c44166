"""Hopf points of the basic model (figure 3).

References
----------
Section "Numerical analysis of the Hopf bifurcation" of the paper, equations (9) and (10).
"""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from tramdva.bifurcation import hopf
from tramdva.bifurcation.hopf import HopfPoint
from tramdva.wheelset.model import WheelsetParameters, dynamical_system, equilibrium_state, scaling
from tramdva.wheelset.stability import growth_rate

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class WheelsetHopfPoint:
    """A Hopf point of the wheelset in SI units, and as the bifurcation package knows it."""

    values: WheelsetParameters
    with_absorber: bool
    scaled: HopfPoint
    frequency: float
    first_lyapunov_coefficient: float

    @property
    def converged(self) -> bool:
        """Whether Newton's method reached its tolerance."""
        return self.scaled.converged


def physical_values(
    values: WheelsetParameters, with_absorber: bool, scaled: np.ndarray
) -> WheelsetParameters:
    """Parameters in SI units from a scaled parameter vector."""
    return WheelsetParameters(*(scaled * scaling(values, with_absorber).parameters).tolist())


def rim_velocity(with_absorber: bool) -> int:
    """Index of y_R' in the state, which normalises the first Lyapunov coefficient."""
    return 5 if with_absorber else 3


def solve_hopf_point(
    values: WheelsetParameters,
    with_absorber: bool,
    parameter: str,
    tolerance: float = 1e-11,
    max_iterations: int = 20,
) -> WheelsetHopfPoint:
    """Hopf point of the wheelset near given values, eq. (10).

    Parameters
    ----------
    values : WheelsetParameters
        SI units; the free parameter near its Hopf value.
    with_absorber : bool
        Whether the absorber is mounted.
    parameter : {"c_A", "c_T", "d_T"}
        Parameter that is solved for.
    tolerance, max_iterations
        Newton's method on the scaled extended system.

    Returns
    -------
    WheelsetHopfPoint
        Frequency in Hz; first Lyapunov coefficient in (s/m)^2, for an eigenvector with the rim's
        velocity 1.
    """
    units = scaling(values, with_absorber)
    system = dynamical_system(values, with_absorber)
    state = units.from_states(equilibrium_state(values, with_absorber))
    vector = np.array(values) / units.parameters
    point = hopf.solve_hopf_point(
        system, state, vector, parameter, tolerance=tolerance, max_iterations=max_iterations
    )
    l_1 = np.nan
    if point.converged:
        l_1 = hopf.first_lyapunov_coefficient(system, point, rim_velocity(with_absorber))
    return WheelsetHopfPoint(
        values=physical_values(values, with_absorber, point.parameters),
        with_absorber=with_absorber,
        scaled=point,
        frequency=point.omega / (2.0 * np.pi * units.time),
        first_lyapunov_coefficient=l_1,
    )


def sign_changes(
    axis: np.ndarray, sampled: np.ndarray, function: Callable[[float], float]
) -> list[float]:
    """Zeros of a function between samples, and pairs of zeros hidden inside one interval.

    Parameters
    ----------
    axis, sampled : (k,) array
        Positions and values of the function there.
    function : callable
        The function itself, to look closer.

    Returns
    -------
    list of float
        Zeros in ascending order; a local maximum below zero that turns out to be above counts
        twice.
    """
    axis, sampled = np.array(axis), np.array(sampled)
    peaks = 1 + np.flatnonzero((sampled[1:-1] > sampled[:-2]) & (sampled[1:-1] >= sampled[2:]))
    extra = []
    for k in peaks[sampled[peaks] < 0.0]:
        bounds = (axis[k - 1], axis[k + 1])
        found = minimize_scalar(lambda x: -function(x), bounds=bounds, method="bounded")
        if found.fun < 0.0:
            extra.append((found.x, -found.fun))
    if extra:
        axis = np.append(axis, [x for x, _ in extra])
        sampled = np.append(sampled, [y for _, y in extra])
        order = np.argsort(axis)
        axis, sampled = axis[order], sampled[order]
    crossings = np.flatnonzero(np.sign(sampled[:-1]) * np.sign(sampled[1:]) < 0)
    return [brentq(function, axis[k], axis[k + 1], rtol=1e-10) for k in crossings]


def growth_along(
    values: WheelsetParameters, with_absorber: bool, parameter: str
) -> Callable[[float], float]:
    """Growth rate in 1/s as a function of one parameter."""

    def function(value: float) -> float:
        return float(growth_rate(values._replace(**{parameter: value}), with_absorber))

    return function


def hopf_points_along(
    values: WheelsetParameters,
    with_absorber: bool,
    parameter: str,
    axis: np.ndarray,
    sampled: np.ndarray | None = None,
    **newton: Any,
) -> list[WheelsetHopfPoint]:
    """All Hopf points along one parameter that the samples or their maxima betray.

    Parameters
    ----------
    values, with_absorber, parameter
        As in `solve_hopf_point`.
    axis : (k,) array
        Samples of the parameter, ascending.
    sampled : (k,) array, optional
        Growth rates there, if known.
    **newton
        Tolerance and iterations.

    Returns
    -------
    list of WheelsetHopfPoint
        Oscillatory ones only: a zero growth rate at frequency zero is no Hopf point.

    Examples
    --------
    Between its two Hopf points the wheelset without absorber vibrates by itself (figure 3). Both
    are supercritical: their first Lyapunov coefficients are negative.

    >>> import numpy as np
    >>> from tramdva.wheelset.hopf import hopf_points_along
    >>> from tramdva.wheelset.published import paper_wheelset
    >>> stiffness = np.geomspace(2e7, 3e8, 50)
    >>> for point in hopf_points_along(paper_wheelset(), False, "c_A", stiffness):
    ...     print(f"{point.values.c_A / 1e6:.1f} MN/m, {point.frequency:.1f} Hz,",
    ...           point.first_lyapunov_coefficient < 0.0)
    47.7 MN/m, 46.5 Hz, True
    192.1 MN/m, 80.3 Hz, True
    """
    function = growth_along(values, with_absorber, parameter)
    if sampled is None:
        sampled = growth_rate(values._replace(**{parameter: axis}), with_absorber)
    points = []
    for zero in sign_changes(axis, sampled, function):
        try:
            points.append(
                solve_hopf_point(
                    values._replace(**{parameter: zero}), with_absorber, parameter, **newton
                )
            )
        except ArithmeticError:
            logger.info("%s = %.6g: the instability is monotone, no Hopf point", parameter, zero)
    return points
