"""Hopf points: extended system, first Lyapunov coefficient, curves in two parameters.

References
----------
Equations (9) and (10) of the paper; Y. A. Kuznetsov, Elements of Applied Bifurcation Theory,
sections 5.4 and 10.2.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tramdva.bifurcation import extended_system
from tramdva.bifurcation.compiled import Evaluation
from tramdva.bifurcation.continuation import (
    AlgebraicCurve,
    CurvePoint,
    StepControl,
    sign_changes,
    trace,
)
from tramdva.bifurcation.system import DynamicalSystem


@dataclass(frozen=True)
class HopfPoint:
    """An equilibrium with the eigenvalues +- i omega.

    Attributes
    ----------
    state : (n,) array
        Equilibrium x.
    vector : (n,) complex array
        Eigenvector u = u_R + i u_I of i omega; its component k is 1.
    omega : float
        Angular frequency, positive.
    parameters : (q,) array
        Parameter vector.
    residual : float
        Largest component of the extended system (10) before Newton's last step.
    converged : bool
        Whether Newton's method reached its tolerance.
    """

    state: np.ndarray
    vector: np.ndarray
    omega: float
    parameters: np.ndarray
    residual: float
    converged: bool


def solve_equilibrium(
    system: DynamicalSystem, state: np.ndarray, parameters: np.ndarray, tolerance: float = 1e-12
) -> np.ndarray | None:
    """Equilibrium f(x, p) = 0 near a state by Newton's method, or None without convergence."""
    x = np.array(state, float)
    for _ in range(30):
        f = system.rhs(x[None], parameters)[0]
        dx = np.linalg.solve(system.jacobian(x[None], parameters)[0], -f)
        x = x + dx
        if not np.isfinite(x).all():
            return None
        if np.abs(dx).max() <= tolerance * max(1.0, np.abs(x).max()):
            return x
    return None


def critical_pair(
    system: DynamicalSystem, state: np.ndarray, parameters: np.ndarray
) -> tuple[complex, np.ndarray]:
    """Complex eigenvalue (positive imaginary part) of largest real part, and its eigenvector.

    Raises
    ------
    ArithmeticError
        If all eigenvalues are real.
    """
    values, vectors = np.linalg.eig(system.jacobian(state[None], parameters)[0])
    upper = np.flatnonzero(values.imag > 0.0)
    if upper.size == 0:
        raise ArithmeticError("all eigenvalues are real: there is no Hopf point to start from")
    k = upper[np.argmax(values[upper].real)]
    vector = vectors[:, k]
    return complex(values[k]), vector / vector[np.argmax(np.abs(vector))]


class _ExtendedSystem:
    """Equations (10): unknowns z = (x, u_R, u_I, omega, p_1 [, p_2]), 3 n + 2 equations."""

    def __init__(
        self, system: DynamicalSystem, parameters: np.ndarray, free: tuple[int, ...], component: int
    ) -> None:
        self._parameters = np.array(parameters, float)
        self._free, self._component = np.array(free), component
        self.n = system.dimension
        self.evaluation = Evaluation(system)
        self.unknowns = extended_system.Unknowns(
            self.evaluation.evaluator, self._parameters, self._free, component
        )

    def parameters(self, z: np.ndarray) -> np.ndarray:
        p = self._parameters.copy()
        p[self._free] = z[3 * self.n + 1 :]
        return p

    def pack(self, point: HopfPoint) -> np.ndarray:
        u = point.vector / point.vector[self._component]
        free = point.parameters[self._free]
        return np.concatenate([point.state, u.real, u.imag, [point.omega], free])

    def unpack(self, z: np.ndarray, residual: float, converged: bool = True) -> HopfPoint:
        n = self.n
        u = z[n : 2 * n] + 1j * z[2 * n : 3 * n]
        return HopfPoint(z[:n], u, float(z[3 * n]), self.parameters(z), residual, converged)


