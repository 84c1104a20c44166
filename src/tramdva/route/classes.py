"""Running conditions of a route, and how often each wheel meets them.

Sections that are run alike fall into one class: the vehicle is computed once for each. A wheel of
the vehicle meets a class in several places of the bogie: a left and a right curve swap the sides,
and where the tram reverses at its ends, the axle that leads becomes the one that trails.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from tramdva.bogie.names import WHEELS
from tramdva.route.parameters import RouteSection

# Wheels as they stay on the vehicle: sides seen from its end A, which leads on the way there.
OWN_WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
TURNED = {"left": "right", "right": "left", "straight": "straight"}


class RunningClass(NamedTuple):
    """Conditions in which the vehicle runs; a curve is computed as one to the left.

    curvature : 1/m, 0 on straight track; cant : m, outer rail above the inner one
    speed : m/s, mean; scatter : its standard deviation, share of the mean
    friction : mu_0, or NaN for the line's; flange_wear_share : of flange contacts
    """

    curvature: float
    cant: float
    speed: float
    scatter: float
    friction: float
    flange_wear_share: float


class Passage(NamedTuple):
    """A passage of a section.

    running : its place among the classes; section : its place in the route
    turn : as the tram runs; leading : end of the vehicle that leads, A or B
    length : m in a lap
    """

    running: int
    section: int
    turn: str
    leading: str
    length: float


def class_of(section: RouteSection) -> RunningClass:
    """Class of a section, in SI units."""
    straight = section.radius_m is None
    return RunningClass(
        0.0 if straight else 1.0 / section.radius_m,
        0.0 if straight else 1e-3 * section.cant_mm,
        section.speed_km_h / 3.6,
        1e-2 * section.speed_scatter_percent,
        np.nan if section.friction is None else section.friction,
        section.flange_wear_share,
    )


def _key(running: RunningClass) -> tuple[float, ...]:
    """Conditions that are alike to six digits are the same."""
    return tuple(float(f"{value:.6g}") if np.isfinite(value) else -1.0 for value in running)


def _ways(way: str, ends: str) -> Iterator[tuple[bool, str]]:
    """Whether the sections are run backwards, and the end that leads."""
    yield False, "A"
    if way == "there_and_back":
        yield True, "B" if ends == "reverse" else "A"


def classes_of(
    sections: Sequence[RouteSection], way: str, ends: str
) -> tuple[list[RunningClass], list[Passage]]:
    """Classes of a route, and its passages.

    Parameters
    ----------
    sections : of the way there
    way : ``there_and_back`` or ``lap``
    ends : ``reverse`` or ``loop``

    Notes
    -----
    A transition counts as half of its length in the curve: its mean curvature is half.
    """
    known: dict[tuple[float, ...], int] = {}
    found: list[RunningClass] = []
    passages = []
    for place, section in enumerate(sections):
        running = class_of(section)
        number = known.setdefault(_key(running), len(found))
        if number == len(found):
            found.append(running)
        transitions = 0.0 if section.radius_m is None else section.transition_m
        length = section.passages_per_lap * (section.length_m + transitions)
        for backwards, leading in _ways(way, ends):
            turn = TURNED[section.turn] if backwards else section.turn
            passages.append(Passage(number, place, turn, leading, length))
    return found, passages


def places_of_wheels(turn: str, leading: str) -> list[int]:
    """Places (4,) in `names.WHEELS` where the wheels `OWN_WHEELS` run.

    Parameters
    ----------
    turn : left, right or straight, as the tram runs; on straight track as to the left
    leading : end that leads, A or B
    """
    outer = "left" if turn == "right" else "right"  # seen in the direction of running
    places = []
    for wheel in OWN_WHEELS:
        axle, side = wheel.split("_")
        if leading == "B":  # the vehicle is turned round
            axle = {"front": "rear", "rear": "front"}[axle]
            side = TURNED[side]
        places.append(WHEELS.index(f"{axle}_{'outer' if side == outer else 'inner'}"))
    return places


def lap_length(passages: Iterable[Passage]) -> float:
    """Length of a lap in m."""
    return sum(passage.length for passage in passages)


class Case(NamedTuple):
    """A class as the vehicle meets it.

    running : place among the classes
    turn : left, right or straight, as the tram runs; leading : end that leads, A or B
    share : of the distance
    """

    running: int
    turn: str
    leading: str
    share: float

    @property
    def places(self) -> list[int]:
        """Places (4,) in `names.WHEELS` of the vehicle's own wheels."""
        return places_of_wheels(self.turn, self.leading)


def cases_of(passages: Sequence[Passage]) -> list[Case]:
    """Cases of a lap in the order in which they are met first."""
    length = lap_length(passages)
    share: dict[tuple[int, str, str], float] = {}
    for one in passages:
        met = one.running, one.turn, one.leading
        share[met] = share.get(met, 0.0) + one.length / length
    return [Case(*met, part) for met, part in share.items()]
