"""Interactive explorer: what any absorber does to stability, response and wheel orders.

One page that holds its data and the plotting library. The page of a report is opened as a data
address, of which Chromium takes 2 MB: so all parts are compressed.
"""

import html
import json
import logging
from pathlib import Path

import bokeh
import bokeh.embed
import contourpy
import numpy as np
from bokeh.models import (
    BasicTicker,
    BasicTickFormatter,
    ColorBar,
    ColumnDataSource,
    FixedTicker,
    LinearAxis,
    LinearColorMapper,
    LogColorMapper,
    NumeralTickFormatter,
    Range1d,
    Span,
)
from bokeh.palettes import Blues9, Cividis256, OrRd9
from bokeh.plotting import figure

from tramdva import figures, job, packing, results
from tramdva.figures import KILO, MEGA

FOLDER = Path(__file__).parent
LIBRARY = Path(bokeh.__file__).parent / "server/static/js/bokeh.min.js"
OPENS_IN_REPORT = 1_500_000  # bytes; in base 64 Chromium's 2 MB
MM_PER_KN = 1e-6  # m/N
STEPS = 1e-3  # of a receptance's logarithm
GROWTH = {"step": 0.02, "kind": "asinh", "scale": 0.02}  # of a growth rate in 1/s
TENDENCY_STEP = 5e-4  # of the largest without absorber
FINER = 5  # cells that are drawn per cell of the stability map, between computed values
GROWTH_TICKS = (-30, -10, -3, 0, 1, 3)
GROWTH_END = 30.0  # 1/s
SIGNED = [*Blues9[:7], *reversed(OrRd9[1:8])]  # stable, then unstable
UNSTABLE = "#b9bec4"
OWN, NOW, WITHOUT = "#b3261e", "#0550ae", "#1b1f24"
WHEELSET = {
    "stable": ("good", "Stable: does not vibrate by itself at B = {B:g} s/m"),
    "oscillatory": ("bad", "Unstable: vibrates by itself at B = {B:g} s/m"),
    "monotone": ("bad", "Unstable: leaves steady rolling at B = {B:g} s/m"),
    "no_equilibrium": ("bad", "There is no steady rolling in this curve"),
}
BOGIE = {
    "stable": ("good", "Stable: does not vibrate by itself at B = {B:g} s/m"),
    "self_excited": ("bad", "Unstable: vibrates by itself at B = {B:g} s/m"),
    "no_oscillation": ("bad", "No oscillation was found in the band of self-excitation"),
    "no_equilibrium": ("bad", "No equilibrium in the curve was found"),
}
UNITS = {
    "rotation": ("kg m²", "kN m/rad", "N m s/rad"),
    "translation": ("kg", "kN/m", "N s/m"),
}


def main(*, page: str, code: str, cfg: dict, wheelset_designs: str, bogie_designs: str) -> None:
    """Write the page.

    Parameters
    ----------
    page : str
        The page as HTML.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line, friction decreases, motion of the bogie's absorber, band of design.
    wheelset_designs, bogie_designs : str
        Result files.
    """
    parts = [
        wheelset_part(cfg, results.read(wheelset_designs)),
        bogie_part(cfg, results.read(bogie_designs)),
    ]
    text = filled(cfg["label"], parts)
    if len(text.encode()) > OPENS_IN_REPORT:
        logging.getLogger(__name__).warning(
            "the page has %d kB: Chromium does not open it within a report; as a file it works",
            len(text.encode()) // 1000,
        )
    with results.atomically(page) as part:
        part.write_text(text, encoding="utf-8")


def filled(label: str, parts: list[dict]) -> str:
    """Fill the parts of both models into the page; the label may hold anything."""
    data = json.dumps({part["name"]: part["data"] for part in parts}, allow_nan=False)
    blobs = {
        "library": packing.deflated(LIBRARY.read_bytes()),
        "data": packing.deflated(data.encode()),
    }
    text = (FOLDER / "explorer.html").read_text(encoding="utf-8")
    for name, content in {
        "style": (FOLDER / "explorer.css").read_text(encoding="utf-8"),
        "sections": "\n".join(part["section"] for part in parts),
        "data": json.dumps(blobs),
        "script": (FOLDER / "explorer.js").read_text(encoding="utf-8"),
        "title": f"Absorber explorer: {html.escape(label)}",
        "label": html.escape(label),  # last: a label cannot stand for another part
    }.items():
        text = text.replace(f"@{name}@", content)
    return text


