"""Plots of absorber designs for pages in a browser. For scripts in `paper_figures/`.

A source named `now` is filled by the page's script with what belongs to the chosen design, `place`
marks this design among all, and cells of `designs` can be clicked.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from bokeh.models import (
    BasicTicker,
    ColorBar,
    ColorMapper,
    ColumnDataSource,
    FixedTicker,
    LinearColorMapper,
    LogColorMapper,
    NumeralTickFormatter,
    Range1d,
)
from bokeh.palettes import Blues9, Cividis256, OrRd9
from bokeh.plotting import figure

GROWTH_TICKS = (-30, -10, -3, 0, 1, 3)
GROWTH_END = 30.0  # 1/s
SIGNED = [*Blues9[:7], *reversed(OrRd9[1:8])]  # stable, then unstable
UNSTABLE = "#b9bec4"
OWN, NOW, WITHOUT = "#b3261e", "#0550ae", "#1b1f24"


class Grid:
    """The designs of a model in the units of its axes.

    Parameters
    ----------
    found : mapping
        ``c_T``, ``d_T``, ``m_T`` and, each with ``own_`` and ``best_`` before it, ``c_T`` and
        ``d_T`` of a result file, SI.
    look : mapping
        Divisor and unit of the stiffness ``c`` and of the damping ``d``.
    """

    def __init__(
        self, found: Mapping[str, np.ndarray], look: Mapping[str, tuple[float, str]]
    ) -> None:
        self.look = look
        self.c_T, self.d_T = found["c_T"] / look["c"][0], found["d_T"] / look["d"][0]
        self.own, self.best = (_place(found, which) for which in ("own", "best"))
        inertia = float(found["m_T"])
        self.tuned = np.sqrt(found["c_T"] / inertia) / (2.0 * np.pi)
        critical = 2.0 * np.sqrt(found["c_T"] * inertia)
        self.damping_ratio = found["d_T"][:, None] / critical

    def data(self) -> dict[str, Any]:
        """What the sliders need; no best design where there is none."""
        stiffness, damping = self.look["c"][1], self.look["d"][1]
        return {
            "x": self.c_T.tolist(),
            "y": self.d_T.tolist(),
            "stiffness": [f"{value:.3g} {stiffness}" for value in self.c_T],
            "tuned": [f"tuned to {value:.1f} Hz" for value in self.tuned],
            "damping": [f"{value:.3g} {damping}" for value in self.d_T],
            "ratio": [[f"damping ratio {v:.3f}" for v in values] for values in self.damping_ratio],
            "own": self.own,
            "best": self.best,
        }

    def edges(self) -> tuple[np.ndarray, np.ndarray]:
        """Limits of the cells around the designs."""
        return tuple(_edges(axis) for axis in (self.c_T, self.d_T))


def _place(found: Mapping[str, np.ndarray], which: str) -> list[int] | None:
    """Row and column of a design of the file."""
    if np.isnan(found[f"{which}_c_T"]):
        return None
    return [int(np.flatnonzero(found[k] == found[f"{which}_{k}"])[0]) for k in ("d_T", "c_T")]


def _edges(axis: np.ndarray) -> np.ndarray:
    inner = np.sqrt(axis[1:] * axis[:-1])
    return np.concatenate([[axis[0] ** 2 / inner[0]], inner, [axis[-1] ** 2 / inner[-1]]])


def canvas(x: str, y: str, height: int, **options: Any) -> figure:
    """Empty plot that takes the width it is given."""
    plot = figure(
        height=height, sizing_mode="stretch_width", x_axis_label=x, y_axis_label=y,
        min_width=0, **({"tools": "", "toolbar_location": None} | options),
    )  # fmt: skip
    for axis in plot.axis:
        axis.axis_label_text_font_style = "normal"
    return plot


def design_axes(grid: Grid) -> figure:
    """Plot of all designs: stiffness across, damping up, in equal ratios."""
    plot = canvas(
        f"absorber stiffness c_T ({grid.look['c'][1]})",
        f"absorber damping d_T ({grid.look['d'][1]})",
        320, x_axis_type="log", y_axis_type="log",
    )  # fmt: skip
    for axis, values in zip((plot.xaxis, plot.yaxis), grid.edges(), strict=True):
        axis.ticker = FixedTicker(ticks=round_values(values[0], values[-1]))
        axis.formatter = NumeralTickFormatter(format="0.[000]")
    x, y = grid.edges()
    plot.x_range, plot.y_range = Range1d(x[0], x[-1]), Range1d(y[0], y[-1])
    plot.grid.visible = False
    return plot


def round_values(low: float, high: float) -> list[float]:
    """Numbers 1, 2, 5 times powers of ten between limits."""
    exponents = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    values = [digit * 10.0**k for k in exponents for digit in (1, 2, 5)]
    return [value for value in values if low <= value <= high]


def cells(plot: figure, grid: Grid, values: np.ndarray, mapper: ColorMapper) -> None:
    """Draw a clickable cell per design, and the marks of the line's and of this design."""
    x, y = grid.edges()
    rows, columns = np.indices(values.shape)
    source = ColumnDataSource(
        {
            "left": x[columns].ravel(), "right": x[columns + 1].ravel(),
            "bottom": y[rows].ravel(), "top": y[rows + 1].ravel(),
            "value": values.ravel().astype(np.float32),
        },
        name="designs",
    )  # fmt: skip
    colour = {"field": "value", "transform": mapper}
    plot.quad(
        "left", "right", "top", "bottom", source=source, fill_color=colour, line_color=colour,
        line_width=0.6, nonselection_fill_alpha=1.0, nonselection_line_alpha=1.0,
    )  # fmt: skip
    plot.add_tools("tap")
    i, j = grid.own
    mark = {"line_color": "white", "line_width": 1.0}
    plot.scatter([grid.c_T[j]], [grid.d_T[i]], marker="star", size=17, color=OWN, **mark)
    place = ColumnDataSource({"x": [grid.c_T[j]], "y": [grid.d_T[i]]}, name="place")
    for width, colour in ((5.0, "white"), (2.5, NOW)):
        plot.scatter(
            "x", "y", source=place, marker="circle", size=19, fill_color=None,
            line_color=colour, line_width=width,
        )  # fmt: skip


