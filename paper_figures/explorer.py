"""Interactive explorer: what any absorber does to stability, response and wheel orders.

One page that holds its data and the plotting library. The page of a report is opened as a data
address, of which Chromium takes 2 MB: so all parts are compressed.
"""

import logging
from pathlib import Path

import contourpy
import numpy as np
from bokeh.models import (
    BasicTickFormatter,
    BoxAnnotation,
    ColumnDataSource,
    LinearAxis,
    Range1d,
    Span,
)
from bokeh.plotting import figure

from tramdva import results
from tramdva.report import packed_arrays
from tramdva.report.explorer_page import Part, Shown, filled, row, row_of, verdicts
from tramdva.report.explorer_plots import (
    GROWTH_END,
    WITHOUT,
    Grid,
    canvas,
    cells,
    design_axes,
    growth_bar,
    plane,
    signed_colours,
    three_curves,
)
from tramdva.report.figures import KILO, MEGA
from tramdva.report.script import run

FOLDER = Path(__file__).parent
OPENS_IN_REPORT = 1_500_000  # bytes; in base 64 Chromium's 2 MB
MM_PER_KN = 1e-6  # m/N
STEPS = 1e-3  # of a receptance's logarithm
GROWTH = {"step": 0.02, "kind": "asinh", "scale": 0.02}  # of a growth rate in 1/s
TENDENCY = {"step": 0.005, "kind": "asinh", "scale": 0.05}  # of the relative tendency
FINER = 5  # cells that are drawn per cell of the stability map, between computed values
SHADE = {"fill_color": "#eaeef2", "fill_alpha": 0.9, "line_color": None, "level": "underlay"}
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


def main(
    *,
    page: str,
    code: str,
    cfg: dict,
    wheelset_designs: str,
    bogie_designs: str,
    basic_model: str | None = None,
) -> None:
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
    basic_model : str, optional
        Result file of the basic model where the band follows from the line's bogie.
    """
    cfg = results.completed(cfg, results.read(basic_model) if basic_model else None)
    parts = [
        wheelset_part(cfg, results.read(wheelset_designs)),
        bogie_part(cfg, results.read(bogie_designs)),
    ]
    text = filled(FOLDER, cfg["label"], parts)
    if len(text.encode()) > OPENS_IN_REPORT:
        logging.getLogger(__name__).warning(
            "the page has %d kB: Chromium does not open it within a report; as a file it works",
            len(text.encode()) // 1000,
        )
    with results.atomically(page) as part:
        part.write_text(text, encoding="utf-8")


def wheelset_part(cfg: dict, found: dict[str, np.ndarray]) -> Part:
    """Describe the basic model's part of the page."""
    grid = Grid(found, {"c": (MEGA, "MN/m"), "d": (KILO, "kN s/m")})
    peak = found["peak_receptance"] / MM_PER_KN
    shown = np.where(found["instability"] == "stable", peak, np.nan)
    quiet = cfg["forced_excitation"]["B"]
    receptance = found["receptance_amplitude"] / MM_PER_KN
    array = packed_arrays.pack(receptance, STEPS, (2, 2, 1), "log")
    growth = packed_arrays.pack(found["map_growth_rate"], differences=(1, 2, 3), **GROWTH)
    note = f"No steady response: the wheelset vibrates by itself at B = {quiet:g} s/m as well."
    data = {
        **grid.data(),
        **verdicts(found["instability"], WHEELSET, cfg["creep_force"]["B"]),
        "notes": ["", note],
        "note": np.where(np.isfinite(peak), 0, 1).tolist(),
        "rows": wheelset_rows(found),
        "curves": [{"plot": "wheelset_response", "array": array}],
        "images": [
            {"plot": "wheelset_stability", "array": growth, "finer": FINER, "end": GROWTH_END}
        ],
    }
    title = f"Wheelset: absorber of {float(found['m_T']):g} kg"
    shown_plots = wheelset_plots(cfg, grid, found, shown)
    return Part("wheelset", title, "best stop: lowest receptance", data, shown_plots)


