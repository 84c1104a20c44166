"""Alignment of a track: its elements, its plan, and the sections of a route that it makes.

Curvature is positive to the left; along an element it is constant or, in a transition, linear.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tramdva.route.parameters import RouteSection

STRAIGHTEST = 1e5  # m, radius from which on a curve is straight track
SHORTEST = 0.1  # m, section of a route
PLAN_STEP = 5.0  # m, between points of the plan of a route
SIGN = {"left": 1.0, "right": -1.0, "straight": 0.0}


class Stretch(NamedTuple):
    """An element of an alignment: length in m, curvature in 1/m at its start and its end."""

    length: float
    start: float
    end: float


class Alignment(NamedTuple):
    """Elements of a track in the order of its stations.

    name : as in the file
    stretches : Stretch
    cant : (k, 2) places from the start and cant, m; none of them: unknown
    notes : what had to be assumed, a line each
    """

    name: str
    stretches: tuple[Stretch, ...]
    cant: np.ndarray
    notes: tuple[str, ...]

    @property
    def length(self) -> float:
        """Length of the track in m."""
        return sum(stretch.length for stretch in self.stretches)


class TrackSection(NamedTuple):
    """A section as a route has it.

    turn : left, right or straight; radius : m, infinite on straight track
    length : m without transitions; transition : m, mean of that before and that behind
    cant : m, outer rail above the inner one
    start, end : m along the alignment, transitions included
    """

    turn: str
    radius: float
    length: float
    transition: float
    cant: float
    start: float
    end: float


def curvature_at(alignment: Alignment, place: np.ndarray) -> np.ndarray:
    """Curvature (k,) in 1/m at places (k,) in m from the start."""
    ends = np.cumsum([stretch.length for stretch in alignment.stretches])
    number = np.minimum(np.searchsorted(ends, place, side="right"), ends.size - 1)
    length, start, end = np.array(alignment.stretches).T
    share = np.clip((place - ends[number] + length[number]) / length[number], 0.0, 1.0)
    return start[number] + share * (end - start)[number]


def plan(alignment: Alignment, step: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Plan of the track: it starts at the origin along x.

    Parameters
    ----------
    alignment : Alignment
    step : m, largest distance of the points

    Returns
    -------
    place : (k,) m along the track, the ends of all stretches among them
    points : (k, 2) x, y in m
    """
    nodes, weights = np.polynomial.legendre.leggauss(6)
    places, points = [0.0], [np.zeros(2)]
    heading, here, gone = 0.0, np.zeros(2), 0.0
    for length, start, end in alignment.stretches:
        turn = abs(start) + abs(end)
        count = max(1, math.ceil(length / step), math.ceil(length * turn / 0.2))
        edges = np.linspace(0.0, length, count + 1)
        half = 0.5 * (edges[1:] - edges[:-1])
        along = 0.5 * (edges[1:] + edges[:-1])[:, None] + half[:, None] * nodes
        angle = heading + start * along + 0.5 * (end - start) / length * along**2
        pieces = np.stack([np.cos(angle) @ weights, np.sin(angle) @ weights], axis=1)
        track = here + np.cumsum(pieces * half[:, None], axis=0)
        places.extend(gone + edges[1:])
        points.extend(track)
        heading += 0.5 * (start + end) * length
        here, gone = track[-1], gone + length
    return np.array(places), np.array(points)


