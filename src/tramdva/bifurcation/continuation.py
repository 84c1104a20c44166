"""Pseudo-arclength continuation: predictor, corrector, event location, record.

`trace` walks along any solution curve that offers the operations of `Curve`; `AlgebraicCurve`
offers them for N equations in N + 1 unknowns.

References
----------
H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems, 1977.
"""

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np
from scipy.optimize import brentq

from tramdva.bifurcation.elimination import jit

logger = logging.getLogger(__name__)

# A walk that approaches its end stops within this share of the initial step before it.
_APPROACH = 0.1


class Curve(Protocol):
    """A solution curve as `trace` sees it; points are opaque."""

    def predict(self, point: Any, step: float) -> Any:
        """Point at arclength `step` along the tangent, not yet on the curve."""

    def correct(self, predicted: Any) -> tuple[Any | None, int]:
        """Point on the curve beside the prediction (None if that fails), iterations it took."""

    def test_functions(self, point: Any) -> Mapping[str, float]:
        """Functions whose sign changes mark special points, by kind."""

    def turning(self, point: Any, new: Any) -> float:
        """Cosine of the angle between the tangents of two points."""

    def prepare(self, point: Any) -> Any:
        """The point as the next step should start from it (an adapted mesh, say)."""

    def record(self, point: Any) -> Any:
        """The point as the branch keeps it, without what only the next step needs."""

    def stride(
        self, point: Any, step: float, control: "StepControl", most: int
    ) -> tuple[list[Any], Any, float]:
        """Steps in which nothing happens, in one go, for curves that are faster at that.

        Returns points as the branch keeps them, at most `most`: those that `trace` would reach
        with steps of the first length without repeating one, without a sign change of a test
        function and without leaving the window; the last one as the next step should start from
        it; and the length of that step. No points where the next step is none of these.
        """


@dataclass(frozen=True)
class SpecialPoint:
    """A located zero of a test function.

    Attributes
    ----------
    kind : str
        Name of the test function.
    point : Any
        Point on the curve.
    precision : float
        Arclength within which the zero lies.
    after : int
        Index of the point of the branch before it.
    """

    kind: str
    point: Any
    precision: float
    after: int


@dataclass
class Branch:
    """Points in order with their test functions, special points, and why the walk ended."""

    points: list[Any] = field(default_factory=list)
    tests: list[Mapping[str, float]] = field(default_factory=list)
    special: list[SpecialPoint] = field(default_factory=list)
    ended: str = ""


@dataclass(frozen=True)
class StepControl:
    """Arclength steps.

    Attributes
    ----------
    initial, smallest, largest : float
        Arclengths in the scaled variables of the curve.
    max_points : int
        Points after which the walk ends.
    min_cosine : float
        A step that turns the tangent by more is repeated with half the length.
    comfortable_iterations : int
        Steps grow while the corrector needs no more, and shrink where it needs twice as many.
    """

    initial: float
    smallest: float
    largest: float
    max_points: int
    min_cosine: float = 0.9
    comfortable_iterations: int = 3

    @property
    def rule(self) -> tuple[float, float, float, int]:
        """The arguments of `next_step` that stay."""
        return (
            float(self.smallest),
            float(self.largest),
            float(self.min_cosine),
            int(self.comfortable_iterations),
        )


