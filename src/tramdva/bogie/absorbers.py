"""Response of the bogie with any absorbers from that of the bogie without, for all at once.

An absorber answers the motion u of the axle where it sits with the force -Z(w) u,

    Z = -w^2 I (c + i w d) / (c + i w d - w^2 I),

so that the vehicle without absorbers, its response to radius deviations and to forces at the four
places tell the response with absorbers of every stiffness and damping by a system of four
equations per frequency. The equilibrium must be that without absorbers: exact where they rotate.
"""

from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize

from tramdva.bogie.curving import Equilibrium, Linearisation, System, linearise, linearised
from tramdva.bogie.modes import modes_of
from tramdva.bogie.names import ENERGY_CLASSES
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.rough_wheels import RoughBogie, deviation_forces
from tramdva.bogie.tram import BogieLine, Running, changed
from tramdva.bogie.vehicle import absorber_carriers, with_absorber_values


class Receptances(NamedTuple):
    """Complex responses of the bogie without absorbers at f frequencies.

    angular_frequency : (f,) rad/s
    local_by_wave : (f, 40), local variables of the contacts by radius deviations
    place_by_wave : (f, p), motion of the places of the absorbers by the same
    local_by_force : (f, 40, p); place_by_force : (f, p, p), by forces at these places

    The first four places are the absorbers'; others carry an absorber's mass only.
    """

    angular_frequency: np.ndarray
    local_by_wave: np.ndarray
    place_by_wave: np.ndarray
    local_by_force: np.ndarray
    place_by_force: np.ndarray


def receptances(
    system: System,
    equilibrium: Equilibrium,
    bogie: RoughBogie,
    absorber,
    angular_frequency: np.ndarray,
    source: np.ndarray,
) -> Receptances:
    """Responses of a vehicle without absorbers.

    Parameters
    ----------
    system, equilibrium : of the vehicle without absorbers
    bogie : RoughBogie of the same
    absorber : bogie.parameters.BogieAbsorber, for places and direction
    angular_frequency : (f,) rad/s
    source : (f, 4, zones) complex radius deviations at the contacts in m
    """
    linear = linearise(system, equilibrium.state)
    values, vectors = np.linalg.eig(linear.matrix)
    places = np.vstack(absorber_carriers(system.vehicle, absorber))
    modal = np.linalg.solve(vectors, linear.input.astype(complex))
    place_out = places[:, : system.size] @ vectors[: system.size]
    local_out = linear.output @ vectors
    wave_in = deviation_forces(bogie, angular_frequency, source)
    wave_in = wave_in @ (modal @ system.vehicle.force_input).T
    gain = 1.0 / (1j * angular_frequency[:, None] - values)
    by_force = gain[:, :, None] * (modal @ places.T)
    by_wave = gain * wave_in
    return Receptances(
        angular_frequency,
        by_wave @ local_out.T,
        by_wave @ place_out.T,
        local_out @ by_force,
        place_out @ by_force,
    )


def dynamic_stiffness(angular_frequency: np.ndarray, inertia: float, c_T, d_T) -> np.ndarray:
    """Force per motion of its place, Z, of absorbers of stiffness c_T and damping d_T (SI)."""
    spring = c_T + 1j * angular_frequency * d_T
    mass = -(angular_frequency**2) * inertia
    return mass * spring / (spring + mass)


def attach(
    bare: Receptances, inertia: float, c_T: float, d_T: float, output: np.ndarray
) -> np.ndarray:
    """Response (f, k) of quantities with four absorbers attached.

    Parameters
    ----------
    bare : Receptances
    inertia : kg m^2 (kg if it translates); c_T, d_T : SI
    output : (f, k, 40), quantities per local variables of the contacts
    """
    turn, count = bare.angular_frequency, bare.place_by_wave.shape[1]
    stiffness = np.empty((turn.size, count), complex)
    stiffness[:, :4] = dynamic_stiffness(turn, inertia, c_T, d_T)[:, None]
    stiffness[:, 4:] = -(turn[:, None] ** 2) * inertia
    matrix = np.eye(count) + stiffness[:, :, None] * bare.place_by_force
    force = -np.linalg.solve(matrix, (stiffness * bare.place_by_wave)[..., None])
    local = bare.local_by_wave + (bare.local_by_force @ force)[..., 0]
    return (output @ local[..., None])[..., 0]


class AbsorberFamily(NamedTuple):
    """A bogie with its absorbers at a state of equilibrium, for any stiffness and damping of them.

    At rest an absorber transmits its weight, whatever its stiffness and damping: rims, contacts
    and their Jacobian are the same for all. A rotating one transmits nothing.

    system : with the absorbers `design`; contact_jacobian : (24, 40)
    """

    system: System
    design: BogieAbsorber
    contact_jacobian: np.ndarray

    def member(self, c_T: float, d_T: float) -> tuple[System, Linearisation]:
        """System and linearisation with a stiffness (N m/rad, N/m) and damping (N m s/rad)."""
        vehicle = with_absorber_values(self.system.vehicle, self.design, c_T, d_T)
        system = self.system._replace(vehicle=vehicle)
        return system, linearised(system, self.contact_jacobian)


def absorber_family(line: BogieLine, known: Running) -> AbsorberFamily:
    """Absorbers of the line in the curve."""
    design = line.bogie.absorber
    return family_of(design, changed(line, design, known))


def family_of(design: BogieAbsorber, run: Running) -> AbsorberFamily:
    """Absorbers of any stiffness and damping from the vehicle that runs with one of them."""
    linear = linearise(run.curve, run.equilibrium.state)
    return AbsorberFamily(run.curve, design, linear.contact_jacobian)


def tuned_absorber(
    family: AbsorberFamily, limits: tuple[float, float], start: tuple[float, float]
) -> tuple[float, float]:
    """Stiffness and damping that damp antisymmetric bending most; inertia as configured.

    Parameters
    ----------
    family : AbsorberFamily
    limits : Hz, of the oscillations that count
    start : stiffness (N m/rad, or N/m) and damping (N m s/rad, or N s/m)

    Notes
    -----
    The aim is the largest growth rate of the modes with more than half of their strain energy in
    antisymmetric bending and in the absorbers; others, which no absorber reaches, do not count.
    """
    classes = [ENERGY_CLASSES.index(name) for name in ("antisymmetric_bending", "absorber")]

    def growth(c_T: float, d_T: float) -> float:
        found = modes_of(*family.member(c_T, d_T), limits)
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
