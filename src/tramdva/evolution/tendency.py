"""Wear response and evolution tendency of wheel orders.

With radius deviation Re R_n exp(i n theta) (crest positive) and wear depth Re W_n exp(i n theta)
per revolution (removed material positive) at the same material point, H_n = W_n / R_n is the wear
response. The evolution tendency (17) of Peng's method, ::

    -cos(arg H_n) |H_n| = -Re H_n,

is positive where more is removed in the troughs: the order grows, by ``d ln|R_n|`` per revolution;
the polygon drifts around the wheel at arg-rate -Im H_n.
"""

from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tramdva.bogie.names import WHEELS
from tramdva.bogie.rough_wheels import RoughBogie, contact_angles, local_response, wheel_mask
from tramdva.contact import patch
from tramdva.contact.fastsim import PatchGrid
from tramdva.wear.chart import WearChart
from tramdva.wear.gradient import worn_area_gradient
from tramdva.wear.passages import ContactHistory

# Results of a contact on which its wear depends.
WEAR_INPUTS = [getattr(patch, name.upper()) for name in ContactHistory._fields]


def excitation_frequency(order: ArrayLike, speed: float, wheel_radius: float) -> np.ndarray:
    """Frequency in Hz of an order, eq. (18): speed in m/s over the wavelength 2 pi R / order."""
    return np.asarray(order, float) * speed / (2.0 * np.pi * wheel_radius)


def order_of_frequency(frequency: ArrayLike, speed: float, wheel_radius: float) -> np.ndarray:
    """Order, not necessarily whole, of a frequency in Hz: the inverse of eq. (18)."""
    return np.asarray(frequency, float) * 2.0 * np.pi * wheel_radius / speed


def evolution_tendency(response: np.ndarray) -> np.ndarray:
    """Evolution tendency (17), growth per revolution, of complex wear responses (m over m).

    Examples
    --------
    What is worn most on the crests of a wave evens it out; what is worn most in its troughs, half
    a wave away, lets it grow; a quarter of a wave away the wave only wanders.

    >>> import numpy as np
    >>> from tramdva.evolution.tendency import evolution_tendency, excitation_frequency
    >>> away = np.array([0.0, 0.25, 0.5])  # waves, from the crest to the most worn place
    >>> response = 0.02 * np.exp(2j * np.pi * away)
    >>> [f"{growth:+.3f}" for growth in evolution_tendency(response) + 0.0]
    ['-0.020', '-0.000', '+0.020']

    Its frequency: 4 m/s over a wave of 1.885 m / 26 around a wheel of 0.3 m radius.

    >>> float(excitation_frequency(26, speed=4.0, wheel_radius=0.3).round(1))
    55.2
    """
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


class Wearing(NamedTuple):
    """What wears, and how: the wear chart, the cells of the worn patch, the wheels out of round.

    wheels : names, of `names.WHEELS`
    """

    chart: WearChart
    grid: PatchGrid
    wheels: tuple[str, ...]

    @property
    def places(self) -> list[int]:
        """Places of the wheels in `names.WHEELS`."""
        return [WHEELS.index(name) for name in self.wheels]


def wear_sensitivity(bogie: RoughBogie, law: patch.ContactLaw, wearing: Wearing) -> WearSensitivity:
    """Wear in equilibrium of the contacts of the wheels out of round; zero for the others.

    Parameters
    ----------
    bogie : RoughBogie; law : ContactLaw of its contacts
    wearing : Wearing
    """
    shape = bogie.results.shape[:2]
    area, gradient = np.zeros(shape), np.zeros((*shape, len(WEAR_INPUTS)))
    worn = bogie.touching & (wheel_mask(wearing.wheels) > 0.0)[:, None]
    for wheel, zone in zip(*np.nonzero(worn), strict=True):
        area[wheel, zone], gradient[wheel, zone] = worn_area_gradient(
            bogie.results[wheel, zone, WEAR_INPUTS],
            law.kalker_table,
            law.shear_modulus,
            wearing.grid,
            bogie.rolling_speed[wheel],
            wearing.chart,
        )
    return WearSensitivity(area, gradient, patch_width(bogie))


