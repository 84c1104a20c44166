"""Wheels out of round and their wear: the fastest growing order of a band, and all orders."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
MICRO = 1e-6
SIZE = 0.14  # of the polar axis: half height of the drawn wave


def main(
    *, pdf: str, png: str, code: str, cfg: dict, evolution_tendency: str, wear: list[str]
) -> None:
    """Draw the wheels, each worn by its fastest growing order without absorbers."""
    tendency = results.read(evolution_tendency)
    bare = (part for part in map(results.read, wear) if part["absorber"] == "none")
    by_order = {float(part["order"]): part for part in bare}
    worn = [by_order.get(order) for order in tendency["fastest_order"].tolist()]
    with figures.style(STYLE):
        figures.save(draw(tendency, worn), pdf, png, f"Wear around the wheels: {cfg['label']}")


def draw(tendency: dict[str, np.ndarray], worn: Sequence[dict[str, np.ndarray] | None]) -> Figure:
    """Draw a row per wheel: polar plot of its fastest growing order, response of all orders."""
    wheels = tendency["wheel"]
    figure = figures.canvas(figures.DOUBLE_COLUMN, 8 + 72 * len(wheels))
    grid = figure.add_gridspec(len(wheels), 2, width_ratios=[4, 6])
    for row, wheel in enumerate(wheels):
        polar = figure.add_subplot(grid[row, 0], projection="polar")
        if worn[row] is None:
            none = list(tendency["absorber"]).index("none")
            why = figures.status_words(tendency["status"][none], "periodic")
            figures.nothing(polar, "\n".join(["no order ran steadily", *why.split("; ")]))
        else:
            draw_wheel(polar, worn[row], row)
        spectrum = figure.add_subplot(grid[row, 1])
        draw_orders(spectrum, tendency, row)
        words = [f"{str(wheel).replace('_', ' ')} wheel", polar.get_title()]
        polar.set_title(", ".join(filter(None, words)))
    return figure


def draw_wheel(axes: Axes, worn: dict[str, np.ndarray], row: int) -> None:
    """Draw radius deviation and varying part of the wear around the wheel, each to its scale."""
    angle = np.append(worn["angle"], 2.0 * np.pi)
    deviation, depth = worn["radius_deviation"][row], worn["wear_depth"][row]
    largest, variation = worn["largest_radius_deviation"][row], worn["wear_depth_variation"][row]
    for values, size, words, colour in (
        (deviation, largest, f"radius deviation, {largest / MICRO:.2g} µm", "C1"),
        (
            depth - worn["mean_wear_depth"][row],
            variation,
            f"wear beyond its mean, ±{1e3 * variation / MICRO:.2g} nm per revolution",
            "C0",
        ),
    ):
        wave = np.append(values, values[0]) / size
        axes.plot(angle, 1.0 + SIZE * wave, linewidth=0.9, label=words, color=colour)
    axes.set(ylim=(0.0, 1.25), yticks=[])
    axes.set_title(f"order {int(worn['order'])}, {float(worn['frequency']):.1f} Hz")
    axes.set_xticklabels([])
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.02), frameon=False)


def draw_orders(axes: Axes, tendency: dict[str, np.ndarray], row: int) -> None:
    """Draw the order spectrum: levels now and after some revolutions."""
    order = tendency["order"]
    axes.step(order, tendency["level"][row], where="mid", color="black", linewidth=0.9, label="now")
    for k, name in enumerate(map(str, tendency["absorber"])):
        words = figures.design_name(name)
        axes.step(
            order, tendency["level_after"][k, row], where="mid",
            color=figures.ABSORBER_COLOURS[name], linewidth=1.1, label=f"later, {words}",
        )  # fmt: skip
    axes.set(xlabel="order (waves around the wheel)", ylabel="level (dB re 1 µm)")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.3 * (high - low))  # room for the legend
    axes.legend(loc="upper left", ncols=2)
    speed = float(tendency["frequency_axis"][0] / tendency["order_axis"][0])
    top = axes.secondary_xaxis("top", functions=(lambda n: n * speed, lambda f: f / speed))
    top.set_xlabel("frequency (Hz)")
    axes.tick_params(which="both", top=False)


if __name__ == "__main__":
    run(main, snakemake)
