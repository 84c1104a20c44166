"""Critical Hopf points: where two Hopf points merge under a second parameter.

At a critical point the growth rate of the pair +- i omega touches zero as a function of p_1. The
points form a curve in (p_2, p_3), given by the extended system (10) and the tangency (15).

References
----------
Equations (10)-(15) of the paper.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tramdva.bifurcation.continuation import AlgebraicCurve, CurvePoint, StepControl, trace
from tramdva.bifurcation.hopf import HopfPoint, solve_equilibrium
from tramdva.bifurcation.system import DynamicalSystem


def eigenvalue_derivative(
    system: DynamicalSystem,
    state: np.ndarray,
    parameters: np.ndarray,
    near: complex,
    index: int,
) -> complex:
    """Derivative of an eigenvalue in a parameter, along the branch of equilibria.

    Parameters
    ----------
    system : DynamicalSystem
    state : (n,) array
        Equilibrium.
    parameters : (q,) array
    near : complex
        The eigenvalue of J nearest to this is meant.
    index : int
        Position of the parameter.

    Returns
    -------
    complex
        psi^T J' u / psi^T u with the left eigenvector psi, eq. (15).

    Notes
    -----
    J' is the total derivative: J also changes with the equilibrium, x' = -J^-1 f_p.
    """
    J = system.jacobian(state[None], parameters)[0]
    values, vectors = np.linalg.eig(J)
    k = int(np.argmin(np.abs(values - near)))
    psi = np.linalg.inv(vectors)[k]  # rows of the inverse are left eigenvectors, psi^T u = 1
    total = total_jacobian_derivative(system, state, parameters, J, index)
    return complex(psi @ total @ vectors[:, k])


def total_jacobian_derivative(
    system: DynamicalSystem,
    state: np.ndarray,
    parameters: np.ndarray,
    J: np.ndarray,
    index: int,
) -> np.ndarray:
    """J' = J_p + (dJ/dx) x' with x' = -J^-1 f_p along the branch of equilibria, (n, n)."""
    f_p = system.rhs_parameter_derivatives(state, parameters, [index])[0]
    moved = np.linalg.solve(J, -f_p)
    J_x, J_p = system.jacobian_derivatives(state, parameters, moved[None], [index])
    return J_p[0] + J_x[0]


@dataclass(frozen=True)
class CriticalCurve:
    """Critical Hopf points along their curve.

    Attributes
    ----------
    points : list of HopfPoint
    tangents : (len(points), 3) array
        Tangents in (p_1, p_2, p_3).
    special : list of (str, int, HopfPoint)
        Kind, index of the point before, and point. Kinds: ``largest`` (p_2 has an extremum),
        ``fold`` (p_3 has an extremum), ``vanishing`` (p_2 passes the level given).
    ended : str
        Why the walk ended.
    """

    points: list[HopfPoint]
    tangents: np.ndarray
    special: list[tuple[str, int, HopfPoint]]
    ended: str


class _CriticalSystem:
    """Equations (10b-e) and (15) in z = (u_R, u_I, omega, p_1, p_2, p_3); (10a) is solved inside.

    The equilibrium is not among the unknowns: on the way to p_2 = 0 it may go to infinity (an
    absorber without spring) while its eigenvalues stay smooth.
    """

    def __init__(
        self, system: DynamicalSystem, start: HopfPoint, free: tuple[str, str, str]
    ) -> None:
        self.system = system
        self.free = [system.index(name) for name in free]
        self.k = int(np.argmax(np.abs(start.vector)))
        self._parameters = start.parameters
        self._state = start.state
        self.n = system.dimension
        # dRe(sigma)/dp_1 relative to the frequency and to p_1, of the size of the other equations
        self._scale = max(1.0, abs(start.parameters[self.free[0]])) / start.omega

    def pack(self, point: HopfPoint) -> np.ndarray:
        u = point.vector / point.vector[self.k]
        return np.concatenate([u.real, u.imag, [point.omega], point.parameters[self.free]])

    def unpack(self, z: np.ndarray, residual: float) -> HopfPoint:
        parameters = self.parameters(z)
        n = self.n
        u = z[:n] + 1j * z[n : 2 * n]
        return HopfPoint(
            self.equilibrium(parameters), u, float(z[2 * n]), parameters, residual, True
        )

    def parameters(self, z: np.ndarray) -> np.ndarray:
        p = self._parameters.copy()
        p[self.free] = z[2 * self.n + 1 :]
        return p

    def equilibrium(self, parameters: np.ndarray) -> np.ndarray:
        state = solve_equilibrium(self.system, self._state, parameters)
        return np.full(self.n, np.nan) if state is None else state

    def residual(self, z: np.ndarray) -> np.ndarray:
        n = self.n
        u_R, u_I, omega = z[:n], z[n : 2 * n], z[2 * n]
        p = self.parameters(z)
        x = self.equilibrium(p)
        if not np.isfinite(x).all():
            return np.full(2 * n + 3, np.nan)
        J = self.system.jacobian(x[None], p)[0]
        scaling = [u_R[self.k] - 1.0, u_I[self.k]]
        tangency = [self._tangency(z[2 * n + 1 :], omega)]
        return np.concatenate([J @ u_R + omega * u_I, J @ u_I - omega * u_R, scaling, tangency])

    def _tangency(self, free: np.ndarray, omega: float) -> float:
        """Scaled derivative of the growth rate in p_1, of the eigenvalue near i omega, eq. (15)."""
        p = self._parameters.copy()
        p[self.free] = free
        slope = eigenvalue_derivative(self.system, self.equilibrium(p), p, 1j * omega, self.free[0])
        return self._scale * slope.real

    def derivative(self, z: np.ndarray) -> np.ndarray:
        """Derivative of the residual in z.

        ::

                      u_R      u_I      omega   p_1..p_3
            (10b)  [  J        omega    u_I     J' u_R   ]
            (10c)  [ -omega    J       -u_R     J' u_I   ]
            (10d)  [  e_k      .        .       .        ]
            (10e)  [  .        e_k      .       .        ]
            (15)   [  .        .        .       central differences ]

        (15) already contains second derivatives of f.
        """
        n, k = self.n, self.k
        u_R, u_I, omega = z[:n], z[n : 2 * n], z[2 * n]
        p = self.parameters(z)
        x = self.equilibrium(p)
        J = self.system.jacobian(x[None], p)[0]
        out = np.zeros((2 * n + 3, z.size))
        out[:n, :n] = out[n : 2 * n, n : 2 * n] = J
        rows = np.arange(n)
        out[rows, n + rows] = omega
        out[n + rows, rows] = -omega
        out[:n, 2 * n] = u_I
        out[n : 2 * n, 2 * n] = -u_R
        out[2 * n, k] = out[2 * n + 1, n + k] = 1.0
        free = z[2 * n + 1 :]
        for i, index in enumerate(self.free):
            column = 2 * n + 1 + i
            total = total_jacobian_derivative(self.system, x, p, J, index)
            out[:n, column] = total @ u_R
            out[n : 2 * n, column] = total @ u_I
            h = 1e-6 * max(1.0, abs(free[i])) * np.eye(3)[i]
            slope = self._tangency(free + h, omega) - self._tangency(free - h, omega)
            out[2 * n + 2, column] = slope / (2.0 * h[i])
        return out


