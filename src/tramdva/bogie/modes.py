"""Modes of the vehicle on the track: names, growth rates, critical friction decrease, tuning."""

import itertools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq, minimize

from tramdva.bogie.curving import System, linearise
from tramdva.bogie.line import BogieLine, Running, absorber, changed, with_friction_decrease
from tramdva.bogie.vehicle import AXLES, ENERGY_CLASSES, WHEELS

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
# The first bending mode is the one of most symmetric bending below this frequency; it bends the
# primary suspension more than the beam, so that its own class would not name it.
FIRST_BENDING_BELOW = 40.0  # Hz


class Modes(NamedTuple):
    """Oscillatory modes by rising frequency.

    eigenvalue : (k,) 1/s; shape : (n, k) displacements
    share : (k, classes, 3) of the strain energy in front axle, rear axle, elsewhere
    name : k texts, class and axle
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
    """Modes of the vehicle linearised at a state, with frequencies (Hz) within limits."""
    values, vectors = np.linalg.eig(linearise(system, state).matrix)
    frequency = values.imag / (2.0 * np.pi)
    kept = np.flatnonzero((frequency > limits[0]) & (frequency < limits[1]))
    kept = kept[np.argsort(frequency[kept])]
    k = system.size
    shape = vectors[:k, kept]
    shape = shape / np.abs(shape).max(axis=0)
    share = strain_energy_share(system, shape)
    return Modes(values[kept], shape, share, _names(share, frequency[kept]))


def strain_energy_share(system: System, shape: np.ndarray) -> np.ndarray:
    """Share (modes, classes, 3) of strain energy by class and place (front, rear, elsewhere)."""
    k = system.size
    energy = np.zeros((shape.shape[1], len(ENERGY_CLASSES), 3))
    for (kind, axle), stiffness in system.vehicle.strain.items():
        place = (*AXLES, "").index(axle)
        work = np.einsum("im,ij,jm->m", shape.conj(), stiffness[:k, :k], shape).real
        energy[:, ENERGY_CLASSES.index(kind), place] += work
    return energy / energy.sum(axis=(1, 2), keepdims=True)


def _names(share: np.ndarray, frequency: np.ndarray) -> tuple[str, ...]:
    names = []
    for mode in share:
        kind, place = np.unravel_index(np.argmax(mode), mode.shape)
        name = NAME_OF_CLASS[ENERGY_CLASSES[kind]]
        names.append(f"{name}_{AXLES[place]}" if place < len(AXLES) else name)
    low = np.flatnonzero(frequency < FIRST_BENDING_BELOW)
    bending = ENERGY_CLASSES.index("symmetric_bending")
    for place, axle in enumerate(AXLES):
        if low.size:
            names[low[np.argmax(share[low, bending, place])]] = f"first_bending_{axle}"
    return tuple(names)


class Critical(NamedTuple):
    """Least stable oscillation: growth rate in 1/s and frequency in Hz."""

    growth_rate: float
    frequency: float


def critical_oscillation(
    system: System, state: np.ndarray, limits: tuple[float, float]
) -> Critical:
    """Largest growth rate of the oscillations with frequencies (Hz) within limits."""
    values = np.linalg.eigvals(linearise(system, state).matrix)
    frequency = values.imag / (2.0 * np.pi)
    values = values[(frequency > limits[0]) & (frequency < limits[1])]
    top = values[np.argmax(values.real)]
    return Critical(float(top.real), float(top.imag / (2.0 * np.pi)))


def critical_friction_decrease(
    line: BogieLine, known: Running, design, limits: tuple[float, float], largest: float
) -> float:
    """Friction decrease B (s/m) at which self-excitation sets in; NaN if not below `largest`.

    Brackets it in steps of 0.2 s/m, then by Brent's method to 1e-4 s/m.
    """

    def growth(B: float) -> float:
        run = changed(with_friction_decrease(line, B), design, known)
        return critical_oscillation(run.curve, run.equilibrium.state, limits).growth_rate

    grid = np.arange(0.0, largest + 0.1, 0.2)
    before = growth(grid[0])
    for low, high in itertools.pairwise(grid):
        after = growth(high)
        if before < 0.0 <= after:
            return float(brentq(growth, low, high, xtol=1e-4))
        before = after
    return float("nan")


def growth_with(
    line: BogieLine, known: Running, limits: tuple[float, float]
) -> Callable[[float, float], float]:
    """Growth rate of the critical oscillation over stiffness and damping of the absorber."""

    def growth(c_T: float, d_T: float) -> float:
        run = changed(line, absorber(line, c_T, d_T), known)
        return critical_oscillation(run.curve, run.equilibrium.state, limits).growth_rate

    return growth


def tuned_absorber(
    line: BogieLine, known: Running, limits: tuple[float, float], start: tuple[float, float]
) -> tuple[float, float]:
    """Stiffness and damping that damp antisymmetric bending most; inertia as configured.

    Parameters
    ----------
    start : stiffness (N m/rad, or N/m) and damping (N m s/rad, or N s/m)

    Notes
    -----
    The aim is the largest growth rate of the modes with more than half of their strain energy in
    antisymmetric bending and in the absorbers; others, which no absorber reaches, do not count.
    """
    classes = [ENERGY_CLASSES.index(name) for name in ("antisymmetric_bending", "absorber")]

    def growth(c_T: float, d_T: float) -> float:
        run = changed(line, absorber(line, c_T, d_T), known)
        found = modes(run.curve, run.equilibrium.state, limits)
        reached = found.share[:, classes].sum(axis=(1, 2)) > 0.5
        return float(found.eigenvalue.real[reached].max()) if reached.any() else np.inf

    found = minimize(
        lambda logarithms: growth(*np.exp(logarithms)),
        np.log(start),
        method="Nelder-Mead",
        options={"xatol": 2e-3, "fatol": 1e-3, "maxfev": 80},
    )
    return tuple(map(float, np.exp(found.x)))


def carried_over(inertia: float, m_T: float, c_T: float, d_T: float) -> tuple[float, float]:
    """Stiffness and damping that give `inertia` the frequency and damping ratio of an absorber."""
    return inertia * c_T / m_T, inertia * d_T / m_T


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
