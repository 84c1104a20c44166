"""Modes of the vehicle on the track: names, growth rates, critical friction decrease."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from tramdva.bogie.curving import (
    Linearisation,
    System,
    linearise,
    near,
    oscillations,
    with_friction_decrease,
)
from tramdva.bogie.names import AXLES, ENERGY_CLASSES, WHEELS

NAME_OF_CLASS = {
    "symmetric_bending": "third_bending",
    "antisymmetric_bending": "second_bending",
    "lateral_bending": "axle_lateral_bending",
    "axle_torsion": "axle_torsion",
    "primary": "wheelset_on_primary",
    "secondary": "bogie_on_secondary",
    "resilient_wheel": "resilient_wheel",
    "car_support": "car_body",
    "absorber": "absorber",
}
BENDING = ("symmetric", "antisymmetric")
# The first bending modes are the two of most symmetric bending below this frequency; they bend the
# primary suspension more than the beam, so that their own class would not name them.
FIRST_BENDING_BELOW = 40.0  # Hz
MOSTLY = 0.5  # a bending mode of its own class has more than this share of its strain energy there
OWN_AXLE = 0.8  # a mode with more of its class's strain energy at one axle is that axle's
ALIKE = 0.5  # axles that are less correlated do not move in or out of phase


class Modes(NamedTuple):
    """Oscillatory modes by rising frequency.

    eigenvalue : (k,) 1/s; shape : (n, k) displacements
    share : (k, classes, 3) of the strain energy in front axle, rear axle, elsewhere
    name : k texts: class, then front or rear, or how both axles move: in_phase, opposed, both_axles
    """

    eigenvalue: np.ndarray
    shape: np.ndarray
    share: np.ndarray
    name: tuple[str, ...]

    @property
    def frequency(self) -> np.ndarray:
        """Frequency (k,) in Hz."""
        return self.eigenvalue.imag / (2.0 * np.pi)

    @property
    def damping_ratio(self) -> np.ndarray:
        """Damping ratio (k,)."""
        return -self.eigenvalue.real / np.abs(self.eigenvalue)


def modes(system: System, state: np.ndarray, limits: tuple[float, float]) -> Modes:
    """Modes of the vehicle linearised at a state, with frequencies (Hz) within limits.

    `tram.run_through` has an example.
    """
    return modes_of(system, linearise(system, state), limits)


def modes_of(system: System, linear: Linearisation, limits: tuple[float, float]) -> Modes:
    """Modes of the linearised vehicle with frequencies (Hz) within limits."""
    values, vectors = np.linalg.eig(linear.matrix)
    frequency = values.imag / (2.0 * np.pi)
    kept = np.flatnonzero((frequency > limits[0]) & (frequency < limits[1]))
    kept = kept[np.argsort(frequency[kept])]
    k = system.size
    shape = vectors[:k, kept]
    shape = shape / np.abs(shape).max(axis=0)
    share = strain_energy_share(system, shape)
    return Modes(values[kept], shape, share, _names(system, shape, share, frequency[kept]))


def strain_energy_share(system: System, shape: np.ndarray) -> np.ndarray:
    """Share (modes, classes, 3) of strain energy by class and place (front, rear, elsewhere)."""
    k = system.size
    energy = np.zeros((shape.shape[1], len(ENERGY_CLASSES), 3))
    for (kind, axle), stiffness in system.vehicle.strain.items():
        place = (*AXLES, "").index(axle)
        work = np.sum(shape.conj() * (stiffness[:k, :k] @ shape), axis=0)
        energy[:, ENERGY_CLASSES.index(kind), place] += work.real
    return energy / energy.sum(axis=(1, 2), keepdims=True)


def _names(
    system: System, shape: np.ndarray, share: np.ndarray, frequency: np.ndarray
) -> tuple[str, ...]:
    """Name modes by the class of largest strain energy in the whole vehicle, and by axle.

    Second and third bending must have most of it: a wheelset that moves on its springs bends, too.
    """
    energy = share.sum(axis=2)
    bending, other = (ENERGY_CLASSES.index(f"{kind}_bending") for kind in BENDING)
    partly = energy[:, [bending, other]] <= MOSTLY
    energy[:, [bending, other]] = np.where(partly, 0.0, energy[:, [bending, other]])
    kinds = energy.argmax(axis=1)
    words = [NAME_OF_CLASS[ENERGY_CLASSES[kind]] for kind in kinds]
    low = np.flatnonzero(frequency < FIRST_BENDING_BELOW)
    for mode in low[np.argsort(share[low, bending].sum(axis=1))[-len(AXLES) :]]:
        kinds[mode], words[mode] = bending, "first_bending"
    return tuple(
        word + _axle_suffix(system, shape[:, mode], share[mode, kinds[mode]])
        for mode, word in enumerate(words)
    )


def _axle_suffix(system: System, shape: np.ndarray, share: np.ndarray) -> str:
    """Tell which axle a mode with `share` (3,) of a class moves, or how both do.

    On straight track the axles are nearly alike: their modes come in pairs that move both.
    """
    front, rear, elsewhere = share
    if elsewhere > front + rear:
        return ""
    if max(front, rear) > OWN_AXLE * (front + rear):
        return f"_{AXLES[int(rear > front)]}"
    alike = axle_correlation(system, shape)
    if abs(alike) < ALIKE:
        return "_both_axles"
    return "_in_phase" if alike > 0.0 else "_opposed"


def of_front_axle(found: Modes, word: str) -> int | None:
    """Index of the lowest mode whose name begins with a word and that moves the front axle."""
    fitting = (
        k for k, name in enumerate(found.name) if name.startswith(word) and name != f"{word}_rear"
    )
    return next(fitting, None)


def axle_correlation(system: System, shape: np.ndarray) -> float:
    """Correlation of the motions of both axles with their rims in a mode, -1 .. 1; by mass."""
    names, k = system.vehicle.names, system.size
    front, rear = (
        [i for i, name in enumerate(names[:k]) if name.startswith(f"{axle}_")] for axle in AXLES
    )
    mass = system.vehicle.mass[np.ix_(front, front)]

    def product(a: np.ndarray, b: np.ndarray) -> float:
        return float((a.conj() @ mass @ b).real)

    a, b = shape[front], shape[rear]
    return product(a, b) / np.sqrt(product(a, a) * product(b, b))


class Critical(NamedTuple):
    """Least stable oscillation: growth rate in 1/s and frequency in Hz."""

    growth_rate: float
    frequency: float


def critical_oscillation(
    system: System, state: np.ndarray, limits: tuple[float, float]
) -> Critical:
    """Largest growth rate of the oscillations with frequencies (Hz) within limits."""
    return critical_of(linearise(system, state), limits)


def critical_of(linear: Linearisation, limits: tuple[float, float]) -> Critical:
    """Largest growth rate of the linearised vehicle's oscillations within limits (Hz)."""
    values = oscillations(np.linalg.eigvals(linear.matrix), limits)
    top = values[np.argmax(values.real)]
    return Critical(float(top.real), float(top.imag / (2.0 * np.pi)))


