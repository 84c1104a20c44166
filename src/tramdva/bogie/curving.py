"""Curving equilibrium and linearisation of the vehicle on the track.

The state is x = (q without the angles of the hubs, v): those angles are cyclic, the hubs turn at a
constant rate in equilibrium.
"""

import logging
from typing import NamedTuple

import numpy as np
import scipy  # its parts load when they are used: many short jobs need none

from tramdva.bogie import track, wheel_forces
from tramdva.bogie.names import AXLES, SIDE, WHEELS
from tramdva.bogie.vehicle import Vehicle, frame_loads
from tramdva.contact import creep_table, patch

logger = logging.getLogger(__name__)

HUBS = 4
STATUS = ("converged", "not_converged", "wheel_lifted", "outside_profile")
# Per step of the continuation, in the units of `vehicle.LOCAL`.
_LARGEST_CHANGE = np.tile([2e-4, 5e-5, 4e-3, 4e-3, 0.02, 0.05, 0.05, 0.2, 0.2, 0.2, 4e-3], 4)


class System(NamedTuple):
    """Vehicle with contacts in one state of the track.

    vehicle : Vehicle; contacts : running.Contacts
    curvatures : (3,) in 1/m per frame; load : (n,) generalised loads
    """

    vehicle: Vehicle
    contacts: wheel_forces.Contacts
    curvatures: np.ndarray
    load: np.ndarray

    @property
    def size(self) -> int:
        """Number of positions in the state, the angles of the hubs left out."""
        return len(self.vehicle.names) - HUBS

    @property
    def states(self) -> int:
        """Number of values in the state: positions, then velocities of all coordinates."""
        return self.size + len(self.vehicle.names)

    def local(self, state: np.ndarray) -> np.ndarray:
        """Local variables (44,) of the contacts."""
        k, vehicle = self.size, self.vehicle
        return vehicle.local_position[:, :k] @ state[:k] + vehicle.local_velocity @ state[k:]

    def forces(self, state: np.ndarray) -> np.ndarray:
        """Sum of all generalised forces (n,) except inertia."""
        k, vehicle = self.size, self.vehicle
        contact, _ = wheel_forces.contact_forces(self.contacts, self.curvatures, self.local(state))
        return (
            self.load
            + vehicle.force_input @ contact
            - vehicle.stiffness[:, :k] @ state[:k]
            - (vehicle.damping + vehicle.gyroscopic) @ state[k:]
        )


def system_on(
    vehicle: Vehicle,
    contacts: wheel_forces.Contacts,
    line: track.TrackLine,
    place: float,
    half_wheelbase: float,
    gravity: float,
) -> System:
    """System with the bogie's centre at `place` (m) of a line where the curvature is constant."""
    frames = track.frame_motion(line, place, half_wheelbase, contacts.places.speed)
    return System(vehicle, contacts, frames.curvature, frame_loads(vehicle, frames, gravity))


class Linearisation(NamedTuple):
    """State matrix A of x' = A (x - x_0) and its parts.

    matrix : (2 n - 4, 2 n - 4); contact_jacobian : (24, 44)
    output : (44, 2 n - 4), local variables of the contacts from the state
    input : (2 n - 4, n), state derivative from generalised forces
    """

    matrix: np.ndarray
    contact_jacobian: np.ndarray
    output: np.ndarray
    input: np.ndarray


def with_friction_decrease(system: System, B: float) -> System:
    """Return the system with another friction decrease B in s/m."""
    law = system.contacts.law
    law = law._replace(friction=(*law.friction[:2], float(B)))
    return system._replace(contacts=system.contacts._replace(law=law))


class _Constants(NamedTuple):
    """What linearisations of a vehicle share: output, D + G, inverse of the mass."""

    output: np.ndarray
    damping: np.ndarray
    inverse: np.ndarray


def _constants(system: System) -> _Constants:
    vehicle = system.vehicle
    return _Constants(
        np.hstack([vehicle.local_position[:, : system.size], vehicle.local_velocity]),
        vehicle.damping + vehicle.gyroscopic,
        np.linalg.inv(vehicle.mass),
    )


def linearise(system: System, state: np.ndarray, step_scale: float = 1.0) -> Linearisation:
    """Linearise about a state; the contact by central differences with scaled steps."""
    jacobian = wheel_forces.contact_jacobian(
        system.contacts, system.curvatures, system.local(state), step_scale
    )
    return linearised(system, jacobian)


def linearised(system: System, contact_jacobian: np.ndarray) -> Linearisation:
    """Linearise a vehicle whose contacts have this Jacobian (24, 44).

    Notes
    -----
    With positions p (hub angles left out), velocities v and the contact Jacobian J = [J_p J_v]::

        A = [        0            E        ]    E = rows of the identity without the hubs
            [ M^-1 (J_p - K)  M^-1 (J_v - D - G) ]
    """
    k, constants = system.size, _constants(system)
    matrix = _state_matrix(system, contact_jacobian, constants)
    forces = np.vstack([np.zeros((k, k + HUBS)), constants.inverse])
    return Linearisation(matrix, contact_jacobian, constants.output, forces)