def wheelset_rows(found: dict[str, np.ndarray]) -> list[dict]:
    """Rows of the table beside the sliders."""
    none = found["none_peak_receptance"] / MM_PER_KN
    return [
        row_of(found, "growth_rate", "growth rate", "1/s", "{:+.2f}"),
        row_of(found, "leading_frequency", "its frequency", "Hz", "{:.1f}"),
        row("largest receptance", "mm/kN", "{:.3f}", found["peak_receptance"] / MM_PER_KN, none),
        row_of(found, "peak_frequency", "its frequency", "Hz", "{:.1f}"),
        row("reduction", "times", "{:.2f}", found["reduction"], np.nan),
    ]


def wheelset_plots(cfg: dict, grid: Grid, found: dict, shown: np.ndarray) -> list[Shown]:
    """Draw designs, stability with the chosen one, and its response."""
    operating, quiet = cfg["creep_force"]["B"], cfg["forced_excitation"]["B"]
    return [
        Shown(
            "wheelset_plane",
            "All designs: largest receptance (mm/kN)",
            "★ line's absorber · ○ this design · grey: vibrates by itself",
            plane(grid, shown),
        ),
        Shown(
            "wheelset_stability",
            f"This design: growth rate (1/s) at B = {operating:g} s/m",
            "Red: vibrates by itself · + wheelset of the line · dashed: boundary without absorber",
            stability(found),
        ),
        Shown(
            "wheelset_response",
            f"Receptance of the rim at B = {quiet:g} s/m",
            "Lateral motion of the rim per force that a wheel out of round exerts on it",
            response(grid, found),
            wide=True,
        ),
    ]


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


def response(grid: Grid, found: dict[str, np.ndarray]) -> figure:
    """Receptance with this design, the line's and none."""
    plot = canvas("frequency (Hz)", "receptance (mm/kN)", 260, y_axis_type="log")
    none = found["none_receptance_amplitude"] / MM_PER_KN
    designs = found["receptance_amplitude"] / MM_PER_KN
    three_curves(plot, found["frequency"], designs[tuple(grid.own)], none, "top_right")
    known = np.concatenate([values[np.isfinite(values)] for values in (designs, none)])
    ends = (known.min() / 1.2, known.max() * 1.2) if known.size else (0.01, 1.0)
    plot.y_range = Range1d(*map(float, ends))
    plot.yaxis.formatter = BasicTickFormatter()
    return plot


def bogie_part(cfg: dict, found: dict[str, np.ndarray]) -> Part:
    """Describe the bogie's part of the page."""
    inertia, stiffness, damping = UNITS[cfg["bogie"]["absorber"]["motion"]]
    grid = Grid(found, {"c": (KILO, stiffness), "d": (1.0, damping)})
    limits = "{min:g} to {max:g} Hz".format(**cfg["study"]["design_band"])
    stable = found["self_excitation"] == "stable"
    shown = np.where(stable[..., None], found["band_factor"], np.nan)
    worst = found["worst_band_factor"]
    quiet = cfg["forced_excitation"]["B"]
    note = f"No steady wear: no equilibrium, or the bogie vibrates at B = {quiet:g} s/m as well."
    relative, none = relative_tendency(found)
    data = {
        **grid.data(),
        **verdicts(found["self_excitation"], BOGIE, cfg["creep_force"]["B"]),
        "notes": ["", note],
        "note": np.where(found["quiet_self_excitation"] == "stable", 0, 1).tolist(),
        "rows": bogie_rows(found, shown, limits),
        "curves": [
            {
                "plot": f"bogie_tendency_{w}",
                "array": packed_arrays.pack(relative[:, :, w], differences=(2, 2, 1), **TENDENCY),
            }
            for w in range(len(none))
        ],
        "images": [],
    }
    plots = [*bogie_planes(cfg, grid, found, worst), *tendencies(cfg, grid, found, relative, none)]
    title = f"Bogie: four absorbers of {float(found['m_T']):g} {inertia}"
    return Part("bogie", title, f"best stop: least tendency in {limits}", data, plots)