def solve_hopf_point(
    system: DynamicalSystem,
    state: np.ndarray,
    parameters: np.ndarray,
    free: str,
    *,
    tolerance: float = 1e-11,
    max_iterations: int = 20,
) -> HopfPoint:
    """Hopf point near an equilibrium, eq. (10), by Newton's method.

    Parameters
    ----------
    system : DynamicalSystem
        Well-scaled system of dimension n.
    state : (n,) array
        Equilibrium, approximately.
    parameters : (q,) array
        Parameter vector, the free parameter near its Hopf value.
    free : str
        Name of the parameter that is solved for.
    tolerance : float
        Largest component of the extended system's residual.
    max_iterations : int
        Newton iterations.

    Returns
    -------
    HopfPoint
        ``converged`` is False when the tolerance was not reached (or omega is not positive).
    """
    eigenvalue, vector = critical_pair(system, state, parameters)
    guess = HopfPoint(state, vector, eigenvalue.imag, np.array(parameters, float), np.inf, False)
    component = int(np.argmax(np.abs(vector)))
    extended = _ExtendedSystem(system, parameters, (system.index(free),), component)
    z, size = extended_system.solve(
        extended.unknowns, extended.pack(guess), tolerance, max_iterations
    )
    extended.evaluation.check()
    point = extended.unpack(z, size)
    return replace(point, converged=bool(size <= tolerance and point.omega > 0.0))


def first_lyapunov_coefficient(
    system: DynamicalSystem, point: HopfPoint, component: int, radius: float = 1e-2
) -> float:
    """First Lyapunov coefficient of one Hopf point, see `first_lyapunov_coefficients`."""
    return float(first_lyapunov_coefficients(system, [point], component, radius)[0])


def first_lyapunov_coefficients(
    system: DynamicalSystem, points: Sequence[HopfPoint], component: int, radius: float = 1e-2
) -> np.ndarray:
    """First Lyapunov coefficients of Hopf points: negative is supercritical.

    Parameters
    ----------
    system : DynamicalSystem
        Well-scaled system.
    points : sequence of HopfPoint
        Converged points.
    component : int
        The critical eigenvector is scaled to 1 in this component (the coefficient's unit is one
        over that component squared).
    radius : float
        Radius of the circle, in multiples of the eigenvector with largest component 1, on which
        Cauchy's formula takes the directional derivatives of the Jacobian; must stay within the
        region where f is analytic.

    Returns
    -------
    (len(points),) array
        ``l_1 = Re(c_1) / omega`` of the normal form ``z' = i omega z + c_1 z |z|^2``.

    Notes
    -----
    Kuznetsov (2004), eq. (5.39), with the multilinear forms B and C of f::

        l_1 = Re[ <p, C(q, q, q*)> - 2 <p, B(q, J^-1 B(q, q*))>
                  + <p, B(q*, (2 i omega - J)^-1 B(q, q))> ] / (2 omega)
    """
    if not points:
        return np.empty(0)
    evaluation = Evaluation(system)
    coefficients = extended_system.lyapunov_coefficients(
        evaluation.evaluator,
        np.array([point.state for point in points]),
        np.array([point.vector for point in points]),
        np.array([point.omega for point in points]),
        np.array([point.parameters for point in points]),
        component,
        radius,
    )
    evaluation.check()
    return coefficients


class _HopfCurve(AlgebraicCurve):
    """Curve of the extended system with two free parameters, by its compiled corrector."""

    def __init__(self, extended: _ExtendedSystem, tolerance: float, window: np.ndarray) -> None:
        super().__init__(None, None, _tests_of(extended.n), tolerance)
        self._extended, self._window = extended, window

    def stride(
        self, point: CurvePoint, step: float, control: StepControl, most: int
    ) -> tuple[list[CurvePoint], CurvePoint, float]:
        """All steps until something happens in one compiled call."""
        lu, pivots = point.factors or _NO_FACTORS
        walk = extended_system.Walk(
            control.rule, self._tolerance, self._max_iterations, self._window
        )
        points, tangents, residuals, lu, pivots, step = extended_system.stride(
            self._extended.unknowns, point.z, point.tangent, lu, pivots, float(step), walk, most
        )
        self._extended.evaluation.check()
        passed = list(map(CurvePoint, points, tangents, residuals.tolist()))
        if passed:
            point = replace(passed[-1], factors=(lu, pivots))
        return passed, point, step

    def correct(self, predicted: CurvePoint) -> tuple[CurvePoint | None, int]:
        """As in `AlgebraicCurve`, with the matrix of the last point first."""
        lu, pivots = predicted.factors or _NO_FACTORS
        size, iterations, z, tangent, lu, pivots = extended_system.correct(
            self._extended.unknowns,
            predicted.z,
            predicted.tangent,
            self._tolerance,
            self._max_iterations,
            lu,
            pivots,
        )
        self._extended.evaluation.check()
        if not size <= self._tolerance:
            return None, iterations
        return CurvePoint(z, tangent, size, (lu, pivots)), iterations


