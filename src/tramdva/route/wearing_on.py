"""A wheel that wears on: its profile over kilometres, all orders at once, the contact as it is.

The orders of a profile change by the wear of every revolution,

    dR_n / du = - W_n(R),

u the revolutions, times the scale by which the law's wear is brought to the measured one. Steps are
of an exponential Runge-Kutta scheme: what is proportional to an order, -H_n R_n, is integrated
exactly, growth, drift and decay, the rest by the pair of P. Bogacki and L. F. Shampine (Appl. Math.
Lett. 2 (1989) 321-325) in the frame that grows and turns with H_n. H_n is that of the moment,
W_n / R_n, where most of the wear of an order goes with it, else that of small waves. Steps follow
the difference of the pair and the fastest order, never a fixed mileage.
"""

import logging
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tramdva.route.growth import peak_to_peak
from tramdva.route.nonlinear import Revolution, WearingWheel, revolution

logger = logging.getLogger(__name__)

STATUS = (
    "limit_reached",
    "saturated",
    "horizon",
    "step_limit",
    "not_periodic",
    "outside_profile",
    "not_finite",
    "no_equilibrium",
    "self_excited",
)
LARGE = 0.1  # of the largest order: those that saturation is judged by, with those that grow
STEADY = 0.02  # of the fastest growth of small waves: less is none
FAST = 0.1  # of the fastest growth: orders that may still come
COUNTED = 0.01  # of the largest order: smaller ones are not controlled to their own size
FIRST = 0.1  # e-folds or radians of the first step
LONGEST = 0.5  # e-folds of the fastest order in a step
SHORTEST = 0.05  # of the longest step; where no shorter one runs steadily, the run ends
STEADILY = (
    "periodic",
    "contact_lost",
)  # revolutions that are alike, with a wheel off the rail or not

# Stages of the pair at shares of the step, and weights of both of its results.
_AT = (0.0, 0.5, 0.75, 1.0)
_STAGE = ((), (0.5,), (0.0, 0.75), (2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0))
_ERROR = (5.0 / 72.0, -1.0 / 12.0, -1.0 / 9.0, 1.0 / 8.0)


class Bounds(NamedTuple):
    """Until when a wheel wears on, and how exactly.

    horizon : scaled revolutions; limit : m, peak to peak
    tolerance : of a step, share of an order
    most_steps : number
    """

    horizon: float
    limit: float
    tolerance: float
    most_steps: int


class Step(NamedTuple):
    """Profile at a number of scaled revolutions u.

    amplitude : (o,) complex, R_n in m; depth : (o,) complex, W_n in m; mean : m, mean depth
    response : (o,) complex, H_n with which the step from here was made
    lifts : whether the wheel leaves the rail at times
    """

    u: float
    amplitude: np.ndarray
    depth: np.ndarray
    mean: float
    response: np.ndarray
    lifts: bool


class WornOn(NamedTuple):
    """How a wheel wore on: its steps, revolutions that were simulated, `STATUS` of the end."""

    orders: np.ndarray
    steps: list[Step]
    evaluations: int
    status: str

    @property
    def end(self) -> float:
        """Scaled revolutions to the end of the run."""
        return self.steps[-1].u

    def at(self, u: np.ndarray) -> np.ndarray:
        """Complex amplitudes (k, o) in m at scaled revolutions (k,) within the run.

        Cubic between two steps, in the frame of the response.
        """
        starts = np.array([step.u for step in self.steps])
        out = np.empty((len(u), self.orders.size), complex)
        for row, value in enumerate(np.asarray(u, float)):
            place = int(np.clip(np.searchsorted(starts, value, "right") - 1, 0, starts.size - 1))
            if place + 1 == starts.size:
                out[row] = self.steps[-1].amplitude
            else:
                out[row] = _between(self.steps[place], self.steps[place + 1], value)
        return out

    def mean_depth(self, u: np.ndarray) -> np.ndarray:
        """Mean loss of radius (k,) in m after scaled revolutions (k,)."""
        starts = np.array([step.u for step in self.steps])
        rate = np.array([step.mean for step in self.steps])
        lost = np.append(0.0, np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(starts)))
        return np.interp(u, starts, lost)

    def lifts_from(self) -> float:
        """Scaled revolutions from which the wheel leaves the rail at times, or NaN."""
        return next((step.u for step in self.steps if step.lifts), np.nan)

    def reaches(self, limit: float) -> float:
        """Scaled revolutions at which the profile first is `limit` (m) peak to peak, or NaN."""
        if peak_to_peak(self.orders, self.steps[0].amplitude) >= limit:
            return 0.0
        for before, after in zip(self.steps[:-1], self.steps[1:], strict=True):
            u = np.linspace(before.u, after.u, 9)
            over = np.flatnonzero(peak_to_peak(self.orders, self.at(u)) >= limit)
            if over.size:
                place = int(over[0])
                return self._bisected(limit, u[max(place - 1, 0)], u[place])
        return np.nan

    def _bisected(self, limit: float, low: float, high: float) -> float:
        while high - low > 1e-6 * high:
            middle = 0.5 * (low + high)
            value = peak_to_peak(self.orders, self.at(np.array([middle])))[0]
            low, high = (low, middle) if value >= limit else (middle, high)
        return float(high)


