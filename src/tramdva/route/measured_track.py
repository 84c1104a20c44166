"""Alignment of a track out of GPS runs over it, with how sure its radii are.

Places err by metres, so that a curvature from neighbours is noise. Straight pieces and arcs are
found coarsely in the heading and then fitted, curve by curve, to the places of all runs; what the
fit leaves says how far places err, and the least squares how much of that a radius takes.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy

from tramdva.route.alignment import Alignment, Stretch
from tramdva.route.passes import SAME_LENGTH, headings
from tramdva.route.safe_xml import RouteFileError
from tramdva.route.tracks import Run

STEP = 2.0  # m
BLUR = 5.0  # m, over which curvature is averaged when curves are sought
FLATTEST = 1.0 / 250.0  # 1/m, below which a piece counts as straight
SHORTEST = 8.0  # m
LEAST_TURN = math.radians(6.0)
MOST_CURVES = 150
MOST_POINTS = 6000
SHARPEST = 10.0  # m
FARTHEST = 10.0  # m, along the track, between a place by distance and the nearest one
LEAST_LENGTH = 1.0  # m, of a piece that is kept
LEAST_TRACK = 50.0  # m
UNSURE = 5.0  # standard deviation over curvature of what is no curve
APART = 15.0  # m, of straight track between curves that are fitted apart
WINDOW = 60.0  # m, of straight track beside curves that counts for them


class MeasuredTrack(NamedTuple):
    """An alignment out of places.

    alignment : Alignment, arcs and straight pieces only
    uncertainty : of the radius of each stretch, share of it (one standard deviation); 0 straight
    noise : m, by which places err across it (rms)
    runs : as they run over it, from its start to its end
    """

    alignment: Alignment
    uncertainty: tuple[float, ...]
    noise: float
    runs: tuple[Run, ...]


def measured_track(runs: Sequence[Run], origin: str) -> MeasuredTrack:
    """Fit an alignment to runs with points; the longest is the track, others go along it.

    Raises
    ------
    RouteFileError
        Where there are too many curves, or the fit fails.
    """
    longest = max(runs, key=lambda run: run.place[-1])
    if longest.place[-1] < LEAST_TRACK:
        raise RouteFileError(
            f"{origin}: the longest run is {longest.place[-1]:.0f} m; {LEAST_TRACK:g} m at least"
        )
    along, notes = _along(longest, runs)
    mean = _mean_run(along)
    edges, curvature = _pieces(mean)
    if (curvature != 0.0).sum() > MOST_CURVES:
        raise RouteFileError(
            f"{origin}: has more than {MOST_CURVES} curves; divide it into parts of the route"
        )
    pieces = _fitted(mean, along, edges, curvature)
    stretches, share = _joined(pieces)
    errors = [piece.noise for piece in pieces if piece.curvature]
    noise = float(np.median(errors)) if errors else math.nan
    if errors:
        notes.append(f"places err by {noise:.1f} m (rms) across the curves that fit them")
    alignment = Alignment("track of the log", stretches, np.zeros((0, 2)), tuple(notes))
    scale = alignment.length / longest.place[-1]
    return MeasuredTrack(
        alignment, share, noise, tuple(run._replace(place=scale * run.place) for run in along)
    )


class _Piece(NamedTuple):
    """An arc or a straight piece: m, 1/m, standard deviation of it, noise of its places in m."""

    length: float
    curvature: float
    spread: float
    noise: float


def _fitted(mean: Run, runs: Sequence[Run], edges, curvature) -> list[_Piece]:
    """Pieces, curve by curve: those that are near each other together.

    Windows reach to the middle of the straight pieces beside: an error there concerns no other.
    """
    place = np.concatenate([run.place for run in runs])
    points = np.concatenate([run.points for run in runs])
    _, heading = headings(mean, STEP)
    pieces, gone = [], 0.0
    for first, last in _clusters(edges, curvature):
        begin = max(0.5 * (edges[first - 1] + edges[first]), edges[first] - WINDOW, gone)
        end = min(0.5 * (edges[last + 1] + edges[last + 2]), edges[last + 1] + WINDOW)
        inside = np.flatnonzero((place >= begin) & (place <= end))
        chosen = inside[np.linspace(0, inside.size - 1, min(inside.size, MOST_POINTS)).astype(int)]
        at = min(int(begin / STEP), heading.size - 1)
        start = np.array([*mean.points[at], heading[at]])
        start[:2] += (begin - STEP * at) * _way(heading[at])
        cuts = np.concatenate([[begin], edges[first : last + 2], [end]])
        bent = np.concatenate([[0.0], curvature[first : last + 1], [0.0]])
        fit = _fit(cuts, bent, start, place[chosen], points[chosen])
        pieces.append(_Piece(begin - gone, 0.0, 0.0, 0.0))
        if fit is None:
            pieces.append(_Piece(end - begin, 0.0, 0.0, 0.0))
        else:
            rows = zip(np.diff(fit.edges), fit.curvature, fit.spread, strict=True)
            pieces += [_Piece(*map(float, row), fit.noise) for row in rows]
        gone = end
    return [*pieces, _Piece(edges[-1] - gone, 0.0, 0.0, 0.0)]


def _clusters(edges: np.ndarray, curvature: np.ndarray) -> list[tuple[int, int]]:
    """First and last pieces of curves without a long straight piece between them."""
    found: list[list[int]] = []
    for piece in np.flatnonzero(curvature):
        if found and edges[piece] - edges[found[-1][1] + 1] < APART:
            found[-1][1] = int(piece)
        else:
            found.append([int(piece), int(piece)])
    return [(first, last) for first, last in found]


def _joined(pieces: Sequence[_Piece]) -> tuple[tuple[Stretch, ...], tuple[float, ...]]:
    """Stretches, straight neighbours as one, and the share by which each radius is unsure."""
    stretches: list[Stretch] = []
    shares: list[float] = []
    for piece in pieces:
        if piece.length <= 0.0:
            continue
        if piece.curvature == 0.0 and stretches and stretches[-1].start == 0.0:
            stretches[-1] = Stretch(stretches[-1].length + piece.length, 0.0, 0.0)
            continue
        stretches.append(Stretch(piece.length, piece.curvature, piece.curvature))
        shares.append(piece.spread / abs(piece.curvature) if piece.curvature else 0.0)
    return tuple(stretches), tuple(shares)


def _along(longest: Run, runs: Sequence[Run]) -> tuple[list[Run], list[str]]:
    """Runs over the track of the longest, turned its way and stretched to its length."""
    found, other = [], 0
    whole = longest.place[-1]
    reach = max(30.0, 0.05 * whole)
    for run in runs:
        if abs(run.place[-1] / whole - 1.0) > SAME_LENGTH:
            other += 1
            continue
        ways = [run, run.reversed()]
        far = [np.hypot(*_at_shares(way) - _at_shares(longest)).max() for way in ways]
        way = ways[int(np.argmin(far))]
        if min(far) > reach:
            other += 1
            continue
        found.append(way._replace(place=way.place * (whole / way.place[-1])))
    return found, [f"{other} runs over other tracks are left out"] if other else []


def _at_shares(run: Run) -> np.ndarray:
    """Points (2, 9) at equal shares of a run's length."""
    place = np.linspace(0.0, run.place[-1], 9)
    return np.array([np.interp(place, run.place, run.points[:, k]) for k in range(2)])


