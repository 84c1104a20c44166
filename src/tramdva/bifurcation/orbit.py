"""Periodic orbits on their mesh, directions along a branch, extreme values over a period."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from tramdva.bifurcation import collocation
from tramdva.bifurcation.orbit_corrector import Direction, Linearisation


@dataclass(frozen=True)
class LimitCycle:
    """A periodic orbit on its mesh.

    Attributes
    ----------
    mesh : (N + 1,) array
        Mesh points in [0, 1], times over the period.
    nodal : (N m + 1, n) array
        States at the nodes.
    period : float
    parameters : (q,) array
    tangent : Direction
        Unit tangent of the branch.
    multipliers : (n,) complex array
        Floquet multipliers, the trivial one (nearest to 1) first.
    residual : float
        Largest residual of the collocation equations.
    curvature : Direction or None
        Change of the tangent per arclength, for a predictor of second order.
    step : float
        Arclength from the orbit that predicted this one.
    linearisation : Linearisation or None
        Factorised matrix of the orbit, for the next one.
    """

    mesh: np.ndarray
    nodal: np.ndarray
    period: float
    parameters: np.ndarray
    tangent: Direction
    multipliers: np.ndarray = field(default_factory=lambda: np.empty(0, complex))
    residual: float = np.inf
    curvature: Direction | None = field(default=None, repr=False, compare=False)
    step: float = 0.0
    linearisation: Linearisation | None = field(default=None, repr=False, compare=False)

    @property
    def degree(self) -> int:
        """Degree m of the polynomials."""
        return (len(self.nodal) - 1) // (len(self.mesh) - 1)

    @property
    def stable(self) -> bool:
        """Whether all but the trivial multiplier are inside the unit circle."""
        return bool(np.all(np.abs(self.multipliers[1:]) < 1.0))

    def states(self, tau: np.ndarray) -> np.ndarray:
        """States (k, n) at times tau (k,) in [0, 1]."""
        return collocation.evaluate(self.mesh, self.nodal, self.degree, tau)

    def moved(self, change: Direction, index: int) -> "LimitCycle":
        """The orbit after a change; the free parameter stands at `index`."""
        parameters = self.parameters.copy()
        parameters[index] += change.parameter
        return replace(
            self,
            nodal=self.nodal + change.nodal,
            period=self.period + change.period,
            parameters=parameters,
        )

    def deviation(self) -> np.ndarray:
        """Nodal values less their mean over the nodes, (N m + 1, n)."""
        return self.nodal - self.nodal[:-1].mean(axis=0)


def extrema(
    cycle: LimitCycle, observables: Callable[[np.ndarray], np.ndarray], samples: int = 8
) -> tuple[np.ndarray, np.ndarray]:
    """Smallest and largest values of functions of the state over the orbit.

    Parameters
    ----------
    cycle : LimitCycle
        Orbit.
    observables : callable
        Functions of the states, (m, n) -> (m, k).
    samples : int
        Samples per mesh interval of the first search.

    Returns
    -------
    tuple of (k,) arrays
        Minima and maxima of the polynomial orbit, not of its mesh values: each is bracketed by the
        samples,
        sampled anew in the bracket and interpolated by a parabola (relative error below 1e-10).
    """
    fractions = np.arange(samples) / samples
    tau = (cycle.mesh[:-1, None] + np.diff(cycle.mesh)[:, None] * fractions).ravel()
    values = observables(cycle.states(tau))
    signed = np.hstack([-values, values])
    best = np.argmax(signed, axis=0)
    after = np.append(tau, 1.0 + tau[0])[best + 1]
    before = np.append(tau[-1] - 1.0, tau)[best]
    fine = before + (after - before) * np.linspace(0.0, 1.0, 33)[:, None]
    refined = observables(cycle.states(np.mod(fine, 1.0).ravel()))
    refined = np.hstack([-refined, refined]).reshape(33, len(best), len(best))
    peaks = np.array([_parabola_maximum(refined[:, k, k]) for k in range(len(best))])
    half = len(best) // 2
    return -peaks[:half], peaks[half:]


def _parabola_maximum(y: np.ndarray) -> float:
    """Maximum of equidistant samples with an inner maximum."""
    k = int(np.clip(np.argmax(y), 1, len(y) - 2))
    left, centre, right = y[k - 1 : k + 2]
    curvature = left - 2.0 * centre + right
    if curvature >= 0.0:
        return float(y.max())
    return float(centre - 0.125 * (right - left) ** 2 / curvature)