def _frame(response: np.ndarray, u: float) -> np.ndarray:
    """Growth and turn exp(-H u) of the orders; bounded, for orders that die out at once."""
    x = -response * u
    return np.exp(np.clip(x.real, -200.0, 200.0) + 1j * x.imag)


def _between(before: Step, after: Step, u: float) -> np.ndarray:
    """Amplitudes at u between two steps."""
    h = after.u - before.u
    t = (u - before.u) / h
    fits = np.abs(before.response.real) * h < 20.0  # else the frame holds nothing of the end
    response = np.where(fits, before.response, 1j * before.response.imag)
    back = _frame(response, -h)
    start, end = before.amplitude, after.amplitude * back
    first = response * before.amplitude - before.depth
    last = (response * after.amplitude - after.depth) * back
    inner = (1.0 - 2.0 * t) * (end - start) + (t - 1.0) * h * first + t * h * last
    return _frame(response, t * h) * ((1.0 - t) * start + t * end + t * (t - 1.0) * inner)


def wear_on(
    wheel: WearingWheel,
    orders: np.ndarray,
    initial: np.ndarray,
    response: np.ndarray,
    bounds: Bounds,
) -> WornOn:
    """Wear a wheel on from a profile.

    Parameters
    ----------
    wheel : WearingWheel
    orders : (o,) whole numbers; initial : (o,) complex, R_n in m
    response : (o,) complex, H_n of small waves
    bounds : Bounds

    Notes
    -----
    It is saturated where neither the large orders nor those that small waves let grow, grow any
    more.
    """
    state = np.zeros(2 * wheel.bogie.eigenvalue.size)

    def worn(amplitude: np.ndarray) -> Revolution:
        return revolution(wheel, orders, amplitude, state)

    return worn_on(worn, orders, initial, response, bounds)


def worn_on(
    worn: Callable[[np.ndarray], Revolution],
    orders: np.ndarray,
    initial: np.ndarray,
    response: np.ndarray,
    bounds: Bounds,
) -> WornOn:
    """Wear a profile on by any wear of a revolution; parameters as in `wear_on`."""
    fastest = max(float(-response.real.min()), 1e-3 * np.abs(response).max(), 1e-300)
    longest = LONGEST / fastest
    h = min(FIRST / np.abs(response).max(), longest)
    first = worn(initial)
    if first.status not in STEADILY:
        start = Step(0.0, initial, first.depth, first.mean, response, lifts=False)
        return WornOn(orders, [start], 1, first.status)
    steps = [_step(0.0, initial, first, response)]
    evaluations = 1
    while True:
        now = steps[-1]
        if status := _ended(now, response, fastest, bounds, len(steps)):
            return WornOn(orders, steps, evaluations, status)
        if peak_to_peak(orders, now.amplitude) >= bounds.limit:
            return WornOn(orders, steps, evaluations, "limit_reached")
        h = min(h, longest, bounds.horizon - now.u)
        amplitude, found, error, count = _pair(worn, now, h, bounds.tolerance)
        evaluations += count
        if found.status not in STEADILY:
            if h < SHORTEST * longest:
                return WornOn(orders, steps, evaluations, found.status)
            h *= 0.25
            continue
        if error <= 1.0:
            steps.append(_step(now.u + h, amplitude, found, response))
            logger.info("%.4g scaled revolutions, step %.2g: %.3g um", now.u + h, h,
                        1e6 * np.abs(amplitude).max())  # fmt: skip
        h *= float(np.clip(0.9 * max(error, 1e-6) ** (-1.0 / 3.0), 0.2, 3.0))


