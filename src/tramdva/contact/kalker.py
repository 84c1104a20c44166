"""Kalker's creep coefficients, the flexibilities of the simplified theory, a saturated linear law.

Coefficients C11, C22, C23 from Kalker, Three-Dimensional Elastic Bodies in Rolling Contact
(1990), for Poisson's ratio 0, 1/4, 1/2 and a / b from 0.1 to 10 (a along rolling). 1 / C is
interpolated quadratically in Poisson's ratio and by a cubic spline in ln(a / b), so that the
flexibilities have continuous slopes; at the nodes it is the table. Outside 0.1 .. 10 the
asymptotes of Kalker continue the table, scaled to meet it at its ends.
"""

import functools

import numpy as np
from numba import njit

from tramdva.contact.interpolation import hermite, locate, sample_spline

RATIOS = np.arange(1, 11) / 10.0
POISSON = np.array([0.0, 0.25, 0.5])

# Rows a/b = 0.1 .. 1.0; per row (C11, C22, C23), each for nu = 0, 1/4, 1/2.
SHORT = np.array(
    [
        [[2.51, 3.31, 4.85], [2.51, 2.52, 2.53], [0.334, 0.473, 0.731]],
        [[2.59, 3.37, 4.81], [2.59, 2.63, 2.66], [0.483, 0.603, 0.809]],
        [[2.68, 3.44, 4.80], [2.68, 2.75, 2.81], [0.607, 0.715, 0.889]],
        [[2.78, 3.53, 4.82], [2.78, 2.88, 2.98], [0.720, 0.823, 0.977]],
        [[2.88, 3.62, 4.83], [2.88, 3.01, 3.14], [0.827, 0.929, 1.07]],
        [[2.98, 3.72, 4.91], [2.98, 3.14, 3.31], [0.930, 1.03, 1.18]],
        [[3.09, 3.81, 4.97], [3.09, 3.28, 3.48], [1.03, 1.14, 1.29]],
        [[3.19, 3.91, 5.05], [3.19, 3.41, 3.65], [1.13, 1.25, 1.40]],
        [[3.29, 4.01, 5.12], [3.29, 3.54, 3.82], [1.23, 1.36, 1.51]],
        [[3.40, 4.12, 5.20], [3.40, 3.67, 3.98], [1.33, 1.47, 1.63]],
    ]
)
# Rows b/a = 0.1 .. 1.0.
LONG = np.array(
    [
        [[10.7, 11.7, 12.9], [10.7, 12.8, 16.0], [12.2, 14.6, 18.0]],
        [[6.96, 7.78, 8.82], [6.96, 8.14, 9.79], [5.72, 6.63, 7.89]],
        [[5.57, 6.34, 7.34], [5.57, 6.40, 7.51], [3.79, 4.32, 5.01]],
        [[4.84, 5.57, 6.57], [4.84, 5.48, 6.31], [2.88, 3.24, 3.70]],
        [[4.37, 5.10, 6.11], [4.37, 4.90, 5.56], [2.35, 2.62, 2.96]],
        [[4.06, 4.78, 5.80], [4.06, 4.50, 5.04], [2.01, 2.23, 2.50]],
        [[3.82, 4.54, 5.58], [3.82, 4.21, 4.67], [1.76, 1.95, 2.18]],
        [[3.65, 4.36, 5.42], [3.65, 3.99, 4.39], [1.58, 1.75, 1.94]],
        [[3.51, 4.22, 5.30], [3.51, 3.81, 4.16], [1.44, 1.59, 1.77]],
        [[3.40, 4.12, 5.20], [3.40, 3.67, 3.98], [1.33, 1.47, 1.63]],
    ]
)

LOG_RATIO_LIMIT = float(np.log(100.0))
LOG_RATIO_COUNT = 401
LOG_RATIO_STEP = 2.0 * LOG_RATIO_LIMIT / (LOG_RATIO_COUNT - 1)


