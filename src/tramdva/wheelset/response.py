"""Frequency response of the wheelset (figure 7).

A harmonic force acts on the rim at the wheel-rail contact, eq. (16); the response is linearised
about the steady state in the curve.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from tramdva.wheelset.model import WheelsetParameters, linearised


class Response(NamedTuple):
    """Complex responses per unit force, in m/N: rim and stroke y_T - y_A of the absorber."""

    receptance: np.ndarray
    stroke: np.ndarray


def response(values: WheelsetParameters, with_absorber: bool, frequency: np.ndarray) -> Response:
    """Response of the rim to a lateral force on it.

    Parameters
    ----------
    values : WheelsetParameters
        Numbers or arrays that broadcast with the frequency; SI units.
    with_absorber : bool
        Whether the absorber is mounted.
    frequency : array
        In Hz.

    Returns
    -------
    Response
        Positive force and position point to the centre of the curve. The stroke is 0 without
        absorber.

    Notes
    -----
    With the dynamic stiffnesses A, T, R of the bodies and t, r of the couplings::

        y_R / F = 1 / (R - r^2 / (A - t^2 / T))
    """
    p = values
    s = 2j * np.pi * np.asarray(frequency)
    Omega2 = p.Omega**2
    shape = np.broadcast_shapes(*(np.shape(value) for value in values))
    kappa = linearised(values, with_absorber).kappa.reshape(shape)
    r = p.d_R * s + p.c_R
    A = p.m_A * (s**2 - Omega2) + p.d_A * s + p.c_A + r
    R = p.m_R * (s**2 - Omega2) + kappa * s + r
    transfer = np.zeros(np.broadcast_shapes(shape, s.shape))
    if with_absorber:
        t = p.d_T * s + p.c_T
        transfer = t / (p.m_T * (s**2 - Omega2) + t)  # y_T / y_A
        A = A + t - t * transfer
    receptance = 1.0 / (R - r**2 / A)
    stroke = (transfer - 1.0) * r / A * receptance if with_absorber else 0.0 * receptance
    return Response(receptance, stroke)


class Peak(NamedTuple):
    """Largest value of a response and its frequency in Hz."""

    amplitude: float
    frequency: float


def largest_peak(amplitude: Callable[[np.ndarray], np.ndarray], frequency: np.ndarray) -> Peak:
    """Largest value of a function of the frequency, sampled and then refined.

    Parameters
    ----------
    amplitude : callable
        Function of the frequency (k,) in Hz.
    frequency : (k,) array
        Samples.

    Returns
    -------
    Peak
    """
    sampled = amplitude(frequency)
    k = int(np.argmax(sampled))
    if k in (0, len(frequency) - 1):
        return Peak(float(sampled[k]), float(frequency[k]))
    found = minimize_scalar(
        lambda f: -float(amplitude(np.array([f]))[0]),
        bounds=(frequency[k - 1], frequency[k + 1]),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return Peak(float(-found.fun), float(found.x))


def peak_receptance(values: WheelsetParameters, with_absorber: bool, frequency: np.ndarray) -> Peak:
    """Largest receptance in m/N over sampled frequencies (Hz), refined."""
    return largest_peak(lambda f: np.abs(response(values, with_absorber, f).receptance), frequency)


def peak_stroke(values: WheelsetParameters, frequency: np.ndarray) -> Peak:
    """Largest stroke of the absorber per force in m/N over sampled frequencies (Hz), refined."""
    return largest_peak(lambda f: np.abs(response(values, True, f).stroke), frequency)