def trace(
    curve: Curve,
    start: Any,
    control: StepControl,
    stop: Callable[[Any], str | None] = lambda point: None,
    discard: frozenset[str] = frozenset(),
    approach: frozenset[str] = frozenset(),
) -> Branch:
    """Walk along a solution curve.

    Parameters
    ----------
    curve : Curve
        What to walk along.
    start : point of the curve
        With a tangent in the direction to go.
    control : StepControl
        Steps.
    stop : callable
        Reason to end after a point, or None.
    discard : set of str
        Reasons for which the point itself is not part of the branch.
    approach : set of str
        Those of them for which shorter steps first come close to the end.

    Returns
    -------
    Branch
        ``ended`` is the reason of `stop`, ``max_points`` or ``no_convergence``.
    """
    step, point = control.initial, start
    tests = curve.test_functions(start)
    branch = Branch(points=[start], tests=[tests])
    while len(branch.points) < control.max_points:
        passed, point, step = curve.stride(
            point, step, control, control.max_points - len(branch.points)
        )
        for new in passed:
            tests = curve.test_functions(new)
            branch.points.append(new)
            branch.tests.append(tests)
            branch.ended = stop(new) or ""
            if branch.ended:
                return branch
        if len(branch.points) == control.max_points:
            break
        new, iterations = curve.correct(curve.predict(point, step))
        cosine = -1.0 if new is None else curve.turning(point, new)
        if cosine < control.min_cosine:
            if step <= control.smallest:
                branch.ended = "no_convergence" if new is None else "sharp_turn"
                logger.warning(
                    "continuation ended after %d points: %s", len(branch.points), branch.ended
                )
                return branch
            step = max(0.5 * step, control.smallest)
            continue
        reason = stop(new)
        if reason in discard:
            if reason in approach and step > _APPROACH * control.initial:
                step *= 0.5
                continue
            branch.ended = reason
            return branch
        new_tests = curve.test_functions(new)
        for kind, value in new_tests.items():
            if value * tests.get(kind, np.nan) < 0.0:
                ends = (tests[kind], value)
                located, precision = _locate(
                    curve, point, step, lambda p, k=kind: curve.test_functions(p)[k], ends
                )
                after = len(branch.points) - 1
                branch.special.append(SpecialPoint(kind, located, precision, after))
        branch.points.append(curve.record(new))
        branch.tests.append(new_tests)
        if reason is not None:
            branch.ended = reason
            return branch
        step = next_step(step, iterations, cosine, *control.rule)
        point = curve.prepare(new)
        tests = new_tests
    branch.ended = "max_points"
    return branch


@jit
def next_step(step, iterations, cosine, smallest, largest, min_cosine, comfortable_iterations):
    """Length of the step after one of given iterations and turn, see `StepControl`."""
    comfortable = cosine > 1.0 - 0.3 * (1.0 - min_cosine)
    if iterations <= comfortable_iterations and comfortable:
        step *= 1.5
    elif iterations >= 2 * comfortable_iterations:
        step *= 0.6
    return min(max(step, smallest), largest)


def _locate(
    curve: Curve,
    point: Any,
    step: float,
    test: Callable[[Any], float],
    ends: tuple[float, float],
) -> tuple[Any, float]:
    """Zero of a test function between a point and the one a step ahead, its values there given.

    Returns the point and the arclength within which the zero lies.
    """
    found = {0.0: (point, ends[0])}

    def along(length: float) -> float:
        if length == 0.0:
            return ends[0]
        candidate, _ = curve.correct(curve.predict(point, length))
        if candidate is None:  # keep the bracket: treat like its nearer end
            return ends[0] if length < 0.5 * step else ends[1]
        value = test(candidate)
        found[length] = (candidate, value)
        return value

    precision = 1e-10 * step
    brentq(along, 0.0, step, xtol=precision, rtol=1e-12, maxiter=60, full_output=True, disp=False)
    best = min(found.values(), key=lambda pair: abs(pair[1]))
    return curve.record(best[0]), precision


@dataclass(frozen=True)
class CurvePoint:
    """A solution z (N + 1,), its unit tangent, the residual before Newton's last step.

    ``factors`` are those of the last matrix, where the next corrector uses them.
    """

    z: np.ndarray
    tangent: np.ndarray
    residual: float
    factors: Any = field(default=None, repr=False, compare=False)


