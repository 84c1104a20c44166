"""Vehicle on the track: the forces of the four wheels in the contact, compiled.

A wheel sees eleven local variables (`vehicle.LOCAL`): position and angles of its rim relative to
the rail (m, rad), the rates of its six motions relative to the frame of its axle (m/s, rad/s), and
how far it is ahead of that frame (m). The
contact answers with six generalised forces (`vehicle.FORCES`, N and N m). Zones of the profile
(tread and flange) act at once.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.bogie.names import AXLE_OF_WHEEL, FORCES, LOCAL, SIDE
from tramdva.contact import patch, yawed_wheel

LOCALS, WHEEL_FORCES, X = len(LOCAL), len(FORCES), LOCAL.index("x")


class WheelPlaces(NamedTuple):
    """Where the wheels are, and how they run; plain arrays and numbers.

    side : (4,); axle : (4,) frame of the wheel's axle in `track.FRAMES`
    lateral_position : (4,) m, wheel centres from the track centre
    tape_circle : m outboard of the wheel centre; rail : m, top of the rail outside the tape circle
    speed : m/s; spin_rate : rad/s of hub and rim at rest in the coordinates
    """

    side: np.ndarray
    axle: np.ndarray
    lateral_position: np.ndarray
    tape_circle: float
    rail: float
    speed: float
    spin_rate: float


class Contacts(NamedTuple):
    """All that the contacts need: tables of the zones, law, places of the wheels."""

    tables: tuple
    law: patch.ContactLaw
    places: WheelPlaces


def wheel_places(
    half_distance: float, tape_circle: float, rail: float, speed: float, wheel_radius: float
) -> WheelPlaces:
    """Places of the wheels of a bogie, lengths in m, speed in m/s; see `WheelPlaces`."""
    side = np.array(SIDE)
    return WheelPlaces(
        side,
        np.array(AXLE_OF_WHEEL) + 1,
        side * half_distance,
        tape_circle,
        rail,
        speed,
        speed / wheel_radius,
    )


# Kernels are compiled for this number of zones: fewer leave tables at the end unused.
MOST_ZONES = 3
# Beyond the results of a contact: where it was evaluated (y, z, roll, yaw, x), radius deviation.
PLACE = patch.RESULTS
COLUMNS = PLACE + 6
# A change of the radius deviation of this size (m) is allowed for in any case.
_DEVIATION = 1e-4


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _still_apart(result, y, z, roll, yaw, x, deviation):
    """Whether a zone that was apart cannot touch yet.

    The gap is a distance: it changes by no more than the wheel moves. Its slope in the yaw angle,
    R tan(delta)^2 tan(yaw), stays below 0.3 m/rad, that in the roll angle below the radius; the
    forward motion counts by the tangent of the yaw angle.
    """
    if result[patch.STATUS] != patch.NO_CONTACT or result[patch.PENETRATION] >= 0.0:
        return False
    moved = abs(y - result[PLACE]) + abs(z - result[PLACE + 1])
    moved += 0.6 * abs(roll - result[PLACE + 2]) + 0.3 * abs(yaw - result[PLACE + 3])
    moved += 0.1 * abs(x - result[PLACE + 4])
    grown = max(abs(deviation - result[PLACE + 5]), _DEVIATION)
    return moved + grown + result[patch.PENETRATION] < 0.0


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _remember(result, y, z, roll, yaw, x, deviation):
    """Note where a zone was evaluated."""
    result[PLACE] = y
    result[PLACE + 1] = z
    result[PLACE + 2] = roll
    result[PLACE + 3] = yaw
    result[PLACE + 4] = x
    result[PLACE + 5] = deviation


@njit(cache=True, nogil=True, error_model="numpy", no_cfunc_wrapper=True, no_cpython_wrapper=True)
def wheel_forces(
    contacts, wheel, curvature, local, deviation, deviation_rate, scratch, results, force
):
    """Generalised forces of the rail on one wheel.

    Parameters
    ----------
    contacts : Contacts, of `compiled_once`
    wheel : index in `vehicle.WHEELS`
    curvature : 1/m at the axle's frame
    local : (11,) local variables of the wheel
    deviation, deviation_rate : (zones,) m and m/s, radius deviation at the contact of each zone,
        crest positive
    scratch : (rows, work) of `patch.contact_workspace`
    results : (zones, COLUMNS), receives the results of each zone
    force : (6,), receives the forces

    Notes
    -----
    The spin turns about the wheel's own axis, which moves with the rim. A yawed axle carries the
    wheel's centre along the track, where the rail, a circle, has another direction. Motions of the
    wheel and forces on it are taken in the axes of the yawed axle, to which its springs belong.
    """
    places = contacts.places
    side = places.side[wheel]
    arm = side * places.tape_circle
    y, z, roll, yaw = local[0], local[1], local[2], local[3]
    speed = places.speed
    turning = speed * curvature
    spin = places.spin_rate + local[8]
    yaw_rate = local[9] + turning
    # A yawed axle carries the wheel on an arc: ahead or back, and nearer to the track's centre.
    base = places.lateral_position[wheel]
    across = y + base * (np.sqrt(1.0 - (local[X] / base) ** 2) - 1.0)
    ahead = local[X] - arm * np.sin(yaw)
    rail_curvature = curvature / (1.0 - curvature * (base + arm + side * places.rail))
    turn = rail_curvature * ahead
    heading = yaw - turn
    axis = yawed_wheel.wheel_axis(roll, heading)
    # Along the rail: the motion of the frame, then that of the wheel beside it, in the axle's axes.
    v_x, v_y = yawed_wheel.turned(turn, speed - turning * (base + across), turning * ahead)
    own_x, own_y = yawed_wheel.turned(-heading, local[4] - yaw_rate * arm, local[5])
    roll_rate, pitch_rate = yawed_wheel.turned(-heading, local[7], 0.0)
    velocity = (v_x + own_x, v_y + own_y, local[6] + local[7] * arm)
    rotation = (roll_rate + spin * axis[0], pitch_rate + spin * axis[1], yaw_rate + spin * axis[2])
    position = (across - 0.5 * turn * ahead - side * places.rail, z + roll * arm)
    rolling = speed - turning * base
    force[:] = 0.0
    for zone in range(results.shape[0]):
        result = results[zone]
        if _still_apart(result, y, z, roll, yaw, local[X], deviation[zone]):
            continue
        f_x, f_y, f_z, m_x, m_y, m_z = patch.wheel_contact(
            contacts.tables[zone], contacts.law, side, position, (roll, heading), velocity,
            rotation, rolling, deviation[zone], deviation_rate[zone], rail_curvature, scratch[0],
            scratch[1], result,
        )  # fmt: skip
        if result[patch.PENETRATION] < 0.0:
            # A zone that does not touch may lie outside its table.
            result[patch.STATUS] = patch.NO_CONTACT
        _remember(result, y, z, roll, yaw, local[X], deviation[zone])
        force[4] += axis[0] * m_x + axis[1] * m_y + axis[2] * m_z
        f_x, f_y = yawed_wheel.turned(heading, f_x, f_y)
        m_x, _ = yawed_wheel.turned(heading, m_x, m_y)
        force[0] += f_x
        force[1] += f_y
        force[2] += f_z
        force[3] += m_x + arm * f_z
        force[5] += m_z - arm * f_x


@njit(cache=True, nogil=True, error_model="numpy", no_cfunc_wrapper=True)
def all_wheel_forces(
    contacts, curvatures, local, deviation, deviation_rate, scratch, results, force
):
    """Forces (24,) of all wheels from the local variables (44,); results (4, zones, COLUMNS).

    `curvatures` (3,) per frame; `deviation` and `deviation_rate` (4, zones).
    """
    for wheel in range(4):
        wheel_forces(
            contacts,
            wheel,
            curvatures[contacts.places.axle[wheel]],
            local[LOCALS * wheel : LOCALS * (wheel + 1)],
            deviation[wheel],
            deviation_rate[wheel],
            scratch,
            results[wheel],
            force[WHEEL_FORCES * wheel : WHEEL_FORCES * (wheel + 1)],
        )


# Steps of the central differences in the local variables, then in radius deviation (m) and its
# rate (m/s): well below the scales of contact, above rounding.
_STEPS = np.array([1e-8, 1e-8, 1e-7, 1e-7, 1e-6, 1e-6, 1e-6, 1e-6, 1e-5, 1e-6, 1e-7, 1e-8, 1e-6])


class RadiusSensitivity(NamedTuple):
    """Derivatives of contact results and wheel forces in the small.

    local : (4, zones, RESULTS, 11), results in the local variables of their wheel
    deviation : (4, zones, RESULTS, 2), in the zone's radius deviation (m) and its rate (m/s)
    force : (4, zones, 6, 2), forces on the wheel in a zone's radius deviation and its rate
    """

    local: np.ndarray
    deviation: np.ndarray
    force: np.ndarray


@njit(cache=True, nogil=True, error_model="numpy", no_cfunc_wrapper=True)
def _sensitivity(contacts, curvatures, local, steps, scratch, results, cases, jacobian, out):
    """Fill `jacobian` (4, 6, 11) and the arrays `out` of a `RadiusSensitivity` by differences.

    These are central, with `steps` (13,). The first eleven of the `cases` change a local variable,
    the others radius deviation and rate, zone by zone.
    """
    by_local, by_deviation, by_force = out
    zones = results.shape[1]
    shifted, force, radius = np.empty(LOCALS), np.empty(WHEEL_FORCES), np.zeros((2, zones))
    for wheel in range(4):
        curvature = curvatures[contacts.places.axle[wheel]]
        for case in range(cases):
            k = case if case < LOCALS else LOCALS + (case - LOCALS) // zones
            zone = (case - LOCALS) % zones
            for sign in (1.0, -1.0):
                for j in range(LOCALS):
                    shifted[j] = local[LOCALS * wheel + j]
                for j in range(zones):
                    radius[0, j] = radius[1, j] = 0.0
                if k < LOCALS:
                    shifted[k] += sign * steps[k]
                else:
                    radius[k - LOCALS, zone] = sign * steps[k]
                wheel_forces(
                    contacts, wheel, curvature, shifted, radius[0], radius[1], scratch,
                    results[0], force,
                )  # fmt: skip
                scale = sign / (2.0 * steps[k])
                for i in range(WHEEL_FORCES):
                    if k < LOCALS:
                        jacobian[wheel, i, k] += scale * force[i]
                    else:
                        by_force[wheel, zone, i, k - LOCALS] += scale * force[i]
                for c in range(patch.RESULTS):
                    if k < LOCALS:
                        for j in range(zones):
                            by_local[wheel, j, c, k] += scale * results[0, j, c]
                    else:
                        by_deviation[wheel, zone, c, k - LOCALS] += scale * results[0, zone, c]


def compiled_once(contacts: Contacts) -> Contacts:
    """Contacts of the type for which kernels are compiled, whatever the number of zones."""
    spare = MOST_ZONES - len(contacts.tables)
    return contacts._replace(tables=contacts.tables + spare * contacts.tables[-1:])


def workspace(contacts: Contacts) -> tuple[tuple, np.ndarray]:
    """Scratch arrays and array of results for `all_wheel_forces`."""
    rows, work, _ = patch.contact_workspace(contacts.law)
    return (rows, work), np.zeros((4, len(contacts.tables), COLUMNS))


def contact_forces(
    contacts: Contacts, curvatures: np.ndarray, local: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Forces (24,) and results (4, zones, COLUMNS) at local variables (44,) with round wheels."""
    scratch, results = workspace(contacts)
    force, zero = np.empty(4 * WHEEL_FORCES), np.zeros((4, len(contacts.tables)))
    all_wheel_forces(
        compiled_once(contacts), curvatures, local, zero, zero, scratch, results, force
    )
    return force, results


