"""Ride from the straight track into the curve (figure 9)."""

import logging
from typing import NamedTuple

import numpy as np

from tramdva.bogie import integration, track, wheel_forces
from tramdva.bogie.curving import Equilibrium, System
from tramdva.bogie.integration import Excitation, Passage
from tramdva.bogie.modal import ModalBasis, modal_basis, modal_state, vehicle_state
from tramdva.bogie.vehicle import frame_loads

logger = logging.getLogger(__name__)


class Ride(NamedTuple):
    """Output of a time integration.

    time : (k,) in s
    local : (k, 44), local variables of the contacts (`vehicle.LOCAL` per wheel)
    results : (k, 4, zones, columns), `integration.RECORDED` of each zone
    status : one of `integration.STATUS`; after an early end the output is NaN
    evaluations : of the contacts
    """

    time: np.ndarray
    local: np.ndarray
    results: np.ndarray
    status: str
    evaluations: int


class Route(NamedTuple):
    """The vehicle before and after the curve entry.

    line : track.TrackLine; speed in m/s; half_wheelbase in m; gravity in m/s^2
    systems, equilibria : on the straight and in the full curve
    """

    line: track.TrackLine
    speed: float
    half_wheelbase: float
    gravity: float
    systems: tuple[System, System]
    equilibria: tuple[Equilibrium, Equilibrium]


class _Section(NamedTuple):
    """Part of a ride between two corners, in intervals of the output; jump of the turning after it.

    places : (2,) m of the bogie's centre at its ends
    """

    first: int
    last: int
    places: tuple[float, float]


def no_excitation(basis: ModalBasis, contacts: wheel_forces.Contacts) -> Excitation:
    """Round wheels and no force."""
    return Excitation(
        np.zeros(0),
        np.zeros((2, 0, 4, len(contacts.tables))),
        np.zeros((2, 0, 4 * wheel_forces.LOCALS)),
        np.zeros((2, 0, 4 * wheel_forces.WHEEL_FORCES)),
        np.zeros((0, 2 * basis.eigenvalue.size)),
    )


def ride(route: Route, duration: float, interval: float, every: int, tolerance: float) -> Ride:
    """Integrate from the equilibrium on the straight track through the curve entry.

    Parameters
    ----------
    route : Route; its line starts at speed times the moment at which the bogie's centre enters
    duration : s; interval : longest step in s; every : intervals per output
    tolerance : see `integration.run`

    Notes
    -----
    Absolute velocities are continuous. Where the turning of a frame jumps, the velocities relative
    to it jump by the frame's motion the other way.
    """
    intervals = round(duration / interval)
    samples = intervals // every
    contacts = route.systems[0].contacts
    zones = len(contacts.tables)
    local = np.full((samples, 4 * wheel_forces.LOCALS), np.nan)
    results = np.full((samples, 4, zones, len(integration.RECORDED)), np.nan)
    columns = np.array(integration.RECORDED)
    work = integration.workspace(contacts)
    bases = [
        modal_basis(system, state)
        for system, state in zip(route.systems, route.equilibria, strict=True)
    ]
    state, before, worst, level, evaluations = bases[0].state, None, 0, 0, 0
    for section in _sections(route, intervals * interval, interval, every):
        entered = section.places[1] > route.line.start - route.half_wheelbase + 1e-9
        basis, system = bases[entered], route.systems[entered]
        inside = _middle(section)
        turning = _frames(route, inside).turning
        if before is not None:
            state = _after_jump(system, state, turning - before)
        passage = (
            _passage(route, section, basis, system)
            if entered
            else integration.steady(basis.eigenvalue.size, system.curvatures)
        )
        z = modal_state(basis, state)
        tables = integration.step_table(basis.eigenvalue, interval)
        part = slice(section.first // every, section.last // every)
        level, status, written, count = integration.run(
            basis.contact, contacts, passage, no_excitation(basis, contacts), tables,
            interval,
            tolerance, level, section.first * interval, z, work, local[part], results[part],
            columns, every,
        )  # fmt: skip
        evaluations += count
        worst = max(worst, status)
        logger.info(
            "%.2f s of %.2f s: %s, %d evaluations, step interval/%d",
            section.last * interval, duration, integration.STATUS[status], count, 2**level,
        )  # fmt: skip
        if status > integration.CONTACT_LOST:
            local[part.start + written :] = np.nan
            results[part.start + written :] = np.nan
            break
        state = vehicle_state(basis, z)
        before = _frames(route, inside, at_end=section).turning
    time = (np.arange(samples) + 1) * interval * every
    return Ride(time, local, results, integration.STATUS[worst], evaluations)


def _frames(route: Route, place: float, at_end: _Section | None = None) -> track.FrameMotion:
    """Frames at a place of the bogie's centre (m), or just before the end of a section."""
    if at_end is not None:
        place = at_end.places[1] - 1e-9 * max(at_end.places[1] - at_end.places[0], 1e-6)
    return track.frame_motion(route.line, place, route.half_wheelbase, route.speed)


def _middle(section: _Section) -> float:
    """Place just after the start of a section."""
    return section.places[0] + 1e-9 * max(section.places[1] - section.places[0], 1e-6)


def _sections(route: Route, duration: float, interval: float, every: int) -> list[_Section]:
    """Sections between the corners; these are moved to the nearest output."""
    places = sorted({place for place, _ in track.corners(route.line, route.half_wheelbase)})
    end = route.speed * duration
    places = [place for place in places if 0.0 < place < end]
    unit = interval * every * route.speed
    marks = [0] + [every * round(p / unit) for p in places]
    marks += [every * round(end / unit)]
    places = [0.0, *places, end]
    return [
        _Section(a, b, (p, q))
        for a, b, p, q in zip(marks[:-1], marks[1:], places[:-1], places[1:], strict=True)
        if b > a
    ]


def _after_jump(system: System, state: np.ndarray, jump: np.ndarray) -> np.ndarray:
    """State after the turning (3, 3) of the frames has jumped."""
    state = state.copy()
    state[system.size :] -= system.vehicle.frame_motion @ jump.ravel()
    return state


def _passage(route: Route, section: _Section, basis: ModalBasis, system: System) -> Passage:
    """Loads and curvatures of a section beyond those of the full curve.

    Offsets of the frames are cubic polynomials of the place between two corners: four values give
    them exactly.
    """
    shares = 0.5 - 0.5 * np.cos((2 * np.arange(4) + 1) * np.pi / 8)
    places = section.places[0] + shares * (section.places[1] - section.places[0])
    frames = [_frames(route, place) for place in places]
    loads = np.array([frame_loads(system.vehicle, f, route.gravity) for f in frames])
    modal = (loads - system.load) @ basis.load.T
    modal[:, np.abs(loads - system.load).max() * np.abs(basis.load).max(axis=1) < 1e-12] = 0.0
    coefficients = np.linalg.solve(np.vander(shares, 4, increasing=True), modal)
    curvatures = np.array([f.curvature for f in frames])
    line = np.linalg.lstsq(np.vander(shares, 2, increasing=True), curvatures, rcond=None)[0]
    packed = np.hstack([coefficients.real, coefficients.imag])
    return Passage(np.ascontiguousarray(packed), np.ascontiguousarray(line))


def contact_point_velocity(wheel_radius: float, local: np.ndarray) -> np.ndarray:
    """Lateral velocity (4, k) in m/s of the rims at the contacts, to the left positive.

    It is the velocity of the rim, not of the material that turns through the contact.
    """
    per_wheel = local.reshape(len(local), 4, wheel_forces.LOCALS)
    return (per_wheel[..., 5] + wheel_radius * per_wheel[..., 7]).T
