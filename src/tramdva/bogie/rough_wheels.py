"""The vehicle on wheels out of round, in the small: how the contacts answer a radius deviation.

A wave of order n around a wheel comes to the rail with the angular frequency n V / r_0; all wheels
that are out of round turn by s / r_0 and carry the wave in phase. So a wheel that rolls along its
own rail at V_w counts as one of radius r_w = r_0 V_w / V. A contact that lies ahead of the lowest
point of its circle by x_c, along the wheel, meets the material point x_c / r_w further: the
deviation there is r(V t / r_0 + x_c / r_w).
"""

from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from tramdva.bogie import wheel_forces
from tramdva.bogie.integration import Excitation, ModalContacts
from tramdva.bogie.names import WHEELS
from tramdva.contact import patch


class RoughBogie(NamedTuple):
    """Vehicle in its curving equilibrium and what it answers to small radius deviations.

    eigenvalue : (m,) complex, 1/s, of the vehicle's modes; one of each pair
    modal : integration.ModalContacts, the contacts in these modes
    curvatures : (3,) in 1/m per frame
    results : (4, zones, patch.RESULTS) of the contacts in equilibrium
    sensitivity : wheel_forces.RadiusSensitivity
    rolling_speed : (4,) m/s, of each wheel along its rail
    """

    eigenvalue: np.ndarray
    modal: ModalContacts
    curvatures: np.ndarray
    results: np.ndarray
    sensitivity: wheel_forces.RadiusSensitivity
    rolling_speed: np.ndarray

    @property
    def touching(self) -> np.ndarray:
        """Whether the zones (4, zones) are in contact."""
        return self.results[..., patch.STATUS] == patch.CONTACT


def wheel_mask(wheels: Collection[str]) -> np.ndarray:
    """Whether each of `names.WHEELS` is named in `wheels`, as numbers (4,)."""
    return np.array([float(name in wheels) for name in WHEELS])


def contact_angles(bogie: RoughBogie, wheel_radius: float, speed: float) -> np.ndarray:
    """Angle (4, zones) in rad by which the contacts lie ahead of the wheels' lowest points."""
    lead = np.where(bogie.touching, bogie.results[..., patch.WHEEL_LEAD], 0.0)
    return lead / rolling_radius(bogie, wheel_radius, speed)[:, None]


def rolling_radius(bogie: RoughBogie, wheel_radius: float, speed: float) -> np.ndarray:
    """Radius (4,) in m with which the wheels roll along their rails and turn by s / r_0."""
    return wheel_radius * bogie.rolling_speed / speed


def excitation(
    bogie: RoughBogie,
    wheel_radius: float,
    order: float,
    speed: float,
    amplitude: complex,
    wheels: Collection[str],
) -> Excitation:
    """Excitation of the time integration by waves of an order.

    Parameters
    ----------
    bogie : RoughBogie
    wheel_radius : m; order : waves around the wheel; speed : m/s
    amplitude : complex, R_n in m
    wheels : names of the wheels out of round
    """
    lead = order * contact_angles(bogie, wheel_radius, speed)
    source = amplitude * wheel_mask(wheels)[:, None] * np.exp(1j * lead)
    return waves(bogie, np.array([order * speed / wheel_radius]), source[None])


def waves(bogie: RoughBogie, angular_frequency: np.ndarray, source: np.ndarray) -> Excitation:
    """Excitation of the time integration by waves on the wheels.

    Parameters
    ----------
    bogie : RoughBogie
    angular_frequency : (k,) rad/s
    source : (k, 4, zones) complex radius deviations at the contacts in m
    """
    local = local_response(bogie, angular_frequency, source)
    force = deviation_forces(bogie, angular_frequency, source)
    return Excitation(
        np.asarray(angular_frequency, float),
        np.array([source.real, source.imag]),
        np.array([local.real, local.imag]),
        np.array([force.real, force.imag]),
        np.zeros((0, 2 * bogie.eigenvalue.size)),
    )


def deviation_forces(
    bogie: RoughBogie, angular_frequency: np.ndarray, source: np.ndarray
) -> np.ndarray:
    """Complex forces (f, 24) on the wheels by radius deviations alone, arguments as below."""
    touching = np.where(bogie.touching[None], source, 0.0)
    by_deviation, by_rate = np.moveaxis(bogie.sensitivity.force, -1, 0)
    force = np.einsum("fwz,wzk->fwk", touching, by_deviation.astype(complex))
    force += np.einsum("f,fwz,wzk->fwk", 1j * angular_frequency, touching, by_rate)
    return force.reshape(len(source), -1)


def local_response(
    bogie: RoughBogie, angular_frequency: np.ndarray, source: np.ndarray
) -> np.ndarray:
    """Complex amplitudes (f, 44) of the local variables of the contacts.

    Parameters
    ----------
    bogie : RoughBogie
    angular_frequency : (f,) rad/s
    source : (f, 4, zones) complex radius deviations at the contacts in m

    Notes
    -----
    A modal state turns as z_1 exp(i w t) + conj(z_2) exp(-i w t).
    """
    modal, m = bogie.modal, bogie.eigenvalue.size
    packed = deviation_forces(bogie, angular_frequency, source) @ modal.forcing
    turn = 1j * angular_frequency[:, None]
    first = 0.5 * (packed[:, :m] + 1j * packed[:, m:]) / (turn - bogie.eigenvalue)
    second = 0.5 * (packed[:, :m] - 1j * packed[:, m:]) / (turn - bogie.eigenvalue.conj())
    output = modal.output[:m] - 1j * modal.output[m:]
    return first @ output + second @ output.conj()
