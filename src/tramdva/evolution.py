"""Wear response and evolution tendency of wheel orders.

With radius deviation Re R_n exp(i n theta) (crest positive) and wear depth Re W_n exp(i n theta)
per revolution (removed material positive) at the same material point, H_n = W_n / R_n is the wear
response. The evolution tendency (17) of Peng's method,

    -cos(arg H_n) |H_n| = -Re H_n,

is positive where more is removed in the troughs: the order grows, by d ln|R_n| per revolution; the
polygon drifts around the wheel at arg-rate -Im H_n.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.rough_wheels import (
    RoughBogie,
    contact_angles,
    contact_response,
    wheel_mask,
)
from tramdva.contact import patch
from tramdva.contact.fastsim import PatchGrid
from tramdva.wear import WearChart
from tramdva.wear_derivative import worn_area_gradient

WEAR_INPUTS = (
    patch.SEMI_AXIS_LONGITUDINAL, patch.SEMI_AXIS_LATERAL, patch.NORMAL_FORCE, patch.FRICTION,
    patch.LONGITUDINAL_CREEPAGE, patch.LATERAL_CREEPAGE, patch.SPIN_CREEPAGE,
)  # fmt: skip


def excitation_frequency(order, speed: float, wheel_radius: float):
    """Frequency in Hz of an order, eq. (18): speed in m/s over the wavelength 2 pi R / order."""
    return np.asarray(order, float) * speed / (2.0 * np.pi * wheel_radius)


def order_of_frequency(frequency, speed: float, wheel_radius: float):
    """Order, not necessarily whole, of a frequency in Hz: the inverse of eq. (18)."""
    return np.asarray(frequency, float) * 2.0 * np.pi * wheel_radius / speed


def evolution_tendency(response) -> np.ndarray:
    """Evolution tendency (17) of complex wear responses."""
    return -np.cos(np.angle(response)) * np.abs(response)


class WearSensitivity(NamedTuple):
    """Wear of the contacts in equilibrium and its derivatives.

    area : (4, zones) m^2, cross-section worn away per passage
    gradient : (4, zones, 7), derivatives in the columns `WEAR_INPUTS`
    width : (4,) m, width 2 b of each wheel's patch (of the widest, if several)
    """

    area: np.ndarray
    gradient: np.ndarray
    width: np.ndarray

    def mean_depth(self) -> np.ndarray:
        """Wear depth (4,) in m per revolution of the wheels in equilibrium."""
        return self.area.sum(axis=1) / self.width


def wear_sensitivity(bogie: RoughBogie, law: patch.ContactLaw, grid: PatchGrid, chart: WearChart):
    """Wear of the contacts in equilibrium; `grid` of the patch for wear, `law` of the contacts."""
    shape = bogie.results.shape[:2]
    area, gradient = np.zeros(shape), np.zeros((*shape, len(WEAR_INPUTS)))
    for wheel, zone in zip(*np.nonzero(bogie.touching), strict=True):
        area[wheel, zone], gradient[wheel, zone] = worn_area_gradient(
            bogie.results[wheel, zone, list(WEAR_INPUTS)],
            law.kalker_table,
            law.shear_modulus,
            grid,
            bogie.rolling_speed[wheel],
            chart,
        )
    return WearSensitivity(area, gradient, patch_width(bogie))


def patch_width(bogie: RoughBogie) -> np.ndarray:
    """Width (4,) in m of the patches in equilibrium, over which wear is averaged."""
    return 2.0 * np.where(bogie.touching, bogie.results[..., patch.SEMI_AXIS_LATERAL], 0.0).max(1)


def linear_wear_response(
    bogie: RoughBogie,
    wear: WearSensitivity,
    frequency: np.ndarray,
    speed: float,
    wheel_radius: float,
    wheels,
) -> np.ndarray:
    """Wear response (f, 4) of the wheels to waves at frequencies in Hz, per revolution.

    Parameters
    ----------
    bogie : RoughBogie; wear : WearSensitivity
    frequency : (f,) Hz; speed : m/s; wheel_radius : m
    wheels : names of the wheels out of round, their waves in phase

    Notes
    -----
    A contact that moves ahead at x_c' passes the material faster, by 1 + x_c' / V_w: the depth
    changes by -x_c' / V_w of the mean depth. The wear is taken back to the angle at which it
    happened, x_c / r_w ahead of the wheel's angle.
    """
    turn = 2.0 * np.pi * np.asarray(frequency, float)
    order = order_of_frequency(frequency, speed, wheel_radius)
    lead = np.exp(1j * order[:, None, None] * contact_angles(bogie, wheel_radius, speed))
    response = contact_response(bogie, turn, lead * wheel_mask(wheels)[None, :, None])
    area = np.einsum("fwzc,wzc->fwz", response[..., list(WEAR_INPUTS)], wear.gradient)
    passing = 1j * turn[:, None] / bogie.rolling_speed
    area -= wear.area * passing[..., None] * response[..., patch.FORWARD_SHIFT]
    return (area / lead).sum(axis=2) / wear.width
