"""Figure 4: Hopf points over the stiffnesses of axle and absorber."""

from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import KILO, MEGA
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
LINES = ("-", *figures.DASHES)


def main(
    *, pdf: str, png: str, code: str, cfg: dict, hopf_curves: str, critical_hopf_curve: str
) -> None:
    """Draw figure 4.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line.
    hopf_curves, critical_hopf_curve : str
        Result files.
    """
    with figures.style(STYLE):
        figure = draw(results.read(hopf_curves), results.read(critical_hopf_curve))
        figures.save(figure, pdf, png, f"Hopf curves: {cfg['label']}")


def draw(curves: dict[str, np.ndarray], critical: dict[str, np.ndarray]) -> Figure:
    """Draw a curve for each damping and the line of the critical points."""
    figure = figures.canvas(figures.SINGLE_COLUMN, 92)
    axes = figure.subplots()
    axes.set(xlabel="axle stiffness $c_A$ (MN/m)", ylabel="absorber stiffness $c_T$ (MN/m)")
    if not curves["c_A"].size:
        figures.nothing(axes, "no Hopf point with any of these absorbers")
        return figure
    entries = draw_curves(axes, curves)
    window = axes.get_xlim(), (0, 0.96 * curves["c_T"].max() / MEGA)
    drawn = curves["d_T"].min(), curves["d_T"].max()
    entries += draw_critical_points(axes, critical, drawn)
    axes.set(xlim=window[0], ylim=window[1])
    figures.legend_below(figure, entries, 2)
    return figure


def draw_curves(axes: Axes, curves: dict[str, np.ndarray]) -> list[Artist]:
    """Draw the Hopf curves and return a legend entry for each damping."""
    values = np.unique(curves["d_T"])
    entries: list[Artist] = []
    for count, (colour, d_T) in enumerate(zip(figures.shades(values), values, strict=True)):
        look = {"color": colour, "linestyle": LINES[count % len(LINES)]}
        for number in np.unique(curves["curve"][curves["d_T"] == d_T]):
            here = curves["curve"] == number
            axes.plot(curves["c_A"][here] / MEGA, curves["c_T"][here] / MEGA, **look)
        entries.append(figures.key(f"$d_T$ = {d_T / KILO:.4g} kN s/m", **look))
    return entries


def draw_critical_points(
    axes: Axes, critical: dict[str, np.ndarray], drawn: tuple[float, float]
) -> list[Artist]:
    """Draw the line of the critical points, thick where it meets the curves that are drawn."""
    entries: dict[str, Artist] = {}
    for rows in figures.critical_pieces(critical):
        look = figures.critical_look(critical, rows) | {"linewidth": 0.8, "zorder": 4}
        axes.plot(critical["c_A"][rows] / MEGA, critical["c_T"][rows] / MEGA, **look)
        words = {"critical": "critical, other $d_T$"}.get(look["label"], look["label"])
        entries.setdefault(words, figures.key(**look | {"label": words}))
    inside = (critical["d_T"] >= drawn[0]) & (critical["d_T"] <= drawn[1])
    met = np.where(inside & (critical["branch"] == "upper"), critical["c_T"], np.nan)
    look = {"color": "black", "linewidth": 2.2, "label": "critical, at these $d_T$"}
    if not np.isfinite(met).any():
        return list(entries.values())
    axes.plot(critical["c_A"] / MEGA, met / MEGA, zorder=4, **look)
    return [figures.key(**look), *entries.values()]


if __name__ == "__main__":
    run(main, snakemake)