def _asymptote(ratio: float, poisson_ratio: float) -> np.ndarray:
    """Kalker's asymptotic (C11, C22, C23) for a/b -> 0 or b/a -> 0."""
    g, nu = min(ratio, 1.0 / ratio), poisson_ratio
    log_term = np.log(16.0 / g**2)
    if ratio < 1.0:
        c23 = np.pi * np.sqrt(g) / (3.0 * (1.0 - nu))
        c23 *= 1.0 + nu * (0.5 * log_term + np.log(4.0) - 5.0)
        return np.array([np.pi**2 / (4.0 * (1.0 - nu)), np.pi**2 / 4.0, c23])
    offset = 3.0 - np.log(4.0)
    first, second = log_term - 2.0 * nu, (1.0 - nu) * log_term + 2.0 * nu
    c11 = 2.0 * np.pi / (first * g) * (1.0 + offset / first)
    c22 = 2.0 * np.pi / (second * g) * (1.0 + (1.0 - nu) * offset / second)
    c23 = 2.0 * np.pi / (3.0 * g**1.5) / ((1.0 - nu) * log_term - 2.0 + 4.0 * nu)
    return np.array([c11, c22, c23])


def _at_poisson(rows: np.ndarray, poisson_ratio: float) -> np.ndarray:
    """Interpolate 1 / C quadratically in Poisson's ratio: (n, 3, 3) -> (n, 3)."""
    nu, (n0, n1, n2) = poisson_ratio, POISSON
    weights = np.array(
        [
            (nu - n1) * (nu - n2) / ((n0 - n1) * (n0 - n2)),
            (nu - n0) * (nu - n2) / ((n1 - n0) * (n1 - n2)),
            (nu - n0) * (nu - n1) / ((n2 - n0) * (n2 - n1)),
        ]
    )
    return 1.0 / ((1.0 / rows) @ weights)


def _nodes(poisson_ratio: float) -> tuple[np.ndarray, np.ndarray]:
    """ln(a / b) and coefficients of the table, continued by the asymptotes."""
    middle_ratio = np.concatenate([RATIOS, 1.0 / RATIOS[-2::-1]])
    middle = np.vstack(
        [_at_poisson(SHORT, poisson_ratio), _at_poisson(LONG, poisson_ratio)[-2::-1]]
    )
    low_ratio = np.array([0.01, 0.02, 0.03, 0.05, 0.07])
    low = np.array([_asymptote(r, poisson_ratio) for r in low_ratio])
    high = np.array([_asymptote(r, poisson_ratio) for r in 1.0 / low_ratio[::-1]])
    low *= middle[0] / _asymptote(0.1, poisson_ratio)
    high *= middle[-1] / _asymptote(10.0, poisson_ratio)
    ratio = np.concatenate([low_ratio, middle_ratio, 1.0 / low_ratio[::-1]])
    return np.log(ratio), np.vstack([low, middle, high])


@functools.cache
def kalker_table(poisson_ratio: float) -> np.ndarray:
    """Table of 1 / C11, 1 / C22, 1 / C23 over ln(a / b) for `creep_coefficients`.

    Made once per process; nobody may write to it.
    """
    log_ratio, coefficients = _nodes(poisson_ratio)
    return sample_spline(
        log_ratio, 1.0 / coefficients, -LOG_RATIO_LIMIT, LOG_RATIO_STEP, LOG_RATIO_COUNT
    )


@njit(cache=True, nogil=True, error_model="numpy")
def creep_coefficients(table, semi_axis_ratio):
    """C11, C22, C23 (dimensionless) for the ratio of semi-axes, longitudinal over lateral."""
    index, fraction = locate(table, -LOG_RATIO_LIMIT, LOG_RATIO_STEP, np.log(semi_axis_ratio))
    return (
        1.0 / hermite(table, index, fraction, 0),
        1.0 / hermite(table, index, fraction, 1),
        1.0 / hermite(table, index, fraction, 2),
    )


@njit(cache=True, nogil=True, error_model="numpy")
def flexibilities(table, semi_axis_longitudinal, semi_axis_lateral, shear_modulus):
    """L1, L2, L3 in m/Pa of the simplified theory (Kalker 1982).

    Notes
    -----
    L1 = 8 a / (3 C11 G), L2 = 8 a / (3 C22 G), L3 = pi a^2 / (4 G sqrt(a b) C23): with them
    FASTSIM without sliding gives Kalker's linear forces.
    """
    a, b = semi_axis_longitudinal, semi_axis_lateral
    index, fraction = locate(table, -LOG_RATIO_LIMIT, LOG_RATIO_STEP, np.log(a / b))
    return _flexibilities_at(table, index, fraction, a, b, shear_modulus)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _flexibilities_at(table, index, fraction, a, b, shear_modulus):
    over_modulus = a / shear_modulus
    return (
        8.0 / 3.0 * over_modulus * hermite(table, index, fraction, 0),
        8.0 / 3.0 * over_modulus * hermite(table, index, fraction, 1),
        0.25 * np.pi * over_modulus * np.sqrt(a / b) * hermite(table, index, fraction, 2),
    )