def at_friction(system: System, state: np.ndarray, B: float) -> Linearisation:
    """Linearise at the equilibrium for another friction decrease B (s/m), from a known state."""
    other = with_friction_decrease(system, B)
    return linearise(other, near(other, state).state)


def critical_friction_decrease(
    system: System,
    state: np.ndarray,
    limits: tuple[float, float],
    decrease: np.ndarray,
    growth: np.ndarray,
) -> float:
    """Friction decrease B (s/m) at which self-excitation sets in, to 1e-4 s/m; NaN if nowhere.

    Parameters
    ----------
    system, state : with its equilibrium at any friction decrease
    limits : Hz, of the oscillations that count
    decrease, growth : (k,) s/m and 1/s, between which of them the growth rate changes sign
    """
    onset = np.flatnonzero((growth[:-1] < 0.0) & (growth[1:] >= 0.0))
    if not onset.size:
        return float("nan")
    return float(
        brentq(
            lambda B: critical_of(at_friction(system, state, B), limits).growth_rate,
            *decrease[onset[0] : onset[0] + 2],
            xtol=1e-4,
        )
    )


def axle_points(system: System, axle: str) -> tuple[np.ndarray, np.ndarray]:
    """Points of an axle for drawings: rims, arms, nodes of the beam.

    Returns
    -------
    positions (p, 3) in m, motion (p, 6, n)
    """
    vehicle = system.vehicle
    flexible = vehicle.axle
    wheels = [name for name in WHEELS if name.startswith(axle)]
    index = vehicle.names.index(f"{axle}_axle x")
    size = flexible.shape.shape[1]
    positions, motion = [], []
    for y in flexible.beam.position:
        own = np.zeros((6, len(vehicle.names)))
        own[:, index : index + size] = flexible.motion(y, flexible.beam_height)
        positions.append((0.0, y, flexible.beam_height))
        motion.append(own)
    half = abs(_rim_position(system, wheels[0]))
    outer, inner = (vehicle.motion_of[f"{name}_rim"] for name in wheels)
    positions = [(0.0, -half, flexible.height), *positions, (0.0, half, flexible.height)]
    return np.array(positions), np.array([outer, *motion, inner])


def _rim_position(system: System, wheel: str) -> float:
    return float(system.contacts.places.lateral_position[WHEELS.index(wheel)])
