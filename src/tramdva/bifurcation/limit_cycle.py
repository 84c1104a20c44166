"""Branches of limit cycles: collocation, pseudo-arclength continuation, Floquet multipliers.

References
----------
E. J. Doedel, H. B. Keller, J. P. Kernevez, Int. J. Bifurcation and Chaos 1 (1991) 745-772.
"""

from dataclasses import replace

import numpy as np
from scipy.linalg import eigvals
from scipy.optimize import brentq

from tramdva.bifurcation import collocation
from tramdva.bifurcation.collocation import BorderedFactors
from tramdva.bifurcation.continuation import Branch, StepControl, trace
from tramdva.bifurcation.hopf import HopfPoint
from tramdva.bifurcation.orbit import Direction, LimitCycle, Linearisation
from tramdva.bifurcation.system import DynamicalSystem

# A chord step must shrink the residual by this factor, else the matrix is factorised anew.
_CHORD_RATE = 0.2
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
        self.index = system.index(parameter)
        self._weight = 1.0 / parameter_scale**2
        self._tolerance, self._max_iterations = tolerance, max_iterations
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
        rest = point.multipliers[1:]
        i, j = np.triu_indices(len(rest), 1)
        return {
            "fold": point.tangent.parameter,
            "period_doubling": float(np.prod(1.0 + rest).real) if rest.size else np.nan,
            "torus": float(np.prod(1.0 - rest[i] * rest[j]).real) if len(rest) > 1 else np.nan,
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
        """Newton steps, with the matrix of the last orbit as long as they converge fast (chord).

        Every step is orthogonal to the orbit's time derivative (phase) and to the tangent
        (arclength), or leaves the parameter as it is.
        """
        cycle, linearisation = predicted, predicted.linearisation
        row = Direction(0.0 * predicted.nodal, 0.0, 1.0)
        if not fixed_parameter:
            row = self._dual(predicted, predicted.tangent)
        last, last_change = np.inf, np.inf
        for iteration in range(1, self._max_iterations + 1):
            f, residual = self._residual(cycle)
            size = np.abs(residual).max()
            if not np.isfinite(size):
                return None, iteration
            if linearisation is None or size > _CHORD_RATE * last:
                linearisation = self._linearise(cycle, f)
            if linearisation is None:
                return None, iteration
            step = self._step(linearisation, residual, row)
            cycle = cycle.moved(step, self.index)
            change = max(np.abs(step.nodal).max(), abs(step.period) / cycle.period)
            # The next change would be smaller by the rate seen so far.
            rate = change / last_change if np.isfinite(last_change) else 1.0
            if change * min(rate, 1.0) <= self._tolerance:
                return self._finished(cycle, predicted), iteration
            last, last_change = size, change
        return None, self._max_iterations

    def _step(
        self, linearisation: Linearisation, residual: np.ndarray, row: Direction
    ) -> Direction:
        """Newton step x with v x = 0 for the wanted last row v.

        The matrix may have another last row: with t = `column` all other rows give zero, so that
        x - t (v x) / (v t) solves the system with the row v.
        """
        x = Direction(*collocation.solve(linearisation.factors, -residual, (0.0, 0.0)))
        t = linearisation.column
        return x.plus(t.scaled(-row.dot(x) / row.dot(t)))

    def _finished(self, cycle: LimitCycle, predicted: LimitCycle) -> LimitCycle | None:
        """The converged orbit with its own matrix, tangent and multipliers."""
        f, residual = self._residual(cycle)
        linearisation = self._linearise(cycle, f)
        if linearisation is None or not cycle.period > 0.0:
            return None
        tangent = self._unit(cycle, linearisation.column)
        if self.product(cycle, predicted.tangent, tangent) < 0.0:
            tangent = tangent.scaled(-1.0)
        bend = tangent.plus(predicted.tangent.scaled(-1.0))
        return replace(
            cycle,
            tangent=tangent,
            curvature=bend.scaled(1.0 / predicted.step) if predicted.step else None,
            multipliers=floquet_multipliers(linearisation.factors),
            residual=float(np.abs(residual).max()),
            linearisation=linearisation,
        )

    def _at_gauss_points(self, nodal: np.ndarray, matrix: np.ndarray, degree: int) -> np.ndarray:
        return matrix @ collocation.interval_values(nodal, degree)

    def _residual(self, cycle: LimitCycle) -> tuple[np.ndarray, np.ndarray]:
        """f and u' - T f at the Gauss points, (N, m, n)."""
        base = collocation.basis(cycle.degree)
        u = self._at_gauss_points(cycle.nodal, base.values, cycle.degree)
        f = self.system.rhs(u.reshape(-1, u.shape[-1]), cycle.parameters).reshape(u.shape)
        h = np.diff(cycle.mesh)[:, None, None]
        slope = self._at_gauss_points(cycle.nodal, base.derivatives, cycle.degree) / h
        return f, slope - cycle.period * f

    def _linearise(self, cycle: LimitCycle, f: np.ndarray) -> Linearisation | None:
        base = collocation.basis(cycle.degree)
        h = np.diff(cycle.mesh)
        u = self._at_gauss_points(cycle.nodal, base.values, cycle.degree)
        states = u.reshape(-1, u.shape[-1])
        J = self.system.jacobian(states, cycle.parameters).reshape(*u.shape, u.shape[-1])
        f_p = self.system.rhs_parameter_derivative(states, cycle.parameters, self.index)
        slope = (
            self._at_gauss_points(cycle.nodal, base.derivatives, cycle.degree) / h[:, None, None]
        )
        nodal, period, parameter = cycle.tangent
        arc = self._at_gauss_points(nodal, base.values, cycle.degree)
        scalars = (period / cycle.period**2, parameter * self._weight)
        try:
            factors = collocation.factorise(
                base, h, cycle.period, J, f, f_p.reshape(u.shape), slope, arc, scalars
            )
            column = Direction(*collocation.solve(factors, np.zeros_like(f), (0.0, 1.0)))
        except np.linalg.LinAlgError:
            return None
        return Linearisation(factors, column) if np.isfinite(column.nodal).all() else None

    def product(self, cycle: LimitCycle, a: Direction, b: Direction) -> float:
        """Inner product of two directions: states over the period, period, scaled parameter."""
        return self._dual(cycle, a).dot(b)

    def _dual(self, cycle: LimitCycle, direction: Direction) -> Direction:
        """Weights whose plain dot product with another direction is the inner product."""
        base = collocation.basis(cycle.degree)
        nodal = direction.nodal
        local = base.mass @ collocation.interval_values(nodal, cycle.degree)
        local *= np.diff(cycle.mesh)[:, None, None]
        weights = np.zeros_like(nodal)
        weights[:-1] = local[:, :-1].reshape(-1, nodal.shape[1])
        weights[cycle.degree :: cycle.degree] += local[:, -1]
        return Direction(
            weights, direction.period / cycle.period**2, self._weight * direction.parameter
        )

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