def bogie_rows(found: dict[str, np.ndarray], shown: np.ndarray, limits: str) -> list[dict]:
    """Rows of the table beside the sliders; no tendency where the bogie is unstable."""
    without = np.where(found["band_status"] == "found", 1.0, np.nan)
    return [
        row_of(found, "growth_rate", "growth rate", "1/s", "{:+.2f}"),
        row_of(found, "leading_frequency", "its frequency", "Hz", "{:.1f}"),
        *(
            row(f"tendency left, {name}", limits, "{:.2f}", shown[..., w], without[w])
            for w, name in enumerate(words(found["wheel"]))
        ),
    ]


def bogie_planes(cfg: dict, grid: Grid, found: dict, worst: np.ndarray) -> list[Shown]:
    """Draw what all designs leave of the tendency, and how they damp self-excitation."""
    band, operating = cfg["study"]["design_band"], cfg["creep_force"]["B"]
    marks = "★ line's absorbers · ○ this design"
    grey = "vibrates by itself" if np.isfinite(worst).any() else "nothing to compare"
    return [
        Shown(
            "bogie_plane",
            f"All designs: share left of the tendency in {band['min']:g} to {band['max']:g} Hz",
            f"Largest value in the band on any wheel · {marks} · grey: {grey}",
            plane(grid, worst),
        ),
        Shown(
            "bogie_growth",
            f"All designs: growth rate (1/s) at B = {operating:g} s/m",
            f"{marks} · red: vibrates by itself",
            growth_plane(grid, found["growth_rate"]),
        ),
    ]


def tendencies(cfg: dict, grid: Grid, found: dict, relative, none) -> list[Shown]:
    """Draw the evolution tendency of each wheel."""
    quiet, band = cfg["forced_excitation"]["B"], cfg["study"]["design_band"]
    caption = "Above zero waves grow · shaded: band of design · 1: the largest without absorber"
    return [
        Shown(
            f"bogie_tendency_{w}",
            f"Evolution tendency, {name} wheel, at B = {quiet:g} s/m",
            caption,
            tendency(grid, found, relative[:, :, w], none[w], band),
        )
        for w, name in enumerate(words(found["wheel"]))
    ]


def words(names: np.ndarray) -> list[str]:
    """Write names for readers."""
    return [str(name).replace("_", " ") for name in names]


def relative_tendency(found: dict[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Tendencies with and without absorbers over the largest without of each wheel."""
    size = found["largest_tendency"]
    scale = np.where(size > 0.0, size, 1.0)[:, None]
    return found["tendency"] / scale, found["none_tendency"] / scale


def tendency(grid: Grid, found: dict, relative: np.ndarray, none: np.ndarray, band: dict) -> figure:
    """Evolution tendency of one wheel with this design, the line's and none."""
    plot = canvas("frequency (Hz)", "evolution tendency (relative)", 280)
    plot.add_layout(BoxAnnotation(left=band["min"], right=band["max"], **SHADE))
    three_curves(plot, found["frequency"], relative[tuple(grid.own)], none, "bottom_left")
    plot.add_layout(Span(location=0, dimension="width", line_color="#8c959f", level="underlay"))
    known = [values[np.isfinite(values)] for values in (relative, none)]
    ends = np.concatenate([np.array([-0.1, 0.1]), *known])
    plot.y_range = Range1d(max(1.08 * ends.min(), -1.6), min(1.08 * ends.max(), 1.6))
    order = found["order"]
    plot.extra_x_ranges = {"order": Range1d(order[0], order[-1])}
    plot.add_layout(
        LinearAxis(x_range_name="order", axis_label="order", axis_label_text_font_style="normal"),
        "above",
    )
    return plot


def growth_plane(grid: Grid, growth: np.ndarray) -> figure:
    """Growth rates of all designs."""
    mapper = signed_colours()
    plot = design_axes(grid)
    shown = np.sign(growth) * np.sqrt(np.abs(growth) / GROWTH_END)
    cells(plot, grid, np.clip(shown, -1.0, 1.0), mapper)
    plot.add_layout(growth_bar(mapper), "right")
    return plot


if __name__ == "__main__":
    run(main, snakemake)
