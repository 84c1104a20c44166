"""Time integration of the vehicle on the track: an exponential integrator, compiled end to end.

The vehicle linearised about an equilibrium, contacts included, is integrated exactly in its modal
coordinates; what the contacts do beyond their linearisation is the forcing of an exponential
Runge-Kutta scheme of fourth order (S. Krogstad, J. Comput. Phys. 203 (2005) 72-88). A small
oscillation about the equilibrium therefore grows or decays without numerical damping at any step.

Steps are the interval of the output or a half, quarter, ... of it: as few as keep the difference
between the scheme and one of second order below a tolerance. Mostly the contacts cost time.
"""

from math import factorial
from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.bogie import wheel_forces
from tramdva.contact import patch

FAST = {"contract", "reassoc", "nsz"}
LEVELS = 9  # steps of 1, 1/2, ... 1/256 of the output interval
STATUS = ("completed", "contact_lost", "outside_profile", "not_finite")
COMPLETED, CONTACT_LOST, OUTSIDE_PROFILE, NOT_FINITE = range(len(STATUS))
RECORDED = (
    patch.NORMAL_FORCE, patch.CONTACT_ANGLE, patch.LONGITUDINAL_CREEPAGE, patch.LATERAL_CREEPAGE,
    patch.SPIN_CREEPAGE, patch.SEMI_AXIS_LONGITUDINAL, patch.SEMI_AXIS_LATERAL,
    patch.WHEEL_POSITION, patch.FORWARD_SHIFT, patch.SLIP_VELOCITY, patch.FRICTION,
    patch.WHEEL_LEAD,
)  # fmt: skip

# Of what Python itself does not call: the way from there takes longer to compile.
INNER = {"cache": True, "nogil": True, "error_model": "numpy"}
INNER |= {"no_cfunc_wrapper": True, "no_cpython_wrapper": True}


class ModalContacts(NamedTuple):
    """What the contacts are to the m modes near an equilibrium.

    output : (2 m, 44), local variables of the contacts; forcing : (24, 2 m), from their forces
    local, force, jacobian : (44,), (24,), (24, 44) at the equilibrium
    """

    output: np.ndarray
    forcing: np.ndarray
    local: np.ndarray
    force: np.ndarray
    jacobian: np.ndarray


# Coefficients of the scheme: half and whole propagators, weights of the forcing.
HALF, HALF_FIRST, HALF_SECOND, WHOLE, FIRST, SECOND, THIRD = range(7)


def step_table(eigenvalue: np.ndarray, interval: float) -> np.ndarray:
    """Coefficients (LEVELS, 7, 2, m) of the scheme for steps interval / 2^level.

    Notes
    -----
    With x = h lambda and phi_1 = (e^x - 1) / x, phi_k+1 = (phi_k - 1 / k!) / x: exp(x/2),
    h/2 phi_1(x/2), h phi_2(x/2), exp(x), h phi_1, h phi_2, h (4 phi_3 - 2 phi_2).
    """
    out = np.empty((LEVELS, 7, 2, eigenvalue.size))
    for level in range(LEVELS):
        h = interval / 2**level
        x = h * eigenvalue.astype(complex)
        half, whole = _phi(0.5 * x), _phi(x)
        coefficients = (
            np.exp(0.5 * x),
            0.5 * h * half[0],
            h * half[1],
            np.exp(x),
            h * whole[0],
            h * whole[1],
            h * (4.0 * whole[2] - 2.0 * whole[1]),
        )
        for k, value in enumerate(coefficients):
            out[level, k] = value.real, value.imag
    return out


