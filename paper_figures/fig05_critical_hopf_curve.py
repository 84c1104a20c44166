"""Figure 5: the absorbers at which self-excitation begins or ends."""

from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import KILO, MEGA
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
FAR = 0.3  # of the largest d_T
DETAIL = (0.30, 0.13, 0.52, 0.36)  # place of the inset
STAR = {"marker": "*", "color": "black", "linestyle": "none", "markersize": 8, "mec": "white"}
PEAK = {"marker": "^", "color": "black", "linestyle": "none", "markersize": 5}


def main(
    *,
    pdf: str,
    png: str,
    code: str,
    cfg: dict,
    critical_hopf_curve: str,
    basic_model: str | None = None,
) -> None:
    """Draw figure 5.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line, c_T and d_T of the line's absorber.
    critical_hopf_curve : str
        Result file.
    basic_model : str, optional
        Result file of the basic model where the absorber follows from the line's bogie.
    """
    cfg = results.completed(cfg, results.read(basic_model) if basic_model else None)
    with figures.style(STYLE):
        figure = draw(cfg, results.read(critical_hopf_curve))
        figures.save(figure, pdf, png, f"Critical Hopf curve: {cfg['label']}")


def draw(cfg: dict, critical: dict[str, np.ndarray]) -> Figure:
    """Draw the curve, the absorbers without self-excitation, and small dampings in an inset."""
    figure = figures.canvas(figures.SINGLE_COLUMN, 92)
    axes = figure.subplots()
    axes.set(xlabel="absorber damping $d_T$ (kN s/m)", ylabel="absorber stiffness $c_T$ (MN/m)")
    if not critical["d_T"].size:
        figures.nothing(axes, "no critical Hopf point:\nno absorber where Hopf points merge")
        return figure
    entries = draw_plane(axes, cfg, critical)
    right, top = critical["d_T"].max() / KILO, critical["c_T"].max() / MEGA
    axes.set(xlim=(0, 1.06 * right), ylim=(0, 1.22 * top))
    say_where(axes, critical)
    draw_detail(axes, cfg, critical)
    figures.legend_below(figure, entries, 2)
    return figure


def draw_plane(axes: Axes, cfg: dict, critical: dict[str, np.ndarray]) -> list[Artist]:
    """Draw the curve over the safe absorbers and return the entries of the legend."""
    entries: dict[str, Artist] = {}
    if len(corners := safe_corners(critical)):
        axes.add_patch(Polygon(corners, facecolor=figures.STABLE, edgecolor="none"))
    for rows in figures.critical_pieces(critical):
        look = figures.critical_look(critical, rows)
        axes.plot(critical["d_T"][rows] / KILO, critical["c_T"][rows] / MEGA, **look)
        entries.setdefault(look["label"], figures.key(**look))
    axes.plot(cfg["absorber"]["d_T"] / KILO, cfg["absorber"]["c_T"] / MEGA, **STAR)
    known = [entries[label] for label in sorted(entries)]
    return [*known, figures.key("line's absorber", **STAR)]


def safe_corners(critical: dict[str, np.ndarray]) -> list[tuple[float, float]]:
    """Outline (kN s/m, MN/m) of the absorbers that stabilise every c_A, down to c_T = 0."""
    corners: list[tuple[float, float]] = []
    previous = -1
    for rows in figures.critical_pieces(critical):
        if not critical["stabilises_all_c_A"][rows[0]]:
            continue
        d_T, c_T = critical["d_T"][rows] / KILO, critical["c_T"][rows] / MEGA
        if corners and rows[0] == previous + 1:  # between them c_T was negative
            corners += [(corners[-1][0], 0.0), (d_T[0], 0.0)]
        corners += zip(d_T, c_T, strict=True)
        previous = rows[-1]
    if corners and corners[-1][0] - corners[0][0] > FAR * critical["d_T"].max() / KILO:
        corners += [(corners[-1][0], 0.0), (corners[0][0], 0.0)]
    return corners


def say_where(axes: Axes, critical: dict[str, np.ndarray]) -> None:
    """Name the two regions and the largest critical stiffness."""
    words = "self-excitation for some $c_A$"
    axes.text(0.5, 0.97, words, transform=axes.transAxes, ha="center", va="top", fontweight="bold")
    for row in np.flatnonzero(critical["special_kind"] == "largest_c_T"):
        d_T, c_T = critical["special_d_T"][row] / KILO, critical["special_c_T"][row] / MEGA
        axes.plot(d_T, c_T, **PEAK)
        words = f"largest $c_T$ = {c_T:.1f} MN/m at $d_T$ = {d_T:.1f} kN s/m"
        offset = {"textcoords": "offset points", "ha": "center"}
        axes.annotate(words, (d_T, c_T), (0, 6), **offset)
        if critical["stabilises_all_c_A"].any():
            axes.annotate("no self-excitation", (d_T, c_T), (0, -30), fontweight="bold", **offset)


def draw_detail(axes: Axes, cfg: dict, critical: dict[str, np.ndarray]) -> None:
    """Show in an inset the small dampings at which the lower branch returns."""
    small = critical["d_T"] < FAR * critical["d_T"].max()
    lower = small & (critical["branch"] == "lower")
    if not lower.any():
        return
    right = 1.3 * critical["d_T"][lower].max()
    top = 1.1 * critical["c_T"][critical["d_T"] <= right].max()
    detail = axes.inset_axes(DETAIL)
    draw_plane(detail, cfg, critical)
    detail.set(xlim=(0, right / KILO), ylim=(0, top / MEGA))
    detail.tick_params(labelsize=6.5)
    detail.locator_params(nbins=4)
    axes.indicate_inset_zoom(detail, edgecolor="black", alpha=1.0, linewidth=0.5)


if __name__ == "__main__":
    run(main, snakemake)
