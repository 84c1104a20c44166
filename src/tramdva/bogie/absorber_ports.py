"""The bogie as its absorbers see it: four places that answer their torques (or forces).

What the four places and the wear of the wheels answer to waves and to the absorbers is all that is
needed to attach absorbers of any stiffness and damping. All four have the same dynamic stiffness
Z, so that with the eigenvalues p_k of the receptance P of the places, P = V diag(p) V^-1, each
response is a sum of four terms:

    y = V diag(1 / (1 + Z p)) V^-1 y_wave,    H = H_wave - L V diag(Z / (1 + Z p)) V^-1 y_wave.

Responses with any number of absorbers for any number of vehicles are then products of arrays.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tramdva.bogie.curving import Equilibrium, Linearisation, System, linearise, oscillations
from tramdva.bogie.rough_wheels import RoughBogie, deviation_forces
from tramdva.bogie.vehicle import absorber_carriers

if TYPE_CHECKING:
    from tramdva.bogie.parameters import BogieAbsorber

ABSORBERS = 4


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
    absorber: BogieAbsorber,
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


def dynamic_stiffness(
    angular_frequency: np.ndarray, inertia: float, c_T: ArrayLike, d_T: ArrayLike
) -> np.ndarray:
    """Force per motion of its place, Z, of absorbers of stiffness c_T and damping d_T (SI)."""
    spring = c_T + 1j * angular_frequency * d_T
    mass = -(angular_frequency**2) * inertia
    return mass * spring / (spring + mass)


class Ports(NamedTuple):
    """Complex answers of k quantities and of the four places, by waves and by the absorbers.

    Leading dimensions (..., f) are free: vehicles, frequencies.

    angular_frequency : (..., f) rad/s
    output_by_wave : (..., f, k); output_by_force : (..., f, k, 4)
    place_by_wave : (..., f, 4), rad or m; place_by_force : (..., f, 4, 4)
    """

    angular_frequency: np.ndarray
    output_by_wave: np.ndarray
    output_by_force: np.ndarray
    place_by_wave: np.ndarray
    place_by_force: np.ndarray


class Attachable(NamedTuple):
    """What the bogie does without absorbers, and what to attach them to.

    without_absorbers : (..., f, k) complex quantities; no mass and no weight of absorbers
    place_without : (..., f, 4) complex motion of the places of the absorbers, likewise
    ports : of these places, with the absorbers' weight on the axles and mass across their direction
    """

    without_absorbers: np.ndarray
    place_without: np.ndarray
    ports: Ports


def ports(bare: Receptances, inertia: float, output: np.ndarray, direct: np.ndarray) -> Ports:
    """Reduce the receptances of a bogie without absorbers to the four places.

    Parameters
    ----------
    bare : Receptances
    inertia : kg m^2, or kg of absorbers that translate
    output : (f, k, 44), quantities per local variables; direct : (f, k), their part by the wave

    Notes
    -----
    Across its direction an absorber that translates is a mass on the axle. With S = -w^2 m and the
    places x of these masses, their forces f = -(1 + S P_xx)^-1 S (x_wave + P_x4 f_4) are put in.
    """
    wave, force = bare.place_by_wave, bare.place_by_force
    output_wave = (output @ bare.local_by_wave[..., None])[..., 0] + direct
    output_force = output @ bare.local_by_force
    n = ABSORBERS
    if wave.shape[1] > n:
        mass = -(bare.angular_frequency[:, None, None] ** 2) * inertia
        matrix = np.eye(wave.shape[1] - n) + mass * force[:, n:, n:]
        coming = np.concatenate([wave[:, n:, None], force[:, n:, :n]], axis=2)
        answer = -np.linalg.solve(matrix, mass * coming)
        answered = force[:, :n, n:] @ answer
        heard = output_force[:, :, n:] @ answer
        wave = wave[:, :n] + answered[..., 0]
        output_wave = output_wave + heard[..., 0]
        output_force = output_force[:, :, :n] + heard[..., 1:]
        force = force[:, :n, :n] + answered[..., 1:]
    return Ports(bare.angular_frequency, output_wave, output_force, wave, force)


class PortModes(NamedTuple):
    """Ports in the eigenvectors of the places' receptance.

    angular_frequency : (..., f); output_by_wave : (..., f, k)
    receptance : (..., f, 4), eigenvalues p
    output : (..., f, k, 4), L V times V^-1 y_wave; place : (..., f, 4, 4), V times V^-1 y_wave
    """

    angular_frequency: np.ndarray
    output_by_wave: np.ndarray
    receptance: np.ndarray
    output: np.ndarray
    place: np.ndarray

    def at(self, index: ArrayLike) -> PortModes:
        """Part of the leading dimensions."""
        return PortModes(*(values[index] for values in self))

    def response(self, inertia: float, c_T: ArrayLike, d_T: ArrayLike) -> np.ndarray:
        """Quantities (..., f, k) with absorbers; c_T and d_T broadcast with (..., f)."""
        stiffness = dynamic_stiffness(self.angular_frequency, inertia, c_T, d_T)[..., None]
        force = stiffness / (1.0 + stiffness * self.receptance)
        return self.output_by_wave - (self.output @ force[..., None])[..., 0]

    def carrier(self, inertia: float, c_T: ArrayLike, d_T: ArrayLike) -> np.ndarray:
        """Motion (..., f, 4) of the places with absorbers, rad or m."""
        stiffness = dynamic_stiffness(self.angular_frequency, inertia, c_T, d_T)[..., None]
        return (self.place @ (1.0 / (1.0 + stiffness * self.receptance))[..., None])[..., 0]

    def stroke(self, inertia: float, c_T: ArrayLike, d_T: ArrayLike) -> np.ndarray:
        """Motion (..., f, 4) of the absorbers relative to their places, rad or m."""
        turn = self.angular_frequency
        pull = turn**2 * inertia
        ratio = pull / (c_T + 1j * turn * d_T - pull)
        return ratio[..., None] * self.carrier(inertia, c_T, d_T)


def port_modes(found: Ports) -> PortModes:
    """Diagonalise the receptances of the places."""
    values, vectors = np.linalg.eig(found.place_by_force)
    amount = np.linalg.solve(vectors, found.place_by_wave[..., None])[..., 0][..., None, :]
    return PortModes(
        found.angular_frequency,
        found.output_by_wave,
        values,
        (found.output_by_force @ vectors) * amount,
        vectors * amount,
    )


class Motion(NamedTuple):
    """Free motion of a bogie without absorbers, as far as its absorbers can move it.

    eigenvalue : (n,) complex, 1/s, those with negative imaginary part left out, by size
    place : (p, n) complex, motion of the places per modal state
    forcing : (n, p) complex, modal state per torque (or force) there
    """

    eigenvalue: np.ndarray
    place: np.ndarray
    forcing: np.ndarray

    def below(self, frequency: float) -> Motion:
        """Only the modes below a frequency in Hz: what is above is taken as rigid."""
        kept = self.eigenvalue.imag < 2.0 * np.pi * frequency
        return Motion(self.eigenvalue[kept], self.place[:, kept], self.forcing[kept])


def motion(system: System, linear: Linearisation, absorber: BogieAbsorber) -> Motion:
    """Free motion of a linearised bogie at the places of absorbers (`BogieAbsorber`)."""
    values, vectors = np.linalg.eig(linear.matrix)
    places = np.vstack(absorber_carriers(system.vehicle, absorber))
    forcing = np.linalg.solve(vectors, (linear.input @ places.T).astype(complex))
    place = places[:, : system.size] @ vectors[: system.size]
    kept = np.flatnonzero(values.imag >= 0.0)
    kept = kept[np.lexsort((values.real[kept], values.imag[kept]))]
    return Motion(values[kept], place[:, kept], forcing[kept])


def growth_rate(eigenvalue: np.ndarray, limits: tuple[float, float]) -> float:
    """Largest growth rate in 1/s of the oscillations within limits (Hz); -inf without any."""
    return float(oscillations(eigenvalue, limits).real.max(initial=-np.inf))


def with_absorbers(bare: Motion, inertia: float, c_T: float, d_T: float) -> np.ndarray:
    """Eigenvalues (1/s) of the bogie with four absorbers.

    Notes
    -----
    A pair of modes x, conj(x) with places y = 2 Re(c x) is written in (Re x, Im x) and the
    absorbers in their angles and rates::

        [x ]'   [ R - F d C R    F c (..)   ]        with the torque on the places
        [a ]  = [      0         identity   ]        c (a - C x) + d (a' - C R x)
        [a']    [ torques on the absorbers  ]

    Masses across the direction take part by their inertia, -m y'' on their places.
    """
    rate, along, along_speed, forcing = with_masses(bare, inertia)
    n, count = rate.shape[0], ABSORBERS
    relative = np.hstack([-along, np.eye(count), np.zeros((count, count))])
    relative_speed = np.hstack([-along_speed, np.zeros((count, count)), np.eye(count)])
    torque = c_T * relative + d_T * relative_speed
    matrix = np.zeros((n + 2 * count, n + 2 * count))
    matrix[:n, :n] = rate
    matrix[:n] += forcing @ torque
    matrix[n : n + count, n + count :] = np.eye(count)
    matrix[n + count :] = -torque / inertia
    return np.linalg.eigvals(matrix)


def with_masses(
    bare: Motion, inertia: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Free motion x' = R x + F f in real coordinates with the absorbers' masses across, if any.

    Returns
    -------
    R (n, n), the places (4, n) of the absorbers and their rates, F (n, 4)
    """
    rate, place, forcing = _real(bare, bare.eigenvalue.imag > 0.0)
    count, speed = ABSORBERS, place @ rate
    if place.shape[0] > count:
        across, hung = place[count:], forcing[:, count:]
        # f = -m (C R^2 x + C R F f + C R F_4 f_4)
        gain = across @ rate @ forcing
        inverse = np.linalg.inv(np.eye(len(across)) + inertia * gain[:, count:])
        rate = rate - inertia * hung @ inverse @ across @ rate @ rate
        forcing = forcing[:, :count] - inertia * hung @ inverse @ gain[:, :count]
    else:
        forcing = forcing[:, :count]
    return rate, place[:count], speed[:count], forcing


def _real(bare: Motion, pair: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """State matrix, places and forcing in real coordinates: pairs first, then real modes."""
    first, single = np.flatnonzero(pair), np.flatnonzero(~pair)
    m, n = first.size, 2 * first.size + single.size
    value = bare.eigenvalue[first]
    rate = np.zeros((n, n))
    k = np.arange(m)
    rate[k, k] = rate[m + k, m + k] = value.real
    rate[k, m + k], rate[m + k, k] = -value.imag, value.imag
    rate[2 * m + np.arange(single.size), 2 * m + np.arange(single.size)] = bare.eigenvalue[
        single
    ].real
    c, f = bare.place[:, first], bare.forcing[first]
    place = np.hstack([2.0 * c.real, -2.0 * c.imag, bare.place[:, single].real])
    forcing = np.vstack([f.real, f.imag, bare.forcing[single].real])
    return rate, place, forcing