def _phi(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """phi_1, phi_2, phi_3 of complex arguments; phi_3 by its series where |x| < 0.5."""
    small = np.abs(x) < 0.5
    safe = np.where(small, 1.0, x)
    phi_1 = np.expm1(safe) / safe
    phi_2 = (phi_1 - 1.0) / safe
    phi_3 = (phi_2 - 0.5) / safe
    series = sum(x**k / factorial(k + 3) for k in range(14))
    phi_3 = np.where(small, series, phi_3)
    phi_2 = np.where(small, 0.5 + x * phi_3, phi_2)
    return np.where(small, 1.0 + x * phi_2, phi_1), phi_2, phi_3


class Excitation(NamedTuple):
    """Sum of k harmonic excitations: the real part of what turns as exp(i angular_frequency t).

    The state that is integrated is the deviation from the linear response to the wheels' radius
    deviations: where the vehicle is linear, the response is exact at any step.

    angular_frequency : (k,) rad/s
    deviation : (2, k, 4, zones) m, radius deviation at the contacts, real and imaginary part
    local : (2, k, 44), linear response of the local variables
    contact_force : (2, k, 24), linear forces of the radius deviations themselves
    force : (j, 2 m), packed modal forcing by the cosines of the first j, without deviations
    """

    angular_frequency: np.ndarray
    deviation: np.ndarray
    local: np.ndarray
    contact_force: np.ndarray
    force: np.ndarray


class Passage(NamedTuple):
    """Loads of the frames while they move relative to each other, over a share u of 0 .. 1.

    load : (4, 2 m) packed modal forcing beyond the equilibrium's, coefficients of u^0 .. u^3
    curvature : (2, 3) in 1/m, coefficients of u^0 and u^1 per frame
    """

    load: np.ndarray
    curvature: np.ndarray


def steady(modes: int, curvatures: np.ndarray) -> Passage:
    """Passage of a track that does not change, for a number of modes."""
    load = np.zeros((4, 2 * modes))
    return Passage(load, np.vstack([curvatures, np.zeros(3)]))


# Functions that are called in one place are inlined: the rest of the chain is then compiled once
# instead of once per level.


@njit(**INNER)
def _copy(source, target):
    """Copy element by element: `target[:] = source` compiles seconds of error messages."""
    for k in range(source.size):
        target[k] = source[k]


@njit(**INNER, fastmath=FAST)
def _turn_waves(excitation, time, waves):
    """Cosine and sine (2, k) of the excitations at a time (s)."""
    for n in range(waves.shape[1]):
        angle = excitation.angular_frequency[n] * time
        waves[0, n] = np.cos(angle)
        waves[1, n] = np.sin(angle)


@njit(**INNER, fastmath=FAST)
def _locals_of(modal, excitation, waves, z, local):
    """Local variables of the contacts of a packed modal state; waves: from `_turn_waves`."""
    for j in range(local.size):
        local[j] = modal.local[j]
    for n in range(waves.shape[1]):
        cosine, sine = waves[0, n], waves[1, n]
        real, imag = excitation.local[0, n], excitation.local[1, n]
        for j in range(local.size):
            local[j] += cosine * real[j] - sine * imag[j]
    for k in range(z.size):
        amount = z[k]
        row = modal.output[k]
        for j in range(local.size):
            local[j] += amount * row[j]


@njit(**INNER, fastmath=FAST)
def _deviations(excitation, waves, deviation, rate):
    """Radius deviations (4, zones) in m at the contacts and their rates in m/s."""
    for w in range(4):
        for zone in range(deviation.shape[1]):
            deviation[w, zone] = rate[w, zone] = 0.0
    for n in range(waves.shape[1]):
        cosine, sine, turn = waves[0, n], waves[1, n], excitation.angular_frequency[n]
        for w in range(4):
            for zone in range(deviation.shape[1]):
                real = excitation.deviation[0, n, w, zone]
                imag = excitation.deviation[1, n, w, zone]
                deviation[w, zone] += cosine * real - sine * imag
                rate[w, zone] -= turn * (sine * real + cosine * imag)


@njit(**INNER, fastmath=FAST)
def _add_remainder(modal, excitation, waves, local, force, forcing):
    """Add the modal forcing by contact forces beyond their linearisation; `force` is used up."""
    for n in range(waves.shape[1]):
        cosine, sine = waves[0, n], waves[1, n]
        real, imag = excitation.contact_force[0, n], excitation.contact_force[1, n]
        for i in range(force.size):
            force[i] -= cosine * real[i] - sine * imag[i]
    for i in range(force.size):
        wheel = i // wheel_forces.WHEEL_FORCES
        start = wheel_forces.LOCALS * wheel
        remainder = force[i] - modal.force[i]
        for j in range(start, start + wheel_forces.LOCALS):
            remainder -= modal.jacobian[i, j] * (local[j] - modal.local[j])
        row = modal.forcing[i]
        for k in range(forcing.size):
            forcing[k] += remainder * row[k]


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _forcing(modal, contacts, passage, excitation, z, time, share, work, waves, forcing):
    """Modal forcing (2 m,) beyond the linearised vehicle at a time (s), share of the passage."""
    local, force, curvatures, deviation, rate, scratch, results = work
    _turn_waves(excitation, time, waves)
    _locals_of(modal, excitation, waves, z, local)
    _deviations(excitation, waves, deviation, rate)
    for f in range(3):
        curvatures[f] = passage.curvature[0, f] + share * passage.curvature[1, f]
    wheel_forces.all_wheel_forces(
        contacts, curvatures, local, deviation, rate, scratch, results, force
    )
    c = passage.load
    for k in range(z.size):
        forcing[k] = c[0, k] + share * (c[1, k] + share * (c[2, k] + share * c[3, k]))
    for n in range(excitation.force.shape[0]):
        for k in range(z.size):
            forcing[k] += waves[0, n] * excitation.force[n, k]
    _add_remainder(modal, excitation, waves, local, force, forcing)


@njit(**INNER, fastmath=FAST)
def _turned(coefficient, z, out, add):
    """Product of a diagonal complex matrix (2, m) and a packed state; added to `out` if `add`."""
    m = coefficient.shape[1]
    for k in range(m):
        real = coefficient[0, k] * z[k] - coefficient[1, k] * z[k + m]
        imag = coefficient[0, k] * z[k + m] + coefficient[1, k] * z[k]
        if add:
            out[k] += real
            out[k + m] += imag
        else:
            out[k] = real
            out[k + m] = imag


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _step(modal, contacts, passage, excitation, table, z, time, share, h, rise, work, arrays):
    """One step of length h; z is advanced. Returns the difference to the second order.

    Notes
    -----
    With forcings g_1 at z, g_2 and g_3 at the middle, g_4 at the end::

        u_2 = HALF z + HALF_FIRST g_1,           u_3 = u_2 + HALF_SECOND (g_2 - g_1)
        u_4 = WHOLE z + FIRST g_1 + 2 SECOND (g_3 - g_1)
        z   = WHOLE z + FIRST g_1 + SECOND (g_4 - g_1) + THIRD (g_1 - g_2 - g_3 + g_4)
    """
    g, u, change, waves = arrays
    _copy(z, u)
    for stage in range(4):
        # One call in a loop: what is called in four places takes four times as long to compile.
        done = 0.5 * ((stage + 1) // 2)
        _forcing(
            modal, contacts, passage, excitation, u, time + done * h, share + done * rise, work,
            waves, g[stage],
        )  # fmt: skip
        factor = 2.0 if stage == 2 else 1.0
        for k in range(z.size):
            change[k] = factor * (g[stage, k] - g[0, k])
        if stage == 0:
            _turned(table[HALF], z, u, False)
            _turned(table[HALF_FIRST], g[0], u, True)
        elif stage == 1:
            _turned(table[HALF_SECOND], change, u, True)
        elif stage == 2:
            _turned(table[WHOLE], z, u, False)
            _turned(table[FIRST], g[0], u, True)
            _copy(u, z)
            _turned(table[SECOND], change, u, True)
    _turned(table[SECOND], change, z, True)
    for k in range(z.size):
        u[k] = g[0, k] - g[1, k] - g[2, k] + g[3, k]
    _turned(table[THIRD], u, change, False)
    error = 0.0
    for k in range(z.size):
        z[k] += change[k]
        error += change[k] * change[k]
    return np.sqrt(error)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _worst(results):
    """Status of the contacts in the last evaluation."""
    worst = COMPLETED
    for wheel in range(results.shape[0]):
        load = 0.0
        for zone in range(results.shape[1]):
            load += results[wheel, zone, patch.NORMAL_FORCE]
            if results[wheel, zone, patch.STATUS] == patch.INVALID:
                return OUTSIDE_PROFILE
        if load <= 0.0:
            worst = CONTACT_LOST
    return worst


def run(
    modal: ModalContacts,
    contacts: wheel_forces.Contacts,
    passage: Passage,
    excitation: Excitation,
    tables: np.ndarray,
    interval: float,
    tolerance: float,
    level: int,
    time: float,
    z: np.ndarray,
    work: tuple,
    locals_out: np.ndarray,
    results_out: np.ndarray,
    columns: np.ndarray,
    every: int,
) -> tuple[int, int, int, int]:
    """Integrate over `locals_out.shape[0] * every` intervals; z is advanced.

    Parameters
    ----------
    modal : ModalContacts; contacts, passage, excitation : see there
    tables : from `step_table`; interval : s
    tolerance : largest difference to the second order per interval, m/s (norm over the modes)
    level : first level of the steps
    time : s at the start
    z : (2 m,) packed modal state
    work : from `workspace`
    locals_out : (k, 44); results_out : (k, 4, zones, columns), receive the output
    columns : indices of `patch` results to record; every : intervals per output

    Returns
    -------
    level, status, outputs written, number of evaluations of the contacts.
    """
    return _run(
        modal, wheel_forces.compiled_once(contacts), passage, excitation, tables, interval,
        tolerance, level, time, z, work, locals_out, results_out, columns, every,
    )  # fmt: skip


@njit(cache=True, nogil=True, error_model="numpy", no_cfunc_wrapper=True)
def _run(
    modal, contacts, passage, excitation, tables, interval, tolerance, level, time, z, work,
    locals_out, results_out, columns, every,
):  # fmt: skip
    """Do what `run` says."""
    waves = np.empty((2, excitation.angular_frequency.size))
    arrays = (np.empty((4, z.size)), np.empty(z.size), np.empty(z.size), waves)
    saved = np.empty(z.size)
    total = locals_out.shape[0] * every
    evaluations, status = 0, COMPLETED
    results = work[6]
    for i in range(total):
        _copy(z, saved)
        while True:
            steps = 1 << level
            h, rise = interval / steps, 1.0 / (total * steps)
            error = 0.0
            for s in range(steps):
                error += _step(
                    modal, contacts, passage, excitation, tables[level], z,
                    time + (i + s / steps) * interval, i / total + s * rise, h, rise, work, arrays,
                )  # fmt: skip
            evaluations += 4 * steps
            if error <= tolerance or level == LEVELS - 1:
                break
            level += 1
            _copy(saved, z)
        if not np.isfinite(error):
            return level, NOT_FINITE, i // every, evaluations
        now = _worst(results)
        if now == OUTSIDE_PROFILE:
            return level, OUTSIDE_PROFILE, i // every, evaluations
        status = max(status, now)
        if (i + 1) % every == 0:
            k = i // every
            _turn_waves(excitation, time + (i + 1) * interval, waves)
            _locals_of(modal, excitation, waves, z, locals_out[k])
            for wheel in range(results.shape[0]):
                for zone in range(results.shape[1]):
                    for c in range(columns.size):
                        results_out[k, wheel, zone, c] = results[wheel, zone, columns[c]]
        # The difference falls with the third power of the step.
        if level > 0 and error < 0.1 * tolerance:
            level -= 1
    return level, status, locals_out.shape[0], evaluations


def workspace(contacts: wheel_forces.Contacts) -> tuple:
    """Scratch arrays for `run`."""
    scratch, results = wheel_forces.workspace(contacts)
    deviation, rate = np.empty((2, 4, len(contacts.tables)))
    local, force = np.empty(4 * wheel_forces.LOCALS), np.empty(4 * wheel_forces.WHEEL_FORCES)
    return local, force, np.empty(3), deviation, rate, scratch, results
