"""Polach's lateral creep force with a friction coefficient that falls with the slip velocity.

The functions are compiled scalar kernels that accept real and complex arguments (they are analytic
in every argument, so that a complex step differentiates them exactly).

Notes
-----
With the slip velocity ``w``, the rolling speed ``V_0`` and ``|w| = sign(w) w``::

    mu(w) = mu_0 ((1 - A) exp(-B |w|) + A)                                   eq. (5)
    F(w)  = sign(w) (2 mu F_N / pi) (k_A eps / (1 + (k_A eps)^2) + atan(k_S eps))
    eps   = (pi / 4) C_22 |w| / (V_0 mu F_N)

after Polach, Wear 258 (2005) 992-1000, for pure lateral creepage; ``C_22 = G a b c_22`` is Kalker's
linear creep stiffness in N. The force on the wheel is ``-F``: it opposes the slip. Equation (5) is
read with the slip velocity, since its ``B`` has the unit s/m.
"""

import math

import numba
import numpy as np

jit = numba.njit(cache=True, nogil=True, error_model="numpy")


@jit
def friction_coefficient(slip_velocity, mu_0, A, B):
    """Friction coefficient at a slip velocity, eq. (5).

    Parameters
    ----------
    slip_velocity : float or complex
        Slip velocity w in m/s; only its magnitude counts.
    mu_0, A, B : float
        Maximum friction coefficient, ratio mu_inf/mu_0, exponential decrease in s/m.

    Returns
    -------
    float or complex
        Friction coefficient.
    """
    sign = 1.0 if slip_velocity.real >= 0.0 else -1.0
    return mu_0 * ((1.0 - A) * np.exp(-B * sign * slip_velocity) + A)


@jit
def creep_force_derivatives(slip_velocity, V_0, F_N, mu_0, A, B, C_22, k_A, k_S):
    """Creep force and its first three derivatives in the slip velocity.

    Parameters
    ----------
    slip_velocity : float or complex
        Slip velocity w in m/s.
    V_0 : float or complex
        Rolling speed in m/s.
    F_N : float
        Normal force in N.
    mu_0, A, B : float
        Friction law, eq. (5); B in s/m.
    C_22 : float
        Kalker's linear creep stiffness G a b c_22 in N.
    k_A, k_S : float
        Polach's reduction factors in the areas of adhesion and slip.

    Returns
    -------
    tuple
        F in N, dF/dw in N s/m, d2F/dw2 in N s^2/m^2, d3F/dw3 in N s^3/m^3.
    """
    sign = 1.0 if slip_velocity.real >= 0.0 else -1.0
    w = sign * slip_velocity
    decay = mu_0 * (1.0 - A) * np.exp(-B * w)
    mu = decay + mu_0 * A
    mu1, mu2, mu3 = -B * decay, B * B * decay, -B * B * B * decay

    # eps = slope * r with r = w/mu; derivatives of r from r mu = w.
    slope = 0.25 * math.pi * C_22 / (V_0 * F_N)
    r = w / mu
    r1 = (1.0 - r * mu1) / mu
    r2 = -(2.0 * r1 * mu1 + r * mu2) / mu
    r3 = -(3.0 * r2 * mu1 + 3.0 * r1 * mu2 + r * mu3) / mu
    e, e1, e2, e3 = slope * r, slope * r1, slope * r2, slope * r3

    h, h1, h2, h3 = saturation_derivatives(e, k_A, k_S)
    g1 = h1 * e1
    g2 = h2 * e1 * e1 + h1 * e2
    g3 = h3 * e1 * e1 * e1 + 3.0 * h2 * e1 * e2 + h1 * e3

    scale = 2.0 * F_N / math.pi
    return (
        sign * scale * mu * h,
        scale * (mu1 * h + mu * g1),
        sign * scale * (mu2 * h + 2.0 * mu1 * g1 + mu * g2),
        scale * (mu3 * h + 3.0 * mu2 * g1 + 3.0 * mu1 * g2 + mu * g3),
    )


@jit
def saturation_derivatives(e, k_A, k_S):
    """Polach's k_A e/(1+(k_A e)^2) + atan(k_S e) and its three derivatives in e."""
    # products instead of powers: complex powers are slow to compile and to run
    x = k_A * e
    q = 1.0 / (1.0 + x * x)
    z = k_S * e
    s = 1.0 / (1.0 + z * z)
    xx, qq = x * x, q * q
    value = x * q + np.arctan(z)
    first = k_A * (1.0 - xx) * qq + k_S * s
    second = k_A * k_A * 2.0 * x * (xx - 3.0) * qq * q - k_S * k_S * 2.0 * z * s * s
    third = -6.0 * k_A * k_A * k_A * (xx * xx - 6.0 * xx + 1.0) * qq * qq
    third += k_S * k_S * k_S * (6.0 * z * z - 2.0) * s * s * s
    return value, first, second, third


@jit
def creep_force(slip_velocity, V_0, F_N, mu_0, A, B, C_22, k_A, k_S):
    """Creep force and its slope; arguments as in `creep_force_derivatives`.

    Returns
    -------
    tuple
        F in N and dF/dw in N s/m.
    """
    sign = 1.0 if slip_velocity.real >= 0.0 else -1.0
    w = sign * slip_velocity
    decay = mu_0 * (1.0 - A) * np.exp(-B * w)
    mu = decay + mu_0 * A
    e = 0.25 * math.pi * C_22 * w / (V_0 * F_N * mu)
    # d(eps)/dw of eps proportional to w/mu(w)
    e1 = 0.25 * math.pi * C_22 / (V_0 * F_N * mu) * (1.0 + B * w * decay / mu)
    x = k_A * e
    q = 1.0 / (1.0 + x * x)
    z = k_S * e
    h = x * q + np.arctan(z)
    h1 = k_A * (1.0 - x * x) * q * q + k_S / (1.0 + z * z)
    scale = 2.0 * F_N / math.pi
    return sign * scale * mu * h, scale * (mu * h1 * e1 - B * decay * h)