def _state_matrix(
    system: System, contact_jacobian: np.ndarray, constants: _Constants
) -> np.ndarray:
    k, vehicle = system.size, system.vehicle
    force = vehicle.force_input @ contact_jacobian @ constants.output
    force[:, :k] -= vehicle.stiffness[:, :k]
    force[:, k:] -= constants.damping
    matrix = np.zeros((2 * k + HUBS, 2 * k + HUBS))
    matrix[:k, k : 2 * k] = np.eye(k)
    matrix[k:] = constants.inverse @ force
    return matrix


def _matrix_at(system: System, state: np.ndarray, constants: _Constants) -> np.ndarray:
    jacobian = wheel_forces.contact_jacobian(
        system.contacts, system.curvatures, system.local(state)
    )
    return _state_matrix(system, jacobian, constants)


class Equilibrium(NamedTuple):
    """Steady running: state, largest residual as an acceleration, contact results, status.

    results : (4, zones, patch.RESULTS)
    status : one of `STATUS`; outside a table the results of that contact are not a number
    needed_yaw : rad of a wheel against its rail where that is beyond the contact tables, else NaN

    Outside a profile by the shift or roll of a wheel, `needed_yaw` is NaN as well.
    """

    state: np.ndarray
    residual: float
    results: np.ndarray
    status: str
    needed_yaw: float = np.nan


def equilibrium(
    system: System, start: np.ndarray, tolerance: float = 1e-9, max_iterations: int = 400
) -> Equilibrium:
    """Steady running from a start on the same or another track.

    Parameters
    ----------
    system : System
    start : (2 n - 4,) state, as from `resting_start` or another equilibrium
    tolerance : largest acceleration that counts as zero, m/s^2 or rad/s^2
    max_iterations : of the implicit steps

    Notes
    -----
    Pseudo-transient continuation (Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998)): linearly
    implicit Euler steps of the equations of motion. Their length is such that no local variable of
    a contact changes by much more than its entry in `_LARGEST_CHANGE`: the first steps follow the
    vehicle into the curve, the last, of endless length, are Newton's.
    """
    state, length, mass = start.copy(), 1e-3, scipy.linalg.lu_factor(system.vehicle.mass)
    rate, constants = _rate(system, state, mass), _constants(system)
    change = np.inf
    for _ in range(max_iterations):
        if change < 1.0 and length > 1e6 and _unbalanced(rate) < tolerance:
            break
        matrix = _matrix_at(system, state, constants)
        step = np.linalg.solve(np.eye(state.size) / length - matrix, rate)
        trial_rate = _rate(system, state + step, mass)
        change = _felt(constants.output, step)
        if change > 3.0 or not np.isfinite(trial_rate).all():
            length *= 0.25
            continue
        length *= min(max(1.0 / max(change, 1e-300), 0.5), 100.0)
        state, rate = state + step, trial_rate
    return _ended(system, state, _unbalanced(rate), tolerance)


def corrected(
    system: System, start: np.ndarray, tolerance: float = 1e-9, max_iterations: int = 12
) -> Equilibrium | None:
    """Steady running near a start by Newton's method, or None if it does not get there.

    Parameters
    ----------
    system, start, tolerance : as of `equilibrium`
    max_iterations : Newton steps

    Notes
    -----
    Deuflhard's natural monotonicity test (Newton Methods for Nonlinear Problems, 2004, ch. 3):
    a damped step counts if the next simplified step, with the same matrix, is shorter. Steps are
    measured by what the contacts feel, `_LARGEST_CHANGE`; residuals are no measure, for those of a
    light rim and of the car differ by five decades.
    """
    state, mass = start.copy(), scipy.linalg.lu_factor(system.vehicle.mass)
    rate, constants = _rate(system, state, mass), _constants(system)
    for _ in range(max_iterations):
        if not np.isfinite(rate).all():
            return None
        factors = scipy.linalg.lu_factor(_matrix_at(system, state, constants))
        step = -scipy.linalg.lu_solve(factors, rate)
        size = _felt(constants.output, step)
        damping = min(1.0, 3.0 / max(size, 1e-300))
        while True:
            trial = _rate(system, state + damping * step, mass)
            if np.isfinite(trial).all():
                simplified = _felt(constants.output, scipy.linalg.lu_solve(factors, trial))
                if simplified <= (1.0 - 0.5 * damping) * size or size < 1e-6:
                    break
            damping *= 0.5
            if damping < 1e-2:
                return None
        state, rate = state + damping * step, trial
        # Below 1e-9 of a change rounding is all that is left.
        if size < 1e-3 and _unbalanced(rate) < (tolerance if size > 1e-9 else 10.0 * tolerance):
            found = _ended(system, state, _unbalanced(rate), tolerance)
            return found if found.status == "converged" else None
    return None


