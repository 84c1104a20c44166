"""Design sheet of the absorber: a page of the report and three pages of PDF."""

import io
import textwrap
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import (
    design_sheet,
    design_sheet_page,
    figures,
    sheet_numbers,
    sheet_verdicts,
    stamp,
)
from tramdva.report.design_sheet import Sheet, Table
from tramdva.report.script import run
from tramdva.report.sheet_verdicts import NAMES, NOMINAL, NONE, PAPER, ROBUST
from tramdva.results import atomically

STYLE = Path(__file__).parent / "tramdva.mplstyle"
WIDTH, HEIGHT, MARGIN = 210.0, 297.0, 16.0  # mm, A4
ROW, LETTER = 3.9, 1.33  # mm, of a row and of an average letter at 7 pt
LOOKS = {
    NONE: {"color": "C0", "linestyle": ":"},
    PAPER: {"color": "0.45", "linestyle": "--"},
    NOMINAL: {"color": "C1", "linestyle": "-."},
    ROBUST: {"color": "black", "linestyle": "-"},
}
MARKS = {PAPER: "s", NOMINAL: "^", ROBUST: "o"}
# Why there is nothing to draw, by the state of the search.
EMPTY = {
    "no_equilibrium": "not computed:\nno steady running in the curve",
    "not_computed": "not computed: vibrates by itself\nwithout absorbers in every condition",
    "nothing_grows": "no order grows\nin the conditions that were computed",
    "nothing_to_tune": "no order grows\nin the conditions that were computed",
}
SHARES = (0.0, 0.05, 0.5, 0.95, 1.0)  # of the drawn cases below: extremes, bar and median
LEVELS = np.array([0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0])


def main(
    *,
    pdf: str,
    html: str,
    code: str,
    cfg: dict,
    stability_map: str,
    bogie_modes: str,
    tendency_maps: str,
    robust_tuning: str,
    curving_equilibrium: str,
    polygon_growth: str,
    route_remedies: str,
    basic_model: str | None = None,
) -> None:
    """Write the sheet as PDF and as a page."""
    cfg = results.completed(cfg, results.read(basic_model) if basic_model else None)
    tuning = results.read(robust_tuning)
    content = design_sheet.sheet(
        cfg,
        tuning,
        results.read(stability_map),
        results.read(bogie_modes),
        results.read(tendency_maps),
        results.read(curving_equilibrium),
        results.read(polygon_growth),
        results.read(route_remedies),
    )
    with figures.style(STYLE):
        with atomically(pdf) as part:
            about = {"Title": content.title, "CreationDate": None}
            with PdfPages(part, metadata=about) as document:
                for page in pages(content, tuning, cfg):
                    document.savefig(page)
        picture = svg(pictures(tuning, cfg))
    with atomically(html) as part:
        part.write_text(design_sheet_page.page(content, picture), encoding="utf-8")


def svg(figure: Figure) -> bytes:
    """Return a figure as SVG without date."""
    file = io.BytesIO()
    figure.savefig(file, format="svg", metadata={"Date": None})
    return file.getvalue()


def paper() -> Figure:
    """Return an empty page."""
    figure = figures.canvas(WIDTH, HEIGHT)
    figure.set_layout_engine("none")
    write(figure, (MARGIN, HEIGHT - 10.0), stamp.words(), fontsize=5.5, color="0.4")
    return figure


def write(figure: Figure, place: tuple[float, float], words: str, **look) -> None:
    """Write a line at a place in mm from the upper left corner."""
    x, y = place
    look = {"va": "top", "fontsize": 7} | look
    figure.text(x / WIDTH, 1.0 - y / HEIGHT, figures.verbatim(words), **look)


