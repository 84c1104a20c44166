"""Orthogonal collocation of periodic orbits: basis, mesh, and the bordered linear system.

An orbit with the period T is a continuous piecewise polynomial u(tau), tau = t/T in [0, 1], of
degree m on
N intervals, held by its values at m + 1 equidistant nodes of each interval. It satisfies u' = T
f(u, p) at the m Gauss points of each interval.

References
----------
C. de Boor, B. Swartz, SIAM J. Numer. Anal. 10 (1973) 582-606; R. D. Russell, J. Christiansen,
ibid. 15
(1978) 59-80 (mesh); T. F. Fairgrieve, A. D. Jepson, ibid. 28 (1991) 1446-1462 (Floquet multipliers
from the condensed matrix).
"""

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import as_strided

from tramdva.bifurcation.elimination import (
    factor,
    factor_columns,
    forward_columns,
    inner_jit,
    jit,
    substitute,
)


class Basis(NamedTuple):
    """Lagrange basis of degree m on the unit interval, at the Gauss points.

    Attributes
    ----------
    degree : int
        m, number of Gauss points.
    nodes : (m + 1,) array
        Equidistant nodes.
    gauss : (m,) array
        Gauss points.
    weights : (m,) array
        Gauss weights, sum 1.
    values, derivatives : (m, m + 1) array
        Basis functions and their derivatives at the Gauss points.
    mass : (m + 1, m + 1) array
        Integrals of the products of two basis functions.
    highest : (m + 1,) array
        Coefficients that give the m-th derivative (constant on the interval).
    """

    degree: int
    nodes: np.ndarray
    gauss: np.ndarray
    weights: np.ndarray
    values: np.ndarray
    derivatives: np.ndarray
    mass: np.ndarray
    highest: np.ndarray


@cache
def basis(degree: int) -> Basis:
    """Basis of a degree."""
    points, weights = np.polynomial.legendre.leggauss(degree)
    gauss = 0.5 * (points + 1.0)
    nodes = np.linspace(0.0, 1.0, degree + 1)
    # Monomials about the centre: columns of `coefficients` are the basis polynomials.
    coefficients = np.linalg.inv(np.vander(nodes - 0.5, increasing=True))
    powers = np.arange(1, degree + 1)
    derivative = np.vander(gauss - 0.5, degree, increasing=True) * powers
    values = np.vander(gauss - 0.5, degree + 1, increasing=True) @ coefficients
    return Basis(
        degree=degree,
        nodes=nodes,
        gauss=gauss,
        weights=0.5 * weights,
        values=values,
        mass=np.einsum("c,ci,ck->ik", 0.5 * weights, values, values),
        derivatives=derivative @ coefficients[1:],
        highest=coefficients[-1] * float(np.prod(powers)),
    )


def lagrange_values(base: Basis, positions: np.ndarray) -> np.ndarray:
    """Basis functions at positions (k,) in the unit interval, (k, m + 1), in barycentric form."""
    difference = positions[:, None] - base.nodes
    exact = np.abs(difference) < 1e-14
    binomial = base.highest  # barycentric weights up to a common factor
    terms = binomial / np.where(exact, 1.0, difference)
    values = terms / terms.sum(axis=1, keepdims=True)
    return np.where(exact.any(axis=1, keepdims=True), exact.astype(float), values)


