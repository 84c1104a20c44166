"""Stability in first approximation: growth rates, Routh-Hurwitz, critical friction decrease.

References
----------
Equations (6)-(8) and figure 2 of the paper; F. R. Gantmacher, The Theory of Matrices, vol. 2,
chapter XV.
"""

from typing import Any

import numpy as np

from tramdva.wheelset.model import WheelsetParameters, linearised

STABLE, OSCILLATORY, MONOTONE, NO_EQUILIBRIUM = 0, 1, 2, 3

# Coefficients are formed with the time in ms: in s they span thirty decades.
_TIME = 1e-3
GREATEST_B = 20.0  # s/m, as the configuration allows


def leading_eigenvalues(values: WheelsetParameters, with_absorber: bool) -> np.ndarray:
    """Eigenvalue of largest real part (with positive imaginary part if complex).

    Parameters
    ----------
    values : WheelsetParameters
        Fields broadcast to the shape of the result; SI units.
    with_absorber : bool
        Whether the absorber is mounted.

    Returns
    -------
    complex array
        In 1/s; NaN where there is no equilibrium.
    """
    shape = np.broadcast_shapes(*(np.shape(value) for value in values))
    matrices = linearised(values, with_absorber).matrices
    missing = ~np.isfinite(matrices).all(axis=(1, 2))
    eigenvalues = np.linalg.eigvals(np.where(missing[:, None, None], 0.0, matrices))
    eigenvalues[missing] = np.nan
    leading = np.argmax(eigenvalues.real, axis=1)
    found = np.take_along_axis(eigenvalues, leading[:, None], axis=1)[:, 0]
    return (found.real + 1j * np.abs(found.imag)).reshape(shape)


def growth_rate(values: WheelsetParameters, with_absorber: bool) -> np.ndarray:
    """Largest real part of the eigenvalues in 1/s; arguments as in `leading_eigenvalues`.

    Examples
    --------
    The wheelset of Table 1 vibrates by itself; neither with the absorber of Table 2 nor on a rail
    whose friction falls less steeply does it.

    >>> from tramdva.wheelset.published import paper_wheelset
    >>> from tramdva.wheelset.stability import growth_rate
    >>> wheelset = paper_wheelset()
    >>> print(f"{growth_rate(wheelset, with_absorber=False):+.2f} 1/s")
    +0.18 1/s
    >>> print(f"{growth_rate(wheelset, with_absorber=True):+.1f} 1/s")
    -11.8 1/s
    >>> bool(growth_rate(wheelset._replace(B=0.4), with_absorber=False) < 0.0)
    True

    Values that are arrays give a map at once.

    >>> import numpy as np
    >>> growth_rate(wheelset._replace(c_A=np.array([4e7, 5.2e7, 2.5e8])), False) > 0.0
    array([False,  True, False])
    """
    return leading_eigenvalues(values, with_absorber).real


def characteristic_polynomial(values: WheelsetParameters, with_absorber: bool) -> np.ndarray:
    """Coefficients 1, a_1, .., a_n of the characteristic equation of (8).

    Parameters
    ----------
    values : WheelsetParameters
        Fields broadcast to the shape of the result; SI units.
    with_absorber : bool
        Whether the absorber is mounted: n = 6, else n = 4.

    Returns
    -------
    (..., n + 1) array
        In ms: a_i is in (1/ms)^i.

    Notes
    -----
    From the determinant of the mechanical system, not from the state matrix: with the polynomials
    ``A``, ``T``, ``R`` (inertia, damping and stiffness of each body) and the couplings ``t``,
    ``r``, ``det = A T R - t^2 R - r^2 T``.
    """
    p = WheelsetParameters(*np.broadcast_arrays(*values))
    shape = p.m_A.shape
    kappa = linearised(values, with_absorber).kappa.reshape(shape)
    time, Omega2 = _TIME, p.Omega**2

    def quadratic(mass: Any, damping: Any, stiffness: Any) -> np.ndarray:
        return np.stack([mass, damping * time, stiffness * time**2], axis=-1)

    c_T, d_T = (p.c_T, p.d_T) if with_absorber else (np.zeros(shape), np.zeros(shape))
    A = quadratic(p.m_A, p.d_A + p.d_R + d_T, p.c_A + p.c_R + c_T - p.m_A * Omega2)
    R = quadratic(p.m_R, p.d_R + kappa, p.c_R - p.m_R * Omega2)
    r = quadratic(np.zeros(shape), p.d_R, p.c_R)
    polynomial = _product(A, R) - _product(r, r)
    if with_absorber:
        T = quadratic(p.m_T, d_T, c_T - p.m_T * Omega2)
        t = quadratic(np.zeros(shape), d_T, c_T)
        polynomial = _product(polynomial, T) - _product(_product(t, t), R)
    return polynomial / polynomial[..., :1]


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Products of polynomials along the last axis."""
    out = np.zeros((*a.shape[:-1], a.shape[-1] + b.shape[-1] - 1))
    for i in range(a.shape[-1]):
        out[..., i : i + b.shape[-1]] += a[..., i : i + 1] * b
    return out


def hurwitz_determinants(coefficients: np.ndarray) -> np.ndarray:
    """Hurwitz determinants H_1, .., H_n of polynomials 1, a_1, .., a_n.

    Parameters
    ----------
    coefficients : (..., n + 1) array
        Leading coefficient 1 first.

    Returns
    -------
    (..., n) array
        All positive if and only if all roots have negative real parts.
    """
    n = coefficients.shape[-1] - 1
    matrix = np.zeros((*coefficients.shape[:-1], n, n))
    for i in range(n):
        for j in range(n):
            k = 2 * (j + 1) - (i + 1)
            if 0 <= k <= n:
                matrix[..., i, j] = coefficients[..., k]
    minors = [np.linalg.det(matrix[..., :order, :order]) for order in range(1, n + 1)]
    return np.stack(minors, axis=-1)


def classify(leading: np.ndarray) -> np.ndarray:
    """`STABLE`, `OSCILLATORY`, `MONOTONE` or `NO_EQUILIBRIUM` from leading eigenvalues (1/s)."""
    kind = np.where(leading.imag > 0.0, OSCILLATORY, MONOTONE)
    kind = np.where(leading.real < 0.0, STABLE, kind)
    return np.where(np.isnan(leading), NO_EQUILIBRIUM, kind).astype(np.int8)


def critical_friction_decrease(values: WheelsetParameters, with_absorber: bool) -> float:
    """Smallest friction decrease B in s/m with self-excitation, to 1e-6 of its value.

    Zero where the wheelset is unstable without any decrease; NaN where it is stable up to
    `GREATEST_B`, or where there is no equilibrium.
    """
    low, high = 0.0, GREATEST_B
    for _ in range(4):  # each look at the first change of sign is fifty times closer
        decrease = np.linspace(low, high, 401 if low == 0.0 else 51)
        growth = growth_rate(values._replace(B=decrease), with_absorber)
        excited = np.flatnonzero(growth >= 0.0)
        if not excited.size:
            return float("nan")
        if excited[0] == 0:
            return float(decrease[0])
        low, high = decrease[excited[0] - 1], decrease[excited[0]]
    return float(0.5 * (low + high))
