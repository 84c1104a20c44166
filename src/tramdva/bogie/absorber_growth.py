"""Least stable oscillation of a bogie with absorbers, without all eigenvalues of either.

The modes of the bogie without absorbers up to somewhat above the frequencies that count, and the
flexibility R of the places by all others, tell nearly what it does with absorbers. The few least
stable eigenvalues are then corrected by Newton's method on the whole bogie as its absorbers see it,

    det(1 + Z(s) P(s)) = 0,    P(s) = sum over its modes k of place_k forcing_k / (s - s_k),

with the dynamic stiffness Z of an absorber. Times the product of all s - s_k this is the
characteristic polynomial: no mode that the absorbers do not reach is a pole of it.

Nothing is taken on trust: where a correction does not converge, moves an eigenvalue by more than
`LARGEST_SHIFT`, makes two of them one or leaves none within the limits, all eigenvalues are found.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tramdva.bogie.absorber_ports import ABSORBERS, Motion, motion, with_absorbers, with_masses
from tramdva.bogie.curving import linearised, oscillations

if TYPE_CHECKING:
    from tramdva.bogie.absorbers import AbsorberFamily
    from tramdva.bogie.tram import Running

MODES_UP_TO = 1.25  # times the largest frequency that counts
LARGEST_SHIFT = 0.5  # 1/s, of a correction
CANDIDATES = 6.0 * LARGEST_SHIFT  # 1/s, below the least stable of the few modes
EDGE = 0.01  # share by which a frequency beyond the limits may still come within them
NEWTON_STEPS = 12
TOLERANCE = 1e-9  # 1/s


class Seen(NamedTuple):
    """A bogie without absorbers as they see it.

    motion, low : all its modes, and those that nearly decide
    rest : (4, 4) flexibility of the places by the others, rad/(N m) or m/N; NaN where it is none
    pole : (n,) eigenvalues, both of each pair; place (p, n) and forcing (n, p) as of `Motion`
    limits : Hz, of the oscillations that count
    """

    motion: Motion
    low: Motion
    rest: np.ndarray
    pole: np.ndarray
    place: np.ndarray
    forcing: np.ndarray
    limits: tuple[float, float]


def seen(free: Motion, limits: tuple[float, float]) -> Seen:
    """Prepare the free motion of a bogie for `least_stable` within limits (Hz)."""
    limit = MODES_UP_TO * limits[1]
    beyond = free.eigenvalue.imag >= 2.0 * np.pi * limit
    pole, place, forcing = _both(
        free.eigenvalue[beyond], free.place[:, beyond], free.forcing[beyond]
    )
    rest = (-(place[:ABSORBERS] / pole) @ forcing[:, :ABSORBERS]).real
    if np.linalg.matrix_rank(rest) < ABSORBERS:
        rest = np.full_like(rest, np.nan)
    return Seen(free, free.below(limit), rest, *_both(*free), limits)


def seen_by_absorbers(family: AbsorberFamily, known: Running, limits: tuple[float, float]) -> Seen:
    """Prepare the bogie of a family of absorbers.

    Parameters
    ----------
    family : AbsorberFamily, whose contacts count: they bear the weight of the absorbers
    known : Running, of the vehicle without absorbers
    limits : Hz, of the oscillations that count
    """
    linear = linearised(known.curve, family.contact_jacobian)
    return seen(motion(known.curve, linear, family.design), limits)


def _both(
    value: np.ndarray, place: np.ndarray, forcing: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Modes with both of each pair."""
    pair = value.imag > 0.0
    return (
        np.concatenate([value, value[pair].conj()]),
        np.hstack([place, place[:, pair].conj()]),
        np.vstack([forcing, forcing[pair].conj()]),
    )


