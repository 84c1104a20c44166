"""The line at a glance: where wheels touch, what they carry, which vibrations grow."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import ABSORBER_COLOURS, KILO, MILLI
from tramdva.report.preflight import ABSORBER_WORDS, STATUS_WORDS
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
SHOWN = (-39.0, 30.0)  # mm of the wheel profile
MARKERS = {"front_outer": "o", "front_inner": "s", "rear_outer": "^", "rear_inner": "D"}
LOWEST = -40.0  # 1/s; what dies out faster is no concern


def main(*, pdf: str, png: str, code: str, cfg: dict, preflight: str) -> None:
    """Draw the figure.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line.
    preflight : str
        Result file.
    """
    with figures.style(STYLE):
        figure = draw(results.read(preflight))
        figures.save(figure, pdf, png, f"The line at a glance: {cfg['label']}")


def draw(values: dict[str, np.ndarray]) -> Figure:
    """Draw loads, contacts and modes side by side."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 72)
    loads, contacts, modes = figure.subplots(1, 3)
    if str(values["status"][0]) == "converged":
        draw_loads(loads, values)
        draw_modes(modes, values)
    else:
        words = STATUS_WORDS[str(values["status"][0])].replace(": ", ":\n").replace(" or ", "\nor ")
        for axes in (loads, modes):
            figures.nothing(axes, words)
    draw_contacts(contacts, values)
    for axes, name in zip((loads, contacts, modes), "abc", strict=True):
        figures.letter(axes, name)
    return figure


def draw_loads(axes: Axes, values: dict[str, np.ndarray]) -> None:
    """Draw the wheel loads on straight track and in the curve, without absorbers."""
    places = np.arange(len(values["wheel"]))
    for shift, name, colour, words in (
        (-0.2, "straight_wheel_load", "0.75", "straight"),
        (0.2, "wheel_load", "C0", "in the curve"),
    ):
        axes.bar(places + shift, values[name][0] / KILO, 0.4, color=colour, label=words)
    names = [str(name).replace("_", "\n") for name in values["wheel"]]
    axes.set_xticks(places, names, fontsize="small")
    top = np.nanmax([values["straight_wheel_load"][0], values["wheel_load"][0]]) / KILO
    axes.set(ylabel="wheel load (kN)", ylim=(0.0, 1.3 * top))
    axes.tick_params(axis="x", length=0)
    axes.legend(loc="upper center", ncols=2, fontsize="small", frameon=False)


def draw_contacts(axes: Axes, values: dict[str, np.ndarray]) -> None:
    """Draw the wheel profile and where the wheels touch."""
    y, z = values["profile_position"] / MILLI, values["profile_depth"] / MILLI
    shown = (y > SHOWN[0]) & (y < SHOWN[1])
    axes.plot(y[shown], z[shown], color="0.4", linewidth=1.0)
    for w, wheel in enumerate(values["wheel"]):
        touching = np.isfinite(values["normal_force"][0, w])
        place = values["wheel_position"][0, w][touching] / MILLI
        if touching.any():
            axes.plot(
                place, np.interp(place, y, z), linestyle="none", marker=MARKERS[str(wheel)],
                markersize=4, label=str(wheel).replace("_", " "),
            )  # fmt: skip
    axes.set(xlabel="from the tape circle, outwards (mm)", ylabel="depth (mm)", xlim=SHOWN)
    axes.invert_yaxis()
    if axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize="x-small", loc="lower right")


def draw_modes(axes: Axes, values: dict[str, np.ndarray]) -> None:
    """Draw growth rates over frequencies of the modes in operation; above zero they grow."""
    axes.axhspan(0.0, 1e3, color=figures.OSCILLATORY, zorder=0)
    axes.axhline(0.0, color="black", linewidth=0.8)
    tops = [5.0]
    for i, name in enumerate(values["absorber"]):
        frequency, rate = values["mode_frequency"][i], values["mode_growth_rate"][i]
        shown = rate > LOWEST
        axes.plot(
            frequency[shown], rate[shown], linestyle="none", marker="o" if i == 0 else "x",
            markersize=4, color=ABSORBER_COLOURS[str(name)], label=ABSORBER_WORDS[str(name)],
        )  # fmt: skip
        tops += [1.3 * float(top) for top in rate[shown]]
    axes.set(xlabel="frequency (Hz)", ylabel="growth rate (1/s)", ylim=(LOWEST, max(tops)))
    axes.text(0.98, 0.98, "grows", transform=axes.transAxes, ha="right", va="top", fontsize="small")
    axes.legend(fontsize="x-small", loc="lower right")


if __name__ == "__main__":
    run(main, snakemake)