@njit(cache=True, nogil=True, error_model="numpy")
def complex_flexibilities(table, semi_axis_longitudinal, semi_axis_lateral, shear_modulus):
    """Flexibilities of semi-axes that carry a derivative (`complex_step`), with its derivative."""
    a, b = semi_axis_longitudinal, semi_axis_lateral
    ratio = a / b
    log_ratio = np.log(ratio.real)
    index, fraction = locate(table, -LOG_RATIO_LIMIT, LOG_RATIO_STEP, log_ratio)
    held = abs(log_ratio) >= LOG_RATIO_LIMIT
    change = 0.0 if held else ratio.imag / ratio.real / LOG_RATIO_STEP
    return _flexibilities_at(table, index, complex(fraction, change), a, b, shear_modulus)


@njit(cache=True, nogil=True, error_model="numpy")
def saturated_forces(
    semi_axis_longitudinal,
    semi_axis_lateral,
    normal_force,
    friction,
    longitudinal_creepage,
    lateral_creepage,
    spin_creepage,
    coefficients,
    shear_modulus,
):
    """Creep forces of Shen, Hedrick and Elkins: the linear theory, saturated by a cubic.

    Proc. 8th IAVSD Symposium (1983) 591, with the curve of Vermeulen and Johnson (1964); made for
    contacts of little spin. Interface as `polach.polach_forces`.

    Parameters
    ----------
    semi_axis_longitudinal, semi_axis_lateral : m
    normal_force : N; friction : coefficient of the contact
    longitudinal_creepage, lateral_creepage : dimensionless; spin_creepage : 1/m
    coefficients : (C11, C22, C23) of Kalker
    shear_modulus : Pa

    Returns
    -------
    longitudinal_force in N, lateral_force in N, spin_moment in N m.

    Notes
    -----
    With ``c = sqrt(a b)`` and ``e = |(F_x', F_y')| / (mu N)``::

        F_x' = -G c^2 C11 nu_x,   F_y' = -G c^2 (C22 nu_y + c C23 phi),   M' = G c^3 C23 nu_y
        (F_x, F_y, M) = (F_x', F_y', M') (1 - e/3 + e^2/27)  for e < 3, else (...) / e

    The moment by the spin itself (C33) is left out: it hardly moves a vehicle.

    Examples
    --------
    A round patch under 35 kN: Kalker's linear force at first, Coulomb's of 12250 N in the end.

    >>> from tramdva.contact.kalker import saturated_forces
    >>> for nu_y in (1e-6, 1e-3, 0.5):
    ...     _, F_y, _ = saturated_forces(
    ...         4.2e-3, 4.2e-3, 35e3, 0.35, 0.0, nu_y, 0.0, (4.2, 3.7, 1.5), 8.2e10
    ...     )
    ...     print(f"{F_y:.1f} N, linear {-3.7 * 8.2e10 * 4.2e-3**2 * nu_y:.1f} N")
    -5.4 N, linear -5.4 N
    -4610.4 N, linear -5352.0 N
    -12250.0 N, linear -2675988.0 N
    """
    limit = friction * normal_force
    if limit <= 0.0:
        return 0.0, 0.0, 0.0
    mean = np.sqrt(semi_axis_longitudinal * semi_axis_lateral)
    stiffness = shear_modulus * mean * mean
    along = -stiffness * coefficients[0] * longitudinal_creepage
    across = -stiffness * (
        coefficients[1] * lateral_creepage + mean * coefficients[2] * spin_creepage
    )
    moment = stiffness * mean * coefficients[2] * lateral_creepage
    e = np.sqrt(along * along + across * across) / limit
    share = 1.0 - e / 3.0 + e * e / 27.0 if e < 3.0 else 1.0 / e
    return share * along, share * across, share * moment
