"""Hertz contact of two bodies, also where its principal directions are turned against rolling.

Near the contact point the gap is A x^2 + B y^2 (x along rolling, y lateral). With penetration
delta, effective modulus E* and the functions of ln(B / A) tabulated here,

    N = c_N E* delta^(3/2) (A + B)^(-1/2)
    a = c_a (delta / (A + B))^(1/2)        along rolling
    b = c_b (delta / (A + B))^(1/2)        lateral

The functions hold complete elliptic integrals (Johnson, Contact Mechanics, 1985, ch. 4),
evaluated by SciPy when the table is built and by cubic Hermite interpolation in the loop.
"""

import functools

import numpy as np
import scipy  # its parts load when they are used: many short jobs need none
from numba import njit

from tramdva.contact.interpolation import hermite, locate, sample_spline

LOG_RATIO_LIMIT = 12.0
LOG_RATIO_STEP = 0.05


def effective_modulus(youngs_modulus: float, poisson_ratio: float) -> float:
    """E* in Pa of two bodies of the same material: E / (2 (1 - nu^2))."""
    return youngs_modulus / (2.0 * (1.0 - poisson_ratio**2))


def _integrals(flatness: float) -> tuple[float, float, float]:
    """Return (ratio of curvatures >= 1, K, E) of an ellipse with minor / major = `flatness`."""
    modulus_squared = 1.0 - flatness**2
    if modulus_squared < 1e-12:
        return 1.0, np.pi / 2.0, np.pi / 2.0
    k, e = scipy.special.ellipk(modulus_squared), scipy.special.ellipe(modulus_squared)
    return (e / flatness**2 - k) / (k - e), k, e


def ellipse_functions(log_curvature_ratio: float) -> np.ndarray:
    """Exact c_N, c_a, c_b for one value of ln(B / A).

    Returns
    -------
    (3,) array, dimensionless.
    """
    target = abs(log_curvature_ratio)
    if target < 1e-7:
        flatness = 1.0
    else:
        flatness = np.exp(
            scipy.optimize.brentq(
                lambda u: np.log(_integrals(np.exp(u))[0]) - target,
                -0.9 * target - 1e-3,
                -1e-9,
                xtol=1e-15,
                rtol=1e-15,
            )
        )
    _, k, e = _integrals(flatness)
    # Major semi-axis c, minor d = flatness c: p0 = 3N / (2 pi c d); sum of curvatures and
    # penetration are (A + B) = p0 d E / (E* c^2 flatness^2) ..., delta = p0 d K / E*.
    sum_over_pressure = e / flatness  # (A + B) c E* / p0
    delta_over_pressure = flatness * k  # delta E* / (p0 c)
    major = np.sqrt(sum_over_pressure / delta_over_pressure)
    minor = flatness * major
    pressure = 1.0 / (delta_over_pressure * major)
    normal = 2.0 * np.pi / 3.0 * major * minor * pressure
    if log_curvature_ratio > 0.0:
        return np.array([normal, major, minor])
    return np.array([normal, minor, major])


@functools.cache
def hertz_table() -> np.ndarray:
    """Table of c_N, c_a, c_b over ln(B / A) for `hertz_ellipse`, relative error below 1e-7.

    Made once per process; nobody may write to it.
    """
    count = round(2.0 * LOG_RATIO_LIMIT / LOG_RATIO_STEP) + 1
    nodes = np.linspace(-LOG_RATIO_LIMIT, LOG_RATIO_LIMIT, count)
    values = np.array([ellipse_functions(node) for node in nodes])
    return sample_spline(nodes, values, -LOG_RATIO_LIMIT, LOG_RATIO_STEP, count)