def headings(contacts: Contacts, curvatures: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Magnitudes (4,) in rad of the yaw of the wheels against their rails abreast of them."""
    wheel, places = local.reshape(4, LOCALS), contacts.places
    curvature = curvatures[places.axle]
    return np.abs(
        wheel[:, 3] - curvature / (1.0 - curvature * places.lateral_position) * wheel[:, X]
    )


def _derivatives(
    contacts: Contacts, curvatures: np.ndarray, local: np.ndarray, scale: float, deviations: bool
) -> tuple[np.ndarray, RadiusSensitivity]:
    """Blocks (4, 6, 11) of the Jacobian, and the sensitivity; in radius deviations if wanted."""
    scratch, results = workspace(contacts)
    zones = len(contacts.tables)
    blocks = np.zeros((4, WHEEL_FORCES, LOCALS))
    out = RadiusSensitivity(
        np.zeros((4, zones, patch.RESULTS, LOCALS)),
        np.zeros((4, zones, patch.RESULTS, 2)),
        np.zeros((4, zones, WHEEL_FORCES, 2)),
    )
    cases = LOCALS + 2 * zones if deviations else LOCALS
    steps = scale * _STEPS
    _sensitivity(
        compiled_once(contacts), curvatures, local, steps, scratch, results, cases, blocks,
        tuple(out),
    )  # fmt: skip
    return blocks, out


def contact_jacobian(
    contacts: Contacts, curvatures: np.ndarray, local: np.ndarray, scale: float = 1.0
) -> np.ndarray:
    """Derivatives (24, 44) of the forces in the local variables; `scale` of the steps."""
    blocks, _ = _derivatives(contacts, curvatures, local, scale, deviations=False)
    jacobian = np.zeros((4 * WHEEL_FORCES, 4 * LOCALS))
    for wheel, block in enumerate(blocks):
        rows = slice(WHEEL_FORCES * wheel, WHEEL_FORCES * (wheel + 1))
        jacobian[rows, LOCALS * wheel : LOCALS * (wheel + 1)] = block
    return jacobian


def radius_sensitivity(
    contacts: Contacts, curvatures: np.ndarray, local: np.ndarray, scale: float = 1.0
) -> RadiusSensitivity:
    """Sensitivity of the contacts at local variables (44,); `scale` of the steps."""
    return _derivatives(contacts, curvatures, local, scale, deviations=True)[1]
