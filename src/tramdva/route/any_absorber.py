"""Growth on the route with any absorber, from the vehicle without absorbers in each class.

At the mean speed of a class the vehicle is linearised once; its wheels' wear by their own waves and
by forces at the absorbers' places, and what these places answer, are sums over its modes. Any
stiffness and damping then costs a product of arrays (`bogie.absorber_ports`). The response of the
mean speed stands for the class: the frequencies follow the speed, the equilibrium does not.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.bogie.absorber_ports import (
    Motion,
    Receptances,
    growth_rate,
    motion,
    port_modes,
    ports,
    with_absorbers,
)
from tramdva.bogie.curving import Equilibrium, System, linearise, near, with_friction_decrease
from tramdva.bogie.modal import ModalBasis, modal_basis
from tramdva.bogie.names import WHEELS
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.bogie.vehicle import absorber_carriers
from tramdva.evolution.tendency import WearSensitivity
from tramdva.route.own_response import of_modes, patch_filter, wheel_modes

SLOWEST = 5.0  # Hz, of vibrations
MODES_UP_TO = 400.0  # Hz; faster modes do not change the sign of a growth rate below 200 Hz


class ClassPorts(NamedTuple):
    """Wheels in a class as absorbers see them, over f = orders x speeds.

    turn : (wheels, f) rad/s
    bare : (wheels, f), growth per revolution without absorbers, -Re H
    receptance : (wheels, f, 4) complex, eigenvalues of the places' receptance
    output : (wheels, f, 4) complex, wear by the absorbers' forces in these (`PortModes`)
    revolutions : (wheels, speeds) in 1000 km of a wheel that is always there
    motions : free motion when forced, and in operation where there is an equilibrium
    """

    turn: np.ndarray
    bare: np.ndarray
    receptance: np.ndarray
    output: np.ndarray
    revolutions: np.ndarray
    motions: list[Motion]

    def growth(self, inertia: float, c_T: float, d_T: float) -> np.ndarray:
        """Growth (wheels, orders) in 1000 km, before any scale of the wear.

        NaN for c_T: without absorbers.
        """
        answer = self.bare.copy()
        if np.isfinite(c_T):
            add_absorbers(
                self.turn, self.receptance, self.output, float(inertia), float(c_T), float(d_T),
                answer,
            )  # fmt: skip
        wheels, count = self.revolutions.shape
        return np.einsum("wop,wp->wo", answer.reshape(wheels, -1, count), self.revolutions)

    def rate(self, inertia: float, c_T: float, d_T: float, friction: int) -> float:
        """Largest growth rate in 1/s of the vehicle's vibrations at a friction.

        -inf where the vehicle has no equilibrium at the friction of operation.
        """
        limits = (SLOWEST, 0.5 * MODES_UP_TO)
        if friction >= len(self.motions):
            return -np.inf
        free = self.motions[friction]
        if not np.isfinite(c_T):
            return growth_rate(free.eigenvalue, limits)
        return growth_rate(with_absorbers(free, inertia, c_T, d_T), limits)


@njit(cache=True, nogil=True, error_model="numpy")
def add_absorbers(turn, receptance, output, inertia, c_T, d_T, growth):
    """Add to the growth (wheels, f) per revolution what absorbers change (`absorber_ports`)."""
    for wheel in range(turn.shape[0]):
        for i in range(turn.shape[1]):
            w = turn[wheel, i]
            spring, mass = complex(c_T, w * d_T), -w * w * inertia
            stiffness = mass * spring / (spring + mass)
            total = 0.0
            for k in range(receptance.shape[2]):
                force = stiffness / (1.0 + stiffness * receptance[wheel, i, k])
                total += (output[wheel, i, k] * force).real
            growth[wheel, i] += total


def class_ports(
    system: System,
    equilibrium: Equilibrium,
    bogie: RoughBogie,
    wear: WearSensitivity,
    turns: np.ndarray,
    orders: np.ndarray,
    revolutions: np.ndarray,
    absorber: BogieAbsorber,
    operating: float,
) -> ClassPorts:
    """Prepare a class for any absorber of given place and inertia.

    Parameters
    ----------
    system, equilibrium, bogie : of the vehicle without absorbers at the mean speed
    wear : of one law
    turns : (speeds, wheels) rad/s of the wheels; orders : (o,)
    revolutions : (wheels, speeds) in 1000 km
    absorber : place, direction and inertia
    operating : B in s/m of operation
    """
    basis = modal_basis(system, equilibrium)
    places = np.vstack(absorber_carriers(system.vehicle, absorber))
    modes = []
    for wheel in range(len(WHEELS)):
        turn = (orders[:, None] * turns[None, :, wheel]).ravel()
        n = np.repeat(orders, turns.shape[0])
        spin = float(turns[turns.shape[0] // 2, wheel])
        bare = _receptances(basis, system, bogie, wear, wheel, spin, places, n, turn)
        one = np.ones((turn.size, 1, 1))
        found = ports(bare, absorber.I_T, one, np.zeros((turn.size, 1)))
        modes.append(port_modes(found))
    packed = (
        np.array([one.angular_frequency for one in modes]),
        np.array([-one.output_by_wave[:, 0].real for one in modes]),
        np.array([one.receptance for one in modes]),
        np.array([one.output[:, 0] for one in modes]),
    )
    motions = [motion(system, linearise(system, equilibrium.state), absorber).below(MODES_UP_TO)]
    rough = with_friction_decrease(system, operating)
    there = near(rough, equilibrium.state)
    if there.status == "converged":
        motions.append(motion(rough, linearise(rough, there.state), absorber).below(MODES_UP_TO))
    return ClassPorts(*packed, revolutions, motions)


def _receptances(
    basis: ModalBasis,
    system: System,
    bogie: RoughBogie,
    wear: WearSensitivity,
    wheel: int,
    spin: float,
    places: np.ndarray,
    order: np.ndarray,
    turn: np.ndarray,
) -> Receptances:
    """Wear of a wheel and motion of places, by waves on this wheel and by forces there."""
    parts = wheel_modes(bogie, [wear], wheel, spin)
    own = of_modes(bogie.eigenvalue, parts)
    moved = places[:, : system.size] @ basis.to_state[: system.size]  # place, mode
    pushed = 0.5 * (basis.load @ places.T)  # mode, place
    s = 1j * turn[:, None]
    first, second = 1.0 / (s - basis.eigenvalue), 1.0 / (s - basis.eigenvalue.conj())
    zones = len(parts.lead)
    left = patch_filter(np.outer(order, parts.half_length))  # f, zone
    ahead = np.exp(1j * np.outer(order, parts.lead))
    place_by_wave = np.zeros((turn.size, len(places)), complex)
    wear_by_force = np.zeros((turn.size, len(places)), complex)
    for z in range(zones):
        push = moved * parts.push[z, 0], moved * parts.push[z, 1]  # place, mode
        answer = first @ push[0].T + second @ push[0].conj().T
        answer += s * (first @ push[1].T + second @ push[1].conj().T)
        place_by_wave += (left[:, z] * ahead[:, z])[:, None] * answer
        heard = (parts.heard[k, z, :, 0][:, None] * pushed for k in (0, 1))
        steady, rate = heard
        answer = first @ steady + second @ steady.conj()
        answer += s * (first @ rate + second @ rate.conj())
        wear_by_force += (left[:, z] / ahead[:, z])[:, None] * answer
    both = moved.T[:, :, None] * pushed[:, None, :]  # mode, place, force
    flat = both.reshape(len(both), -1)
    by_force = (first @ flat + second @ flat.conj()).reshape(turn.size, *both.shape[1:])
    return Receptances(
        turn,
        own.at(order, turn)[0][:, None],
        place_by_wave,
        wear_by_force[:, None, :],
        by_force,
    )