def plan_of_route(
    sections: Sequence[RouteSection],
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Plan of the way there of a route, which begins at the origin along x.

    Parameters
    ----------
    sections : in their order; transitions are clothoids outside of the length of a curve

    Returns
    -------
    x, y : (k,) m; section : (k,) number of the section of each point
    """
    parts = [_stretches(section) for section in sections]
    stretches = tuple(one for part in parts for one in part)
    place, points = plan(Alignment("", stretches, np.zeros((0, 2)), ()), PLAN_STEP)
    ends = np.cumsum([sum(one.length for one in part) for part in parts])
    # A point belongs to the section that ends there or behind it.
    section = np.searchsorted(ends * (1.0 + 1e-12), place)
    return points[:, 0], points[:, 1], np.minimum(section, len(parts) - 1)


def _stretches(section: RouteSection) -> list[Stretch]:
    """Elements of a section: the curve or straight piece between its transitions."""
    curvature = SIGN[section.turn] / (section.radius_m or np.inf)
    body = Stretch(section.length_m, curvature, curvature)
    if curvature == 0.0 or section.transition_m == 0.0:
        return [body]
    ramp = section.transition_m
    return [Stretch(ramp, 0.0, curvature), body, Stretch(ramp, curvature, 0.0)]


def sections_of(alignment: Alignment) -> list[TrackSection]:
    """Sections of a route, each a curve with its transitions or straight track.

    Notes
    -----
    A transition that ends straight belongs to the curve at its other end; one between two curves
    belongs to both by halves. Neighbours of the same curvature are one section.
    """
    bodies: list[dict] = []
    place = 0.0
    for stretch in alignment.stretches:
        for length, curvature, role in _parts(stretch):
            if bodies and _joins(bodies[-1], curvature, role):
                own = bodies[-1]
                own[role] += length
                own["end"] = place + length
                own["body_met"] |= role != "before"
            else:
                own = {"curvature": curvature, "before": 0.0, "body": 0.0, "behind": 0.0}
                own |= {"start": place, "end": place + length, "body_met": role != "before"}
                own[role] = length
                bodies.append(own)
            place += length
    return [_section(alignment, body) for body in _long_enough(bodies)]


def _parts(stretch: Stretch) -> list[tuple[float, float, str]]:
    """Parts of a stretch: length, curvature of the section that it belongs to, and as what."""
    length, start, end = stretch
    flat = 1.0 / STRAIGHTEST
    start, end = (0.0 if abs(value) <= flat else value for value in (start, end))
    if start == end:
        return [(length, start, "body")]
    if start == 0.0:
        return [(length, end, "before")]
    if end == 0.0:
        return [(length, start, "behind")]
    if start * end > 0.0:
        return [(0.5 * length, start, "body"), (0.5 * length, end, "body")]
    first = length * abs(start) / (abs(start) + abs(end))  # up to where it is straight
    return [(first, start, "behind"), (length - first, end, "before")]


def _joins(last: dict, curvature: float, role: str) -> bool:
    """Whether a part continues the section before it: not where a curve begins anew."""
    same = math.isclose(last["curvature"], curvature, rel_tol=1e-6, abs_tol=1e-12)
    begun = last["body_met"] if role == "before" else last["behind"] > 0.0 and role == "body"
    return same and not begun


def _long_enough(bodies: list[dict]) -> list[dict]:
    """Give a curve that is all transition a body, and short sections to their neighbours."""
    kept: list[dict] = []
    for body in bodies:
        missing = SHORTEST - body["body"]
        if missing > 0.0 and body["before"] + body["behind"] > missing:
            share = missing / (body["before"] + body["behind"])
            body["before"] *= 1.0 - share
            body["behind"] *= 1.0 - share
            body["body"] = SHORTEST
        elif missing > 0.0 and kept:
            kept[-1]["body"] += body["body"]
            kept[-1]["end"] = body["end"]
            continue
        kept.append(body)
    if len(kept) > 1 and kept[0]["body"] < SHORTEST:
        kept[1]["body"] += kept[0]["body"]
        kept[1]["start"] = kept[0]["start"]
        del kept[0]
    return kept


def _section(alignment: Alignment, body: dict) -> TrackSection:
    curvature = body["curvature"]
    if curvature == 0.0:
        turn, radius = "straight", math.inf
    else:
        turn, radius = ("left" if curvature > 0.0 else "right"), 1.0 / abs(curvature)
    middle = body["start"] + body["before"] + 0.5 * body["body"]
    cant = 0.0
    if alignment.cant.size and curvature != 0.0:
        cant = float(np.interp(middle, alignment.cant[:, 0], alignment.cant[:, 1]))
    transition = 0.5 * (body["before"] + body["behind"])
    return TrackSection(turn, radius, body["body"], transition, cant, body["start"], body["end"])
