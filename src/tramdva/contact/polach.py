"""Polach's creep force of one contact with longitudinal, lateral and spin creepage, compiled.

Polach, Proc. Instn Mech. Engrs 213 F (1999): force from the gradient of the tangential stress.
`tramdva.contact.creep_force` has the lateral force alone with its derivatives, and the friction
law.
"""

import numpy as np
from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
def polach_forces(
    semi_axis_longitudinal,
    semi_axis_lateral,
    normal_force,
    friction,
    longitudinal_creepage,
    lateral_creepage,
    spin_creepage,
    coefficients,
    shear_modulus,
    k_A,
    k_S,
):
    """Creep forces on the wheel by Polach's formula; interface as `fastsim.fastsim_forces`.

    Parameters
    ----------
    semi_axis_longitudinal, semi_axis_lateral : m
    normal_force : N; friction : coefficient of the contact
    longitudinal_creepage, lateral_creepage : dimensionless; spin_creepage : 1/m
    coefficients : (C11, C22, C23) of Kalker
    shear_modulus : Pa
    k_A, k_S : reduction factors in the areas of adhesion and slip

    Returns
    -------
    longitudinal_force in N, lateral_force in N, spin_moment in N m.

    Notes
    -----
    With ``nu_yc = nu_y + phi a`` where ``|nu_y + phi a| > |nu_y|``, else ``nu_y``, and
    ``nu_c = |(nu_x, nu_yc)|``::

        F   = (2 mu N / pi) (k_A e / (1 + (k_A e)^2) + atan(k_S e))
        e   = G pi a b c_jj nu_c / (4 mu N)
        F_x = -F nu_x / nu_c,   F_y = -F nu_y / nu_c + F_spin
        c_jj = sqrt((C11 nu_x / nu)^2 + (C22 nu_y / nu)^2)
        F_spin = (9/16) a mu N K_M (1 + 6.3 (1 - exp(-a/b))) phi / nu_c,
        K_M = |e_s| (d^3/3 - d^2/2 + 1/6) - (1/3) sqrt((1 - d^2)^3),  d = (e_s^2 - 1)/(e_s^2 + 1),
        e_s = (8/3) (b sqrt(a b) / (mu N)) G C23 nu_yc / (1 + 6.3 (1 - exp(-a/b)))

    The formula gives no spin moment.

    Examples
    --------
    A round patch under 35 kN. Where the wheel hardly creeps, the force is Kalker's linear one,
    ``C22 G a b nu_y``; where it slides, it is that of Coulomb, ``mu N`` = 12250 N.

    >>> from tramdva.contact.polach import polach_forces
    >>> patch = {"semi_axis_longitudinal": 4.2e-3, "semi_axis_lateral": 4.2e-3,
    ...          "normal_force": 35e3, "friction": 0.35, "longitudinal_creepage": 0.0,
    ...          "spin_creepage": 0.0, "coefficients": (4.2, 3.7, 1.5), "shear_modulus": 8.2e10,
    ...          "k_A": 1.0, "k_S": 1.0}
    >>> for nu_y in (1e-6, 1e-3, 0.5):
    ...     _, F_y, _ = polach_forces(lateral_creepage=nu_y, **patch)
    ...     print(f"{F_y:.1f} N, linear {-3.7 * 8.2e10 * 4.2e-3**2 * nu_y:.1f} N")
    -5.4 N, linear -5.4 N
    -4971.9 N, linear -5352.0 N
    -12250.0 N, linear -2675988.0 N
    """
    a, b = semi_axis_longitudinal, semi_axis_lateral
    nu_x, nu_y, phi = longitudinal_creepage, lateral_creepage, spin_creepage
    limit = friction * normal_force
    if limit <= 0.0:
        return 0.0, 0.0, 0.0
    nu_yc = nu_y + phi * a
    if abs(nu_yc) <= abs(nu_y):
        nu_yc = nu_y
    nu_c = np.sqrt(nu_x * nu_x + nu_yc * nu_yc)
    if nu_c == 0.0:
        return 0.0, 0.0, 0.0
    nu = np.sqrt(nu_x * nu_x + nu_y * nu_y)
    c_jj = coefficients[1]
    if nu > 0.0:
        c_jj = np.hypot(coefficients[0] * nu_x / nu, coefficients[1] * nu_y / nu)
    e = 0.25 * np.pi * shear_modulus * a * b * c_jj * nu_c / limit
    force = 2.0 * limit / np.pi * (k_A * e / (1.0 + (k_A * e) ** 2) + np.arctan(k_S * e))
    shape = 1.0 + 6.3 * (1.0 - np.exp(-a / b))
    e_s = 8.0 / 3.0 * b * np.sqrt(a * b) / limit * shear_modulus * coefficients[2] * nu_yc / shape
    d = (e_s * e_s - 1.0) / (e_s * e_s + 1.0)
    k_m = abs(e_s) * (d * d * d / 3.0 - 0.5 * d * d + 1.0 / 6.0)
    k_m -= (1.0 - d * d) ** 1.5 / 3.0
    spin = 9.0 / 16.0 * a * limit * k_m * shape * phi / nu_c
    return -force * nu_x / nu_c, -force * nu_y / nu_c + spin, 0.0
