"""Response of the bogie with any absorbers from that of the bogie without, for all at once.

An absorber answers the motion u of the axle where it sits with the force -Z(w) u,

    Z = -w^2 I (c + i w d) / (c + i w d - w^2 I),

so that the vehicle without absorbers, its response to radius deviations and to forces at the four
places tell the response with absorbers of every stiffness and damping by a system of four
equations per frequency. The equilibrium must be that without absorbers: exact where they rotate.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.curving import Equilibrium, System, linearise
from tramdva.bogie.rough_wheels import RoughBogie, deviation_forces
from tramdva.bogie.vehicle import absorber_carriers


class Receptances(NamedTuple):
    """Complex responses of the bogie without absorbers at f frequencies.

    angular_frequency : (f,) rad/s
    local_by_wave : (f, 44), local variables of the contacts by radius deviations
    place_by_wave : (f, p), motion of the places of the absorbers by the same
    local_by_force : (f, 44, p); place_by_force : (f, p, p), by forces at these places

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
    absorber : bogie_parameters.BogieAbsorber, for places and direction
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
    output : (f, k, 44), quantities per local variables of the contacts
    """
    turn, count = bare.angular_frequency, bare.place_by_wave.shape[1]
    stiffness = np.empty((turn.size, count), complex)
    stiffness[:, :4] = dynamic_stiffness(turn, inertia, c_T, d_T)[:, None]
    stiffness[:, 4:] = -(turn[:, None] ** 2) * inertia
    matrix = np.eye(count) + stiffness[:, :, None] * bare.place_by_force
    force = -np.linalg.solve(matrix, (stiffness * bare.place_by_wave)[..., None])
    local = bare.local_by_wave + (bare.local_by_force @ force)[..., 0]
    return (output @ local[..., None])[..., 0]