# ---------------------------------------------------------------------------------- the wheelset


def wheelset_part(cfg: dict, found: dict[str, np.ndarray]) -> dict:
    """Section and data of the basic model."""
    peak = found["peak_receptance"] / MM_PER_KN
    stable = found["instability"] == "stable"
    steady = np.isfinite(peak)
    look = {"c": (MEGA, "MN/m"), "d": (KILO, "kN s/m"), "m": "kg"}
    grid = Grid(found, look)
    reduction = np.where(stable, found["none_peak_receptance"] / MM_PER_KN / peak, np.nan)
    quiet = cfg["forced_excitation"]["B"]
    data = {
        **grid.data(np.where(stable & steady, peak, np.inf)),
        **verdicts(found["instability"], WHEELSET, cfg["creep_force"]["B"]),
        "notes": [
            "",
            f"No steady response: the wheelset vibrates by itself at B = {quiet:g} s/m as well.",
        ],
        "note": np.where(steady, 0, 1).tolist(),
        "rows": [
            row("growth rate", "1/s", "{:+.2f}", found["growth_rate"], found["none_growth_rate"]),
            row("its frequency", "Hz", "{:.1f}", found["leading_frequency"],
                found["none_leading_frequency"]),
            row("largest receptance", "mm/kN", "{:.3f}", peak,
                found["none_peak_receptance"] / MM_PER_KN),
            row("its frequency", "Hz", "{:.1f}", found["peak_frequency"],
                found["none_peak_frequency"]),
            row("reduction", "times", "{:.2f}", reduction, np.nan),
        ],
        "curves": [
            {
                "plot": "wheelset_response",
                "array": packing.pack(
                    found["receptance_amplitude"] / MM_PER_KN, STEPS, (2, 2, 1), "log"
                ),
            }
        ],
        "images": [
            {
                "plot": "wheelset_stability",
                "array": packing.pack(found["map_growth_rate"], differences=(1, 2, 3), **GROWTH),
                "finer": FINER,
                "end": GROWTH_END,
            }
        ],
        "plots": {
            "wheelset_plane": item(
                plane(grid, np.where(stable, peak, np.nan), "largest receptance (mm/kN)", stable)
            ),
            "wheelset_stability": item(stability(found)),
            "wheelset_response": item(response(grid, found)),
        },
    }  # fmt: skip
    figures_ = [
        frame("wheelset_plane", "All designs: largest receptance",
              "★ line's absorber · ○ this design · grey: vibrates by itself"),
        frame("wheelset_stability", f"Stability with this design, B = {cfg['creep_force']['B']:g} s/m",
              "Red: vibrates by itself · + wheelset of the line · dashed: boundary without absorber"),
        frame("wheelset_response", f"Receptance of the rim, B = {quiet:g} s/m", "", wide=True),
    ]  # fmt: skip
    title = f"Wheelset: absorber of {float(found['m_T']):g} kg"
    return {
        "name": "wheelset",
        "data": data,
        "section": section("wheelset", title, "lowest receptance", "", figures_),
    }


def stability(found: dict[str, np.ndarray]) -> figure:
    """Map of the growth rate over the wheelset's stiffnesses, filled by the page's script."""
    c_R, c_A = found["c_R"] / MEGA, found["c_A"] / MEGA
    plot = canvas("wheel stiffness c_R (MN/m)", "axle stiffness c_A (MN/m)", 320)
    size = [FINER * (axis.size - 1) + 1 for axis in (c_A, c_R)]
    steps = [np.ptp(axis) / (count - 1) for axis, count in zip((c_A, c_R), size, strict=True)]
    box = {
        "x": [c_R[0] - 0.5 * steps[1]], "dw": [steps[1] * size[1]],
        "y": [c_A[0] - 0.5 * steps[0]], "dh": [steps[0] * size[0]],
    }  # fmt: skip
    source = ColumnDataSource({"image": [np.zeros(size, np.float32)], **box}, name="now")
    mapper = signed_colours()
    plot.image("image", "x", "y", "dw", "dh", source=source, color_mapper=mapper)
    plot.x_range, plot.y_range = Range1d(c_R[0], c_R[-1]), Range1d(c_A[0], c_A[-1])
    growth = found["none_map_growth_rate"].T  # (c_A, c_R)
    lines = contourpy.contour_generator(c_R, c_A, np.ma.masked_invalid(growth)).lines(0.0)
    plot.multi_line(
        [line[:, 0] for line in lines], [line[:, 1] for line in lines],
        color=WITHOUT, line_width=1.5, line_dash="dashed",
    )  # fmt: skip
    plot.scatter(
        found["baseline_c_R"] / MEGA, found["baseline_c_A"] / MEGA,
        marker="cross", size=14, line_width=2.5, color=WITHOUT,
    )  # fmt: skip
    plot.add_layout(growth_bar(mapper), "right")
    return plot


