"""Figure 9: lateral velocity of the inner front wheel's contact point, into the curve."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import MILLI
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
LOOKS = (
    {"color": "C1", "linewidth": 0.4},  # without absorber, as in the paper
    {"color": "0.35", "linewidth": 0.7},  # with the line's absorber, as in the paper
    {"color": "C2", "linewidth": 0.6},
)
WHEEL = "front_inner"
AFTER = 4.0  # s after the entry at which the oscillation about the steady state has begun
PERIODS = 6


def main(*, pdf: str, png: str, code: str, cfg: dict, curve_entry: str, bogie_modes: str) -> None:
    """Draw figure 9.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line and moment of the entry.
    curve_entry, bogie_modes : str
        Result files.
    """
    with figures.style(STYLE):
        figure = draw(results.read(curve_entry), results.read(bogie_modes), cfg["study"]["entry"])
        figures.save(figure, pdf, png, f"Curve entry: {cfg['label']}")


def draw(ride: dict[str, np.ndarray], modes: dict[str, np.ndarray], entry: float) -> Figure:
    """Draw the whole ride and its last periods."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 72)
    if why := figures.status_words(modes["status"][: len(ride["absorber"])], "converged"):
        figures.nothing(figure.subplots(), f"The bogie has no steady running in its curve:\n{why}")
        return figure
    whole, detail = figure.subplots(1, 2, width_ratios=[3, 1])
    wheel = int(np.flatnonzero(ride["wheel"] == WHEEL)[0])
    velocity = ride["contact_point_lateral_velocity"][:, wheel] / MILLI
    draw_ride(whole, ride, velocity, entry)
    frequency = float(modes["operating_frequency"][0])
    draw_detail(detail, ride, velocity, frequency)
    entries = []
    for row, name in enumerate(ride["absorber"]):
        words = f"{figures.design_name(str(name))}: "
        mode = int(np.flatnonzero(modes["absorber"] == name)[0])
        rate = f"{modes['operating_growth_rate'][mode]:+.2f}".replace("-", "−")
        words += f"growth rate {rate} 1/s at "
        words += f"{modes['operating_frequency'][mode]:.1f} Hz"
        if ride["status"][row] != "completed":
            words += f" ({ride['status'][row].replace('_', ' ')})"
        entries.append(figures.key(words, **{**LOOKS[row], "linewidth": 1.4}))
    figures.legend_below(figure, entries, 2)
    for axes, name in ((whole, "a"), (detail, "b")):
        figures.letter(axes, name)
    return figure


def draw_ride(axes: Axes, ride: dict[str, np.ndarray], velocity: np.ndarray, entry: float) -> None:
    """Draw the velocities over the time; the scale leaves out the blow at the entry."""
    time = ride["time"]
    for row, values in enumerate(velocity):
        axes.plot(time, values, zorder=3 + row, **LOOKS[row])
    later = velocity[:, time > entry + AFTER]
    top = 1.6 * np.nanmax(np.abs(later)) if np.isfinite(later).any() else 1.0
    axes.set(
        xlim=(0.0, time[-1]), ylim=(-top, top), xlabel="time (s)",
        ylabel=r"$\dot y_{Rc}$ (mm/s)",
    )  # fmt: skip
    axes.axvline(entry, color="0.6", linewidth=0.6, linestyle=":")
    axes.annotate(
        "curve", (entry, 0.9 * top), (-3, 0), textcoords="offset points", ha="right", va="center"
    )


def draw_detail(
    axes: Axes, ride: dict[str, np.ndarray], velocity: np.ndarray, frequency: float
) -> None:
    """Draw the last periods."""
    time = ride["time"]
    if not np.isfinite(frequency):
        figures.nothing(axes, "no oscillation\nin the band")
        return
    shown = time > time[-1] - PERIODS / frequency
    for row, values in enumerate(velocity):
        axes.plot(time[shown], values[shown], **{**LOOKS[row], "linewidth": 1.2})
    axes.set(xlabel="time (s)", xlim=(time[shown][0], time[-1]))
    axes.xaxis.set_major_locator(MaxNLocator(3, prune="both"))
    axes.set_title(f"{PERIODS} periods at {frequency:.1f} Hz", loc="right", fontsize="small")


if __name__ == "__main__":
    run(main, snakemake)
