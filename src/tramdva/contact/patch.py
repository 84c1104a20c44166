"""One wheel-rail contact from position and velocity to force, as one compiled call.

Vehicle axes: x along the rail, y left, z up, right-handed; `side` is +1 for a left wheel, -1 for
a right wheel. Profiles and tables use outward and downward axes (CONTACT's, for the right wheel):
outwards = side y, downwards = -z, roll (outer side down) = -side roll about x, yaw (heading
outwards) = side yaw about z. The contact frame is (x, t, n): n the normal on the wheel, t = n x x
to the left along the rail's surface.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.contact import (
    creep_table,
    fastsim,
    geometry,
    hertz,
    kalker,
    locus,
    polach,
    yawed_wheel,
)
from tramdva.contact.creep_force import friction_coefficient

NO_CONTACT, CONTACT, INVALID = 0, 1, 2
FASTSIM, POLACH, HALF_SPACE, SATURATED = 0, 1, 2, 3
METHODS = {
    "fastsim": FASTSIM,
    "polach": POLACH,
    "half_space": HALF_SPACE,
    "shen_hedrick_elkins": SATURATED,
}

(
    STATUS, NORMAL_FORCE, LONGITUDINAL_FORCE, LATERAL_FORCE, SPIN_MOMENT, PENETRATION,
    CONTACT_ANGLE, LONGITUDINAL_CREEPAGE, LATERAL_CREEPAGE, SPIN_CREEPAGE,
    SEMI_AXIS_LONGITUDINAL, SEMI_AXIS_LATERAL, FRICTION, SLIP_VELOCITY, ROLLING_RADIUS,
    WHEEL_POSITION, RAIL_POSITION, FORWARD_SHIFT, CURVATURE_LATERAL, LATERAL_VELOCITY,
    WHEEL_LEAD, SHEAR,
) = range(22)  # fmt: skip
RESULTS = 22


class ContactLaw(NamedTuple):
    """Material, friction and numerics of the contacts of a vehicle; built by `contact_law`.

    hertz_table, kalker_table : tables of `hertz` and `kalker`
    modulus : E* in Pa; shear_modulus : Pa
    friction : (mu_0, A, B in s/m); polach : (k_A, k_S)
    damping_time : s/m of `hertz.damped_normal_force`
    method : FASTSIM, POLACH, HALF_SPACE or SATURATED
    grid : PatchGrid of FASTSIM
    creep_table : CreepTable of HALF_SPACE
    """

    hertz_table: np.ndarray
    kalker_table: np.ndarray
    modulus: float
    shear_modulus: float
    friction: tuple[float, float, float]
    polach: tuple[float, float]
    damping_time: float
    method: int
    grid: fastsim.PatchGrid
    creep_table: creep_table.CreepTable


def contact_law(
    friction_maximum: float,
    friction_ratio: float,
    friction_decrease: float,
    youngs_modulus: float = 2.06e11,
    poisson_ratio: float = 0.27,
    cells_along: int = 12,
    strips: int = 12,
    bound: str = "balanced",
    method: str = "fastsim",
    reduction_adhesion: float = 1.0,
    reduction_slip: float = 1.0,
    damping_time: float = 0.0,
) -> ContactLaw:
    """Collect the constants of the contacts.

    Parameters
    ----------
    friction_maximum, friction_ratio : mu_0 and A, dimensionless; friction_decrease : B in s/m
    youngs_modulus : Pa; poisson_ratio : both bodies
    cells_along, strips, bound : see `fastsim.patch_grid`
    method : 'fastsim', 'polach', 'half_space' or 'shen_hedrick_elkins'
    reduction_adhesion, reduction_slip : Polach's k_A and k_S
    damping_time : s/m, see `hertz.damped_normal_force`
    """
    if method not in METHODS:
        raise ValueError(f"creep force method '{method}' is unknown; allowed: {list(METHODS)}")
    return law_of_tables(
        hertz.hertz_table(),
        kalker.kalker_table(poisson_ratio),
        hertz.effective_modulus(youngs_modulus, poisson_ratio),
        0.5 * youngs_modulus / (1.0 + poisson_ratio),
        (float(friction_maximum), float(friction_ratio), float(friction_decrease)),
        fastsim.patch_grid(cells_along, strips, bound),
        creep_table.creep_table(poisson_ratio),
        (float(reduction_adhesion), float(reduction_slip)),
        float(damping_time),
        METHODS[method],
    )


def law_of_tables(
    hertz_table: np.ndarray,
    kalker_table: np.ndarray,
    modulus: float,
    shear_modulus: float,
    friction: tuple[float, float, float],
    grid: fastsim.PatchGrid,
    creep: creep_table.CreepTable,
    polach: tuple[float, float] = (1.0, 1.0),
    damping_time: float = 0.0,
    method: int = FASTSIM,
) -> ContactLaw:
    """Constants of the contacts from tables that are there already; fields as in `ContactLaw`."""
    return ContactLaw(
        hertz_table, kalker_table, modulus, shear_modulus, friction, polach, damping_time, method,
        grid, creep,
    )  # fmt: skip


def contact_workspace(law: ContactLaw) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Scratch arrays for `wheel_contact`, one set per thread."""
    return np.zeros((geometry.WINDOW, locus.STRIDE)), fastsim.workspace(law.grid), np.zeros(RESULTS)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def tangential_forces(
    law,
    semi_axis_longitudinal,
    semi_axis_lateral,
    normal_force,
    friction,
    longitudinal_creepage,
    lateral_creepage,
    spin_creepage,
    work,
    shear,
):
    """Longitudinal force, lateral force (N) and spin moment (N m) by the chosen method.

    FASTSIM alone knows a patch that is turned; the others leave the shear out. A patch that is
    longer or wider than the table knows has no forces: NaN.
    """
    a, b = semi_axis_longitudinal, semi_axis_lateral
    if law.method == HALF_SPACE:
        if not creep_table.holds_for(a, b):
            return np.nan, np.nan, np.nan
        return creep_table.half_space_forces(
            a, b, normal_force, friction, longitudinal_creepage, lateral_creepage, spin_creepage,
            law.shear_modulus, law.creep_table,
        )  # fmt: skip
    if law.method == SATURATED:
        coefficients = kalker.creep_coefficients(law.kalker_table, a / b)
        return kalker.saturated_forces(
            a, b, normal_force, friction, longitudinal_creepage, lateral_creepage, spin_creepage,
            coefficients, law.shear_modulus,
        )  # fmt: skip
    if law.method == POLACH:
        coefficients = kalker.creep_coefficients(law.kalker_table, a / b)
        return polach.polach_forces(
            a, b, normal_force, friction, longitudinal_creepage, lateral_creepage, spin_creepage,
            coefficients, law.shear_modulus, law.polach[0], law.polach[1],
        )  # fmt: skip
    flexibility = kalker.flexibilities(law.kalker_table, a, b, law.shear_modulus)
    return fastsim.fastsim_forces(
        a, b, normal_force, friction, longitudinal_creepage, lateral_creepage, spin_creepage,
        flexibility, law.grid, work, shear,
    )  # fmt: skip


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def contact_point(table, side, position, angles, radius_deviation, rail_curvature, rows):
    """Contact in vehicle axes, before any force.

    The rail is a circle in plan; x runs along it abreast of the wheel's centre. Where the contact
    leads by c the rail has turned by c times its curvature: the results are in axes turned so.

    Parameters
    ----------
    table : geometry.ContactTable of one zone
    side : +1 left wheel, -1 right wheel
    position : (lateral, vertical) in m, wheel centre relative to its place with the wheel's
        tape circle on the rail's top
    angles : (roll, yaw) in rad, about x and z
    radius_deviation : m, out-of-roundness at the contact, crest positive
    rail_curvature : 1/m in plan, to the left positive
    rows : scratch of `geometry.locate_contact`

    Returns
    -------
    As `geometry.locate_contact`, then the arm from the wheel centre to the contact point:
    arm_x, arm_y, arm_z in m, the yaw of the wheel and the turn of the axes in rad.
    """
    roll, yaw, lateral = -side * angles[0], angles[1], position[0]
    radius = table.wheel_radius
    # Out-of-roundness lowers the wheel: it acts like a larger radius along the normal.
    height = -position[1] - radius * (1.0 - np.cos(roll)) + radius_deviation
    sway, turn = radius * np.sin(roll), 0.0
    if rail_curvature != 0.0:
        slope, on_wheel = geometry.approximate_contact(
            table, side * lateral - sway, height, roll, side * yaw
        )
        lead = yawed_wheel.approximate_shift(radius, -slope, on_wheel, roll, side * yaw)
        turn = rail_curvature * lead
        yaw -= turn
        lateral += 0.5 * turn * lead
    found = geometry.locate_contact(table, side * lateral - sway, height, roll, side * yaw, rows)
    arm_y = side * (found[4] - side * lateral)
    arm_z = -(found[5] + position[1] + radius)
    normal = (-side * np.sin(found[1]), np.cos(found[1]))
    axis = yawed_wheel.wheel_axis(angles[0], yaw)
    return found, yawed_wheel.forward_shift(axis, normal, arm_y, arm_z), arm_y, arm_z, yaw, turn


