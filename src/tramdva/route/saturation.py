"""Saturation of wheel orders: the wear response of single orders over their amplitude.

A wave of one order answers with ``H_n(|R_n|)``: a describing function. With it every order changes
by itself::

    dR_n / ds = - N H_n(|R_n|) R_n,

linear between the amplitudes of a table over ``ln |R_n|``: so each stretch is integrated exactly.
It knows no waves of other orders; where several are large, only the simulation of all tells.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.revolutions import STATUS as WAVE_STATUS
from tramdva.route.nonlinear import WearingWheel, revolution

LEFT = 0.1  # of the growth of small waves at what counts as saturation
STEADILY = ("periodic", "contact_lost")
SMOOTH = 1e-9  # of an interval in the logarithm, below which the rate counts as constant


class Describing(NamedTuple):
    """Describing function of orders.

    order : (o,); amplitude : (a,) m, rising
    response : (o, a) complex, H_n; NaN where there is no steady running
    harmonics : (o, a) effective value of the harmonics in the wear, over that of the order
    status : (o, a) of `revolutions.STATUS`
    """

    order: np.ndarray
    amplitude: np.ndarray
    response: np.ndarray
    harmonics: np.ndarray
    status: np.ndarray


def describing(wheel: WearingWheel, orders: np.ndarray, amplitudes: np.ndarray) -> Describing:
    """Describing function of orders (o,) at rising amplitudes (a,) in m.

    Notes
    -----
    An order that no longer runs steadily is not taken to larger amplitudes: these have its status.
    ``contact_lost`` tells that the wheel leaves the rail at times; it then wears while it touches.
    """
    shape = orders.size, amplitudes.size
    response, harmonics = np.full(shape, np.nan + 0j), np.full(shape, np.nan)
    status = np.full(shape, WAVE_STATUS[0], dtype="<U32")
    for row, order in enumerate(orders.astype(int)):
        multiples = order * np.arange(1, max(2, int(orders.max()) // order) + 1)
        state = np.zeros(2 * wheel.bogie.eigenvalue.size)
        for column, size in enumerate(amplitudes):
            wave = np.zeros(multiples.size, complex)
            wave[0] = size
            found = revolution(wheel, multiples, wave, state)
            status[row, column:] = found.status
            if found.status not in STEADILY:
                break
            response[row, column] = found.depth[0] / size
            harmonics[row, column] = np.linalg.norm(found.depth[1:]) / abs(found.depth[0])
            if column + 1 < amplitudes.size:
                state *= amplitudes[column + 1] / size
    return Describing(orders, amplitudes, response, harmonics, status)


def saturation_amplitude(table: Describing, small: np.ndarray) -> np.ndarray:
    """Amplitudes (o,) in m at which only the share `LEFT` of the growth of small waves is left.

    Parameters
    ----------
    table : Describing
    small : (o,) complex, H_n of small waves

    Returns
    -------
    NaN for orders that do not grow, and where the table ends before.
    """
    out = np.full(table.order.size, np.nan)
    for row, first in enumerate(small):
        known = np.isfinite(table.response[row])
        if first.real >= 0.0 or not known.any():
            continue
        left = table.response[row, known].real / first.real - LEFT
        size = np.log(table.amplitude[known])
        below = np.flatnonzero(left <= 0.0)
        if below.size and below[0] > 0:
            k = int(below[0])
            share = left[k - 1] / (left[k - 1] - left[k])
            out[row] = np.exp(size[k - 1] + share * (size[k] - size[k - 1]))
        elif below.size:
            out[row] = table.amplitude[0]
    return out


def saturating(
    initial: np.ndarray,
    distance: np.ndarray,
    amplitude: np.ndarray,
    rate: np.ndarray,
) -> np.ndarray:
    """Amplitudes (k, o) after distances (k,) with rates that depend on the amplitude.

    Parameters
    ----------
    initial : (o,) complex, m
    distance : (k,) rising, from zero
    amplitude : (a,) m, rising
    rate : (o, a) complex, change of ln R_n per distance, -N H_n summed over conditions; below the
        first amplitude that of the first

    Returns
    -------
    Complex, m; NaN beyond the amplitudes whose rate is known.
    """
    size = np.log(amplitude)
    columns = [
        _one(np.log(abs(one)), np.angle(one), np.asarray(distance, float), size, of_order)
        for one, of_order in zip(initial, rate, strict=True)
    ]
    return np.array(columns).T


def _one(
    x: float, phase: float, distance: np.ndarray, size: np.ndarray, rate: np.ndarray
) -> np.ndarray:
    """Amplitude of one order, x its logarithm: from one end of a stretch to the next."""
    out, at, k = np.full(distance.size, np.nan + 0j), 0.0, 0
    while k < distance.size:
        left, right, of_left, of_right = _stretch(x, size, rate)
        if not np.isfinite(of_left + of_right):
            return out
        here = _within(x, left, right, of_left, of_right)
        towards = right if here.real > 0.0 else left
        until = _time_to(towards - x, here.real, (of_right - of_left).real / (right - left))
        while k < distance.size and distance[k] - at <= until:
            new, turned = _after(
                x, phase, distance[k] - at, here, (of_right - of_left) / (right - left)
            )
            out[k] = np.exp(new + 1j * turned)
            k += 1
        if k < distance.size:
            _, phase = _after(x, phase, until, here, (of_right - of_left) / (right - left))
            # Beyond the end, so that the next stretch is found.
            x = np.nextafter(towards, np.inf if here.real > 0.0 else -np.inf)
            at += until
    return out


def _stretch(x: float, size: np.ndarray, rate: np.ndarray) -> tuple[float, float, complex, complex]:
    """Ends of the stretch around x and the rates there."""
    if x < size[0]:
        return min(x, size[0]) - 50.0, float(size[0]), rate[0], rate[0]
    place = int(np.searchsorted(size, x, "right")) - 1
    if place + 1 >= size.size:
        return float(size[-1]), float(size[-1]) + 1.0, np.nan + 0j, np.nan + 0j
    return float(size[place]), float(size[place + 1]), rate[place], rate[place + 1]


def _within(x: float, left: float, right: float, of_left: complex, of_right: complex) -> complex:
    return of_left + (of_right - of_left) * (x - left) / (right - left)


def _time_to(way: float, rate: float, slope: float) -> float:
    """Distance until x has moved by `way` with x' = rate + slope (x - x_0); may be without end."""
    if rate == 0.0:
        return np.inf
    if abs(slope * way) < SMOOTH * abs(rate):
        return way / rate
    grown = 1.0 + slope * way / rate
    return np.log(grown) / slope if grown > 0.0 else np.inf


def _after(x: float, phase: float, s: float, rate: complex, slope: complex) -> tuple[float, float]:
    """Logarithm and phase after a distance s within a stretch.

    x' = a + b (x - x_0), phase' = c + d (x - x_0): with E = (exp(b s) - 1) / b the way is a E, and
    its integral a (E - s) / b.
    """
    b = slope.real
    if abs(b * s) < 1e-6:
        gone, integral = s * (1.0 + 0.5 * b * s), 0.5 * s * s
    else:
        gone = np.expm1(b * s) / b
        integral = (gone - s) / b
    return x + rate.real * gone, phase + rate.imag * s + slope.imag * rate.real * integral