def near(system: System, start: np.ndarray, tolerance: float = 1e-9) -> Equilibrium:
    """Steady running from a start that is probably near: `corrected`, else `equilibrium`."""
    return corrected(system, start, tolerance) or equilibrium(system, start, tolerance)


def _felt(output: np.ndarray, step: np.ndarray) -> float:
    """Largest change of a local variable of a contact in a step, in those of `_LARGEST_CHANGE`."""
    return float(np.max(np.abs(output @ step) / _LARGEST_CHANGE))


def _ended(system: System, state: np.ndarray, residual: float, tolerance: float) -> Equilibrium:
    """State at which a search has ended, with its contacts and its status."""
    _, results = wheel_forces.contact_forces(
        system.contacts, system.curvatures, system.local(state)
    )
    status = _status(results, residual, tolerance)
    logger.info("equilibrium: %s, residual %.1e", status, residual)
    needed = np.nan
    if status == "outside_profile":
        needed, reach = _needed_yaw(system, state), _table_yaw(system)
        logger.info("a wheel is outside its contact table: yaw %.4f rad of %.4f rad", needed, reach)
        if needed <= reach:  # then it is the lateral shift, the roll or the patch
            needed = np.nan
        if (ratio := _longest_patch(system, results)) > creep_table.LARGEST_RATIO:
            logger.info("a contact patch is longer than the creep table knows: ratio %.0f", ratio)
        # Numbers held at the end of a table are no results.
        outside = results[..., patch.STATUS] == patch.INVALID
        results[..., : patch.RESULTS][outside] = np.nan
        results[..., patch.STATUS][outside] = patch.INVALID
    return Equilibrium(state, residual, results, status, needed)


def _table_yaw(system: System) -> float:
    """Largest yaw angle in rad of the contact tables."""
    return float(np.arctan(np.sqrt(system.contacts.tables[0].high[2])))


def _needed_yaw(system: System, state: np.ndarray) -> float:
    """Largest yaw angle in rad of a wheel against its rail in a state."""
    return max(wheel_forces.headings(system.contacts, system.curvatures, system.local(state)))


def _longest_patch(system: System, results: np.ndarray) -> float:
    """Largest ratio of semi-axes of the patches where a table gives their forces, else zero."""
    a, b = (results[..., k] for k in (patch.SEMI_AXIS_LONGITUDINAL, patch.SEMI_AXIS_LATERAL))
    touching = (a > 0.0) & (b > 0.0)
    if system.contacts.law.method != patch.HALF_SPACE or not touching.any():
        return 0.0
    return float(np.maximum(a[touching] / b[touching], b[touching] / a[touching]).max())


def _rate(system: System, state: np.ndarray, mass) -> np.ndarray:
    k = system.size
    force = system.forces(state)  # not a number where profiles cannot touch in one point
    acceleration = scipy.linalg.lu_solve(mass, force, check_finite=False)
    return np.concatenate([state[k : 2 * k], acceleration])


def _unbalanced(rate: np.ndarray) -> float:
    return float(np.abs(rate).max())


def _status(results: np.ndarray, residual: float, tolerance: float) -> str:
    if (results[..., patch.STATUS] == patch.INVALID).any():
        return "outside_profile"
    if (results[..., patch.NORMAL_FORCE].sum(axis=1) <= 0.0).any():
        return "wheel_lifted"
    # Rounding in the forces, 1e5 N over 1 kg, ends near 1e-10.
    return "converged" if residual < 10.0 * tolerance else "not_converged"


def resting_start(system: System, penetration: float = 1e-4) -> np.ndarray:
    """State (2 n - 4,) of the undeformed vehicle, lowered by a penetration in m."""
    state = np.zeros(2 * system.size + HUBS)
    state[: system.size] = -penetration * system.vehicle.rise[: system.size]
    return state


def wheel_loads(equilibrium_: Equilibrium) -> dict[str, float]:
    """Vertical force of the rail on each wheel in N."""
    results = equilibrium_.results
    angle = results[..., patch.CONTACT_ANGLE]
    normal, lateral = results[..., patch.NORMAL_FORCE], results[..., patch.LATERAL_FORCE]
    side = np.array(SIDE)[:, None]
    vertical = (normal * np.cos(angle) + side * lateral * np.sin(angle)).sum(axis=1)
    return dict(zip(WHEELS, map(float, vertical), strict=True))


def angle_of_attack(system: System, equilibrium_: Equilibrium) -> np.ndarray:
    """Yaw angle (2,) of front and rear axle against the track, rad; heading outwards positive."""
    k, motion = system.size, system.vehicle.motion_of
    return np.array([-motion[f"{axle}_axle"][5, :k] @ equilibrium_.state[:k] for axle in AXLES])


def oscillations(eigenvalue: np.ndarray, limits: tuple[float, float]) -> np.ndarray:
    """Those of the eigenvalues (1/s) whose frequencies in Hz lie within limits."""
    frequency = eigenvalue.imag / (2.0 * np.pi)
    return eigenvalue[(frequency > limits[0]) & (frequency < limits[1])]
