"""What a wheel wears by its own waves, as a sum over the vehicle's modes.

Wheels that rotate independently turn at different rates in a curve: over kilometres their waves
pass each other in every phase, and what one wheel's wave does to the other averages out. A wheel's
polygon grows by its own response: the wear of the wheel by waves on it alone, at the rate at which
it turns itself.

The vehicle's modes are known, so the response is a rational function of s = i w, cheap at any
number of frequencies: with zones z that wear and zones z' whose deviation excites,

    H = 1/(2b) sum_zz' exp(i n (phi_z' - phi_z)) sum_m (a + s b)_zm (c + s d)_z'm / (s - lambda_m)
        + conjugate modes + direct part,

a + s b the wear by mode m (`wear_rows`), c + s d the modal force of a deviation and its rate.

A patch does not feel, nor wear, waves shorter than itself. Its force answers a deviation by the
mean under its pressure, and what it removes it spreads over its length as it slides: both by the
Hertzian pressure, which over the length falls as 1 - (x/a)^2. Either mean leaves of a wave of n
around the wheel the share

    F(u) = 3 (sin u - u cos u) / u^3,        u = n a / r_w.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tramdva.bogie import wheel_forces
from tramdva.bogie.curving import System
from tramdva.bogie.names import LOCAL
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.contact import patch
from tramdva.evolution.tendency import WEAR_INPUTS, WearSensitivity

SPIN_RATE = LOCAL.index("spin_rate")


class OwnResponse(NamedTuple):
    """Wear of a wheel by its own waves, for k laws of wear.

    eigenvalue : (m,) complex, 1/s
    modal : (pairs, 3, m, k) complex, coefficients of s^0, s^1, s^2 over s - lambda
    direct : (pairs, k, 3), the same without a mode
    turn : (pairs,) rad, phi_z' - phi_z
    half_length : (pairs, 2) rad, half lengths a / r_w of the patches that excite and that wear
    """

    eigenvalue: np.ndarray
    modal: np.ndarray
    direct: np.ndarray
    turn: np.ndarray
    half_length: np.ndarray

    def at(
        self, order: np.ndarray, angular_frequency: np.ndarray, point_contact: bool = False
    ) -> np.ndarray:
        """Wear response (k, ...) per revolution to waves of orders at frequencies.

        Parameters
        ----------
        order, angular_frequency : (...), waves around the wheel and rad/s
        point_contact : leave out that patches are longer than a point, as figure 10 does
        """
        s = 1j * np.asarray(angular_frequency, float).ravel()
        n = np.broadcast_to(order, np.shape(angular_frequency)).ravel()
        powers = np.array([np.ones_like(s), s, s * s])
        first = 1.0 / (s[:, None] - self.eigenvalue)
        second = 1.0 / (s[:, None] - self.eigenvalue.conj())
        out = np.zeros((self.direct.shape[1], s.size), complex)
        for place, (turn, modal) in enumerate(zip(self.turn, self.modal, strict=True)):
            pair = self.direct[place] @ powers
            for power, coefficient in zip(powers, modal, strict=True):
                pair += power * (first @ coefficient + second @ coefficient.conj()).T
            left = 1.0 if point_contact else patch_filter(np.outer(self.half_length[place], n))
            out += np.exp(1j * n * turn) * np.prod(left, axis=0) * pair
        return out.reshape(-1, *np.shape(angular_frequency))


def patch_filter(wave_number: np.ndarray) -> np.ndarray:
    """Share of a wave that is left by its mean under the Hertzian pressure of a patch.

    Parameters
    ----------
    wave_number : times the half length of the patch, rad
    """
    u = np.asarray(wave_number, float)
    small = np.abs(u) < 1e-2  # where the difference below cancels
    v = np.where(small, 1.0, u)
    return np.where(small, 1.0 - 0.1 * u * u, 3.0 * (np.sin(v) - v * np.cos(v)) / v**3)


def spins(system: System, state: np.ndarray) -> np.ndarray:
    """Rates (4,) in rad/s at which the wheels turn in a state."""
    local = system.local(state).reshape(4, wheel_forces.LOCALS)
    return system.contacts.places.spin_rate + local[:, SPIN_RATE]


class WheelModes(NamedTuple):
    """What a wheel's waves push and what its wear hears, by zones and modes.

    push : (zones, 2, m), modal force by the deviation and by its rate
    heard : (2, zones, m, k), wear of k laws by a mode, coefficients of s^0 and s^1
    direct : (k, zones, 3), wear by the deviation itself, coefficients of s^0, s^1, s^2
    lead : (zones,) rad, by which the contacts lie ahead; half_length : (zones,) rad
    """

    push: np.ndarray
    heard: np.ndarray
    direct: np.ndarray
    lead: np.ndarray
    half_length: np.ndarray


def wheel_modes(
    bogie: RoughBogie, wears: Sequence[WearSensitivity], wheel: int, spin: float
) -> WheelModes:
    """Modal forces of a wheel's waves, and its wear by modes; arguments as in `own_response`."""
    zones = np.flatnonzero(bogie.touching[wheel])
    m = bogie.eigenvalue.size
    own = slice(wheel_forces.LOCALS * wheel, wheel_forces.LOCALS * (wheel + 1))
    forces = slice(wheel_forces.WHEEL_FORCES * wheel, wheel_forces.WHEEL_FORCES * (wheel + 1))
    output = (bogie.modal.output[:m] - 1j * bogie.modal.output[m:])[:, own]
    forcing = bogie.modal.forcing[forces]
    forcing = 0.5 * (forcing[:, :m] + 1j * forcing[:, m:])
    per_metre = spin / bogie.rolling_speed[wheel]
    parts = [_wear_by(bogie, wear, wheel, zones) for wear in wears]
    return WheelModes(
        np.moveaxis(bogie.sensitivity.force[wheel, zones], -1, 1) @ forcing,
        np.stack([local @ output.T for local, _ in parts], axis=-1),
        np.stack([wave for _, wave in parts]),
        bogie.results[wheel, zones, patch.WHEEL_LEAD] * per_metre,
        bogie.results[wheel, zones, patch.SEMI_AXIS_LONGITUDINAL] * per_metre,
    )


