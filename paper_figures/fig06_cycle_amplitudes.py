"""Figure 6: how strong the sustained vibration is, over the stiffness of the absorber."""

from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import KILO, MEGA, MILLI
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
AXLES = {"critical": {"linewidth": 1.3}, "baseline": {"linewidth": 0.8, "linestyle": (0, (5, 2))}}
UNSTABLE = {"linestyle": (0, (1, 1))}
ONSET = {"color": figures.ONSET, "linewidth": 2.0, "marker": "o", "markersize": 4}
PANELS = {
    "y_R_deviation_max": (MILLI, r"largest distance $|y_R - L|$ (mm)"),
    "a_R_max": (1.0, r"largest acceleration $|\ddot{y}_R|$ (m/s$^2$)"),
}


def main(
    *, pdf: str, png: str, code: str, cfg: dict, critical_hopf_curve: str, cycle_amplitudes: str
) -> None:
    """Draw figure 6.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line.
    critical_hopf_curve, cycle_amplitudes : str
        Result files.
    """
    with figures.style(STYLE):
        figure = draw(results.read(critical_hopf_curve), results.read(cycle_amplitudes))
        figures.save(figure, pdf, png, f"Cycle amplitudes: {cfg['label']}")


def draw(critical: dict[str, np.ndarray], cycles: dict[str, np.ndarray]) -> Figure:
    """Draw displacement and acceleration side by side, a line for each damping and axle."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 92)
    for name, axes in zip("ab", figure.subplots(1, 2), strict=True):
        figures.letter(axes, name)
        axes.set(xlabel="absorber stiffness $c_T$ (MN/m)", xscale="log")
    entries: list[Artist] = []
    for axes, (quantity, (unit, label)) in zip(figure.axes, PANELS.items(), strict=True):
        axes.set_ylabel(label)
        if np.isfinite(cycles[quantity]).any():
            entries = draw_lines(axes, cycles, cycles[quantity] / unit)
            show_plain_numbers(axes)
        else:
            figures.nothing(axes, no_cycles(critical, cycles))
    if entries:
        figures.legend_below(figure, entries, 4)
    return figure


def draw_lines(axes: Axes, cycles: dict[str, np.ndarray], values: np.ndarray) -> list[Artist]:
    """Draw one quantity and return the entries of the legend."""
    d_T = np.unique(cycles["d_T"])
    entries: list[Artist] = []
    onset = []
    for colour, damping in zip(figures.shades(d_T), d_T, strict=True):
        words = f"$d_T$ = {damping / KILO:.4g} kN s/m"
        entries.append(figures.key(words, color=colour))
        for axle, look in AXLES.items():
            here = (cycles["axle"] == axle) & (cycles["d_T"] == damping) & np.isfinite(values)
            stable = cycles["stable"][here]
            for piece in figures.pieces(stable):
                style = {"color": colour} | look | ({} if stable[piece][0] else UNSTABLE)
                axes.plot(cycles["c_T"][here][piece] / MEGA, values[here][piece], **style)
            if axle == "critical" and here.any():
                onset.append((cycles["c_T"][here][0] / MEGA, values[here][0]))
    if onset:
        axes.plot(*np.transpose(onset), zorder=5, **ONSET)
        entries.append(figures.key("critical Hopf points", **ONSET))
    words = {"critical": "at the critical $c_A$", "baseline": "at the line's $c_A$"}
    there = [axle for axle in AXLES if axle in cycles["axle"]]
    entries += [figures.key(words[axle], color="black", **AXLES[axle]) for axle in there]
    if not cycles["stable"][np.isfinite(values)].all():
        entries.append(figures.key("unstable cycles", color="black", **UNSTABLE))
    return entries


def show_plain_numbers(axes: Axes) -> None:
    """Label the logarithmic axis with 10, 20, 50, ... MN/m."""
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter("")


def no_cycles(critical: dict[str, np.ndarray], cycles: dict[str, np.ndarray]) -> str:
    """Say why there is nothing to draw."""
    if cycles["c_T"].size:
        return "no limit cycle could be computed"
    if critical["c_T"].size:
        return "no Hopf point with these absorbers:\nthe wheelset does not vibrate by itself"
    return "no critical Hopf point:\nno onset of vibration over $c_T$"


if __name__ == "__main__":
    run(main, snakemake)
