"""Speeds in the sections of a track, out of the runs over it.

Every run counts alike, and in it every metre: a wheel wears by distance. The scatter holds what
differs between the runs and what changes within a section, without what errors of places add.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tramdva.route.alignment import Alignment, TrackSection, curvature_at
from tramdva.route.tracks import Run

SAME_LENGTH = 0.15  # by which the length of a run may differ from that of its track
COVERED = 0.5  # of a section that a run has to pass


class SectionSpeed(NamedTuple):
    """Speed in a section.

    mean, scatter : m/s, over all runs and metres; NaN where no run passes
    between : m/s, standard deviation of the means of the runs
    runs : that pass
    """

    mean: float
    scatter: float
    between: float
    runs: int


def on_alignment(runs: Sequence[Run], alignment: Alignment) -> tuple[list[Run], list[str]]:
    """Runs with places as the track has them, and what was done to them.

    Notes
    -----
    A run with points covers the track from end to end: its distances are stretched to the track's
    length, and it is turned round where that fits the curves better. That of an odometer counts
    from the start of the track as it is.
    """
    found, notes = [], []
    scales = []
    for run in runs:
        if run.points is None:
            found.append(run)
            continue
        scale = alignment.length / run.place[-1] if run.place[-1] > 0.0 else math.inf
        if abs(scale - 1.0) > SAME_LENGTH:
            notes.append(
                f"a run of {run.place[-1]:.0f} m is left out: "
                f"the track has {alignment.length:.0f} m"
            )
            continue
        scales.append(scale)
        run = run._replace(place=scale * run.place)
        turned = run.reversed()
        fits_better = _likeness(turned, alignment) > _likeness(run, alignment)
        found.append(turned if fits_better else run)
    if scales:
        notes.append(
            f"{len(scales)} runs matched by distance, stretched by "
            f"{100.0 * (min(scales) - 1.0):+.1f} to {100.0 * (max(scales) - 1.0):+.1f} %"
        )
    beyond = [run for run in found if run.points is None and run.place[-1] > alignment.length + 1.0]
    if beyond:
        longest = max(run.place[-1] for run in beyond)
        notes.append(f"logs go on to {longest:.0f} m; the track ends at {alignment.length:.0f} m")
    return found, notes


def headings(run: Run, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Places at equal steps (m) and the heading (rad, unwrapped) of a run there."""
    moving = np.concatenate([[True], np.diff(run.place) > 0.0])
    place, points = run.place[moving], run.points[moving]
    grid = np.arange(0.0, place[-1], step)
    reach = 10.0  # m behind and ahead: places err by metres
    ahead, behind = (
        np.column_stack([np.interp(grid + way, place, points[:, k]) for k in range(2)])
        for way in (reach, -reach)
    )
    chord = ahead - behind
    return grid, np.unwrap(np.arctan2(chord[:, 1], chord[:, 0]))


def _likeness(run: Run, alignment: Alignment) -> float:
    """Correlation of the curvature of a run with that of the track."""
    grid, heading = headings(run, 5.0)
    if grid.size < 4:
        return 0.0
    told = np.gradient(heading, grid)
    track = curvature_at(alignment, grid)
    scale = np.linalg.norm(told) * np.linalg.norm(track)
    return float(told @ track / scale) if scale > 0.0 else 0.0


def speeds_of(runs: Sequence[Run], sections: Sequence[TrackSection]) -> list[SectionSpeed]:
    """Speed in each section by all runs that pass at least half of it."""
    means, squares = (np.full((len(runs), len(sections)), np.nan) for _ in range(2))
    starts = np.array([section.start for section in sections])
    ends = np.array([section.end for section in sections])
    for row, run in enumerate(runs):
        steps = np.diff(run.place)
        first, last = np.clip(starts, *run.place[[0, -1]]), np.clip(ends, *run.place[[0, -1]])
        passed = last - first
        enough = passed >= COVERED * (ends - starts)
        passed = np.where(enough & (passed > 0.0), passed, np.nan)
        noise = 0.0 if run.noise is None else run.noise
        for out, each in ((means, run.speed), (squares, run.speed**2 - noise)):
            total = np.concatenate([[0.0], np.cumsum(each * steps)])
            change = np.interp(last, run.place, total) - np.interp(first, run.place, total)
            out[row] = change / passed
    return [_speed(*pair) for pair in zip(means.T, squares.T, strict=True)]


def _speed(means: np.ndarray, squares: np.ndarray) -> SectionSpeed:
    there = ~np.isnan(means)
    if not there.any():
        return SectionSpeed(math.nan, math.nan, math.nan, 0)
    between = float(means[there].std())
    within = max(float((squares - means**2)[there].mean()), 0.0)  # noise may outweigh it
    scatter = math.hypot(math.sqrt(within), between)
    return SectionSpeed(float(means[there].mean()), scatter, between, int(there.sum()))