def _step(u: float, amplitude: np.ndarray, found: Revolution, small: np.ndarray) -> Step:
    """Step whose response is that of the moment where an order's wear goes with the order."""
    own = np.abs(found.depth - small * amplitude) < np.abs(small * amplitude)
    moment = found.depth / np.where(own, amplitude, 1.0)
    lifts = found.status == "contact_lost"
    return Step(u, amplitude, found.depth, found.mean, np.where(own, moment, small), lifts)


def _pair(
    worn: Callable[[np.ndarray], Revolution], now: Step, h: float, tolerance: float
) -> tuple[np.ndarray, Revolution, float, int]:
    """A step of the pair: profile, its wear, error over the tolerance, evaluations."""
    rest = [now.response * now.amplitude - now.depth]
    amplitude, found = now.amplitude, Revolution(now.depth, now.mean, 0.0, "periodic")
    for stage in (1, 2, 3):
        at, weights = _AT[stage], _STAGE[stage]
        amplitude = _frame(now.response, at * h) * now.amplitude
        for begun, weight, value in zip(_AT, weights, rest, strict=False):
            amplitude = amplitude + h * weight * _frame(now.response, (at - begun) * h) * value
        found = worn(amplitude)
        if found.status not in STEADILY:
            return amplitude, found, np.inf, stage
        rest.append(now.response * amplitude - found.depth)
    error = sum(
        weight * _frame(now.response, (1.0 - begun) * h) * value
        for begun, weight, value in zip(_AT, _ERROR, rest, strict=True)
    )
    size = np.abs(amplitude)
    allowed = tolerance * np.maximum(size, COUNTED * size.max())
    return amplitude, found, float((h * np.abs(error) / allowed).max()), 3


def _ended(now: Step, small: np.ndarray, fastest: float, bounds: Bounds, steps: int) -> str:
    """Status of the end, or nothing."""
    if now.u >= bounds.horizon * (1.0 - 1e-9):
        return "horizon"
    size = np.abs(now.amplitude)
    rate = -(now.depth / np.where(size > 0.0, now.amplitude, 1.0)).real
    large = size >= LARGE * size.max()
    may_come = -small.real >= FAST * fastest
    grows = rate[large | may_come] > STEADY * fastest
    if not grows.any() and (np.abs(rate[large]) < STEADY * fastest).all():
        return "saturated"
    return "step_limit" if steps > bounds.most_steps else ""


def own_rates(
    worn: Callable[[np.ndarray], Revolution], now: Step, chosen: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Rates (o,) at which orders change in all, and by what is proportional to them.

    Parameters
    ----------
    worn : wear of a revolution by a profile
    now : Step
    chosen : (k,) places of the orders that are examined; the others are NaN

    Returns
    -------
    total, own : complex, per scaled revolution

    Notes
    -----
    What wears a wheel in an order that it does not have is the others' doing: harmonics and
    combinations that the contact makes. The rest of the order's wear goes with the order.
    """
    total, own = np.full((2, now.amplitude.size), np.nan + 0j)
    for place in chosen:
        without = now.amplitude.copy()
        without[place] = 0.0
        driven = worn(without).depth[place]
        total[place] = -now.depth[place] / now.amplitude[place]
        own[place] = -(now.depth[place] - driven) / now.amplitude[place]
    return total, own


def step_at(
    worn: Callable[[np.ndarray], Revolution], run: WornOn, u: float, small: np.ndarray
) -> Step:
    """Profile and its wear at scaled revolutions u within a run; `small`: H_n of small waves."""
    amplitude = run.at(np.array([u]))[0]
    return _step(u, amplitude, worn(amplitude), small)
