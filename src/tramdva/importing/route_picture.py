"""Picture of a route that was read: its plan by curvature, and the speeds along it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.style
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from tramdva.report.figures import canvas
from tramdva.results import atomically
from tramdva.route.alignment import Alignment, curvature_at, plan

WIDTH, HEIGHT = 174.0, 120.0  # mm
STRONGEST = 0.04  # 1/m, where the colours end
COLOURS = "coolwarm"  # left and right


def save(path: Path, alignment: Alignment, rows: Sequence[Any]) -> None:
    """Draw a route as PNG.

    Parameters
    ----------
    path : of the picture
    alignment : Alignment
    rows : sections with their speeds, km/h, and scatter, %
    """
    with mpl.style.context(["default", {"font.size": 8}]):
        figure = canvas(WIDTH, HEIGHT)
        figure.set_layout_engine("constrained")
        above, below = figure.subplots(2, 1, height_ratios=(3, 2))
        _draw_plan(figure, above, alignment)
        _draw_speeds(below, alignment, rows)
        with atomically(path) as part:
            figure.savefig(part, format="png", dpi=200, metadata={"Title": "route as read"})


def _draw_plan(figure: Any, axes: Any, alignment: Alignment) -> None:
    place, points = plan(alignment, step=max(1.0, alignment.length / 20_000))
    middle = curvature_at(alignment, 0.5 * (place[1:] + place[:-1]))
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    limit = min(max(np.abs(middle).max(), 1e-3), STRONGEST)
    lines = LineCollection(
        pieces, array=middle, cmap=COLOURS, norm=Normalize(-limit, limit), linewidths=2.0
    )
    axes.add_collection(LineCollection(pieces, colors="0.5", linewidths=3.0))  # seen where straight
    axes.add_collection(lines)
    axes.plot(*points[0], "o", color="black", markersize=4)
    axes.annotate("start", points[0], xytext=(4, 4), textcoords="offset points")
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale()
    axes.set_xlabel("m")
    axes.set_ylabel("m")
    figure.colorbar(lines, ax=axes, label="curvature (1/m), left above 0", extend="both")


def _draw_speeds(axes: Any, alignment: Alignment, rows: Sequence[Any]) -> None:
    edges = np.array([row.section.start for row in rows] + [alignment.length])
    speed = np.array([row.speed for row in rows])
    half = 0.01 * np.array([row.scatter for row in rows]) * speed
    axes.stairs(speed + half, edges, baseline=speed - half, fill=True, color="0.8", lw=0)
    axes.stairs(speed, edges, baseline=None, color="black", lw=1.0)
    curved = np.array([row.section.turn != "straight" for row in rows])
    for first, last in zip(edges[:-1][curved], edges[1:][curved], strict=True):
        axes.axvspan(first, last, color="C1", alpha=0.15, lw=0)
    axes.set_xlim(0.0, alignment.length)
    axes.set_ylim(0.0, 1.15 * float((speed + half).max()))
    axes.set_xlabel("distance (m); curves shaded; mean speed and scatter")
    axes.set_ylabel("speed (km/h)")