def patch_width(bogie: RoughBogie) -> np.ndarray:
    """Width (4,) in m of the patches in equilibrium, over which wear is averaged."""
    return 2.0 * np.where(bogie.touching, bogie.results[..., patch.SEMI_AXIS_LATERAL], 0.0).max(1)


class WearRows(NamedTuple):
    """Wear response as a linear function of the vehicle's motion.

    local : (f, 4, 11) complex, per local variables of the wheel
    direct : (f, 4) complex, by the radius deviation itself
    source : (f, 4, zones) complex, deviations at the contacts per unit wave
    """

    local: np.ndarray
    direct: np.ndarray
    source: np.ndarray

    def output(self, wheels: Sequence[int]) -> np.ndarray:
        """Wear of some wheels per local variables (f, wheels, 44) of all contacts."""
        count, places, own = self.local.shape
        out = np.zeros((count, len(wheels), places, own), complex)
        for row, wheel in enumerate(wheels):
            out[:, row, wheel] = self.local[:, wheel]
        return out.reshape(count, len(wheels), -1)


def wear_rows(
    bogie: RoughBogie,
    wear: WearSensitivity,
    frequency: np.ndarray,
    speed: float,
    wheel_radius: float,
    wheels: Collection[str],
) -> WearRows:
    """Wear per revolution of the wheels by waves at frequencies in Hz, arguments as below.

    Notes
    -----
    A contact that moves ahead at x_c' passes the material faster, by 1 + x_c' / V_w: the depth
    changes by -x_c' / V_w of the mean depth. The wear is taken back to the angle at which it
    happened, x_c / r_w ahead of the wheel's angle.
    """
    turn = 2.0 * np.pi * np.asarray(frequency, float)
    order = order_of_frequency(frequency, speed, wheel_radius)
    lead = np.exp(1j * order[:, None, None] * contact_angles(bogie, wheel_radius, speed))
    source = lead * wheel_mask(wheels)[None, :, None] * bogie.touching
    back = bogie.touching / lead / wear.width[:, None]
    passing = 1j * turn[:, None, None] * (wear.area / bogie.rolling_speed[:, None])

    def wear_by(sensitivity: np.ndarray) -> np.ndarray:
        """Wear (f, 4, zones, k) from derivatives (4, zones, results, k) of the contacts."""
        steady = np.einsum("wzck,wzc->wzk", sensitivity[:, :, WEAR_INPUTS], wear.gradient)
        return steady - passing[..., None] * sensitivity[:, :, patch.WHEEL_LEAD]

    deviation = wear_by(bogie.sensitivity.deviation)
    direct = deviation[..., 0] + 1j * turn[:, None, None] * deviation[..., 1]
    return WearRows(
        np.einsum("fwzk,fwz->fwk", wear_by(bogie.sensitivity.local), back),
        np.sum(direct * source * back, axis=2),
        source,
    )


def linear_wear_response(
    bogie: RoughBogie,
    wear: WearSensitivity,
    frequency: np.ndarray,
    speed: float,
    wheel_radius: float,
    wheels: Collection[str],
) -> np.ndarray:
    """Wear response (f, 4) of the wheels to waves at frequencies in Hz, per revolution.

    Parameters
    ----------
    bogie : RoughBogie; wear : WearSensitivity
    frequency : (f,) Hz; speed : m/s; wheel_radius : m
    wheels : names of the wheels out of round, their waves in phase
    """
    rows = wear_rows(bogie, wear, frequency, speed, wheel_radius, wheels)
    local = local_response(bogie, 2.0 * np.pi * np.asarray(frequency, float), rows.source)
    local = local.reshape(*rows.direct.shape, -1)
    return np.einsum("fwk,fwk->fw", rows.local, local) + rows.direct