def _few(bare: Seen, inertia: float, c_T: float, d_T: float) -> np.ndarray:
    """Eigenvalues (1/s) of the few modes with absorbers, the rest of the bogie being a spring.

    With the absorbers' angles a, the places C x of the few modes x and the stretch u of the rubber,
    R the flexibility of the rest, the torque on the places is t = R^-1 (a - C x - u), and
    I a'' = -t, d u' = t - c u.
    """
    rate, along, _, forcing = with_masses(bare.low, inertia)
    n, count = rate.shape[0], ABSORBERS
    stiff = np.linalg.inv(bare.rest)
    torque = np.hstack([-stiff @ along, stiff, np.zeros((count, count)), -stiff])
    stretch = slice(n + 2 * count, n + 3 * count)
    matrix = np.zeros((n + 3 * count, n + 3 * count))
    matrix[:n, :n] = rate
    matrix[:n] += forcing @ torque
    matrix[n : n + count, n + count : n + 2 * count] = np.eye(count)
    matrix[n + count : n + 2 * count] = -torque / inertia
    matrix[stretch] = torque / d_T
    matrix[stretch, stretch] -= c_T / d_T * np.eye(count)
    return np.linalg.eigvals(matrix)


def least_stable(bare: Seen, inertia: float, c_T: float, d_T: float) -> complex | None:
    """Eigenvalue (1/s) of largest real part of the bogie with four absorbers; None without any.

    Parameters
    ----------
    bare : Seen
    inertia : kg m^2, or kg of absorbers that translate
    c_T : N m/rad, or N/m; d_T : N m s/rad, or N s/m
    """
    found = _corrected(bare, inertia, c_T, d_T)
    if found is None:
        found = oscillations(with_absorbers(bare.motion, inertia, c_T, d_T), bare.limits)
    return complex(found[np.argmax(found.real)]) if found.size else None


def _corrected(bare: Seen, inertia: float, c_T: float, d_T: float) -> np.ndarray | None:
    """Corrected eigenvalues within the limits, the least stable among them; None if unsure."""
    if not d_T > 0.0 or np.isnan(bare.rest).any():
        return None
    low, high = bare.limits
    few = _few(bare, inertia, c_T, d_T)
    near = oscillations(few, ((1.0 - EDGE) * low, (1.0 + EDGE) * high))
    if not near.size:
        return None
    top = near.real.max()
    guess = near[near.real > top - CANDIDATES]
    exact = np.array([_root(bare, inertia, c_T, d_T, value) for value in guess])
    apart = np.abs(exact[:, None] - exact) + np.where(np.eye(exact.size), np.inf, 0.0)
    if not (np.abs(exact - guess) < LARGEST_SHIFT).all() or (apart < 1e3 * TOLERANCE).any():
        return None
    inside = oscillations(exact, bare.limits)
    # One that was left out may have come up to CANDIDATES - LARGEST_SHIFT below the top.
    sure = inside.size and inside.real.max() > top - CANDIDATES + LARGEST_SHIFT
    return inside if sure else None


def _root(bare: Seen, inertia: float, c_T: float, d_T: float, start: complex) -> complex:
    """Root of the characteristic polynomial near a start, in 1/s; NaN if Newton's method fails."""
    s = complex(start) + 1e-6j  # never a pole itself
    for _ in range(NEWTON_STEPS):
        gain = 1.0 / (s - bare.pole)
        if not np.isfinite(gain).all():
            return complex(np.nan, np.nan)
        matrix, rate = _condition(bare, inertia, c_T, d_T, s, gain)
        try:
            change = np.trace(np.linalg.solve(matrix, rate))
        except np.linalg.LinAlgError:  # the determinant is zero to the last digit: a root
            return s
        step = 1.0 / (change + gain.sum())
        s -= step
        if abs(step) < TOLERANCE * max(1.0, 1e-3 * abs(s)):
            return s
    return complex(np.nan, np.nan)


def _condition(
    bare: Seen, inertia: float, c_T: float, d_T: float, s: complex, gain: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Matrix 1 + Z P whose determinant vanishes, and its derivative in s.

    The first places carry an absorber each, the others its mass.
    """
    weighted = bare.place * gain
    answer = weighted @ bare.forcing
    answer_rate = -(weighted * gain) @ bare.forcing
    spring, mass = c_T + s * d_T, inertia * s * s
    both = mass + spring
    stiffness = np.full(len(answer), mass)
    stiffness_rate = np.full(len(answer), 2.0 * inertia * s)
    stiffness[:ABSORBERS] = mass * spring / both
    stiffness_rate[:ABSORBERS] = (2.0 * inertia * s * spring**2 + d_T * mass**2) / both**2
    matrix = np.eye(len(answer)) + stiffness[:, None] * answer
    return matrix, stiffness_rate[:, None] * answer + stiffness[:, None] * answer_rate