class AlgebraicCurve:
    """Curve G(z) = 0 of N equations in N + 1 unknowns.

    Parameters
    ----------
    residual : callable
        G(z), (N,).
    derivative : callable
        dG/dz, (N, N + 1).
    tests : callable, optional
        Test functions of a `CurvePoint`.
    tolerance : float
        Largest component of G at a solution.
    max_iterations : int
        Newton iterations.
    """

    def __init__(
        self,
        residual: Callable[[np.ndarray], np.ndarray],
        derivative: Callable[[np.ndarray], np.ndarray],
        tests: Callable[[CurvePoint], Mapping[str, float]] = lambda point: {},
        tolerance: float = 1e-10,
        max_iterations: int = 8,
    ) -> None:
        self._residual, self._derivative, self._tests = residual, derivative, tests
        self._tolerance, self._max_iterations = tolerance, max_iterations

    def start(self, z: np.ndarray, direction: np.ndarray) -> CurvePoint | None:
        """Solution near z, with the tangent that has a positive product with `direction`."""
        guess = CurvePoint(np.array(z, float), direction / np.linalg.norm(direction), np.inf)
        return self.correct(guess)[0]

    def predict(self, point: CurvePoint, step: float) -> CurvePoint:
        """Step along the tangent."""
        return CurvePoint(point.z + step * point.tangent, point.tangent, np.inf, point.factors)

    def correct(self, predicted: CurvePoint) -> tuple[CurvePoint | None, int]:
        """Newton in the hyperplane through the prediction, orthogonal to its tangent.

        The linear system is ::

            [ dG/dz ]        [ -G ]
            [ t^T   ] dz  =  [  0 ]
        """
        z, t = predicted.z, predicted.tangent
        for iteration in range(self._max_iterations + 1):
            try:
                G, solution = self._newton(z, t)
            except np.linalg.LinAlgError:  # singular, or not finite
                return None, iteration
            size = np.abs(G).max()
            if size <= self._tolerance:
                tangent = solution[:, 1] / np.linalg.norm(solution[:, 1])
                return CurvePoint(z + solution[:, 0], tangent, float(size)), iteration
            z = z + solution[:, 0]
        return None, self._max_iterations

    def _newton(self, z: np.ndarray, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """G(z), and from one factorisation Newton's step and the new tangent as columns.

        Raises LinAlgError where the matrix is singular or anything is not finite.
        """
        G = self._residual(z)
        matrix = np.vstack([self._derivative(z), t])
        if not np.isfinite(matrix).all() or not np.isfinite(G).all():
            raise np.linalg.LinAlgError("not finite")
        rhs = np.zeros((len(z), 2))
        rhs[:-1, 0] = -G
        rhs[-1, 1] = 1.0
        return G, np.linalg.solve(matrix, rhs)

    def test_functions(self, point: CurvePoint) -> Mapping[str, float]:
        """Test functions given at construction."""
        return self._tests(point)

    def turning(self, point: CurvePoint, new: CurvePoint) -> float:
        """Cosine between the tangents."""
        return float(point.tangent.dot(new.tangent))

    def prepare(self, point: CurvePoint) -> CurvePoint:
        """Nothing to prepare."""
        return point

    def record(self, point: CurvePoint) -> CurvePoint:
        """The point without factors."""
        return point if point.factors is None else replace(point, factors=None)

    def stride(
        self, point: CurvePoint, step: float, control: StepControl, most: int
    ) -> tuple[list[CurvePoint], CurvePoint, float]:
        """No step: here each takes the same time alone."""
        return [], point, step


def sign_changes(
    curve: AlgebraicCurve,
    points: Sequence[CurvePoint],
    kind: str,
    test: Callable[[CurvePoint], float],
    values: np.ndarray,
) -> list[SpecialPoint]:
    """Zeros of a function along the points of a finished walk, its values there given."""
    found = []
    for i in np.flatnonzero(values[:-1] * values[1:] < 0.0):
        step = float((points[i + 1].z - points[i].z) @ points[i].tangent)
        ends = (float(values[i]), float(values[i + 1]))
        located, precision = _locate(curve, points[i], step, test, ends)
        found.append(SpecialPoint(kind, located, precision, int(i)))
    return found