def largest(tendency: np.ndarray) -> np.ndarray:
    """Largest absolute value (...) along the last axis of tendencies (..., k); NaN counts as 0."""
    return np.abs(np.where(np.isfinite(tendency), tendency, 0.0)).max(axis=-1)


def normalised(tendency: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Tendencies (..., wheel, k) over the largest absolute value of each wheel's reference.

    Parameters
    ----------
    tendency : (absorbers, wheels, k)
    reference : (wheels, k), of the bogie without absorbers; NaN is passed over
    """
    size = largest(reference)
    return tendency / np.where(size > 0.0, size, np.nan)[:, None]


def highest_top(tendency: np.ndarray) -> int | None:
    """Place of the highest positive local maximum in a curve (k,); None where there is none."""
    middle = tendency[1:-1]
    tops = 1 + np.flatnonzero((middle > 0.0) & (middle >= tendency[:-2]) & (middle > tendency[2:]))
    return int(tops[np.argmax(tendency[tops])]) if tops.size else None


def highest_peak(frequency: np.ndarray, tendency: np.ndarray) -> tuple[float, float]:
    """Frequency (Hz) and height of the highest positive local maximum; NaN where there is none.

    The vertex of the parabola through the highest point and its neighbours.
    """
    k = highest_top(tendency)
    if k is None:
        return np.nan, np.nan
    before, after = np.diff(frequency[k - 1 : k + 2])
    rise, fall = np.diff(tendency[k - 1 : k + 2]) / (before, after)
    bend = (fall - rise) / (before + after)
    slope = rise + bend * before  # at the highest point
    shift = np.clip(-0.5 * slope / bend, -before, after)
    return float(frequency[k] + shift), float(tendency[k] + (slope + bend * shift) * shift)


# Axis of frequencies: refined about this many modes, at these distances in their growth rates.
_REFINED_MODES = 6
_DISTANCES = np.array([0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5])


def finer_near_modes(axis: np.ndarray, eigenvalue: np.ndarray) -> np.ndarray:
    """Frequencies in Hz, rising: those of an axis and some about the modes of least damping.

    Parameters
    ----------
    axis : (f,) Hz, rising
    eigenvalue : (k,) complex, 1/s, of the vehicle

    Returns
    -------
    As many for any eigenvalues: the last of the axis stands for what is missing. A peak of little
    damping is narrower than the distance of frequencies on an axis of an even step.
    """
    frequency = eigenvalue.imag / (2.0 * np.pi)
    inside = np.flatnonzero((frequency > axis[0]) & (frequency < axis[-1]))
    least = inside[np.argsort(np.abs(eigenvalue.real[inside]), kind="stable")[:_REFINED_MODES]]
    distance = np.concatenate([-_DISTANCES[:0:-1], _DISTANCES])
    near = frequency[least, None] + np.abs(eigenvalue.real[least, None]) / (2 * np.pi) * distance
    fine = np.full(_REFINED_MODES * distance.size, axis[-1])
    fine[: near.size] = np.clip(near.ravel(), axis[0], axis[-1])
    return np.sort(np.concatenate([axis, fine]))


# Hz, largest distance of frequencies in the band of design. With absorbers peaks are wide, but at
# other places than the modes without: half of this beside one of 1 Hz half width costs 2 %.
BAND_STEP = 0.3


def band_axis(low: float, high: float) -> np.ndarray:
    """Frequencies in Hz, rising, from end to end of a band of design."""
    return np.linspace(low, high, 1 + int(np.ceil((high - low) / BAND_STEP)))


def growth_left(with_absorbers: np.ndarray, without: np.ndarray) -> np.ndarray:
    """What absorbers leave of the growth: the largest on any wheel over that without absorbers.

    Parameters
    ----------
    with_absorbers : (..., wheels) largest tendencies in a band
    without : (wheels,) the same without absorbers

    Returns
    -------
    (...,) array, not a number where nothing grows without absorbers
    """
    reference = np.max(without)
    return np.max(with_absorbers, axis=-1) / (reference if reference > 0.0 else np.nan)


NEAR = 0.1  # of the frequency of a peak
