"""Simulation of the bogie in its curve with wheels out of round by one order (Peng's step 2)."""

import logging
from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from tramdva.bogie import integration, wheel_forces
from tramdva.bogie.integration import Excitation
from tramdva.bogie.names import LOCAL
from tramdva.bogie.rough_wheels import RoughBogie, excitation

logger = logging.getLogger(__name__)

STATUS = (
    "periodic",
    "not_periodic",
    "contact_lost",
    "outside_profile",
    "not_finite",
    "no_equilibrium",
    "self_excited",
)
SLOWEST = 2.0 * np.pi  # 1/s, of an oscillation; slower motions are no vibration
# Velocities among the local variables: they weigh all frequencies alike, positions do not.
_RATES = np.tile([name.startswith("v") or name.endswith("rate") for name in LOCAL], 4)


class Settings(NamedTuple):
    """How a wave is simulated.

    samples : per revolution; kept : revolutions in the output
    longest_transient : revolutions before them at most
    tolerance : share of the response by which a revolution may differ from its limit
    step_tolerance : of the integration per interval, share of the wave's velocity
    """

    samples: int
    kept: int
    longest_transient: int
    tolerance: float
    step_tolerance: float


class WaveRun(NamedTuple):
    """Whole revolutions of the contacts in steady running.

    time : (k,) s, since the wheel angle was zero at the start of a revolution
    results : (k, 4, zones, columns), `integration.RECORDED` of each zone
    transient : revolutions before the output
    difference : between the last revolution and its limit, share of the response
    status : one of `STATUS`
    """

    time: np.ndarray
    results: np.ndarray
    transient: int
    difference: float
    status: str


def simulate_wave(
    contacts: wheel_forces.Contacts,
    bogie: RoughBogie,
    wheel_radius: float,
    order: float,
    amplitude: complex,
    wheels: Collection[str],
    settings: Settings,
) -> WaveRun:
    """Simulate wheels with a wave of one order until they run steadily, then keep revolutions.

    Parameters
    ----------
    contacts : wheel_forces.Contacts
    bogie : RoughBogie
    wheel_radius : m
    order : waves around the wheel; amplitude : complex, R_n in m
    wheels : names of the wheels out of round
    settings : Settings

    Notes
    -----
    The run starts with the linear response to the wave about the curving equilibrium, so that only
    what the contacts do beyond it must settle. Whether it has, is measured: revolutions
    differ by d_1, d_2, ... With their ratio q (of the slowest decay) the last one differs from its
    limit by d q / (1 - q).

    A vehicle that vibrates by itself never settles: `hindrance` tells before.
    """
    speed = contacts.places.speed
    excited = excitation(bogie, wheel_radius, order, speed, amplitude, wheels)
    turn = 2.0 * np.pi * wheel_radius / speed
    velocity = abs(amplitude) * float(excited.angular_frequency[0])
    return run_steadily(contacts, bogie, excited, turn, velocity, settings)


def run_steadily(
    contacts: wheel_forces.Contacts,
    bogie: RoughBogie,
    excited: Excitation,
    turn: float,
    velocity: float,
    settings: Settings,
    start: np.ndarray | None = None,
) -> WaveRun:
    """Simulate waves on the wheels until they run steadily, then keep revolutions.

    Parameters
    ----------
    contacts : wheel_forces.Contacts
    bogie : RoughBogie
    excited : Excitation, periodic with a revolution
    turn : s, of a revolution
    velocity : m/s of the waves, by which the tolerance of the steps is measured
    settings : Settings
    start : (2 m,) deviation from the linear response at the start of a revolution, near that of the
        steady running if it is known; advanced to the end of the run
    """
    z = np.zeros(2 * bogie.eigenvalue.size) if start is None else start
    finest = settings.step_tolerance * velocity
    one = _Revolution(contacts, bogie, excited, turn, settings.samples, finest)
    kept, lost, differences, before = [], [], [], None
    for number in range(settings.longest_transient + settings.kept):
        local, results, status = one.run(z, number)
        if status > integration.CONTACT_LOST:
            return _failed(one, [*kept, results], number, integration.STATUS[status])
        if before is not None:
            differences.append(_difference(local, before))
        before = local
        kept = [*kept, results][-settings.kept :]
        lost = [*lost, status == integration.CONTACT_LOST][-settings.kept :]
        remaining = _remaining(differences)
        logger.info("revolution %d: %.1e from its limit", number + 1, remaining)
        if number + 1 > settings.kept and remaining < settings.tolerance:
            break
    status = "contact_lost" if any(lost) else "periodic"
    if remaining >= settings.tolerance:
        status = "not_periodic"
    return WaveRun(
        one.times(len(kept)), np.concatenate(kept), number + 1 - len(kept), remaining, status
    )