def _pieces(mean: Run) -> tuple[np.ndarray, np.ndarray]:
    """Edges (n + 1,) and curvature (n,) of straight pieces and curves by turns.

    Sought in the mean of the runs: single ones are too rough for their headings.
    """
    place, heading = headings(mean, STEP)
    curvature = scipy.ndimage.gaussian_filter1d(np.gradient(heading, STEP), BLUR / STEP)
    kind = np.where(np.abs(curvature) < FLATTEST, 0, np.sign(curvature)).astype(int)
    marks = [0, *(1 + np.flatnonzero(np.diff(kind))), kind.size]
    cuts, turns = [0.0], []
    for first, last in itertools.pairwise(marks):
        begin, end = place[first], place[min(last, kind.size - 1)]
        turned = heading[min(last, kind.size - 1)] - heading[first]
        if kind[first] == 0 or end - begin < SHORTEST or abs(turned) < LEAST_TURN:
            continue
        inside = min(6.0, 0.25 * (end - begin))  # blur lengthens a curve by about this
        turns += [0.0, turned / (end - begin - 2.0 * inside)]
        cuts += [max(begin + inside, cuts[-1] + 1.0), end - inside]
    turns.append(0.0)
    cuts.append(max(mean.place[-1], cuts[-1] + 1.0))
    return np.array(cuts), np.array(turns)


