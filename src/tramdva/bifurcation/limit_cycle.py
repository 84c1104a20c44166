"""Branches of limit cycles: collocation, pseudo-arclength continuation, Floquet multipliers.

References
----------
E. J. Doedel, H. B. Keller, J. P. Kernevez, Int. J. Bifurcation and Chaos 1 (1991) 745-772.
"""

from dataclasses import replace

import numpy as np
from scipy.linalg import eigvals
from scipy.optimize import brentq

from tramdva.bifurcation import collocation, orbit_corrector
from tramdva.bifurcation.collocation import BorderedFactors
from tramdva.bifurcation.compiled import Evaluation
from tramdva.bifurcation.continuation import Branch, StepControl, trace
from tramdva.bifurcation.hopf import HopfPoint
from tramdva.bifurcation.orbit import LimitCycle
from tramdva.bifurcation.orbit_corrector import Direction
from tramdva.bifurcation.system import DynamicalSystem

# Near a Hopf point a small orbit fixes the parameter to the tolerance over its amplitude only.
_NEAR_ENOUGH = 1e-7


class LimitCycleCurve:
    """Branch of limit cycles in one parameter, as `continuation.trace` walks it.

    Parameters
    ----------
    system : DynamicalSystem
        Well-scaled system: states of order one.
    parameter : str
        Name of the free parameter.
    parameter_scale : float
        Change of the parameter that counts as much as a change of the states by one.
    tolerance : float
        Newton tolerance, relative to states of order one.
    max_iterations : int
        Newton and chord steps per orbit.
    max_imbalance : float
        The mesh is adapted when the largest interval error exceeds the mean by this factor.
    """

    def __init__(
        self,
        system: DynamicalSystem,
        parameter: str,
        *,
        parameter_scale: float = 1.0,
        tolerance: float = 1e-10,
        max_iterations: int = 12,
        max_imbalance: float = 1.5,
    ) -> None:
        self.system = system
        self._evaluation = Evaluation(system)
        self.index = system.index(parameter)
        self._weight = 1.0 / parameter_scale**2
        self._tolerance, self._max_iterations = float(tolerance), max_iterations
        self._max_imbalance = max_imbalance

    def start(self, hopf: HopfPoint, intervals: int, degree: int, sign: int = 1) -> LimitCycle:
        """Orbit of zero amplitude at a Hopf point; its tangent is the critical eigenvector.

        Parameters
        ----------
        hopf : HopfPoint
            Converged point.
        intervals, degree : int
            Mesh.
        sign : {1, -1}
            Half-turn of the phase.
        """
        mesh = np.linspace(0.0, 1.0, intervals + 1)
        phase = np.exp(2j * np.pi * collocation.node_times(mesh, degree))
        direction = sign * np.real(phase[:, None] * hopf.vector)
        nodal = np.tile(hopf.state, (len(phase), 1))
        period = 2.0 * np.pi / hopf.omega
        cycle = LimitCycle(mesh, nodal, period, hopf.parameters, Direction(direction, 0.0, 0.0))
        return replace(cycle, tangent=self._unit(cycle, cycle.tangent))

    # The operations of `continuation.Curve`

    def predict(self, point: LimitCycle, step: float) -> LimitCycle:
        """Orbit at a step along the tangent, bent by the curvature where that is known."""
        change = point.tangent.scaled(step)
        if point.curvature is not None:
            change = change.plus(point.curvature.scaled(0.5 * step**2))
        return replace(point.moved(change, self.index), step=step)

    def correct(self, predicted: LimitCycle) -> tuple[LimitCycle | None, int]:
        """Orbit in the hyperplane through the prediction, orthogonal to its tangent."""
        return self._solve(predicted, fixed_parameter=False)

    def test_functions(self, point: LimitCycle) -> dict[str, float]:
        """Fold, period doubling and torus bifurcation.

        The fold is a zero of the tangent's parameter; the others are products over multipliers,
        the trivial one left out: (mu + 1), and (1 - mu_i mu_j).
        """
        rest = point.multipliers[1:].tolist()
        doubling, torus = 1.0, 1.0
        for i, multiplier in enumerate(rest):
            doubling *= 1.0 + multiplier
            for other in rest[i + 1 :]:
                torus *= 1.0 - multiplier * other
        return {
            "fold": point.tangent.parameter,
            "period_doubling": complex(doubling).real if rest else np.nan,
            "torus": complex(torus).real if len(rest) > 1 else np.nan,
        }

    def turning(self, point: LimitCycle, new: LimitCycle) -> float:
        """Cosine between the tangents."""
        if new.mesh is not point.mesh:
            return 1.0
        return self.product(point, point.tangent, new.tangent)

    def prepare(self, point: LimitCycle) -> LimitCycle:
        """The orbit on an adapted mesh, if its own has become uneven."""
        degree = point.degree
        if collocation.mesh_imbalance(point.mesh, point.nodal, degree) <= self._max_imbalance:
            return point
        adapted = self._solve(self._remeshed(point), fixed_parameter=False)[0]
        return point if adapted is None else adapted

    def record(self, point: LimitCycle) -> LimitCycle:
        """The orbit without its factorised matrix (half a megabyte each)."""
        return replace(point, linearisation=None)

    def stride(
        self, point: LimitCycle, step: float, control: StepControl, most: int
    ) -> tuple[list[LimitCycle], LimitCycle, float]:
        """No step: an orbit takes so long that nothing is won."""
        return [], point, step

    # Orbits at given parameters

    def at_parameter(self, point: LimitCycle, value: float) -> LimitCycle | None:
        """Orbit at a value of the free parameter, from a nearby orbit; None if that fails."""
        distance = value - point.parameters[self.index]
        slope = point.tangent.parameter
        bend = point.curvature.parameter if point.curvature is not None else 0.0
        # Arclength s with slope s + bend s^2 / 2 = distance; the parabola may not reach that far.
        root = np.sqrt(max(slope**2 + 2.0 * bend * distance, 0.0))
        if slope == 0.0 and root == 0.0:
            return None
        predicted = self.predict(point, 2.0 * distance / (slope + np.copysign(root, slope)))
        predicted.parameters[self.index] = value
        return self._solve(predicted, fixed_parameter=True)[0]

    def between(self, point: LimitCycle, following: LimitCycle, value: float) -> LimitCycle | None:
        """Orbit at a value of the parameter between neighbours of the branch; None if that fails.

        Sought along the arclength: slower than `at_parameter`, but safe where the branch is steep.
        """
        found: dict[float, LimitCycle] = {}

        def distance(length: float) -> float:
            cycle = self.correct(self.predict(point, length))[0] if length else point
            if cycle is None:
                raise ArithmeticError("no orbit on the way")
            missed = float(cycle.parameters[self.index] - value)
            found[abs(missed)] = cycle
            return missed

        try:
            brentq(distance, 0.0, following.step, rtol=1e-14)
        except (ArithmeticError, ValueError):  # or the ends have no different signs
            return None
        missed = min(found)
        exact = self.at_parameter(found[missed], value)
        if exact is None and missed <= _NEAR_ENOUGH * abs(value):
            return found[missed]
        return exact

    # Corrector

    def _solve(self, predicted: LimitCycle, fixed_parameter: bool) -> tuple[LimitCycle | None, int]:
        """The orbit beside a prediction, with its matrix, tangent and multipliers."""
        converged, iterations, orbit, residual, linearisation, tangent = orbit_corrector.correct(
            self._equations(predicted.degree),
            _unknowns(predicted),
            predicted.tangent,
            predicted.linearisation or _NO_LINEARISATION,
            fixed_parameter,
        )
        self._evaluation.check()
        if not converged:
            return None, iterations
        bend = None
        if predicted.step:
            bend = tangent.plus(predicted.tangent.scaled(-1.0)).scaled(1.0 / predicted.step)
        cycle = replace(
            predicted,
            nodal=orbit.nodal,
            period=orbit.period,
            parameters=orbit.parameters[0],
            tangent=tangent,
            curvature=bend,
            multipliers=floquet_multipliers(linearisation.factors),
            residual=residual,
            linearisation=linearisation,
        )
        return cycle, iterations

    def _equations(self, degree: int) -> orbit_corrector.Equations:
        return orbit_corrector.Equations(
            self._evaluation.evaluator,
            collocation.basis(degree),
            self.index,
            self._weight,
            self._tolerance,
            self._max_iterations,
        )

    def product(self, cycle: LimitCycle, a: Direction, b: Direction) -> float:
        """Inner product of two directions: states over the period, period, scaled parameter."""
        mass, h = collocation.basis(cycle.degree).mass, cycle.mesh[1:] - cycle.mesh[:-1]
        return orbit_corrector.product(mass, h, float(cycle.period), self._weight, a, b)

    def _unit(self, cycle: LimitCycle, direction: Direction) -> Direction:
        length = np.sqrt(self.product(cycle, direction, direction))
        return direction.scaled(1.0 / length)

    def _remeshed(self, cycle: LimitCycle) -> LimitCycle:
        mesh = collocation.equidistributed_mesh(cycle.mesh, cycle.nodal, cycle.degree)
        tau = collocation.node_times(mesh, cycle.degree)
        tangent = collocation.evaluate(cycle.mesh, cycle.tangent.nodal, cycle.degree, tau)
        return replace(
            cycle,
            mesh=mesh,
            nodal=cycle.states(tau),
            tangent=cycle.tangent._replace(nodal=tangent),
            curvature=None,
            step=0.0,
            linearisation=None,
        )


