"""A yawed and rolled wheel on a rail: its axis, and where ahead of its centre it touches.

Vehicle axes x along the rail, y left, z up. The wheel is a surface of revolution: every normal of
it meets its axis. With the axis e, the normal n and the arm c from the wheel's centre to the
contact the three therefore lie in one plane,

    n . (e x c) = 0,

and because n has no part along the rail this gives the forward part of c from the two others.
The same triple product is the velocity along n, per unit of spin, of the material at the contact:
a wheel that only rolls neither approaches the rail nor leaves it (docs/contact_kinematics.md).
"""

import numpy as np
from numba import njit


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def wheel_axis(roll, yaw):
    """Unit vector (x, y, z) of the axis, to the left; yaw about z, then roll about x, rad."""
    along = np.cos(yaw)
    return -np.sin(yaw), along * np.cos(roll), along * np.sin(roll)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def forward_shift(axis, normal, arm_y, arm_z):
    """Distance in m by which a contact lies ahead of the wheel's centre, along the rail.

    Parameters
    ----------
    axis : (x, y, z) of `wheel_axis`
    normal : (y, z) of the contact's normal
    arm_y, arm_z : m, from the wheel's centre to the contact

    Notes
    -----
    Without roll and with the contact at the radius r and outward position s on the axis, this is
    r tan(delta) sin(gamma) - s sin(gamma) to first order in the yaw angle gamma: the lead on the
    circle through the contact, and that of this circle's centre, which lies on the yawed axis.
    """
    n_y, n_z = normal
    return axis[0] * (n_y * arm_z - n_z * arm_y) / (n_y * axis[2] - n_z * axis[1])


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def approximate_shift(radius, slope, on_wheel, roll, yaw):
    """Forward shift in m by first order in the yaw angle, in the axes of the profile.

    slope : tan(delta); on_wheel : m; roll, yaw : rad, outer side down, heading outwards
    """
    tilt = np.tan(roll)
    return ((radius * (slope + tilt)) / (1.0 - slope * tilt) - on_wheel) * np.sin(yaw)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def turned(angle, x, y):
    """Components (x, y) of a vector in axes turned to the left by a small angle in rad.

    Relative error angle^4 / 24, 1e-7 at 0.04 rad.
    """
    cosine, sine = 1.0 - 0.5 * angle * angle, angle * (1.0 - angle * angle / 6.0)
    return cosine * x + sine * y, cosine * y - sine * x


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def lead_on_wheel(roll, yaw, arm_x, arm_y, arm_z):
    """Distance in m from the lowest point of the circle through the contact, along the wheel.

    It tells which material is in contact; the shift of the circle's centre has no part in it.
    """
    sine = np.sin(yaw)
    return np.cos(yaw) * arm_x + sine * (np.cos(roll) * arm_y + np.sin(roll) * arm_z)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def relative_curvatures(axis, normal, radius, meridian, silhouette, rail_curvature):
    """Relative curvature of wheel and rail in the contact plane, in 1/m: parts xx, xt and tt.

    Parameters
    ----------
    axis : (x, y, z) of `wheel_axis`; normal : (y, z) of the contact's normal
    radius : m, of the circle through the contact
    meridian : 1/m, curvature of the wheel's profile, positive where it is convex
    silhouette : 1/m, curvature of silhouette and rail seen along the rail
    rail_curvature : 1/m, of the rail in plan, to the left positive

    Notes
    -----
    The wheel's principal directions are the meridian, along the axis' part in the contact plane,
    and the circle. Seen along the rail the tensor K shows K_tt - K_xt^2 / K_xx, its curvature in
    the direction in which the wheel's surface turns away least.
    """
    n_y, n_z = normal
    e_x, e_t = axis[0], n_z * axis[1] - n_y * axis[2]
    size = np.sqrt(e_x * e_x + e_t * e_t)
    sine, cosine = e_x / size, e_t / size
    circle = size / radius
    along = circle * cosine * cosine + meridian * sine * sine
    mixed = (meridian - circle) * sine * cosine
    across = silhouette + mixed * mixed / along
    return along - n_y * rail_curvature, mixed, across