def response(grid: "Grid", found: dict[str, np.ndarray]) -> figure:
    """Receptance with this design, the line's and none."""
    plot = canvas("frequency (Hz)", "receptance (mm/kN)", 260, y_axis_type="log")
    three_curves(
        plot,
        found["frequency"],
        found["receptance_amplitude"][grid.own] / MM_PER_KN,
        found["none_receptance_amplitude"] / MM_PER_KN,
    )
    plot.yaxis.formatter = BasicTickFormatter()
    return plot


# ------------------------------------------------------------------------------------- the bogie


def bogie_part(cfg: dict, found: dict[str, np.ndarray]) -> dict:
    """Section and data of the bogie."""
    inertia, stiffness, damping = UNITS[cfg["bogie"]["absorber"]["motion"]]
    grid = Grid(found, {"c": (KILO, stiffness), "d": (1.0, damping), "m": inertia})
    stable = found["self_excitation"] == "stable"
    quiet, band = cfg["forced_excitation"]["B"], cfg["study"]["design_band"]
    limits = f"{band['min']:g} to {band['max']:g} Hz"
    shown = np.where(stable[..., None], found["band_factor"], np.nan)
    worst = shown.max(axis=-1)
    scale = np.array([unit_of(curve) for curve in found["none_tendency"]])
    relative = found["tendency"] / scale[:, None]
    names = [str(name).replace("_", " ") for name in found["wheel"]]
    plots = {
        "bogie_plane": item(plane(grid, worst, "worst wheel, over no absorber", stable)),
        "bogie_growth": item(growth_plane(grid, found["growth_rate"])),
        **{
            f"bogie_tendency_{w}": item(tendency(grid, found, relative, scale, w))
            for w in range(len(names))
        },
    }
    data = {
        **grid.data(np.where(np.isfinite(worst), worst, np.inf)),
        **verdicts(found["self_excitation"], BOGIE, cfg["creep_force"]["B"]),
        "notes": [
            "",
            f"No steady wear: the bogie vibrates by itself at B = {quiet:g} s/m as well, "
            "or has no equilibrium.",
        ],
        "note": np.where(found["quiet_self_excitation"] == "stable", 0, 1).tolist(),
        "rows": [
            row("growth rate", "1/s", "{:+.2f}", found["growth_rate"], found["none_growth_rate"]),
            row("its frequency", "Hz", "{:.1f}", found["leading_frequency"],
                found["none_leading_frequency"]),
            *(
                row(f"tendency left, {name}", limits, "{:.2f}", shown[..., w],
                    1.0 if found["band_status"][w] == "found" else np.nan)
                for w, name in enumerate(names)
            ),
        ],
        "curves": [
            {
                "plot": f"bogie_tendency_{w}",
                "array": packing.pack(relative[:, :, w], TENDENCY_STEP, (2, 2, 1)),
            }
            for w in range(len(names))
        ],
        "images": [],
        "plots": plots,
    }  # fmt: skip
    marks = "★ line's absorbers · ○ this design"
    figures_ = [
        frame("bogie_plane", f"All designs: largest tendency in {limits}, share left",
              f"{marks} · grey: vibrates by itself"),
        frame("bogie_growth", f"All designs: growth rate at B = {cfg['creep_force']['B']:g} s/m",
              f"{marks} · red: vibrates by itself"),
        *(
            frame(f"bogie_tendency_{w}", f"Evolution tendency, {name} wheel, B = {quiet:g} s/m",
                  "Above zero waves grow · shaded: band of design · 1 is the largest without absorber")
            for w, name in enumerate(names)
        ),
    ]  # fmt: skip
    title = f"Bogie: four absorbers of {float(found['m_T']):g} {inertia}"
    return {
        "name": "bogie",
        "data": data,
        "section": section("bogie", title, "least tendency", limits, figures_, band),
    }


