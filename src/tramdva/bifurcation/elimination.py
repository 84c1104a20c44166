"""Gaussian elimination of small dense matrices, compiled; real or complex."""

import numba
import numpy as np

jit = numba.njit(
    cache=True, nogil=True, error_model="numpy", fastmath={"contract"}, no_cfunc_wrapper=True
)
# For what Python itself does not call: half of the compile time would go into the way from there.
inner_jit = numba.njit(
    cache=True,
    nogil=True,
    error_model="numpy",
    fastmath={"contract"},
    no_cfunc_wrapper=True,
    no_cpython_wrapper=True,
)


# Indices without sign: Numba then adds no test for negative ones, and the loops become vectors.
_ONE = np.uint64(1)


@inner_jit
def factor_columns(a, pivots, columns, rows):
    """Gaussian elimination of the first columns; pivots among the first rows.

    Multipliers stay below the diagonal, in the row order of their own step: `forward_columns`
    swaps and subtracts in turn.
    """
    height, width = np.uint64(a.shape[0]), np.uint64(a.shape[1])
    for k in range(np.uint64(columns)):
        best, size = k, abs(a[k, k])
        for i in range(k + _ONE, np.uint64(rows)):
            if abs(a[i, k]) > size:
                best, size = i, abs(a[i, k])
        pivots[k] = best
        if best != k:
            for j in range(k, width):
                a[k, j], a[best, j] = a[best, j], a[k, j]
        inverse = 1.0 / a[k, k]
        for i in range(k + _ONE, height):
            multiplier = a[i, k] * inverse
            a[i, k] = multiplier
            if multiplier != 0.0:
                for j in range(k + _ONE, width):
                    a[i, j] -= multiplier * a[k, j]


@inner_jit
def forward_columns(a, pivots, columns, b):
    """Apply the elimination of `factor_columns` to a right-hand side."""
    for k in range(np.uint64(columns)):
        best = np.uint64(pivots[k])
        if best != k:
            b[k], b[best] = b[best], b[k]
        value = b[k]
        if value != 0.0:
            for i in range(k + _ONE, np.uint64(a.shape[0])):
                b[i] -= a[i, k] * value


@inner_jit
def factor(a):
    """LU factors of a square matrix in its place, and the pivots; singular ones give inf or NaN."""
    pivots = np.empty(a.shape[0], np.int64)
    factor_columns(a, pivots, a.shape[0], a.shape[0])
    return pivots


@inner_jit
def substitute(lu, pivots, b):
    """Solution of the factorised system in the place of its right-hand side."""
    n = lu.shape[0]
    forward_columns(lu, pivots, n, b)
    for k in range(n - 1, -1, -1):
        value = b[k]
        for j in range(k + 1, n):
            value -= lu[k, j] * b[j]
        b[k] = value / lu[k, k]


@inner_jit
def largest_magnitude(values):
    """Largest magnitude of a flat array; NaN where one is not finite."""
    size = 0.0
    for value in values:
        if not np.isfinite(value):
            return np.nan
        size = max(size, abs(value))
    return size