def paragraphs(figure: Figure, y: float, lines: list[str], size: float = 7.5) -> float:
    """Write lines as a list, broken to the width; return where they end (mm)."""
    letters = int((WIDTH - 2 * MARGIN - 4.0) / (LETTER * size / 7.0))
    for line in lines:
        write(figure, (MARGIN, y), "•", fontsize=size)
        for piece in textwrap.wrap(line, letters):
            write(figure, (MARGIN + 4.0, y), piece, fontsize=size)
            y += 0.5 * size
        y += 0.8
    return y


def table(figure: Figure, y: float, content: Table, last: float = WIDTH - MARGIN) -> float:
    """Draw a table with its title; return where it ends (mm)."""
    write(figure, (MARGIN, y), content.title, fontsize=8, fontweight="bold")
    y += 5.0
    lengths = np.array([[len(cell) for cell in row] for row in content.rows]).max(axis=0)
    edges = MARGIN + (last - MARGIN) * np.cumsum(lengths + 4) / np.sum(lengths + 4)
    rule(figure, y - 0.8, last)
    for k, row in enumerate(content.rows):
        weight = "bold" if k == 0 else "normal"
        write(figure, (MARGIN, y), row[0].replace("    ", "   "), fontweight=weight)
        for x, cell in zip(edges[1:], row[1:], strict=True):
            write(figure, (x, y), cell, ha="right", fontweight=weight)
        y += ROW
        if k == 0:
            rule(figure, y - 0.6, last)
    rule(figure, y - 0.2, last)
    return y + 4.5


def rule(figure: Figure, y: float, last: float) -> None:
    """Draw a thin line across the page."""
    height = 1.0 - y / HEIGHT
    line = figures.key("", color="black", linewidth=0.6)
    line.set_data([MARGIN / WIDTH, last / WIDTH], [height, height])
    line.set_transform(figure.transFigure)
    figure.add_artist(line)


def pages(content: Sheet, tuning: dict[str, np.ndarray], cfg: dict) -> list[Figure]:
    """Draw the pages, each with its number."""
    drawn = [first_page(content), second_page(content, tuning, cfg), last_page(content)]
    for number, figure in enumerate(drawn, start=1):
        words = f"{number} of {len(drawn)}"
        write(figure, (WIDTH - MARGIN, HEIGHT - 10.0), words, ha="right")
    return drawn


def first_page(content: Sheet) -> Figure:
    """Draw verdicts, kilometres, the steady running and the absorber."""
    figure = paper()
    write(figure, (MARGIN, 14.0), content.title, fontsize=13, fontweight="bold")
    y = paragraphs(figure, 24.0, content.verdicts)
    for part in (content.kilometres, content.running, content.absorber):
        y = table(figure, y + 1.0, part)
    return figure


def second_page(content: Sheet, tuning: dict[str, np.ndarray], cfg: dict) -> Figure:
    """Draw the distributions, peaks and orders."""
    figure = paper()
    write(figure, (MARGIN, 12.0), "What is left under the ranges", fontsize=10, fontweight="bold")
    draw(figure, tuning, cfg, bottom=1.0 - 150.0 / HEIGHT, top=1.0 - 25.0 / HEIGHT)
    y = table(figure, 166.0, content.peaks)
    table(figure, y + 1.0, content.orders)
    return figure


def last_page(content: Sheet) -> Figure:
    """Draw the ranges and the notes."""
    figure = paper()
    y = table(figure, 14.0, content.ranges)
    write(figure, (MARGIN, y), "Assumptions, status and limits", fontsize=8, fontweight="bold")
    paragraphs(figure, y + 5.0, content.notes, size=6.8)
    return figure


def pictures(tuning: dict[str, np.ndarray], cfg: dict) -> Figure:
    """Draw the pictures of the page."""
    figure = figures.canvas(WIDTH, 140.0)
    figure.set_layout_engine("none")
    draw(figure, tuning, cfg, bottom=0.09, top=0.93)
    return figure


