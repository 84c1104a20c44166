"""Figure 2: where steady curving is stable, without absorber and with each variant."""

from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import KILO, MEGA
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
CIRCLE = {"marker": "o", "color": "black", "linestyle": "none", "markersize": 5}
DETAIL = (0.63, 0.06, 0.34, 0.34)  # inset of panel (a), in parts of the panel
STAR = {"marker": "*", "color": "black", "linestyle": "none", "markersize": 8, "mec": "white"}


def main(
    *, pdf: str, png: str, code: str, cfg: dict, stability_map: str, basic_model: str | None = None
) -> None:
    """Draw figure 2.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line, names and labels of the variants, c_T and d_T of the line's absorber.
    stability_map : str
        Result file.
    basic_model : str, optional
        Result file of the basic model where the absorber follows from the line's bogie.
    """
    cfg = results.completed(cfg, results.read(basic_model) if basic_model else None)
    with figures.style(STYLE):
        figure = draw(cfg, results.read(stability_map))
        figures.save(figure, pdf, png, f"Stability maps: {cfg['label']}")


def draw(cfg: dict, maps: dict[str, np.ndarray]) -> Figure:
    """Draw the planes of the wheelset's and of the absorber's parameters side by side."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 98)
    wheelset, absorber = figure.subplots(1, 2)
    boundaries = draw_wheelset_plane(wheelset, cfg, maps)
    draw_absorber_plane(absorber, cfg, maps)
    kinds = set(np.unique(maps["instability"][0])) | set(np.unique(maps["absorber_instability"]))
    figures.legend_below(figure, [*areas(kinds), *boundaries], 3)
    return figure


def draw_wheelset_plane(axes: Axes, cfg: dict, maps: dict[str, np.ndarray]) -> list[Artist]:
    """Draw panel (a) and return the entries of its boundaries for the legend."""
    c_R, c_A = maps["c_R"] / MEGA, maps["c_A"] / MEGA
    centre = np.array([maps["baseline_c_R"], maps["baseline_c_A"]]) / MEGA
    detail = axes.inset_axes(DETAIL)
    detail.tick_params(labelsize=6)
    detail.locator_params(nbins=3)
    for panel in (axes, detail):
        shade(panel, c_R, c_A, maps["growth_rate"][0].T, maps["coefficient_a6"][0].T)
        lines = [zero_line(panel, c_R, c_A, h5.T, row) for row, h5 in enumerate(maps["hurwitz_h5"])]
        panel.plot(*centre, **CIRCLE)
        if panel is axes:
            boundaries = lines
    zoom(axes, detail, centre)
    marks = [figures.labels(cfg).get(str(name), "") for name in maps["absorber"]]
    for line, mark in zip(boundaries, marks, strict=True):
        name_boundary(axes, line, mark)
    axes.set(xlabel="wheel stiffness $c_R$ (MN/m)", ylabel="axle stiffness $c_A$ (MN/m)")
    axes.set(xlim=figures.limits(c_R), ylim=figures.limits(c_A))
    figures.letter(axes, "a")
    words = [f"{mark}  {tuning(maps, row)}" for row, mark in enumerate(marks)]
    words[0] = "$H_3=0$, no absorber"
    entries = [figures.key(word, **boundary_look(row)) for row, word in enumerate(words)]
    return [figures.key("wheelset of the line", **CIRCLE), *entries]


def zoom(axes: Axes, detail: Axes, centre: np.ndarray) -> None:
    """Let the inset show the surroundings of the line's wheelset where it covers nothing else."""
    low, high = 0.75 * centre, 1.25 * centre
    detail.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    axes.indicate_inset_zoom(detail, edgecolor="black", alpha=1.0, linewidth=0.5)