def unit_of(curve: np.ndarray) -> float:
    """Largest absolute value of a curve, 1 where there is none."""
    largest = np.abs(curve[np.isfinite(curve)]).max(initial=0.0)
    return float(largest) if largest > 0.0 else 1.0


def tendency(grid: "Grid", found: dict, relative: np.ndarray, scale: np.ndarray, wheel: int):
    """Evolution tendency of one wheel with this design, the line's and none."""
    plot = canvas("frequency (Hz)", "tendency (1 = largest without)", 280)
    none = found["none_tendency"][wheel] / scale[wheel]
    three_curves(plot, found["frequency"], relative[grid.own][wheel], none)
    plot.add_layout(Span(location=0, dimension="width", line_color="#8c959f", level="underlay"))
    known = [values[np.isfinite(values)] for values in (relative[:, :, wheel], none)]
    ends = np.concatenate([np.array([-0.1, 0.1]), *known])
    plot.y_range = Range1d(max(1.08 * ends.min(), -1.6), min(1.08 * ends.max(), 1.6))
    order = found["order"]
    plot.extra_x_ranges = {"order": Range1d(order[0], order[-1])}
    plot.add_layout(LinearAxis(x_range_name="order", axis_label="order"), "above")
    return plot


def growth_plane(grid: "Grid", growth: np.ndarray) -> figure:
    """Growth rates of all designs."""
    mapper = signed_colours()
    plot = design_axes(grid)
    shown = np.sign(growth) * np.sqrt(np.abs(growth) / GROWTH_END)
    cells(plot, grid, np.clip(shown, -1.0, 1.0), mapper)
    plot.add_layout(growth_bar(mapper), "right")
    return plot


# ------------------------------------------------------------------------------ shared by both


class Grid:
    """The designs of a model in the units of its axes."""

    def __init__(self, found: dict[str, np.ndarray], look: dict) -> None:
        self.look = look
        self.c_T, self.d_T = found["c_T"] / look["c"][0], found["d_T"] / look["d"][0]
        self.own = (
            int(np.argmin(np.abs(found["d_T"] - found["own_d_T"]))),
            int(np.argmin(np.abs(found["c_T"] - found["own_c_T"]))),
        )
        inertia = float(found["m_T"])
        self.tuned = np.sqrt(found["c_T"] / inertia) / (2.0 * np.pi)
        critical = 2.0 * np.sqrt(found["c_T"] * inertia)
        self.damping_ratio = found["d_T"][:, None] / critical

    def data(self, aim: np.ndarray) -> dict:
        """What the sliders need; the best design is that of the smallest aim, if any is finite."""
        best = None
        if np.isfinite(aim).any():
            best = [int(k) for k in np.unravel_index(np.argmin(aim), aim.shape)]
        stiffness, damping = self.look["c"][1], self.look["d"][1]
        return {
            "x": self.c_T.tolist(),
            "y": self.d_T.tolist(),
            "stiffness": [f"{value:.3g} {stiffness}" for value in self.c_T],
            "tuned": [f"tuned to {value:.1f} Hz" for value in self.tuned],
            "damping": [f"{value:.3g} {damping}" for value in self.d_T],
            "ratio": [[f"damping ratio {v:.3f}" for v in values] for values in self.damping_ratio],
            "own": list(self.own),
            "best": best,
        }

    def edges(self) -> tuple[np.ndarray, np.ndarray]:
        """Limits of the cells around the designs."""
        return tuple(_edges(axis) for axis in (self.c_T, self.d_T))


def _edges(axis: np.ndarray) -> np.ndarray:
    inner = np.sqrt(axis[1:] * axis[:-1])
    return np.concatenate([[axis[0] ** 2 / inner[0]], inner, [axis[-1] ** 2 / inner[-1]]])


def canvas(x: str, y: str, height: int, **options) -> figure:
    """Empty plot that takes the width it is given."""
    plot = figure(
        height=height, sizing_mode="stretch_width", x_axis_label=x, y_axis_label=y,
        tools="box_zoom,reset,save", toolbar_location="above", min_width=0, **options,
    )  # fmt: skip
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    plot.output_backend = "canvas"
    for axis in plot.axis:
        axis.axis_label_text_font_style = "normal"
    return plot