_NO_LINEARISATION = orbit_corrector.no_linearisation()


def _unknowns(cycle: LimitCycle) -> orbit_corrector.Orbit:
    h = cycle.mesh[1:] - cycle.mesh[:-1]
    return orbit_corrector.Orbit(h, cycle.nodal, float(cycle.period), cycle.parameters[None])


def floquet_multipliers(factors: BorderedFactors) -> np.ndarray:
    """Floquet multipliers (n,) from P u(0) + Q u(1) = 0, the one nearest to 1 first."""
    try:
        values = np.linalg.eigvals(np.linalg.solve(factors.right, -factors.left))
    except np.linalg.LinAlgError:  # infinite multipliers
        values = eigvals(-factors.left, factors.right)
    trivial = int(np.argmin(np.abs(values - 1.0)))
    rest = np.delete(values, trivial)
    return np.append(values[trivial], rest[np.argsort(-np.abs(rest), kind="stable")])


def follow(
    curve: LimitCycleCurve,
    start: LimitCycle,
    control: StepControl,
    bounds: tuple[float, float],
) -> Branch:
    """Branch of limit cycles from a Hopf point until it ends.

    Parameters
    ----------
    curve : LimitCycleCurve
        What to follow.
    start : LimitCycle
        Orbit of zero amplitude of `LimitCycleCurve.start`.
    control : StepControl
        Steps.
    bounds : (float, float)
        Window of the parameter.

    Returns
    -------
    Branch
        Without the start. ``ended`` is ``hopf_point`` where the amplitude shrinks to zero (the
        last orbit is
        the last one before), ``window``, ``max_points``, ``no_convergence`` or ``sharp_turn``.
    """
    low, high = bounds
    last = [start.tangent.nodal]  # deviation of the last orbit of the branch

    def ends(cycle: LimitCycle) -> str | None:
        deviation = cycle.deviation()
        if last[0].shape == deviation.shape and np.sum(last[0] * deviation) < 0.0:
            return "hopf_point"  # the amplitude passed zero
        if not low <= cycle.parameters[curve.index] <= high:
            return "window"
        last[:] = [deviation]
        return None

    branch = trace(
        curve,
        start,
        control,
        ends,
        discard=frozenset({"hopf_point", "window"}),
        approach=frozenset({"window"}),
    )
    del branch.points[0], branch.tests[0]
    return branch