def _distance(a: np.ndarray, b: np.ndarray) -> float:
    between = a - b
    return math.sqrt(between.dot(between))


_NO_FACTORS = (np.empty((0, 0)), np.empty(0, np.int64))


def _tests_of(n: int) -> Callable[[CurvePoint], dict[str, float]]:
    def tests(point: CurvePoint) -> dict[str, float]:
        return {"critical": point.tangent[-1], "zero_frequency": point.z[3 * n]}

    return tests


@dataclass(frozen=True)
class HopfCurve:
    """Hopf points along a curve in two parameters, and its special points.

    Attributes
    ----------
    points : list of HopfPoint
    first_lyapunov_coefficients : (len(points),) array
    special : list of (str, HopfPoint)
        Kinds: ``critical`` (the second parameter has an extremum), ``generalised_hopf`` (first
        Lyapunov coefficient zero), ``zero_frequency``.
    ended : str
        Why the walk ended.
    """

    points: list[HopfPoint]
    first_lyapunov_coefficients: np.ndarray
    special: list[tuple[str, HopfPoint]]
    ended: str


def hopf_curve(
    system: DynamicalSystem,
    start: HopfPoint,
    free: tuple[str, str],
    bounds: Mapping[str, tuple[float, float]],
    control: StepControl,
    *,
    direction: int,
    component: int,
    tolerance: float = 1e-10,
) -> HopfCurve:
    """Curve of Hopf points in two parameters, by pseudo-arclength continuation of (10).

    Parameters
    ----------
    system : DynamicalSystem
        Well-scaled system.
    start : HopfPoint
        First point.
    free : (str, str)
        Parameters p_1 and p_2.
    bounds : mapping
        Window (low, high) per parameter; the walk ends with the last point inside.
    control : StepControl
        Steps.
    direction : {1, -1}
        Sign of the change of p_2 at the start.
    component : int
        State that normalises the first Lyapunov coefficient.
    tolerance : float
        Largest component of the extended system's residual.

    Returns
    -------
    HopfCurve
    """
    indices = tuple(system.index(name) for name in free)
    k = int(np.argmax(np.abs(start.vector)))
    extended = _ExtendedSystem(system, start.parameters, indices, k)

    def l_1(point: CurvePoint) -> float:
        hopf = extended.unpack(point.z, point.residual)
        return first_lyapunov_coefficient(system, hopf, component)

    window = np.array([bounds[name] for name in free], float)
    curve = _HopfCurve(extended, float(tolerance), window)
    first = curve.start(extended.pack(start), direction * np.eye(3 * extended.n + 3)[-1])
    if first is None:
        return HopfCurve([], np.empty(0), [], "no_convergence")
    limits = window.tolist()
    travelled = [0.0, first.z]

    def leaves(point: CurvePoint) -> str | None:
        if not all(
            low <= value <= high for value, (low, high) in zip(point.z[-2:], limits, strict=True)
        ):
            return "window"
        step = _distance(point.z, travelled[1])
        travelled[:] = [travelled[0] + step, point.z]
        back = _distance(point.z, first.z)
        return "closed" if back < step and travelled[0] > 4.0 * step else None

    branch = trace(
        curve, first, control, leaves, discard=frozenset({"window"}), approach=frozenset({"window"})
    )
    points = [extended.unpack(point.z, point.residual) for point in branch.points]
    coefficients = first_lyapunov_coefficients(system, points, component)
    special = branch.special + sign_changes(
        curve, branch.points, "generalised_hopf", l_1, coefficients
    )
    return HopfCurve(
        points=points,
        first_lyapunov_coefficients=coefficients,
        special=[(s.kind, extended.unpack(s.point.z, s.point.residual)) for s in special],
        ended=branch.ended,
    )
