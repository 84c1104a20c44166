"""The extended system of Hopf points, compiled: residual, matrix, correctors, strides.

The unknowns are z = (x, u_R, u_I, omega, p_1 [, p_2]), the equations ::

    f(x, p) = 0,   J u_R + omega u_I = 0,   J u_I - omega u_R = 0,   u_R[k] = 1,   u_I[k] = 0

References
----------
Equations (9) and (10) of the paper; Y. A. Kuznetsov, Elements of Applied Bifurcation Theory,
section 10.2.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bifurcation.compiled import STEP, Evaluator, jacobian_matrices, right_hand_sides
from tramdva.bifurcation.continuation import next_step
from tramdva.bifurcation.elimination import factor, inner_jit, jit, largest_magnitude, substitute

# A step with an old matrix must shrink the residual by this factor, else Newton begins anew.
_CHORD_RATE = 0.2
_CHORD_STEPS = 10


class Unknowns(NamedTuple):
    """What the extended system is made of.

    Attributes
    ----------
    system : Evaluator
    parameters : (q,) array
        Values of all parameters; the free ones are replaced.
    free : (1,) or (2,) int array
        Positions of the free parameters.
    component : int
        k, in which the eigenvector is 1.
    """

    system: Evaluator
    parameters: np.ndarray
    free: np.ndarray
    component: int


@inner_jit
def _row(unknowns, z):
    """Parameters at z, (1, q)."""
    row = unknowns.parameters.copy().reshape(1, -1)
    first = z.size - unknowns.free.size
    for i in range(unknowns.free.size):
        row[0, unknowns.free[i]] = z[first + i]
    return row


@inner_jit
def residual(unknowns, z):
    """Residual (3 n + 2,), and J (n, n) for the matrix."""
    n, k = unknowns.system.state.size, unknowns.component
    row, state = _row(unknowns, z), z[:n].copy().reshape(1, n)
    f = right_hand_sides(unknowns.system, state, row)
    J = jacobian_matrices(unknowns.system, state, row)[0]
    omega = z[3 * n]
    G = np.empty(3 * n + 2)
    for i in range(n):
        real, imaginary = omega * z[2 * n + i], -omega * z[n + i]
        for j in range(n):
            real += J[i, j] * z[n + j]
            imaginary += J[i, j] * z[2 * n + j]
        G[i], G[n + i], G[2 * n + i] = f[0, i], real, imaginary
    G[3 * n] = z[n + k] - 1.0
    G[3 * n + 1] = z[2 * n + k]
    return G, J


@inner_jit
def matrix(unknowns, z, J, last_row):
    """Derivative of the residual in z, and below it a last row where one is free, (N, N).

    ::

                 x        u_R      u_I      omega   p
        f     [  J        .        .        .       f_p     ]
        u_R   [  (J u_R)' J        omega    u_I     J_p u_R ]
        u_I   [  (J u_I)' -omega   J       -u_R     J_p u_I ]
              [  .        e_k      .        .       .       ]
              [  .        .        e_k      .       .       ]
              [  last row                                   ]

    All derivatives are complex steps.
    """
    n, k, N = unknowns.system.state.size, unknowns.component, z.size
    out = np.zeros((N, N))
    omega = z[3 * n]
    for i in range(n):
        for j in range(n):
            out[i, j] = out[n + i, n + j] = out[2 * n + i, 2 * n + j] = J[i, j]
        out[n + i, 2 * n + i] = omega
        out[2 * n + i, n + i] = -omega
        out[n + i, 3 * n] = z[2 * n + i]
        out[2 * n + i, 3 * n] = -z[n + i]
    out[3 * n, n + k] = out[3 * n + 1, 2 * n + k] = 1.0
    for j in range(N):
        if 3 * n + 2 < N:
            out[N - 1, j] = last_row[j]
    row = _row(unknowns, z) + 0.0j
    states = np.empty((2, n), np.complex128)
    for j in range(n):
        states[0, j] = z[j] + 1j * STEP * z[n + j]
        states[1, j] = z[j] + 1j * STEP * z[2 * n + j]
    J_x = jacobian_matrices(unknowns.system, states, row)
    state = z[:n].copy().reshape(1, n) + 0.0j
    for i in range(n):
        for j in range(n):
            out[n + i, j] = J_x[0, i, j].imag / STEP
            out[2 * n + i, j] = J_x[1, i, j].imag / STEP
    for c in range(unknowns.free.size):
        column, index = 3 * n + 1 + c, unknowns.free[c]
        row[0, index] += 1j * STEP
        f_p = right_hand_sides(unknowns.system, state, row)[0]
        J_p = jacobian_matrices(unknowns.system, state, row)[0]
        row[0, index] = row[0, index].real
        for i in range(n):
            out[i, column] = f_p[i].imag / STEP
            for j in range(n):
                slope = J_p[i, j].imag / STEP
                out[n + i, column] += slope * z[n + j]
                out[2 * n + i, column] += slope * z[2 * n + j]
    return out


@jit
def solve(unknowns, z, tolerance, max_iterations):
    """Newton's method for one free parameter: z and the residual before the last step."""
    size = np.inf
    for _ in range(max_iterations + 1):
        G, J = residual(unknowns, z)
        size = largest_magnitude(G)
        if not np.isfinite(size):
            break
        lu = matrix(unknowns, z, J, z)
        pivots = factor(lu)
        substitute(lu, pivots, G)
        if not np.isfinite(largest_magnitude(G)):  # singular
            break
        z = z - G  # also once more at the tolerance
        if size <= tolerance:
            break
    return z, size


class Walk(NamedTuple):
    """How to walk along a curve of Hopf points: StepControl.rule, corrector, window.

    Attributes
    ----------
    rule : (float, float, float, int)
        Smallest and largest step, smallest cosine of the turn, comfortable iterations.
    tolerance : float
        Largest component of the residual.
    max_iterations : int
        Newton iterations.
    window : (2, 2) array
        Lowest and highest value of each of the two parameters.
    """

    rule: tuple[float, float, float, int]
    tolerance: float
    max_iterations: int
    window: np.ndarray


@jit
def stride(unknowns, z, tangent, lu, pivots, step, walk, most):
    """Steps from a point of the curve until something happens, at most `most`.

    It ends before a step that has to be repeated, leaves the window, or changes the sign of the
    frequency or of the tangent in the last parameter.

    Returns
    -------
    tuple
        Points (k, N), tangents (k, N), residuals (k,), factors of the last one, next step.
    """
    N, frequency = z.size, z.size - 3
    points, tangents, residuals = np.empty((most, N)), np.empty((most, N)), np.empty(most)
    k = 0
    while k < most:
        predicted = z + step * tangent
        size, iterations, new, direction, matrix, order = correct(
            unknowns, predicted, tangent, walk.tolerance, walk.max_iterations, lu, pivots
        )
        cosine = 0.0
        for i in range(N):
            cosine += tangent[i] * direction[i]
        inside = True
        for i in range(2):
            inside &= walk.window[i, 0] <= new[N - 2 + i] <= walk.window[i, 1]
        event = new[frequency] * z[frequency] < 0.0 or direction[N - 1] * tangent[N - 1] < 0.0
        if not (size <= walk.tolerance and cosine >= walk.rule[2] and inside) or event:
            break
        z, tangent, lu, pivots = new, direction, matrix, order
        for i in range(N):
            points[k, i], tangents[k, i] = z[i], tangent[i]
        residuals[k] = size
        k += 1
        step = next_step(
            step, iterations, cosine, walk.rule[0], walk.rule[1], walk.rule[2], walk.rule[3]
        )
    return points[:k], tangents[:k], residuals[:k], lu, pivots, step


@jit
def correct(unknowns, predicted, tangent, tolerance, max_iterations, lu, pivots):
    """Point in the hyperplane through the prediction, orthogonal to its tangent.

    Steps with the matrix of the last point (`lu`, empty if there is none) come first, as long as
    they converge fast; then, or from the prediction again, Newton's method.

    Returns
    -------
    tuple
        Residual before the last step (NaN without a solution), matrices factorised before the
        last one, z, tangent, and its factors.
    """
    z = predicted
    if lu.size > 0:
        z, close = _chord(unknowns, predicted, tangent, tolerance, lu, pivots)
        if not close:
            z = predicted
    for iteration in range(max_iterations + 1):
        G, J = residual(unknowns, z)
        size = largest_magnitude(G)
        if not np.isfinite(size):
            return np.nan, iteration, z, tangent, lu, pivots
        lu = matrix(unknowns, z, J, tangent)
        pivots = factor(lu)
        step = np.zeros(z.size)
        for i in range(G.size):
            step[i] = -G[i]
        substitute(lu, pivots, step)
        if not np.isfinite(largest_magnitude(step)):
            return np.nan, iteration, z, tangent, lu, pivots
        z = z + step
        if size <= tolerance:
            new = np.zeros(z.size)
            new[-1] = 1.0
            substitute(lu, pivots, new)
            length = 0.0
            for value in new:
                length += value * value
            return size, iteration, z, new / np.sqrt(length), lu, pivots
    return np.nan, max_iterations, z, tangent, lu, pivots


@inner_jit
def _chord(unknowns, z, tangent, tolerance, lu, pivots):
    """Steps with an old matrix: z, and whether its residual is within the tolerance.

    The last row of the old matrix is another one; the tangent t solves its other rows with zero,
    so that x - t (t x) is the step orthogonal to t.
    """
    last = np.inf
    for _ in range(_CHORD_STEPS):
        G, _ = residual(unknowns, z)
        size = largest_magnitude(G)
        if size <= tolerance:
            return z, True
        if not size <= _CHORD_RATE * last:
            return z, False
        step = np.zeros(z.size)
        for i in range(G.size):
            step[i] = -G[i]
        substitute(lu, pivots, step)
        along = 0.0
        for i in range(z.size):
            along += step[i] * tangent[i]
        z = z + (step - along * tangent)
        last = size
    return z, False
