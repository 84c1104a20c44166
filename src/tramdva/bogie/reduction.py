"""The vehicle reduced to two masses at a wheel's contact point, as in the basic model.

The basic model is a chain: ground - (c_A, d_A) - m_A - (c_R, d_R) - m_R, and the creep force acts
on m_R. Its receptance at m_R has two poles s_1, s_2 and a residue at each. The chain that stands
for a vehicle has the same two poles and the same two modal masses::

    M_k = 1 / (2 |Im s_k| |residue of the receptance at s_k|)

as the receptance of the vehicle at the contact point: six numbers for six parameters
(docs/basic_model.md).
"""

from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from tramdva.bogie import wheel_forces
from tramdva.bogie.curving import Linearisation, System, linearised
from tramdva.bogie.modes import modes_of
from tramdva.bogie.names import FORCES, WHEELS
from tramdva.bogie.tracking import second_bending

NO_FRICTION = 1e-9
HEAVIER = 4.0


class PointMode(NamedTuple):
    """A mode seen at a point: pole in 1/s and modal mass in kg for unit motion of the point."""

    pole: complex
    mass: float

    @property
    def frequency(self) -> float:
        """Frequency in Hz."""
        return float(self.pole.imag / (2.0 * np.pi))


class Chain(NamedTuple):
    """Two masses in a row on the ground: kg, N s/m, N/m."""

    m_A: float
    d_A: float
    c_A: float
    m_R: float
    d_R: float
    c_R: float

    def state_matrix(self) -> np.ndarray:
        """Matrix (4, 4) of x' = A x with x = (x_A, x_R, v_A, v_R)."""
        m_A, d_A, c_A, m_R, d_R, c_R = self
        return np.array(
            [
                [0.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
                [-(c_A + c_R) / m_A, c_R / m_A, -(d_A + d_R) / m_A, d_R / m_A],
                [c_R / m_R, -c_R / m_R, d_R / m_R, -d_R / m_R],
            ]
        )

    def share_of_axle(self, pole: complex) -> float:
        """Amplitude of m_A over that of m_R in the mode of a pole."""
        layer = self.d_R * pole + self.c_R
        return float(abs((self.m_R * pole**2 + layer) / layer))


def point_modes(matrix: np.ndarray, push: np.ndarray, seen: np.ndarray) -> list[PointMode]:
    """Oscillatory modes of x' = A x + push f, as the displacement ``seen x`` shows them.

    Parameters
    ----------
    matrix : (n, n) state matrix; push, seen : (n,)

    Returns
    -------
    By rising frequency. A mode that the point does not take part in has an endless mass.
    """
    poles, shapes = np.linalg.eig(matrix)
    residue = (seen @ shapes) * np.linalg.solve(shapes, push.astype(complex))
    found = [
        PointMode(complex(pole), float(1.0 / max(2.0 * pole.imag * abs(part), 1e-300)))
        for pole, part in zip(poles, residue, strict=True)
        if pole.imag > 1e-6
    ]
    return sorted(found, key=lambda mode: mode.pole.imag)


def modes_of_chain(chain: Chain) -> list[PointMode]:
    """Both modes of a chain at m_R, by rising frequency; fewer where it does not oscillate."""
    push, seen = np.array([0.0, 0.0, 0.0, 1.0 / chain.m_R]), np.array([0.0, 1.0, 0.0, 0.0])
    return point_modes(chain.state_matrix(), push, seen)


def undamped_chain(first: PointMode, second: PointMode) -> Chain:
    """Chain with the frequencies and modal masses of two modes, dampings to first order.

    Notes
    -----
    With p_k = m_R / M_k, whose sum is 1: m_R = M_1 M_2 / (M_1 + M_2),
    c_R / m_R = p_1 w_1^2 + p_2 w_2^2, (c_A + c_R) / m_A = p_1 w_2^2 + p_2 w_1^2 and
    c_A c_R / (m_A m_R) = w_1^2 w_2^2. The dampings solve
    -2 Re(s_k) M_k = d_A a_k^2 + d_R (1 - a_k)^2 with a_k = 1 - w_k^2 m_R / c_R.
    """
    masses = np.array([first.mass, second.mass])
    squares = np.abs([first.pole, second.pole]) ** 2
    m_R = float(1.0 / np.sum(1.0 / masses))
    shares = m_R / masses
    rim = float(shares @ squares)
    axle = float(squares[0] * squares[1] / rim)
    c_R = m_R * rim
    m_A = c_R / (float(shares @ squares[::-1]) - axle)
    motion = 1.0 - squares * m_R / c_R
    work = np.column_stack([motion**2, (1.0 - motion) ** 2])
    loss = -2.0 * np.real([first.pole, second.pole]) * masses
    d_A, d_R = np.linalg.solve(work, loss)
    return Chain(m_A, float(d_A), axle * m_A, m_R, float(d_R), c_R)


def chain_of(first: PointMode, second: PointMode) -> Chain | None:
    """Chain with the poles and modal masses of two modes; None where no chain has them.

    Parameters
    ----------
    first, second : of rising frequency

    Notes
    -----
    Newton's method (Levenberg-Marquardt) from `undamped_chain`. A chain whose masses and
    stiffnesses are not all positive is none. A damping below zero says that other wheels feed the
    vibration.
    """
    guess = np.array(undamped_chain(first, second))
    size = np.array([guess[0], 0, guess[2], guess[3], 0, guess[5]])
    size[[1, 4]] = np.sqrt(size[[0, 3]] * size[[2, 5]])

    def missed(scaled: np.ndarray) -> np.ndarray:
        found = modes_of_chain(Chain(*(scaled * size)))
        if len(found) != 2:
            return np.full(6, 1e3)
        out = []
        for own, wanted in zip(found, (first, second), strict=True):
            far = (own.pole - wanted.pole) / abs(wanted.pole)
            out += [far.real, far.imag, np.log(own.mass / wanted.mass)]
        return np.array(out)

    solved = least_squares(missed, guess / size, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    chain = Chain(*map(float, solved.x * size))
    if np.abs(solved.fun).max() > 1e-8 or min(chain[0], chain[2], chain[3], chain[5]) <= 0.0:
        return None
    return chain


class Reduction(NamedTuple):
    """A vehicle seen from a contact point.

    bending, wheel : second bending and the mode of the resilient wheel; None where there is none
    carried : 1/kg or 1/(kg m^2), sum of one over the modal mass of second bending at absorbers
    """

    bending: PointMode | None
    wheel: PointMode | None
    carried: float


def without_own_creep(
    system: System, state: np.ndarray, jacobian: np.ndarray, wheel: str
) -> Linearisation:
    """Linearisation in which one wheel has no creep force: only its normal force holds it.

    jacobian : (24, 44) of all contacts at the state
    """
    law = system.contacts.law
    slippery = system.contacts._replace(law=law._replace(friction=(NO_FRICTION, *law.friction[1:])))
    smooth = wheel_forces.contact_jacobian(slippery, system.curvatures, system.local(state))
    k = WHEELS.index(wheel)
    rows = slice(k * len(FORCES), (k + 1) * len(FORCES))
    out = jacobian.copy()
    out[rows] = smooth[rows]
    return linearised(system, out)


def reduced(
    system: System,
    linear: Linearisation,
    wheel: str,
    radius: float,
    along: np.ndarray,
    limits: tuple[float, float],
) -> Reduction:
    """Modes of a vehicle at the contact point of a wheel.

    Parameters
    ----------
    system, linear : the vehicle and its linearisation without the wheel's creep forces
    wheel : name; radius : m, of the wheel
    along : (4, n) motion of the axles along the absorbers' directions
    limits : Hz, of the modes that count

    Notes
    -----
    Second bending is found by its shape (`tracking`). Of the modes of resilient wheels above it the
    lowest counts whose modal mass at the point is at most `HEAVIER` times that of second bending:
    the others move other wheels.
    """
    rim = system.vehicle.motion_of[f"{wheel}_rim"]

    def at(motion: np.ndarray, poles: np.ndarray) -> list[PointMode]:
        seen = np.concatenate([motion[: system.size], np.zeros(motion.size)])
        found = point_modes(linear.matrix, linear.input @ motion, seen)
        return [min(found, key=lambda mode: abs(mode.pole - pole)) for pole in poles]

    named = modes_of(system, linear, limits)
    own = [mode.index for mode in second_bending(system, named) if wheel.startswith(mode.axle)]
    if not own:
        return Reduction(None, None, np.nan)
    point = at(rim[1] + radius * rim[3], named.eigenvalue)
    bending = point[own[0]]
    wheels = [
        mode
        for mode, name in zip(point, named.name, strict=True)
        if name.startswith("resilient_wheel")
        and mode.frequency > bending.frequency
        and mode.mass < HEAVIER * bending.mass
    ]
    places = [at(motion, np.array([bending.pole]))[0] for motion in along]
    carried = sum(1.0 / place.mass for place in places)
    return Reduction(bending, min(wheels, key=lambda mode: mode.frequency, default=None), carried)


def absorber_mass(inertia: float, seen: Reduction, share_of_axle: float) -> float:
    """Mass in kg at the axle of the chain that is as large in second bending as the absorbers.

    Parameters
    ----------
    inertia : kg m^2, or kg of a translating absorber
    seen : the vehicle at the contact point
    share_of_axle : motion of the chain's axle in second bending, for unit motion of the point

    Notes
    -----
    An absorber moves a pole by the residue of the receptance where it sits, times its own dynamic
    stiffness: so its share of the modal mass there counts.
    """
    return float(inertia * seen.carried * seen.bending.mass / share_of_axle**2)