def _failed(one: "_Revolution", kept: list[np.ndarray], number: int, status: str) -> WaveRun:
    results = np.concatenate(kept)
    return WaveRun(one.times(len(kept)), np.full_like(results, np.nan), number, np.nan, status)


def hindrance(bogie: RoughBogie, converged: bool) -> str:
    """Why no order can run periodically: `no_equilibrium`, `self_excited`, or nothing.

    Parameters
    ----------
    bogie : RoughBogie
        Linearised in its curve; one that vibrates by itself answers no wave steadily, which its
        eigenvalues tell before minutes of simulation do.
    converged : bool
        Whether it has an equilibrium there.
    """
    if not converged or not np.isfinite(bogie.eigenvalue).all():
        return "no_equilibrium"
    oscillating = np.abs(bogie.eigenvalue.imag) >= SLOWEST
    return "self_excited" if (bogie.eigenvalue.real[oscillating] >= 0.0).any() else ""


def not_run(
    contacts: wheel_forces.Contacts, wheel_radius: float, settings: Settings, status: str
) -> WaveRun:
    """A run that was not made: its times, NaN, and the status that says why.

    Parameters are those of `simulate_wave`.
    """
    turn, count = 2.0 * np.pi * wheel_radius / contacts.places.speed, settings.samples
    times = (np.arange(settings.kept * count) + 1) * (turn / count)
    shape = times.size, 4, len(contacts.tables), len(integration.RECORDED)
    return WaveRun(times, np.full(shape, np.nan), 0, np.nan, status)


class _Revolution:
    """Integration over whole revolutions."""

    def __init__(self, contacts, bogie: RoughBogie, excited, turn, samples, tolerance):
        self.contacts, self.bogie, self.excited = contacts, bogie, excited
        self.turn, self.samples = turn, samples
        self.interval = turn / samples
        self.passage = integration.steady(bogie.eigenvalue.size, bogie.curvatures)
        self.tables = integration.step_table(bogie.eigenvalue, self.interval)
        self.tolerance = tolerance
        self.work, self.level = integration.workspace(contacts), 0

    def run(self, z: np.ndarray, number: int) -> tuple[np.ndarray, np.ndarray, int]:
        """Advance z by a revolution: local variables, results, status."""
        columns = np.array(integration.RECORDED)
        local = np.empty((self.samples, 4 * wheel_forces.LOCALS))
        results = np.empty((self.samples, 4, len(self.contacts.tables), columns.size))
        self.level, status, _, _ = integration.run(
            self.bogie.modal, self.contacts, self.passage, self.excited, self.tables,
            self.interval, self.tolerance, self.level, number * self.turn, z, self.work, local,
            results, columns, 1,
        )  # fmt: skip
        return local, results, status

    def times(self, revolutions: int) -> np.ndarray:
        """Times of the output, which holds the ends of the intervals."""
        return (np.arange(revolutions * self.samples) + 1) * self.interval


def _difference(local: np.ndarray, before: np.ndarray) -> float:
    """Share of the response by which two revolutions differ."""
    rates, earlier = local[:, _RATES], before[:, _RATES]
    response = np.linalg.norm(rates - rates.mean(axis=0))
    return float(np.linalg.norm(rates - earlier) / max(response, np.finfo(float).tiny))


def _remaining(differences: list[float]) -> float:
    """Difference from the limit: of two differences a geometric sequence, of one itself."""
    if not differences:
        return np.inf
    last = differences[-1]
    if len(differences) == 1:
        return last
    ratio = min(last / max(differences[-2], np.finfo(float).tiny), 0.999)
    return max(last * ratio / (1.0 - ratio), 0.1 * last)