@njit(cache=True, nogil=True, error_model="numpy")
def hertz_ellipse(table, curvature_longitudinal, curvature_lateral, modulus, penetration):
    """Normal force and semi-axes for a penetration.

    Parameters
    ----------
    table : from `hertz_table`
    curvature_longitudinal, curvature_lateral : sums of both bodies' curvatures in 1/m (2A, 2B)
    modulus : E* in Pa
    penetration : approach of distant points in m; zero or negative means no contact

    Returns
    -------
    normal_force in N, semi_axis_longitudinal in m, semi_axis_lateral in m; zeros out of contact.
    """
    if penetration <= 0.0:
        return 0.0, 0.0, 0.0
    log_ratio = np.log(curvature_lateral / curvature_longitudinal)
    index, fraction = locate(table, -LOG_RATIO_LIMIT, LOG_RATIO_STEP, log_ratio)
    length = np.sqrt(2.0 * penetration / (curvature_longitudinal + curvature_lateral))
    normal = hermite(table, index, fraction, 0) * modulus * penetration * length
    semi_longitudinal = hermite(table, index, fraction, 1) * length
    semi_lateral = hermite(table, index, fraction, 2) * length
    return normal, semi_longitudinal, semi_lateral


@njit(cache=True, nogil=True, error_model="numpy")
def turned_ellipse(table, along, mixed, across, modulus, penetration):
    """Normal force and patch of bodies whose relative curvature is a tensor in the axes of rolling.

    Parameters
    ----------
    table : from `hertz_table`
    along, mixed, across : 1/m, parts xx, xt and tt of the tensor; x along rolling, t lateral
    modulus : E* in Pa
    penetration : m; zero or negative means no contact

    Returns
    -------
    normal_force in N; half length in m of the strip through the centre, along rolling; half width
    in m of the patch, across; shear: the strip at t has its centre at x = shear t. Not a number
    where the tensor is not positive: such bodies do not touch in one point.

    Notes
    -----
    In principal axes, at the angle beta to those of rolling, the patch is an ellipse (a, b). With
    C = rotation diag(a^2, b^2) rotation^T its half width is C_tt^(1/2), the shear C_xt / C_tt, and
    half length times half width is a b. A patch that is not turned has the shear zero.
    """
    if penetration <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    mean, half = 0.5 * (across + along), 0.5 * (across - along)
    radius = np.sqrt(half * half + mixed * mixed)
    if not mean > radius:
        return np.nan, np.nan, np.nan, np.nan
    normal, a, b = hertz_ellipse(table, mean - radius, mean + radius, modulus, penetration)
    scale = 0.5 * (a * a - b * b) / max(radius, 1e-12 * mean)
    width = np.sqrt(0.5 * (a * a + b * b) - scale * half)
    return normal, a * b / width, width, -scale * mixed / (width * width)


@njit(cache=True, nogil=True, error_model="numpy")
def damped_normal_force(elastic_force, penetration_rate, damping_time):
    """Normal force with damping, N.

    Notes
    -----
    N = max(0, N_el (1 + tau d(delta)/dt / delta_ref)) in the form of Hunt and Crossley (1975):
    the damping is proportional to the elastic force, so that it vanishes with it; no jump at
    touch-down or lift-off, no tension. `damping_time` is 3/2 of the restitution coefficient's
    slope, s/m; zero switches it off.
    """
    return max(0.0, elastic_force * (1.0 + damping_time * penetration_rate))


@njit(cache=True, nogil=True, error_model="numpy")
def penetration_of_force(table, curvature_longitudinal, curvature_lateral, modulus, normal_force):
    """Penetration in m that carries `normal_force` in N (the inverse of `hertz_ellipse`)."""
    if normal_force <= 0.0:
        return 0.0
    at_unit, _, _ = hertz_ellipse(table, curvature_longitudinal, curvature_lateral, modulus, 1.0)
    return (normal_force / at_unit) ** (2.0 / 3.0)


@njit(cache=True, nogil=True, error_model="numpy")
def maximum_pressure(normal_force, semi_axis_longitudinal, semi_axis_lateral):
    """Hertzian pressure in the centre, Pa."""
    return 1.5 * normal_force / (np.pi * semi_axis_longitudinal * semi_axis_lateral)
