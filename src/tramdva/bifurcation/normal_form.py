"""First Lyapunov coefficients of Hopf points, compiled.

References
----------
Y. A. Kuznetsov, Elements of Applied Bifurcation Theory, section 5.4.
"""

import numpy as np

from tramdva.bifurcation.compiled import jacobian_matrices
from tramdva.bifurcation.elimination import factor, inner_jit, jit, substitute

# Points of Cauchy's formula on the upper half of the circle, both ends included.
_ARC = 7


@jit
def lyapunov_coefficients(system, states, vectors, omegas, parameters, component, radius):
    """First Lyapunov coefficients of Hopf points, (count,).

    Parameters: states (count, n), vectors (count, n) complex, omegas (count,), parameters
    (count, q); see `tramdva.bifurcation.hopf.first_lyapunov_coefficients`.
    """
    count = states.shape[0]
    out = np.empty(count)
    for i in range(count):
        row = parameters[i : i + 1].copy()
        q = vectors[i] / np.abs(vectors[i]).max()
        J = jacobian_matrices(system, states[i : i + 1].copy(), row)[0]
        D, E = _jacobian_directions(system, states[i], row, q, radius)
        l_1 = _normal_form(J, D, E, q, omegas[i]) / (2.0 * omegas[i])
        out[i] = l_1 / (q[component].real ** 2 + q[component].imag ** 2)
    return out


@inner_jit
def _jacobian_directions(system, state, row, q, radius):
    """First and second derivatives of J along Re q and Im q, (2, n, n) each, Cauchy's formula.

    The trapezoidal rule with K points on the circle has the error of order radius^K and needs no
    small difference; the lower half of the circle is the complex conjugate of the upper one.
    """
    n, K = state.size, 2 * (_ARC - 1)
    states = np.empty((2 * _ARC, n), np.complex128)
    turns = np.empty(_ARC, np.complex128)
    for a in range(_ARC):
        turns[a] = np.exp(2j * np.pi * a / K)
        for j in range(n):
            states[a, j] = state[j] + radius * turns[a] * q[j].real
            states[_ARC + a, j] = state[j] + radius * turns[a] * q[j].imag
    J = jacobian_matrices(system, states, row + 0.0j)
    first, second = np.zeros((2, n, n)), np.zeros((2, n, n))
    for a in range(_ARC):
        weight = (1.0 if a in (0, _ARC - 1) else 2.0) / K
        once = weight * np.conj(turns[a]) / radius
        twice = 2.0 * weight * np.conj(turns[a]) ** 2 / radius**2
        for d in range(2):
            for i in range(n):
                for j in range(n):
                    value = J[d * _ARC + a, i, j]
                    first[d, i, j] += (once * value).real
                    second[d, i, j] += (twice * value).real
    return first, second


@inner_jit
def _applied(matrix, vector):
    n = vector.size
    out = np.zeros(n, np.complex128)
    for i in range(n):
        for j in range(n):
            out[i] += matrix[i, j] * vector[j]
    return out


@inner_jit
def _normal_form(J, D, E, q, omega):
    """Real part of Kuznetsov's bracket, eq. (5.39), for the eigenvector q of i omega."""
    n = q.size
    a, b = q.real + 0.0j, q.imag + 0.0j
    squares = _applied(D[0], a), _applied(D[1], b)
    shifted = -J + 0.0j
    for i in range(n):
        shifted[i, i] += 2j * omega
    h_20 = squares[0] - squares[1] + 2j * _applied(D[0], b)
    substitute(shifted, factor(shifted), h_20)
    h_11 = squares[0] + squares[1]
    inverse = J + 0.0j
    substitute(inverse, factor(inverse), h_11)
    both = E[0] + E[1]
    total = _applied(both, a) + 1j * _applied(both, b)
    total += -2.0 * (_applied(D[0], h_11) + 1j * _applied(D[1], h_11))
    total += _applied(D[0], h_20) - 1j * _applied(D[1], h_20)
    p = _adjoint_vector(J, q, omega)
    value = 0.0
    for i in range(n):
        value += (np.conj(p[i]) * total[i]).real
    return value


@inner_jit
def _adjoint_vector(J, q, omega):
    """Vector p with J^T p = -i omega p and <p, q> = conj(p) . q = 1, by a bordered matrix."""
    n = q.size
    bordered = np.zeros((n + 1, n + 1), np.complex128)
    for i in range(n):
        for j in range(n):
            bordered[i, j] = J[j, i]
        bordered[i, i] += 1j * omega
        bordered[i, n] = q[i]
        bordered[n, i] = np.conj(q[i])
    p = np.zeros(n + 1, np.complex128)
    p[n] = 1.0
    substitute(bordered, factor(bordered), p)
    product = 0.0j
    for i in range(n):
        product += np.conj(p[i]) * q[i]
    return p[:n] / np.conj(product)
