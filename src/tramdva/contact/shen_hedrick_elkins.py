"""Creep forces of Shen, Hedrick and Elkins: the linear theory, saturated by a cubic.

Shen, Hedrick and Elkins, Proc. 8th IAVSD Symposium (1983) 591, with the curve of Vermeulen and
Johnson (1964). Made for contacts of little spin.
"""

import numpy as np
from numba import njit


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
    """Creep forces and spin moment on the wheel; interface as `polach.polach_forces`.

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

    >>> from tramdva.contact.shen_hedrick_elkins import saturated_forces
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