def design_axes(grid: Grid) -> figure:
    """Plot of all designs: stiffness across, damping up, in equal ratios."""
    plot = canvas(
        f"absorber stiffness c_T ({grid.look['c'][1]})", f"absorber damping d_T ({grid.look['d'][1]})",
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


def cells(plot: figure, grid: Grid, values: np.ndarray, mapper) -> None:
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
    plot.quad(
        "left", "right", "top", "bottom", source=source, line_color=None,
        fill_color={"field": "value", "transform": mapper}, nonselection_fill_alpha=1.0,
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


def plane(grid: Grid, values: np.ndarray, name: str, stable: np.ndarray) -> figure:
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
        color_mapper=mapper, title=None, ticker=ticker, width=10,
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
        color_mapper=mapper, title="1/s", width=10, ticker=FixedTicker(ticks=list(places)),
        major_label_overrides={str(k): v for k, v in places.items()} | places,
    )  # fmt: skip


def three_curves(plot: figure, frequency: np.ndarray, own: np.ndarray, none: np.ndarray) -> None:
    """Curves over the frequency; that of this design is filled by the page's script."""
    plot.line(frequency, none, color=WITHOUT, line_dash="dashed", line_width=1.4,
              legend_label="no absorber")  # fmt: skip
    plot.line(frequency, own, color=OWN, line_width=1.4, legend_label="line's absorber")
    source = ColumnDataSource({"x": frequency, "y": np.full(frequency.size, np.nan)}, name="now")
    plot.line("x", "y", source=source, color=NOW, line_width=2.4, legend_label="this design")
    plot.x_range = Range1d(float(frequency[0]), float(frequency[-1]))
    plot.legend.background_fill_alpha = 0.7
    plot.legend.label_text_font_size = "11px"
    plot.legend.padding = 4
    plot.legend.spacing = 0


def item(plot: figure) -> dict:
    """Describe a plot for the library; NaN has the library's own form."""
    return bokeh.embed.json_item(plot)


def row(name: str, unit: str, form: str, values: np.ndarray, none: float) -> dict:
    """Row of the table: texts of all designs and without absorber."""
    return {
        "name": name,
        "unit": unit,
        "cells": [[number(value, form) for value in line] for line in values],
        "none": number(none, form),
    }


def number(value: float, form: str) -> str:
    """Write a number, or a dash where there is none."""
    return form.format(value) if np.isfinite(value) else "–"


def verdicts(kinds: np.ndarray, words: dict[str, tuple[str, str]], B: float) -> dict:
    """Say of every design whether it is stable."""
    names = list(words)
    return {
        "verdicts": [[tone, text.format(B=B)] for tone, text in words.values()],
        "verdict": [[names.index(str(kind)) for kind in line] for line in kinds],
    }


def frame(name: str, title: str, caption: str, wide: bool = False) -> str:
    """Return the place of a plot on the page."""
    return (
        f'<figure{" class=wide" if wide else ""}><h3>{html.escape(title)}</h3>'
        f'<div class="plot" id="{name}"></div>'
        f"<figcaption>{html.escape(caption)}</figcaption></figure>"
    )


def section(
    name: str, title: str, best: str, limits: str, plots: list[str], band: dict | None = None
) -> str:
    """Return the part of the page for one model."""
    best = html.escape(f"{best}{f' in {limits}' if limits else ''}")
    return f"""<section id="{name}">
<div class="panel">
<h2>{html.escape(title)}</h2>
<label class="slider"><span>Stiffness c_T <output class="stiffness"></output></span>
<input type="range" class="c_T" min="0" step="1" aria-label="{name}: stiffness of the absorber">
<small class="tuned"></small></label>
<label class="slider"><span>Damping d_T <output class="damping"></output></span>
<input type="range" class="d_T" min="0" step="1" aria-label="{name}: damping of the absorber">
<small class="ratio"></small></label>
<div class="choices"><button type="button" class="own">line's absorber</button>
<button type="button" class="best">{best}</button></div>
<p class="verdict" role="status"></p>
<table><thead><tr><th></th><th>this</th><th>line's</th><th>none</th></tr></thead>
<tbody></tbody></table>
<p class="note"></p>
</div>
<div class="plots">
{chr(10).join(plots)}
</div>
</section>"""


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            page=snakemake.output.page,
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            wheelset_designs=snakemake.input.wheelset_designs,
            bogie_designs=snakemake.input.bogie_designs,
        )