def own_response(
    bogie: RoughBogie, wears: Sequence[WearSensitivity], wheel: int, spin: float
) -> OwnResponse:
    """Response of a wheel to its own waves.

    Parameters
    ----------
    bogie : RoughBogie
    wears : of each law, from `tendency.wear_sensitivity`
    wheel : place in `names.WHEELS`
    spin : rad/s, from `spins`
    """
    return of_modes(bogie.eigenvalue, wheel_modes(bogie, wears, wheel, spin))


def of_modes(eigenvalue: np.ndarray, parts: WheelModes) -> OwnResponse:
    """Response of a wheel whose modes are known; eigenvalue (m,) in 1/s."""
    zones, laws = len(parts.lead), len(parts.direct)
    pairs = [(z, other) for z in range(zones) for other in range(zones)]
    modal = np.zeros((len(pairs), 3, eigenvalue.size, laws), complex)
    direct = np.zeros((len(pairs), laws, 3))
    for place, (z, other) in enumerate(pairs):
        (a, b), (c, d) = parts.heard[:, z], parts.push[other, :, :, None]
        modal[place] = a * c, a * d + b * c, b * d
        if z == other:
            direct[place] = parts.direct[:, z]
    return OwnResponse(
        eigenvalue,
        modal,
        direct,
        np.array([parts.lead[other] - parts.lead[z] for z, other in pairs]),
        np.array([(parts.half_length[other], parts.half_length[z]) for z, other in pairs]),
    )


def _wear_by(
    bogie: RoughBogie, wear: WearSensitivity, wheel: int, zones: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Wear depth of each zone by the wheel's local variables and by its own deviation.

    Returns
    -------
    local : (2, zones, 11), coefficients of s^0 and s^1 in m per local variable
    direct : (zones, 3), coefficients of s^0, s^1, s^2 in m per m

    Notes
    -----
    A contact that moves ahead passes the material faster (`tendency.wear_rows`): the coefficient
    of s^1.
    """
    gradient = wear.gradient[wheel, zones] / wear.width[wheel]
    passing = wear.area[wheel, zones] / (wear.width[wheel] * bogie.rolling_speed[wheel])
    by_local = bogie.sensitivity.local[wheel, zones]
    by_wave = bogie.sensitivity.deviation[wheel, zones]
    local = np.stack(
        [
            np.einsum("zck,zc->zk", by_local[:, WEAR_INPUTS], gradient),
            -passing[:, None] * by_local[:, patch.WHEEL_LEAD],
        ]
    )
    steady = np.einsum("zck,zc->zk", by_wave[:, WEAR_INPUTS], gradient)
    ahead = -passing[:, None] * by_wave[:, patch.WHEEL_LEAD]
    # Of the deviation (k = 0) and of its rate (k = 1, one power of s more).
    return local, np.stack([steady[:, 0], steady[:, 1] + ahead[:, 0], ahead[:, 1]], axis=-1)
