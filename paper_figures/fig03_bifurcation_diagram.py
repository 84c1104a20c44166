"""Figure 3: limit cycles over the stiffness of the axle."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import MEGA, MILLI
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
SPECIAL = {"fold": "x", "period_doubling": "+", "torus": "1"}  # markers
BLANK = {"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none"}
COMPLETE = ("hopf_point", "window")  # ends of a branch that need no word


def main(*, pdf: str, png: str, code: str, cfg: dict, hopf_points: str, limit_cycles: str) -> None:
    """Draw figure 3.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line, names and labels of the variants.
    hopf_points, limit_cycles : str
        Result files.
    """
    with figures.style(STYLE):
        figure = draw(cfg, results.read(hopf_points), results.read(limit_cycles))
        figures.save(figure, pdf, png, f"Bifurcation diagram: {cfg['label']}")


def draw(cfg: dict, hopf: dict[str, np.ndarray], cycles: dict[str, np.ndarray]) -> Figure:
    """Draw the extremes of the cycles and, below, where each equilibrium is stable."""
    marks = {"none": "no absorber", **figures.labels(cfg)}
    figure = figures.canvas(figures.DOUBLE_COLUMN, 74 + 5 * len(marks))
    diagram, ranges = figure.subplots(2, 1, sharex=True, height_ratios=[9, len(marks)])
    draw_equilibrium(diagram, cycles, "none", 1.0, {"color": figures.NO_ABSORBER})
    for row, name in enumerate(marks):
        draw_cycles(diagram, hopf, cycles, name, look(row))
        draw_special_points(diagram, cycles, name)
        draw_range(ranges, hopf, cycles, name, row)
    c_A = cycles["equilibrium_c_A"] / MEGA
    diagram.set(ylabel=r"position of the rim $y_R^\ast = y_R\,/\,y_{R0}$")
    diagram.margins(y=0.12)
    diagram.tick_params(right=False)
    figures.letter(diagram, "a")
    figures.letter(ranges, "b")
    scale_in_mm(diagram, cycles)
    ranges.set(
        xlabel="axle stiffness $c_A$ (MN/m)",
        xlim=(c_A.min(), c_A.max()),
        ylim=(len(marks) - 0.4, -0.6),
        yticks=range(len(marks)),
        yticklabels=marks.values(),
    )
    ranges.tick_params(axis="y", length=0)
    if not cycles["c_A"].size:
        figures.note(diagram, no_cycles(hopf, cycles))
    explain(figure, cycles)
    return figure


def look(row: int) -> dict:
    """Colour and marker of an absorber; the first is none."""
    colour = figures.NO_ABSORBER if row == 0 else f"C{row - 1}"
    return {"color": colour, "marker": figures.MARKERS[row % len(figures.MARKERS)]}


def draw_equilibrium(
    axes: Axes, cycles: dict[str, np.ndarray], name: str, height: float, style: dict
) -> None:
    """Draw the equilibrium at a height: solid where it is stable, dashed where it is not."""
    here = cycles["equilibrium_absorber"] == name
    c_A, stable = cycles["equilibrium_c_A"][here] / MEGA, cycles["equilibrium_stable"][here]
    for piece in figures.pieces(stable):
        line = "-" if stable[piece][0] else "--"
        x = c_A[piece]
        axes.plot(x, np.full_like(x, height), linestyle=line, linewidth=1.0, **style)


def draw_cycles(
    axes: Axes, hopf: dict[str, np.ndarray], cycles: dict[str, np.ndarray], name: str, style: dict
) -> None:
    """Draw largest and smallest position in the cycles of an absorber."""
    for rows, ended in branches(cycles, name):
        c_A, stable = closed(cycles["c_A"][rows] / MEGA), closed(cycles["stable"][rows])
        c_A[0] = nearest_hopf_point(hopf, name, c_A[0])
        if ended == "hopf_point":
            c_A[-1] = nearest_hopf_point(hopf, name, c_A[-1])
        for extreme in ("y_R_max", "y_R_min"):
            position = closed(cycles[extreme][rows] / cycles["y_R_equilibrium"][rows])
            position[0] = 1.0
            if ended == "hopf_point":
                position[-1] = 1.0
            for piece in figures.pieces(stable):
                line = "-" if stable[piece][0] else "--"
                every = {"markevery": (0.06, 0.11), "markersize": 3}
                axes.plot(c_A[piece], position[piece], linestyle=line, **every, **style)


def branches(cycles: dict[str, np.ndarray], name: str) -> Iterator[tuple[np.ndarray, str]]:
    """Rows and end of each branch of an absorber."""
    for number in np.flatnonzero(cycles["branch_absorber"] == name):
        rows = np.flatnonzero(cycles["cycle_branch"] == number)
        if rows.size:
            yield rows, cycles["branch_ended"][number]


def closed(values: np.ndarray) -> np.ndarray:
    """Repeat the first and the last value, to put the Hopf points there."""
    return values[[0, *range(len(values)), -1]]


def nearest_hopf_point(hopf: dict[str, np.ndarray], name: str, c_A: float) -> float:
    """Axle stiffness (MN/m) of the Hopf point at which a branch begins or ends."""
    points = hopf["c_A"][converged(hopf, name)] / MEGA
    return float(points[np.argmin(np.abs(points - c_A))]) if points.size else c_A


def converged(hopf: dict[str, np.ndarray], name: str) -> np.ndarray:
    """Which Hopf points belong to an absorber."""
    return (hopf["absorber"] == name) & (hopf["status"] == "converged")


def draw_special_points(axes: Axes, cycles: dict[str, np.ndarray], name: str) -> None:
    """Mark folds and other bifurcations of the cycles of an absorber at the nearest cycle."""
    rows = np.flatnonzero(cycles["absorber"] == name)
    for kind, marker in SPECIAL.items():
        here = (cycles["special_absorber"] == name) & (cycles["special_kind"] == kind)
        for c_A in cycles["special_c_A"][here] if rows.size else ():
            row = rows[np.argmin(np.abs(cycles["c_A"][rows] - c_A))]
            for extreme in ("y_R_max", "y_R_min"):
                position = cycles[extreme][row] / cycles["y_R_equilibrium"][row]
                axes.plot(c_A / MEGA, position, marker=marker, color="black", zorder=6)


def draw_range(
    axes: Axes, hopf: dict[str, np.ndarray], cycles: dict[str, np.ndarray], name: str, row: int
) -> None:
    """Draw a row that shows where the equilibrium is stable, with its Hopf points."""
    style = look(row)
    draw_equilibrium(axes, cycles, name, row, {"color": style["color"]})
    points = hopf["c_A"][converged(hopf, name)] / MEGA
    axes.plot(points, np.full_like(points, row), linestyle="none", **style)
    text = {"textcoords": "offset points", "va": "center", "bbox": BLANK}
    for count, c_A in enumerate(points):
        if count % 2:
            axes.annotate(f"H  {c_A:.1f}", (c_A, row), (5, 0), ha="left", **text)
        else:
            axes.annotate(f"{c_A:.1f}  H", (c_A, row), (-5, 0), ha="right", **text)
    if not points.size:
        place = {"xycoords": ("axes fraction", "data"), "ha": "center"}
        axes.annotate(without_hopf_point(cycles, name), (0.5, row), (0, 0), **text, **place)


def without_hopf_point(cycles: dict[str, np.ndarray], name: str) -> str:
    """Say what the absence of Hopf points means for an absorber."""
    stable = cycles["equilibrium_stable"][cycles["equilibrium_absorber"] == name]
    if stable.all():
        return "no Hopf point: stable throughout"
    return "no Hopf point: " + ("stability changes otherwise" if stable.any() else "never stable")


def no_cycles(hopf: dict[str, np.ndarray], cycles: dict[str, np.ndarray]) -> str:
    """Say why there is no branch of limit cycles."""
    if (hopf["status"] == "converged").any():
        return "no limit cycle could be computed"
    if cycles["equilibrium_stable"].all():
        return "no Hopf point: the wheelset does not vibrate by itself"
    return "no Hopf point: vibration neither begins nor ends in this range"


def scale_in_mm(axes: Axes, cycles: dict[str, np.ndarray]) -> None:
    """Add a scale of the distance from the equilibrium (y_R0 hardly depends on c_A)."""
    y_R0 = float(cycles["mean_equilibrium_y_R"])
    scale = axes.secondary_yaxis(
        "right",
        functions=(lambda y: (y - 1) * y_R0 / MILLI, lambda mm: 1 + mm * MILLI / y_R0),
    )
    scale.set_ylabel("$y_R - y_{R0}$ (mm)")


def explain(figure: Figure, cycles: dict[str, np.ndarray]) -> None:
    """Put the legend below the panels: what lines and markers mean, and what went wrong."""
    black = {"color": "black"}
    entries = [
        figures.key("stable", ls="-", **black),
        figures.key("unstable", ls="--", **black),
        figures.key("H: Hopf points", ls="none", marker="o", **black),
    ]
    for kind, marker in SPECIAL.items():
        if kind in cycles["special_kind"]:
            words = f"{kind.replace('_', ' ')} of cycles"
            entries.append(figures.key(words, ls="none", marker=marker, **black))
    if cut := set(cycles["branch_ended"].tolist()) - set(COMPLETE):
        reasons = ", ".join(sorted(cut)).replace("_", " ")
        entries.append(figures.key(f"branches cut off: {reasons}", ls="none"))
    figures.legend_below(figure, entries, len(entries))


if __name__ == "__main__":
    run(main, snakemake)
