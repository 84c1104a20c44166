"""What an operator can change, and what scatter of the speed leaves of an absorber's effect."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
WORDS = {
    "slower": "1 km/h slower",
    "lubricated": "flange lubricated",
    "mixed_speeds": "5 % more scatter of speed",
    "softer_wheels": "wheels softer by 30 %",
    "harder_wheels": "wheels harder by 40 %",
    "turned_earlier": "turned at half the limit",
}
LINES = {"in_phase": "-", "own": "--"}
EXCITATIONS = {"in_phase": "wheels in phase", "own": "each wheel alone"}


def main(*, pdf: str, png: str, code: str, cfg: dict, route_remedies: str) -> None:
    """Draw the remedies and the effect of the absorbers over the scatter."""
    with figures.style(STYLE):
        figure = draw(results.read(route_remedies))
        figures.save(figure, pdf, png, f"What would help: {cfg['label']}")


def draw(found: dict[str, np.ndarray]) -> Figure:
    """Draw lives of wheels by remedy (a) and what absorbers leave over the scatter (b, c)."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 84)
    first, *others = figure.subplots(1, 3, width_ratios=(2, 1, 1))
    draw_remedies(first, found)
    for axes, wheel in zip(others, range(min(found["wheel"].size, 2)), strict=False):
        draw_scatter(axes, found, wheel)
    for axes, name in zip((first, *others), "abc", strict=True):
        figures.letter(axes, name)
    handles = [
        figures.key(figures.design_name(str(name)), color=f"C{k}")
        for k, name in enumerate(found["absorber"])
        if name != "none"
    ]
    handles += [figures.key(EXCITATIONS[k], color="0.3", linestyle=LINES[k]) for k in LINES]
    figures.legend_below(figure, handles, 5)
    return figure


def draw_remedies(axes: Axes, found: dict[str, np.ndarray]) -> None:
    """Draw the change of the wheels' life by every remedy, as in the file the best first."""
    if not found["remedy"].size:
        figures.nothing(axes, "a section has no steady answer")
        return
    life = 100.0 * (found["remedy_wheel_life"] / float(found["bare_wheel_life"]) - 1.0)
    place = np.arange(life.size)
    shown = np.nan_to_num(life)
    axes.barh(place, shown, 0.7, color=np.where(shown > 0.0, "C2", "C1"))
    for where in place[~np.isfinite(life)]:
        axes.text(0.0, where, " no steady answer", va="center", fontsize="small")
    names = [
        WORDS[str(kind)] + (f", {figures.verbatim(str(section))}" if section else "")
        for kind, section in zip(found["remedy"], found["remedy_section"], strict=True)
    ]
    axes.set_yticks(place, names, fontsize="small")
    axes.invert_yaxis()
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.set_xlabel("life of the wheels without absorbers (%)")


def draw_scatter(axes: Axes, found: dict[str, np.ndarray], wheel: int) -> None:
    """Draw what absorbers leave of the growth in the band of design over the scatter."""
    scatter = 100.0 * found["speed_scatter"]
    for row, excitation in enumerate(map(str, found["excitation"])):
        for k, name in enumerate(found["absorber"]):
            if name != "none":
                axes.plot(
                    scatter, found["scatter_factor"][row, :, k, wheel], color=f"C{k}",
                    linestyle=LINES[excitation], marker=".",
                )  # fmt: skip
    axes.axhline(1.0, color="black", linewidth=0.6)
    axes.set(xlabel="scatter of speed (%)", ylabel="growth left by the absorber")
    axes.set_ylim(bottom=0.0)
    axes.set_title(str(found["wheel"][wheel]).replace("_", " "), fontsize="medium")


if __name__ == "__main__":
    run(main, snakemake)
