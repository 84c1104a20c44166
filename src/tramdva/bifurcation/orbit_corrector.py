"""Corrector of periodic orbits, compiled: residual and matrix of the collocation equations, Newton.

The unknowns are the values at the nodes, the period and one parameter, see `collocation`.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bifurcation.collocation import Basis, BorderedFactors, factorise, solve
from tramdva.bifurcation.compiled import STEP, Evaluator, jacobian_matrices, right_hand_sides
from tramdva.bifurcation.elimination import inner_jit, jit, largest_magnitude

# A chord step must shrink the residual by this factor, else the matrix is factorised anew.
_CHORD_RATE = 0.2


class Direction(NamedTuple):
    """Change of an orbit: nodal values (N m + 1, n), period, parameter."""

    nodal: np.ndarray
    period: float
    parameter: float

    def scaled(self, factor: float) -> "Direction":
        """The direction times a number."""
        return Direction(self.nodal * factor, self.period * factor, self.parameter * factor)

    def plus(self, other: "Direction") -> "Direction":
        """Sum of two directions."""
        return Direction(
            self.nodal + other.nodal, self.period + other.period, self.parameter + other.parameter
        )


class Linearisation(NamedTuple):
    """Factorised matrix of an orbit and its solution for the right-hand side (0, .., 0, 1)."""

    factors: BorderedFactors
    column: Direction


class Equations(NamedTuple):
    """What the corrector needs besides an orbit.

    Attributes
    ----------
    system : Evaluator
    base : Basis
    index : int
        Position of the free parameter.
    weight : float
        Of the parameter's square in the inner product.
    tolerance : float
        Largest change by the last step, relative to states of order one.
    max_iterations : int
        Newton and chord steps.
    """

    system: Evaluator
    base: Basis
    index: int
    weight: float
    tolerance: float
    max_iterations: int


class Orbit(NamedTuple):
    """Mesh intervals (N,), nodal values (N m + 1, n), period, parameters (1, q)."""

    h: np.ndarray
    nodal: np.ndarray
    period: float
    parameters: np.ndarray


def no_linearisation() -> Linearisation:
    """The argument of `correct` where no matrix is at hand."""
    matrix, pivots = np.empty((0, 0)), np.empty(0, np.int64)
    matrices, more_pivots = np.empty((0, 0, 0)), np.empty((0, 0), np.int64)
    factors = BorderedFactors(
        matrices, more_pivots, matrices, more_pivots, matrix, pivots, matrix, matrix
    )
    return Linearisation(factors, Direction(matrix, 0.0, 0.0))


@jit
def correct(equations, orbit, tangent, linearisation, fixed_parameter):
    """Newton steps, with the matrix of the last orbit as long as they converge fast (chord).

    Every step is orthogonal to the orbit's time derivative (phase) and to the tangent
    (arclength), or leaves the parameter as it is.

    Returns
    -------
    tuple
        Whether it converged, iterations, the orbit, its largest residual, its linearisation, its
        unit tangent.
    """
    row = Direction(np.zeros_like(orbit.nodal), 0.0, 1.0)
    if not fixed_parameter:
        row = _dual(equations, orbit, tangent)
    last, last_change, iteration, solved = np.inf, np.inf, 0, False
    while iteration < equations.max_iterations or solved:
        f, residual = _residual(equations, orbit)
        size = _largest(residual)
        # one place for each of the large functions: each place is compiled
        if solved or linearisation.column.nodal.size == 0 or size > _CHORD_RATE * last:
            linearisation = _linearise(equations, orbit, f, tangent)
        finite = np.isfinite(size) and np.isfinite(_largest(linearisation.column.nodal))
        if solved or not finite:
            if finite:
                tangent = _unit(equations, orbit, linearisation.column, tangent)
            found = solved and finite and orbit.period > 0.0
            return found, max(iteration, 1), orbit, size, linearisation, tangent
        step = _step(linearisation, residual, row)
        orbit = _moved(orbit, step, equations.index)
        iteration += 1
        change = max(_largest(step.nodal), abs(step.period) / orbit.period)
        # The next change would be smaller by the rate seen so far.
        rate = change / last_change if np.isfinite(last_change) else 1.0
        solved = change * min(rate, 1.0) <= equations.tolerance
        last, last_change = size, change
    return False, equations.max_iterations, orbit, np.nan, linearisation, tangent


@inner_jit
def _largest(values):
    return largest_magnitude(values.ravel())


@jit
def product(mass, h, period, weight, a, b):
    """Inner product of two directions: states over the period, period, scaled parameter."""
    m, n = mass.shape[0] - 1, a.nodal.shape[1]
    total = 0.0
    local = np.empty(n)
    for j in range(h.size):
        for i in range(m + 1):
            local[:] = 0.0
            for k in range(m + 1):
                for s in range(n):
                    local[s] += mass[i, k] * a.nodal[j * m + k, s]
            value = 0.0
            for s in range(n):
                value += local[s] * b.nodal[j * m + i, s]
            total += h[j] * value
    total += a.period / period**2 * b.period
    return total + weight * a.parameter * b.parameter


@inner_jit
def _dual(equations, orbit, direction):
    """Weights whose plain dot product with another direction is the inner product."""
    m, mass = equations.base.degree, equations.base.mass
    n = orbit.nodal.shape[1]
    weights = np.zeros_like(orbit.nodal)
    for j in range(orbit.h.size):
        for i in range(m + 1):
            for k in range(m + 1):
                weight = orbit.h[j] * mass[i, k]
                for s in range(n):
                    weights[j * m + i, s] += weight * direction.nodal[j * m + k, s]
    return Direction(
        weights, direction.period / orbit.period**2, equations.weight * direction.parameter
    )


@inner_jit
def _dot(a, b):
    """Plain dot product of all numbers of two directions."""
    total = a.period * b.period + a.parameter * b.parameter
    for i in range(a.nodal.shape[0]):
        for s in range(a.nodal.shape[1]):
            total += a.nodal[i, s] * b.nodal[i, s]
    return total


@inner_jit
def _unit(equations, orbit, direction, towards):
    """Direction of length 1 with a positive product with another one."""
    mass, weight = equations.base.mass, equations.weight
    factor = 1.0 / np.sqrt(product(mass, orbit.h, orbit.period, weight, direction, direction))
    if product(mass, orbit.h, orbit.period, weight, towards, direction) < 0.0:
        factor = -factor
    return Direction(
        direction.nodal * factor, direction.period * factor, direction.parameter * factor
    )


@inner_jit
def _step(linearisation, residual, row):
    """Newton step -x with v x = 0 for the wanted last row v.

    The matrix may have another last row: with t = `column` all other rows give zero, so that
    x - t (v x) / (v t) solves the system with the row v.
    """
    nodal, period, parameter = solve(linearisation.factors, residual, (0.0, 0.0))
    t = linearisation.column
    share = _dot(row, Direction(nodal, period, parameter)) / _dot(row, t)
    for i in range(nodal.shape[0]):
        for s in range(nodal.shape[1]):
            nodal[i, s] = share * t.nodal[i, s] - nodal[i, s]
    return Direction(nodal, share * t.period - period, share * t.parameter - parameter)


@inner_jit
def _moved(orbit, step, index):
    parameters = orbit.parameters.copy()
    parameters[0, index] += step.parameter
    return Orbit(orbit.h, orbit.nodal + step.nodal, orbit.period + step.period, parameters)


@inner_jit
def _at_gauss_points(nodal, matrix, intervals):
    """Values (N m, n) of polynomials by the matrix (m, m + 1) of their basis."""
    m, n = matrix.shape[0], nodal.shape[1]
    out = np.zeros((intervals * m, n))
    for j in range(intervals):
        for c in range(m):
            values = out[j * m + c]
            for i in range(m + 1):
                weight, node = matrix[c, i], nodal[j * m + i]
                for s in range(n):
                    values[s] += weight * node[s]
    return out


@inner_jit
def _slopes(equations, orbit):
    """Derivatives in tau at the Gauss points, (N, m, n)."""
    N, m, n = orbit.h.size, equations.base.degree, orbit.nodal.shape[1]
    slope = _at_gauss_points(orbit.nodal, equations.base.derivatives, N)
    for j in range(N * m):
        for s in range(n):
            slope[j, s] /= orbit.h[j // m]
    return slope.reshape(N, m, n)


@inner_jit
def _residual(equations, orbit):
    """f and u' - T f at the Gauss points, (N, m, n)."""
    residual = _slopes(equations, orbit)
    u = _at_gauss_points(orbit.nodal, equations.base.values, orbit.h.size)
    f = right_hand_sides(equations.system, u, orbit.parameters).reshape(residual.shape)
    for j in range(residual.shape[0]):
        for c in range(residual.shape[1]):
            for s in range(residual.shape[2]):
                residual[j, c, s] -= orbit.period * f[j, c, s]
    return f, residual


@inner_jit
def _linearise(equations, orbit, f, tangent):
    """Matrix with the tangent as its last row, factorised."""
    base, N = equations.base, orbit.h.size
    shape = f.shape
    u = _at_gauss_points(orbit.nodal, base.values, N)
    J = jacobian_matrices(equations.system, u, orbit.parameters)
    row = orbit.parameters + 0.0j
    row[0, equations.index] += 1j * STEP
    f_p = right_hand_sides(equations.system, u + 0.0j, row).imag / STEP
    factors = factorise(
        base,
        orbit.h,
        orbit.period,
        J.reshape(shape[0], shape[1], shape[2], shape[2]),
        f,
        f_p.reshape(shape),
        _slopes(equations, orbit),
        _at_gauss_points(tangent.nodal, base.values, N).reshape(shape),
        (tangent.period / orbit.period**2, tangent.parameter * equations.weight),
    )
    nodal, period, parameter = solve(factors, np.zeros_like(f), (0.0, 1.0))
    return Linearisation(factors, Direction(nodal, period, parameter))