def interval_values(nodal: np.ndarray, degree: int) -> np.ndarray:
    """Nodal values (N m + 1, n) as overlapping intervals, a view (N, m + 1, n)."""
    row, column = nodal.strides
    shape = ((len(nodal) - 1) // degree, degree + 1, nodal.shape[1])
    return as_strided(nodal, shape, (degree * row, row, column), writeable=False)


def evaluate(mesh: np.ndarray, nodal: np.ndarray, degree: int, tau: np.ndarray) -> np.ndarray:
    """Orbit at the times tau (k,) in [0, 1], (k, n)."""
    base = basis(degree)
    j = np.clip(np.searchsorted(mesh, tau, side="right") - 1, 0, len(mesh) - 2)
    local = (tau - mesh[j]) / (mesh[j + 1] - mesh[j])
    values = lagrange_values(base, local)
    return np.einsum("ki,kin->kn", values, interval_values(nodal, degree)[j])


def node_times(mesh: np.ndarray, degree: int) -> np.ndarray:
    """Times of all nodes, (N m + 1,)."""
    inner = mesh[:-1, None] + np.diff(mesh)[:, None] * basis(degree).nodes[:-1]
    return np.append(inner.ravel(), mesh[-1])


def error_monitor(mesh: np.ndarray, nodal: np.ndarray, degree: int) -> np.ndarray:
    """Density of the local error: norm of the (m + 1)-th derivative to the power 1/(m + 1).

    The derivative comes from the jumps of the m-th derivative at the mesh points, mean of both
    sides.
    """
    return _monitor(mesh[1:] - mesh[:-1], nodal, basis(degree).highest)


@jit
def _monitor(h, nodal, highest):
    N, n, m = h.size, nodal.shape[1], highest.size - 1
    derivative = np.zeros((N, n))
    for s in range(n):
        extent = nodal[:, s].max() - nodal[:, s].min()
        size = max(extent, 1e-300)  # states count alike, whatever their size
        for j in range(N):
            for i in range(m + 1):
                derivative[j, s] += highest[i] * (nodal[j * m + i, s] / size)
            derivative[j, s] /= h[j] ** m
    jump = np.empty(N + 1)
    for j in range(N):
        square = 0.0
        for s in range(n):
            square += (derivative[j, s] - derivative[j - 1, s]) ** 2
        jump[j] = np.sqrt(square) / (0.5 * (h[j] + h[j - 1]))
    jump[N] = jump[0]
    density = np.empty(N)
    total = 0.0
    for j in range(N):
        density[j] = (0.5 * (jump[j] + jump[j + 1])) ** (1.0 / (m + 1))
        total += density[j] * h[j]
    # A floor keeps intervals where the orbit is almost polynomial from growing without bound.
    return np.maximum(density, 0.1 * total + 1e-300)


def equidistributed_mesh(mesh: np.ndarray, nodal: np.ndarray, degree: int) -> np.ndarray:
    """Mesh of as many intervals on which each has the same share of the error monitor."""
    share = np.append(0.0, np.cumsum(error_monitor(mesh, nodal, degree) * np.diff(mesh)))
    new = np.interp(np.linspace(0.0, share[-1], len(mesh)), share, mesh)
    new[0], new[-1] = mesh[0], mesh[-1]
    return new


def mesh_imbalance(mesh: np.ndarray, nodal: np.ndarray, degree: int) -> float:
    """Largest share of the error monitor over the mean; 1 on an equidistributed mesh."""
    share = error_monitor(mesh, nodal, degree) * (mesh[1:] - mesh[:-1])
    return float(share.max() / share.mean())


class BorderedFactors(NamedTuple):
    """Factorised linear system of an orbit; see `factorise`."""

    interval_lu: np.ndarray
    interval_pivots: np.ndarray
    chain_lu: np.ndarray
    chain_pivots: np.ndarray
    closing: np.ndarray
    closing_pivots: np.ndarray
    left: np.ndarray
    right: np.ndarray


@jit
def factorise(base, h, period, J, f, f_p, phase, arc, arc_scalars):
    """Factorise the bordered collocation matrix.

    Parameters
    ----------
    base : Basis
        Degree m.
    h : (N,) array
        Mesh intervals.
    period : float
        T.
    J : (N, m, n, n) array
        Jacobian matrices at the Gauss points.
    f, f_p : (N, m, n) array
        Right-hand side and its derivative in the free parameter p there.
    phase, arc : (N, m, n) array
        Functions of the phase and the arclength row at the Gauss points.
    arc_scalars : (float, float)
        Entries of the arclength row for T and p.

    Returns
    -------
    BorderedFactors
        With ``left`` P and ``right`` Q, (n, n), of the condensed P u(0) + Q u(1) = 0. A singular
        matrix gives factors that are not finite.

    Notes
    -----
    Per interval, the unknowns inside are eliminated; then the mesh points, from left to right,
    with partial
    pivoting; the periodic closure remains. The two border rows take part and are never pivots::

        [ u_0  u_1  u_2 ...  u_N | T    p   ]
        [ X    X                 | -f  -T f_p ]   interval 1 (u inside eliminated)
        [      X    X            | -f  -T f_p ]   interval 2
        [               X    X   | ...      ]
        [ I                  -I  | .    .   ]   periodicity
        [ integral  phase . u    | .    .   ]
        [ integral  arc . u      | s_T  s_p ]
    """
    interval_lu, interval_pivots = _eliminate_intervals(
        base.values, base.derivatives, base.weights, h, period, J, f, f_p, phase, arc
    )
    n = J.shape[2]
    chain_lu, chain_pivots, last = _eliminate_chain(interval_lu, n)
    left, right = last[:n, :n].copy(), last[:n, n : 2 * n].copy()
    closing = np.empty((n + 2, n + 2))
    for i in range(n + 2):
        for k in range(n):
            closing[i, k] = last[i, k] + last[i, n + k]  # u(0) = u(1)
        closing[i, n] = last[i, 2 * n]
        closing[i, n + 1] = last[i, 2 * n + 1]
    closing[n + 1, n] += arc_scalars[0]
    closing[n + 1, n + 1] += arc_scalars[1]
    closing_pivots = factor(closing)
    return BorderedFactors(
        interval_lu,
        interval_pivots,
        chain_lu,
        chain_pivots,
        closing,
        closing_pivots,
        left,
        right,
    )


@jit
def solve(factors, residual, border):
    """Solution of the bordered system.

    Parameters
    ----------
    factors : BorderedFactors
        From `factorise`.
    residual : (N, m, n) array
        Right-hand side of the collocation equations.
    border : (float, float)
        Right-hand sides of the phase and the arclength row.

    Returns
    -------
    tuple
        Nodal values (N m + 1, n), T and p.
    """
    N, m, n = residual.shape
    rhs, chain, closing = _forward(
        factors.interval_lu,
        factors.interval_pivots,
        factors.chain_lu,
        factors.chain_pivots,
        residual.reshape(N, m * n),
        border,
    )
    substitute(factors.closing, factors.closing_pivots, closing)
    nodal = _backward(factors.interval_lu, factors.chain_lu, rhs, chain, closing, m)
    return nodal, closing[n], closing[n + 1]


@inner_jit
def _eliminate_intervals(values, derivatives, weights, h, period, J, f, f_p, phase, arc):
    """Assemble and condense each interval; columns: inside, left, right, T, p; two border rows."""
    N, m, n = f.shape
    inside = n * (m - 1)
    rows = n * m
    lu = np.zeros((N, rows + 2, inside + 2 * n + 2))
    pivots = np.empty((N, inside), np.int64)
    for j in range(N):
        a = lu[j]
        for c in range(m):
            for i in range(m + 1):
                column = inside if i == 0 else (inside + n if i == m else n * (i - 1))
                d, v = derivatives[c, i] / h[j], period * values[c, i]
                weight = weights[c] * h[j] * values[c, i]
                for r in range(n):
                    for s in range(n):
                        a[c * n + r, column + s] = -v * J[j, c, r, s]
                    a[c * n + r, column + r] += d
                    a[rows, column + r] += weight * phase[j, c, r]
                    a[rows + 1, column + r] += weight * arc[j, c, r]
            for r in range(n):
                a[c * n + r, inside + 2 * n] = -f[j, c, r]
                a[c * n + r, inside + 2 * n + 1] = -period * f_p[j, c, r]
        factor_columns(a, pivots[j], inside, rows)
    return lu, pivots


@inner_jit
def _copy_block(target, row, column, source, source_row, source_column, rows, columns):
    for i in range(rows):
        for j in range(columns):
            target[row + i, column + j] = source[source_row + i, source_column + j]


@inner_jit
def _eliminate_chain(lu, n):
    """Eliminate the mesh points between the ends; columns: middle, first, next, T, p.

    The running rows have the columns first, current, T, p; the blocks of `lu` left, right, T, p.
    """
    N, height, width = lu.shape
    inside = width - 2 * n - 2
    top = height - n - 2
    chain = np.zeros((max(N - 1, 0), 2 * n + 2, 3 * n + 2))
    pivots = np.empty((max(N - 1, 0), n), np.int64)
    running = np.empty((n + 2, 2 * n + 2))
    _copy_block(running, 0, 0, lu[0], top, inside, n + 2, 2 * n + 2)
    for j in range(1, N):
        a, block = chain[j - 1], lu[j]
        for first, last, row in ((0, n, 0), (n, n + 2, 2 * n)):
            _copy_block(a, row, 0, running, first, n, last - first, n)
            _copy_block(a, row, n, running, first, 0, last - first, n)
            _copy_block(a, row, 3 * n, running, first, 2 * n, last - first, 2)
        for i in range(n + 2):
            for k in range(2 * n + 2):
                column = k if k < n else k + n
                a[n + i, column] += block[top + i, inside + k]
        factor_columns(a, pivots[j - 1], n, 2 * n)
        _copy_block(running, 0, 0, a, n, n, n + 2, 2 * n + 2)
    return chain, pivots, running


@inner_jit
def _forward(lu, pivots, chain_lu, chain_pivots, residual, border):
    """Forward elimination of the right-hand side through intervals, chain and closure."""
    N, height, _ = lu.shape
    inside = pivots.shape[1]
    rows = height - 2
    n = rows - inside
    rhs = np.zeros((N, height))
    chain = np.zeros((max(N - 1, 0), 2 * n + 2))
    running = np.empty(n + 2)
    for j in range(N):
        for i in range(rows):
            rhs[j, i] = residual[j, i]
        forward_columns(lu[j], pivots[j], inside, rhs[j])
        if j > 0:
            b = chain[j - 1]
            for i in range(n):
                b[i] = running[i]
            for i in range(n + 2):
                b[n + i] = rhs[j, inside + i]
            for i in range(n, n + 2):
                b[n + i] += running[i]
            forward_columns(chain_lu[j - 1], chain_pivots[j - 1], n, b)
        source = rhs[0, inside:] if j == 0 else chain[j - 1, n:]
        for i in range(n + 2):
            running[i] = source[i]
    for i in range(2):
        running[n + i] += border[i]
    return rhs, chain, running


@inner_jit
def _backward(lu, chain_lu, rhs, chain, closing, m):
    """Back substitution: mesh points from right to left, then the nodes inside the intervals.

    What is known is subtracted from all rows first, then column by column: no row waits for the
    sum of another.
    """
    N = lu.shape[0]
    n = closing.shape[0] - 2
    inside = n * (m - 1)
    nodal = np.empty((N * m + 1, n))
    known = np.empty(2 * n + 2)
    x = np.empty(max(inside, n))
    for s in range(n):
        nodal[0, s] = nodal[N * m, s] = known[s] = closing[s]
    known[2 * n], known[2 * n + 1] = closing[n], closing[n + 1]
    for j in range(N - 1, 0, -1):
        for s in range(n):
            known[n + s] = nodal[(j + 1) * m, s]
        _upper(chain_lu[j - 1], n, chain[j - 1], known, x)
        for s in range(n):
            nodal[j * m, s] = x[s]
    for j in range(N):
        for s in range(n):
            known[s], known[n + s] = nodal[j * m, s], nodal[(j + 1) * m, s]
        _upper(lu[j], inside, rhs[j], known, x)
        for i in range(inside):
            nodal[j * m + 1 + i // n, i % n] = x[i]
    return nodal


@inner_jit
def _upper(a, unknowns, b, known, x):
    """Solve the upper triangle left in the first rows of `a`, its last columns' unknowns given."""
    height = np.uint64(unknowns)
    one, zero = np.uint64(1), np.uint64(0)
    for i in range(height):
        value = b[i]
        for s in range(np.uint64(known.size)):
            value -= a[i, height + s] * known[s]
        x[i] = value
    for back in range(height):
        k = height - one - back
        x[k] /= a[k, k]
        value = x[k]
        for i in range(zero, k):
            x[i] -= a[i, k] * value
