"""Hopf points: extended system, first Lyapunov coefficient, curves in two parameters.

References
----------
Equations (9) and (10) of the paper; Y. A. Kuznetsov, Elements of Applied Bifurcation Theory,
sections 5.4 and 10.2.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

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
        self.system, self.free, self.k = system, free, component
        self._parameters = np.array(parameters, float)
        self.n = system.dimension

    def parameters(self, z: np.ndarray) -> np.ndarray:
        p = self._parameters.copy()
        p[list(self.free)] = z[3 * self.n + 1 :]
        return p

    def pack(self, point: HopfPoint) -> np.ndarray:
        u = point.vector / point.vector[self.k]
        free = point.parameters[list(self.free)]
        return np.concatenate([point.state, u.real, u.imag, [point.omega], free])

    def unpack(self, z: np.ndarray, residual: float, converged: bool = True) -> HopfPoint:
        n = self.n
        u = z[n : 2 * n] + 1j * z[2 * n : 3 * n]
        return HopfPoint(z[:n], u, float(z[3 * n]), self.parameters(z), residual, converged)

    def residual(self, z: np.ndarray) -> np.ndarray:
        n, k = self.n, self.k
        x, u_R, u_I, omega = z[:n], z[n : 2 * n], z[2 * n : 3 * n], z[3 * n]
        p = self.parameters(z)
        J = self.system.jacobian(x[None], p)[0]
        f = self.system.rhs(x[None], p)[0]
        scaling = [u_R[k] - 1.0, u_I[k]]
        return np.concatenate([f, J @ u_R + omega * u_I, J @ u_I - omega * u_R, scaling])

    def derivative(self, z: np.ndarray) -> np.ndarray:
        """Derivative of the residual in z.

        ::

                     x        u_R      u_I      omega   p
            f     [  J        .        .        .       f_p     ]
            u_R   [  (J u_R)' J        omega    u_I     J_p u_R ]
            u_I   [  (J u_I)' -omega   J       -u_R     J_p u_I ]
                  [  .        e_k      .        .       .       ]
                  [  .        .        e_k      .       .       ]
        """
        n, k = self.n, self.k
        x, u_R, u_I, omega = z[:n], z[n : 2 * n], z[2 * n : 3 * n], z[3 * n]
        p = self.parameters(z)
        J = self.system.jacobian(x[None], p)[0]
        J_x, J_p = self.system.jacobian_derivatives(x, p, np.stack([u_R, u_I]), self.free)
        f_p = self.system.rhs_parameter_derivatives(x, p, self.free)
        out = np.zeros((3 * n + 2, z.size))
        out[:n, :n] = out[n : 2 * n, n : 2 * n] = out[2 * n : 3 * n, 2 * n : 3 * n] = J
        out[n : 2 * n, :n], out[2 * n : 3 * n, :n] = J_x
        rows = np.arange(n)
        out[n + rows, 2 * n + rows] = omega
        out[2 * n + rows, n + rows] = -omega
        out[n : 2 * n, 3 * n] = u_I
        out[2 * n : 3 * n, 3 * n] = -u_R
        out[:n, 3 * n + 1 :] = f_p.T
        out[n : 2 * n, 3 * n + 1 :] = (J_p @ u_R).T
        out[2 * n : 3 * n, 3 * n + 1 :] = (J_p @ u_I).T
        out[3 * n, n + k] = out[3 * n + 1, 2 * n + k] = 1.0
        return out


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
    z = extended.pack(guess)
    size = np.inf
    for _ in range(max_iterations + 1):
        G = extended.residual(z)
        size = float(np.abs(G).max())
        if not np.isfinite(size):
            break
        try:
            z = z - np.linalg.solve(extended.derivative(z), G)  # also once more at the tolerance
        except np.linalg.LinAlgError:
            break
        if size <= tolerance:
            break
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
    x = np.array([point.state for point in points])
    parameters = np.array([point.parameters for point in points]).T
    omega = np.array([point.omega for point in points])[:, None, None]
    q = np.array([point.vector / np.abs(point.vector).max() for point in points])
    J = system.jacobian(x, parameters)
    a, b = q.real, q.imag
    D_a, E_a = _jacobian_directions(system, x, parameters, a, radius)
    D_b, E_b = _jacobian_directions(system, x, parameters, b, radius)
    B_qq = _apply(D_a, a) - _apply(D_b, b) + 2j * _apply(D_a, b)
    B_qqc = _apply(D_a, a) + _apply(D_b, b)
    C_qqqc = _apply(E_a + E_b, a) + 1j * _apply(E_a + E_b, b)
    identity = np.eye(system.dimension)
    h_20 = np.linalg.solve(2j * omega * identity - J, B_qq[..., None])[..., 0]
    h_11 = np.linalg.solve(J, B_qqc[..., None])[..., 0]
    p = _adjoint_vectors(J, q, omega)
    total = C_qqqc - 2.0 * _apply(D_a + 1j * D_b, h_11) + _apply(D_a - 1j * D_b, h_20)
    l_1 = np.sum(np.conj(p) * total, axis=1).real / (2.0 * omega[:, 0, 0])
    return l_1 / np.abs(q[:, component]) ** 2


def _apply(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    return np.einsum("ajk,ak->aj", matrices, vectors)


def _adjoint_vectors(J: np.ndarray, q: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Vectors p with J^T p = -i omega p and <p, q> = conj(p) . q = 1, by bordered solves."""
    count, n = q.shape
    bordered = np.zeros((count, n + 1, n + 1), complex)
    bordered[:, :n, :n] = np.swapaxes(J, 1, 2) + 1j * omega * np.eye(n)
    bordered[:, :n, n] = q
    bordered[:, n, :n] = np.conj(q)
    right = np.zeros((count, n + 1, 1))
    right[:, n] = 1.0
    p = np.linalg.solve(bordered, right)[:, :n, 0]
    return p / np.conj(np.sum(np.conj(p) * q, axis=1, keepdims=True))


def _jacobian_directions(
    system: DynamicalSystem,
    x: np.ndarray,
    parameters: np.ndarray,
    directions: np.ndarray,
    radius: float,
) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivatives of J at states (k, n) along directions (k, n), Cauchy's formula.

    The trapezoidal rule with K points on the circle has the error of order radius^K and needs no
    small difference; the lower half of the circle is the complex conjugate of the upper one.
    """
    K = 12
    angles = np.pi * np.arange(K // 2 + 1) / (K // 2)
    weights = np.where((angles == 0.0) | (angles == np.pi), 1.0, 2.0) / K
    offsets = radius * np.exp(1j * angles)
    states = x[:, None, :] + offsets[:, None] * directions[:, None, :]
    count, n = x.shape
    repeated = np.repeat(parameters, len(angles), axis=1)
    J = system.jacobian(states.reshape(-1, n), repeated).reshape(count, -1, n, n)
    first = np.einsum("a,kaij->kij", weights * np.exp(-1j * angles) / radius, J)
    second = np.einsum("a,kaij->kij", 2.0 * weights * np.exp(-2j * angles) / radius**2, J)
    return first.real, second.real


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

    def tests(point: CurvePoint) -> dict[str, float]:
        return {"critical": point.tangent[-1], "zero_frequency": point.z[3 * extended.n]}

    def l_1(point: CurvePoint) -> float:
        hopf = extended.unpack(point.z, point.residual)
        return first_lyapunov_coefficient(system, hopf, component)

    curve = AlgebraicCurve(extended.residual, extended.derivative, tests, tolerance)
    first = curve.start(extended.pack(start), direction * np.eye(3 * extended.n + 3)[-1])
    if first is None:
        return HopfCurve([], np.empty(0), [], "no_convergence")
    windows = [(extended.n * 3 + 1 + i, *bounds[name]) for i, name in enumerate(free)]
    travelled = [0.0, first.z]

    def leaves(point: CurvePoint) -> str | None:
        if any(not low <= point.z[i] <= high for i, low, high in windows):
            return "window"
        step = float(np.linalg.norm(point.z - travelled[1]))
        travelled[:] = [travelled[0] + step, point.z]
        back = float(np.linalg.norm(point.z - first.z))
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