def plane(grid: Grid, values: np.ndarray) -> figure:
    """Draw a value of every design; where there is none, grey."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.1, 1.0)
    colours = {"palette": Cividis256[::-1], "nan_color": UNSTABLE}
    if low > 0.0 and high > 3.0 * low:
        mapper = LogColorMapper(low=low, high=high, **colours)
        ticker = FixedTicker(ticks=round_values(low, high))
    else:
        mapper = LinearColorMapper(low=low, high=max(high, low + 1e-6), **colours)
        ticker = BasicTicker()
    plot = design_axes(grid)
    cells(plot, grid, values, mapper)
    bar = ColorBar(
        color_mapper=mapper, ticker=ticker, width=10,
        formatter=NumeralTickFormatter(format="0.[000]"),
    )  # fmt: skip
    plot.add_layout(bar, "right")
    return plot


def signed_colours() -> LinearColorMapper:
    """Colours of growth rates by their signed root: blue below zero, red above."""
    return LinearColorMapper(palette=SIGNED, low=-1.0, high=1.0, nan_color=UNSTABLE)


def growth_bar(mapper: LinearColorMapper) -> ColorBar:
    """Scale of the growth rate in 1/s."""
    places = {float(np.sign(g) * np.sqrt(abs(g) / GROWTH_END)): f"{g}" for g in GROWTH_TICKS}
    return ColorBar(
        color_mapper=mapper, width=10, ticker=FixedTicker(ticks=list(places)),
        major_label_overrides=places,
    )  # fmt: skip


def three_curves(
    plot: figure, frequency: np.ndarray, own: np.ndarray, none: np.ndarray, legend: str
) -> None:
    """Curves over the frequency; that of this design is filled by the page's script."""
    plot.line(frequency, none, color=WITHOUT, line_dash="dashed", line_width=1.4,
              legend_label="no absorber")  # fmt: skip
    plot.line(frequency, own, color=OWN, line_width=1.4, legend_label="line's absorber")
    source = ColumnDataSource({"x": frequency, "y": np.full(frequency.size, np.nan)}, name="now")
    plot.line("x", "y", source=source, color=NOW, line_width=2.4, legend_label="this design")
    plot.x_range = Range1d(float(frequency[0]), float(frequency[-1]))
    plot.add_tools("box_zoom", "reset")
    plot.toolbar_location, plot.toolbar_inner = "above", True
    plot.toolbar.logo, plot.toolbar.autohide = None, True
    plot.legend.location = legend
    plot.legend.background_fill_alpha = 0.7
    plot.legend.label_text_font_size = "11px"
    plot.legend.padding = 4
    plot.legend.spacing = 0