def draw(figure: Figure, tuning: dict[str, np.ndarray], cfg: dict, bottom: float, top: float):
    """Draw the four panels between two heights of a page."""
    grid = figure.add_gridspec(
        2, 2, left=0.10, right=0.95, bottom=bottom, top=top, hspace=0.42, wspace=0.42
    )
    panels = [figure.add_subplot(grid[k // 2, k % 2]) for k in range(4)]
    for axes, name in zip(panels, "abcd", strict=True):
        figures.letter(axes, name)
    draw_distribution(panels[0], tuning)
    draw_peaks(panels[1], tuning)
    draw_map(panels[2], tuning, cfg)
    draw_ranges(panels[3], tuning)


def known(tuning: dict[str, np.ndarray]) -> list[int]:
    """Designs that were found."""
    return [k for k in (PAPER, NOMINAL, ROBUST) if np.isfinite(tuning["c_T"][k])]


def draw_distribution(axes: Axes, tuning: dict[str, np.ndarray]) -> None:
    """Draw the share of sampled conditions in which at most this growth is left."""
    axes.set_title("growth left in the band", fontsize="medium")
    drawn = tuning["varied"] == "all"
    if not np.isfinite(tuning["factor"][:, drawn]).any():
        figures.nothing(
            axes, EMPTY.get(sheet_verdicts.state_of_tuning(tuning), "nothing to compare")
        )
        return
    for k in (NONE, *known(tuning)):
        values = np.sort(tuning["factor"][k, drawn])
        values = values[np.isfinite(values)]
        share = np.arange(1, values.size + 1) / drawn.sum()  # self-excited ones never get there
        axes.step(100 * values, 100 * share, where="post", label=NAMES[k], **LOOKS[k])
    largest = np.nanmax(tuning["factor"][1:, drawn])
    axes.set(
        xlim=(min(0.0, 100 * np.nanmin(tuning["factor"][:, drawn])), 105 * max(1.0, largest)),
        ylim=(0, 100),
        xlabel="growth left (%)",
        ylabel="share of conditions (%)",
    )
    axes.legend(loc="lower right", fontsize="small")


def draw_peaks(axes: Axes, tuning: dict[str, np.ndarray]) -> None:
    """Draw the growth left at each peak, the worse wheel: median, 5 to 95 %, extremes."""
    axes.set_title("growth left at the peaks, worse wheel", fontsize="medium")
    places = [sheet_numbers.place_of(tuning["quantile"], share) for share in SHARES]
    rows, seen = [str(name).replace("_", "\n") for name in tuning["peak"]], False
    for row in range(len(rows)):
        for place, k in enumerate(known(tuning)):
            sample = 100 * tuning["worse_peak_factor_quantile"][k, row]
            configured = 100 * tuning["worse_peak_factor"][k, 0, row]
            x = row + 0.22 * (place - 1)
            colour = LOOKS[k]["color"]
            if np.isfinite(sample).all():
                seen = True
                least, low, middle, high, most = sample[places]
                axes.plot([x, x], [least, most], color=colour, linewidth=0.7)
                axes.plot([x, x], [low, high], color=colour, linewidth=3.5, solid_capstyle="butt")
                axes.plot(x, middle, "_", color="white", markersize=6, markeredgewidth=1.4)
            if np.isfinite(configured):
                axes.plot(x, configured, MARKS[k], color="white", markeredgecolor=colour)
    if not seen:
        figures.nothing(axes, "no peak without absorbers")
        return
    axes.axhline(100, color="0.6", linewidth=0.6, linestyle=":")
    axes.set_xticks(range(len(rows)), rows, fontsize="small")
    axes.tick_params(axis="x", which="minor", bottom=False, top=False)
    axes.set_yscale("symlog", linthresh=100, linscale=2.0)
    axes.set_yticks([0, 50, 100, 300, 1000], ["0", "50", "100", "300", "1000"])
    axes.set(xlim=(-0.6, len(rows) - 0.4), ylabel="growth left (%)")
    axes.set_ylim(bottom=-30)
    axes.legend(
        handles=[
            figures.key(NAMES[k], color=LOOKS[k]["color"], marker=MARKS[k], markerfacecolor="white")
            for k in known(tuning)
        ],
        fontsize="x-small",
        loc="lower left",
        title="mark: as configured",
        title_fontsize="x-small",
    )


def draw_map(axes: Axes, tuning: dict[str, np.ndarray], cfg: dict) -> None:
    """Draw the growth left in the worst case over stiffness and damping, with the tolerance."""
    axes.set_title("growth left in the worst case (%)", fontsize="medium")
    worst = tuning["map_worst_factor"]
    if not np.isfinite(worst).any():
        figures.nothing(axes, "nothing to tune")
        return
    power = int(np.floor(np.log10(tuning["map_c_T"][-1])))
    scale, units = 10.0**power, sheet_verdicts.unit_names(cfg)
    stiffness = tuning["map_c_T"] / scale
    image = axes.contourf(
        stiffness, tuning["map_d_T"], 100 * worst, 100 * LEVELS, cmap=figures.SPREAD, extend="both"
    )
    axes.figure.colorbar(image, ax=axes)
    for k in known(tuning):
        place = tuning["c_T"][k] / scale, tuning["d_T"][k]
        axes.plot(*place, MARKS[k], color="white", markeredgecolor="black", label=NAMES[k])
    if np.isfinite(tuning["c_T"][ROBUST]):
        band, ends = tuning["tolerance"][ROBUST], (tuning["map_c_T"], tuning["map_d_T"])
        for axis in range(2):
            low = band[axis, 0] if np.isfinite(band[axis, 0]) else ends[axis][0]
            high = band[axis, 1] if np.isfinite(band[axis, 1]) else ends[axis][-1]
            x, y = [tuning["c_T"][ROBUST] / scale] * 2, [tuning["d_T"][ROBUST]] * 2
            if axis == 0:
                x = [low / scale, high / scale]
            else:
                y = [low, high]
            axes.plot(x, y, color="white", linewidth=1.2)
    exponent = str(power).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))
    axes.set(
        xlabel=f"stiffness (10{exponent} {units['c_T']})", ylabel=f"damping ({units['d_T']})",
        xlim=(stiffness[0], stiffness[-1]), ylim=(tuning["map_d_T"][0], tuning["map_d_T"][-1]),
    )  # fmt: skip
    axes.legend(loc="upper right", fontsize="x-small", facecolor="0.75")


def draw_ranges(axes: Axes, tuning: dict[str, np.ndarray]) -> None:
    """Draw what the robust optimum leaves when one range alone is at its ends."""
    axes.set_title("robust optimum, single ranges", fontsize="medium")
    nominal = tuning["nominal_factor"][ROBUST]
    if not np.isfinite(nominal):
        figures.nothing(axes, "no optimum")
        return
    names = list(design_sheet.RANGES)
    for row, name in enumerate(names):
        low, high = (100 * design_sheet.left(tuning, ROBUST, name, end) for end in ("min", "max"))
        axes.plot([low, high], [row, row], color="0.6", linewidth=2.5, solid_capstyle="butt")
        axes.plot(low, row, "<", color="C1")
        axes.plot(high, row, ">", color="C0")
    axes.axvline(100 * nominal, color="black", linewidth=0.7)
    words = [name.replace("_", " ").replace("friction decrease", "friction, B") for name in names]
    axes.set_yticks(range(len(names)), words, fontsize="x-small")
    axes.tick_params(axis="y", which="both", left=False, right=False)
    axes.invert_yaxis()
    axes.set(xlabel="growth left (%)")
    handles = [
        figures.key("lower end", color="C1", marker="<", linestyle=""),
        figures.key("upper end", color="C0", marker=">", linestyle=""),
        figures.key("as configured", color="black", linewidth=0.7),
    ]
    axes.legend(handles=handles, fontsize="x-small", loc="best")


if __name__ == "__main__":
    run(main, snakemake)