def _first(
    equations: _CriticalSystem, start: HopfPoint, direction: int, level: float, tolerance: float
) -> tuple[AlgebraicCurve, CurvePoint | None]:
    """The curve and its point at the p_3 of the start."""

    def tests(point: CurvePoint) -> dict[str, float]:
        return {
            "largest": point.tangent[-2],
            "fold": point.tangent[-1],
            "vanishing": point.z[-2] - level,
        }

    curve = AlgebraicCurve(equations.residual, equations.derivative, tests, tolerance)
    z = equations.pack(start)
    return curve, curve.start(z, direction * np.eye(len(z))[-1])


def solve_critical_point(
    system: DynamicalSystem,
    start: HopfPoint,
    free: tuple[str, str, str],
    *,
    tolerance: float = 1e-10,
) -> HopfPoint | None:
    """Critical point at the p_3 of the start, eqs (10) and (15), or None if Newton's method fails.

    Parameters as in `critical_hopf_curve`.
    """
    equations = _CriticalSystem(system, start, free)
    first = _first(equations, start, 1, 0.0, tolerance)[1]
    return None if first is None else equations.unpack(first.z, first.residual)


def critical_hopf_curve(
    system: DynamicalSystem,
    start: HopfPoint,
    free: tuple[str, str, str],
    control: StepControl,
    stop: Callable[[np.ndarray], str | None],
    *,
    direction: int,
    level: float = 0.0,
    tolerance: float = 1e-10,
) -> CriticalCurve:
    """Curve of critical Hopf points in three parameters by pseudo-arclength continuation.

    Parameters
    ----------
    system : DynamicalSystem
        Well-scaled system.
    start : HopfPoint
        Near a critical point.
    free : (str, str, str)
        p_1, in which the eigenvalue touches the axis, p_2 and p_3.
    control : StepControl
        Steps.
    stop : callable
        Reason to end at (p_1, p_2, p_3), or None; a point outside the ``window`` is left out.
    direction : {1, -1}
        Sign of the change of p_3 at the start.
    level : float
        Value of p_2 at which points are located.
    tolerance : float
        Largest component of the residual.

    Returns
    -------
    CriticalCurve
        Without points if Newton's method fails at the start.
    """
    equations = _CriticalSystem(system, start, free)
    curve, first = _first(equations, start, direction, level, tolerance)
    if first is None:
        return CriticalCurve([], np.empty((0, 3)), [], "no_convergence")
    branch = trace(
        curve,
        first,
        control,
        lambda point: stop(point.z[-3:]),
        discard=frozenset({"window"}),
        approach=frozenset({"window"}),
    )
    return CriticalCurve(
        points=[equations.unpack(point.z, point.residual) for point in branch.points],
        tangents=np.array([point.tangent[-3:] for point in branch.points]),
        special=[
            (s.kind, s.after, equations.unpack(s.point.z, s.point.residual)) for s in branch.special
        ],
        ended=branch.ended,
    )