def _mean_run(runs: Sequence[Run]) -> Run:
    """Mean track of runs along each other, averaged over some metres."""
    place = np.arange(0.0, runs[0].place[-1], STEP)
    tracks = [
        np.column_stack([np.interp(place, run.place, run.points[:, k]) for k in range(2)])
        for run in runs
    ]
    points = np.mean(tracks, axis=0)
    slope = (points[-1] - points[0]) / max(place[-1], STEP)  # keeps the ends where they are
    bent = points - points[0] - place[:, None] * slope
    bent = scipy.ndimage.gaussian_filter1d(bent, 0.8 * BLUR / STEP, axis=0, mode="nearest")
    return Run(place, np.zeros(place.size - 1), points[0] + place[:, None] * slope + bent)


def positions(
    place: np.ndarray, edges: np.ndarray, curvature: np.ndarray, start: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Points (k, 2) and headings (k,) at places (k,) of arcs and straight pieces.

    Parameters
    ----------
    place : m; edges : (n + 1,) m; curvature : (n,) 1/m; start : x, y, heading of the first
    """
    length = np.diff(edges)
    heading = start[2] + np.concatenate([[0.0], np.cumsum(curvature * length)])
    middle = heading[:-1] + 0.5 * curvature * length
    chord = length * np.sinc(0.5 * curvature * length / np.pi)
    corner = start[:2] + np.concatenate(
        [np.zeros((1, 2)), np.cumsum(chord[:, None] * _way(middle), axis=0)]
    )
    number = np.clip(np.searchsorted(edges, place, side="right") - 1, 0, curvature.size - 1)
    gone, bent = place - edges[number], curvature[number]
    chord = gone * np.sinc(0.5 * bent * gone / np.pi)
    points = corner[number] + chord[:, None] * _way(heading[number] + 0.5 * bent * gone)
    return points, heading[number] + bent * gone


def _way(heading: np.ndarray) -> np.ndarray:
    return np.stack([np.cos(heading), np.sin(heading)], axis=-1)


def _beside(points, place, edges, curvature, start) -> tuple[np.ndarray, np.ndarray]:
    """Distances (k,) of points from the nearest places of the track, and along it, m."""
    nearest = place
    for _ in range(3):
        track, heading = positions(nearest, edges, curvature, start)
        along = np.sum((points - track) * _way(heading), axis=1)
        nearest = nearest + np.clip(along, -FARTHEST, FARTHEST)
    track, heading = positions(nearest, edges, curvature, start)
    across = np.sum((points - track) * _way(heading + 0.5 * np.pi), axis=1)
    return across, nearest - place


class _Fit(NamedTuple):
    """Pieces by least squares: edges, curvature, standard deviations of it, noise in m."""

    edges: np.ndarray
    curvature: np.ndarray
    spread: np.ndarray
    noise: float


def _fit(edges, curvature, start, place, points) -> _Fit | None:
    """Fit pieces, and leave out those that come to nothing; None without a fit."""
    for _ in range(MOST_CURVES):
        fit, start = _fit_pieces(edges, curvature, start, place, points)
        length, turn = np.diff(fit.edges), np.abs(fit.curvature) * np.diff(fit.edges)
        nothing = length < LEAST_LENGTH
        unsure = fit.spread > UNSURE * np.abs(fit.curvature)
        nothing |= (curvature != 0.0) & ((turn < 0.5 * LEAST_TURN) | unsure)
        nothing |= np.abs(fit.curvature) > 1.0 / SHARPEST
        nothing[[0, -1]] &= curvature[[0, -1]] != 0.0
        if not nothing.any():
            return fit
        worst = int(np.argmin(np.where(nothing, length, np.inf)))
        edges, curvature = _without(worst, fit.edges, fit.curvature)
        if not curvature.any():
            return None
    return None


def _without(piece: int, edges: np.ndarray, curvature: np.ndarray):
    """Pieces without one, which its neighbours take; straight neighbours become one."""
    middle = 0.5 * (edges[piece] + edges[piece + 1])
    edges = np.maximum.accumulate(np.concatenate([edges[:piece], [middle], edges[piece + 2 :]]))
    edges += 0.01 * np.arange(edges.size)  # none is empty
    curvature = np.delete(curvature, piece)
    twins = 1 + np.flatnonzero((curvature[1:] == 0.0) & (curvature[:-1] == 0.0))
    return np.delete(edges, twins), np.delete(curvature, twins)


def _fit_pieces(edges, curvature, start, place, points) -> tuple[_Fit, np.ndarray]:
    """Least squares of the distances from the track; unknown are start, ends and curvatures."""
    curves, inner = np.flatnonzero(curvature != 0.0), edges.size - 2

    def unpacked(unknown):
        bent = np.zeros(curvature.size)
        bent[curves] = unknown[3 + inner :]
        return np.concatenate([edges[:1], unknown[3 : 3 + inner], edges[-1:]]), bent

    def residual(unknown):
        cuts, bent = unpacked(unknown)
        across, along = _beside(points, place, np.maximum.accumulate(cuts), bent, unknown[:3])
        return np.append(across, 0.1 * along.mean())  # else the track may slide along itself

    unknown = np.concatenate([start, edges[1:-1], curvature[curves]])
    sharpest = np.full(curves.size, 1.5 / SHARPEST)
    low = np.concatenate([np.full(3, -np.inf), np.full(inner, edges[0]), -sharpest])
    high = np.concatenate([np.full(3, np.inf), np.full(inner, edges[-1]), sharpest])
    room = 1e-3 * np.minimum(high - low, 1.0)
    found = scipy.optimize.least_squares(
        residual, np.clip(unknown, low + room, high - room), x_scale="jac", max_nfev=60,
        bounds=(low, high),
    )  # fmt: skip
    cuts, bent = unpacked(found.x)
    left = found.fun[:-1]
    spread = np.zeros(curvature.size)
    spread[curves] = _standard_deviations(found.jac, left)[3 + inner :]
    return _Fit(cuts, bent, spread, float(np.sqrt(np.mean(left**2)))), found.x[:3]


def _standard_deviations(jacobian: np.ndarray, left: np.ndarray) -> np.ndarray:
    """Of the unknowns; errors of places that follow each other are alike, which counts less.

    Notes
    -----
    With a correlation r of successive errors k places tell as much as k (1 - r) / (1 + r).
    """
    total = np.sum(left**2)
    variance = total / max(left.size - jacobian.shape[1], 1)
    alike = np.sum(left[1:] * left[:-1]) / total if total > 0.0 else 0.0
    alike = min(max(alike, 0.0), 0.98)
    variance *= (1.0 + alike) / (1.0 - alike)
    return np.sqrt(variance * np.diag(np.linalg.pinv(jacobian.T @ jacobian)).clip(0.0))