@njit(cache=True, nogil=True, error_model="numpy")
def wheel_contact(
    table,
    law,
    side,
    position,
    angles,
    velocity,
    rotation,
    rolling_speed,
    radius_deviation,
    radius_deviation_rate,
    rail_curvature,
    rows,
    work,
    result,
):
    """Force and moment of one contact zone on the wheel; x is along the rail abreast of its centre.

    Parameters
    ----------
    table : geometry.ContactTable of the zone; law : ContactLaw
    side : +1 left wheel, -1 right wheel
    position : (lateral, vertical) in m, see `contact_point`
    angles : (roll, yaw) in rad
    velocity : (x, y, z) in m/s of the wheel centre relative to the rail
    rotation : (x, y, z) in rad/s of the wheel, its spin included (forward rolling: y > 0)
    rolling_speed : m/s, the reference of the creepages
    radius_deviation, radius_deviation_rate : m and m/s, out-of-roundness at the contact
    rail_curvature : 1/m, of the rail in plan, to the left positive
    rows, work, result : from `contact_workspace`; `result` receives the RESULTS numbers whose
        indices are the names above (STATUS, NORMAL_FORCE, ...)

    Returns
    -------
    force (x, y, z) in N on the wheel, then moment (x, y, z) in N m about the wheel's centre.
    """
    found, arm_x, arm_y, arm_z, yaw, turn = contact_point(
        table, side, position, angles, radius_deviation, rail_curvature, rows
    )
    penetration, angle = found[0], found[1]
    sine, cosine = side * np.sin(angle), np.cos(angle)
    # Wheel's material at the contact; n = (0, -sine, cosine), t = (0, cosine, sine).
    roll_rate, spin_rate = yawed_wheel.turned(turn, rotation[0], rotation[1])
    v_x, v_y = yawed_wheel.turned(turn, velocity[0], velocity[1])
    v_x += spin_rate * arm_z - rotation[2] * arm_y
    v_y += rotation[2] * arm_x - roll_rate * arm_z
    v_z = velocity[2] + roll_rate * arm_y - spin_rate * arm_x
    v_t = cosine * v_y + sine * v_z
    v_n = cosine * v_z - sine * v_y
    axis, radius = yawed_wheel.wheel_axis(angles[0], yaw), table.wheel_radius + found[3]
    along, mixed, across = yawed_wheel.relative_curvatures(
        axis, (-sine, cosine), radius, found[8], found[6], rail_curvature
    )
    elastic, a, b, shear = hertz.turned_ellipse(
        law.hertz_table, along, mixed, across, law.modulus, penetration
    )
    approach = cosine * radius_deviation_rate - v_n
    normal = hertz.damped_normal_force(elastic, approach, law.damping_time)
    slip, spin = np.sqrt(v_x * v_x + v_t * v_t), cosine * rotation[2] - sine * spin_rate
    friction = friction_coefficient(slip, *law.friction)
    nu_x, nu_y, phi = v_x / rolling_speed, v_t / rolling_speed, spin / rolling_speed
    force_x = force_t = moment_n = 0.0
    if normal > 0.0:
        force_x, force_t, moment_n = tangential_forces(
            law, a, b, normal, friction, nu_x, nu_y, phi, work, shear
        )
    status = CONTACT if normal > 0.0 else NO_CONTACT
    if found[7] != 0 or not np.isfinite(normal + force_x + force_t):
        status = INVALID
    result[STATUS] = status
    result[NORMAL_FORCE] = normal
    result[LONGITUDINAL_FORCE] = force_x
    result[LATERAL_FORCE] = force_t
    result[SPIN_MOMENT] = moment_n
    result[PENETRATION] = penetration
    result[CONTACT_ANGLE] = angle
    result[LONGITUDINAL_CREEPAGE] = nu_x
    result[LATERAL_CREEPAGE] = nu_y
    result[SPIN_CREEPAGE] = phi
    result[SEMI_AXIS_LONGITUDINAL] = a
    result[SEMI_AXIS_LATERAL] = b
    result[FRICTION] = friction
    result[SLIP_VELOCITY] = slip
    result[ROLLING_RADIUS] = radius
    result[WHEEL_POSITION] = found[2]
    result[RAIL_POSITION] = found[4]
    result[FORWARD_SHIFT] = arm_x
    result[CURVATURE_LATERAL] = found[6]
    result[LATERAL_VELOCITY] = v_t
    result[SHEAR] = shear
    result[WHEEL_LEAD] = yawed_wheel.lead_on_wheel(angles[0], yaw, arm_x, arm_y, arm_z)
    f_y = cosine * force_t - sine * normal
    f_z = sine * force_t + cosine * normal
    m_x = arm_y * f_z - arm_z * f_y
    m_y = arm_z * force_x - arm_x * f_z - sine * moment_n
    m_z = arm_x * f_y - arm_y * force_x + cosine * moment_n
    force_x, f_y = yawed_wheel.turned(-turn, force_x, f_y)
    m_x, m_y = yawed_wheel.turned(-turn, m_x, m_y)
    return force_x, f_y, f_z, m_x, m_y, m_z