def name_boundary(axes: Axes, line: ContourSet, mark: str) -> None:
    """Write the mark of an absorber where its boundary reaches the largest c_R."""
    corners = [segment for segment in line.allsegs[0] if len(segment)]
    if mark and corners:
        points = np.concatenate(corners)
        x, y = points[np.argmax(points[:, 0])]
        offset = {"xytext": (-2, 0), "textcoords": "offset points", "ha": "right", "va": "center"}
        axes.annotate(mark, (x, y), fontsize=10, **offset)


def draw_absorber_plane(axes: Axes, cfg: dict, maps: dict[str, np.ndarray]) -> None:
    """Draw panel (b): the line's wheelset with any absorber of the same mass."""
    d_T, c_T = maps["d_T"] / KILO, maps["c_T"] / MEGA
    shade(axes, d_T, c_T, maps["absorber_growth_rate"].T, maps["absorber_coefficient_a6"].T)
    zero_line(axes, d_T, c_T, maps["absorber_hurwitz_h5"].T, 0)
    marks = figures.labels(cfg)
    for row, name in enumerate(maps["absorber"]):
        if str(name) in marks:
            place = maps["absorber_d_T"][row] / KILO, maps["absorber_c_T"][row] / MEGA
            axes.annotate(marks[str(name)], place, ha="center", va="center", fontsize=10)
    axes.plot(cfg["absorber"]["d_T"] / KILO, cfg["absorber"]["c_T"] / MEGA, **STAR)
    axes.set(
        xlabel="absorber damping $d_T$ (kN s/m)",
        ylabel="absorber stiffness $c_T$ (MN/m)",
        xlim=figures.limits(d_T),
        ylim=figures.limits(c_T),
    )
    figures.letter(axes, "b")


def shade(axes: Axes, x: np.ndarray, y: np.ndarray, growth: np.ndarray, a6: np.ndarray) -> None:
    """Shade a plane by the kind of stability."""
    grey = {"levels": [-np.inf, 0.0, np.inf], "zorder": 0}
    axes.contourf(x, y, growth, colors=[figures.STABLE, figures.OSCILLATORY], **grey)
    if (a6 < 0.0).any():
        axes.contourf(x, y, a6, colors=[figures.MONOTONE, "none"], **grey)
        axes.contour(x, y, a6, [0.0], colors="black", linewidths=0.8, linestyles="dotted")


def zero_line(axes: Axes, x: np.ndarray, y: np.ndarray, h5: np.ndarray, row: int) -> ContourSet:
    """Draw the boundary of stability of an absorber."""
    look = boundary_look(row)
    return axes.contour(
        x, y, h5, [0.0], colors=look["color"], linewidths=look["lw"], linestyles=[look["ls"]]
    )


def boundary_look(row: int) -> dict:
    """Look of the boundary of one absorber; the first is none."""
    if row == 0:
        return {"color": figures.NO_ABSORBER, "lw": 1.4, "ls": "-"}
    return {
        "color": f"C{row - 1}",
        "lw": 1.3,
        "ls": figures.DASHES[(row - 1) % len(figures.DASHES)],
    }


def tuning(maps: dict[str, np.ndarray], row: int) -> str:
    """Stiffness and damping of an absorber in words."""
    c_T, d_T = maps["absorber_c_T"][row] / MEGA, maps["absorber_d_T"][row] / KILO
    return f"$c_T$ = {c_T:.4g} MN/m, $d_T$ = {d_T:.4g} kN s/m"


def areas(kinds: set[str]) -> list[Artist]:
    """Entries of the legend for the shades that occur."""
    looks = {
        "stable": (figures.STABLE, "stable"),
        "oscillatory": (figures.OSCILLATORY, "oscillation grows"),
        "monotone": (figures.MONOTONE, "diverges ($a_6<0$)"),
        "no_equilibrium": ("white", "no equilibrium"),
    }
    shown = [look for kind, look in looks.items() if kind in kinds]
    patches = [Patch(facecolor=grey, edgecolor="black", label=words) for grey, words in shown]
    return [*patches, figures.key("line's absorber", **STAR)]


if __name__ == "__main__":
    run(main, snakemake)
