"""Orders of a polygonal wheel over the speed, with the modes of the bogie."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
ORDERS = (5, 10, 15, 20, 26, 30, 40)
TOP = 160.0  # Hz
KMH = 3.6


def main(*, pdf: str, png: str, code: str, cfg: dict, bogie_modes: str) -> None:
    """Draw the figure from the modes of the bogie."""
    with figures.style(STYLE):
        figure = draw(
            results.read(bogie_modes), cfg["bogie"]["wheel"]["radius"], cfg["track"]["speed"]
        )
        figures.save(figure, pdf, png, f"Orders over speed: {cfg['label']}")


def draw(modes: dict[str, np.ndarray], wheel_radius: float, speed: float) -> Figure:
    """Draw frequency over speed: rays of the orders, level lines of the modes in the curve."""
    figure = figures.canvas(figures.SINGLE_COLUMN, 84)
    axes = figure.subplots()
    fastest = 30.0 / KMH
    for order in ORDERS:
        draw_order(axes, order, wheel_radius, fastest)
    for name, frequency in zip(modes["shape_mode"], modes["shape_frequency"], strict=True):
        if np.isfinite(frequency):
            draw_level(axes, figures.mode_name(str(name)), float(frequency), fastest)
    if not np.isfinite(modes["shape_frequency"]).any():
        why = figures.status_words(modes["status"][:1], "converged")
        figures.note(axes, f"no modes of the bogie:\n{why or 'none of them was found'}")
    axes.axvline(speed * KMH, color="0.5", linestyle=":", linewidth=0.8)
    axes.text(
        1.0, 1.06, "order of the polygon", transform=axes.transAxes, ha="right", va="bottom",
        fontsize="small", color="0.35",
    )  # fmt: skip
    axes.set(
        xlabel="speed (km/h)", ylabel="frequency (Hz)", xlim=(0.0, fastest * KMH), ylim=(0.0, TOP)
    )
    return figure


def draw_order(axes: Axes, order: int, wheel_radius: float, fastest: float) -> None:
    """Draw the frequency at which the waves of an order pass, eq. (18)."""
    frequency = order * fastest / (2.0 * np.pi * wheel_radius)
    axes.plot([0.0, fastest * KMH], [0.0, frequency], color="0.7", linewidth=0.7)
    top = TOP / frequency * fastest * KMH
    place, side = ((top, TOP), "bottom") if top < fastest * KMH else (
        (fastest * KMH, frequency), "center"
    )  # fmt: skip
    axes.annotate(
        f"{order}", place, (0, 2) if side == "bottom" else (3, 0), textcoords="offset points",
        ha="center" if side == "bottom" else "left", va=side, fontsize="small", color="0.35",
    )  # fmt: skip


def draw_level(axes: Axes, words: str, frequency: float, fastest: float) -> None:
    """Draw a mode of the front axle as a level line."""
    axes.plot([0.0, fastest * KMH], [frequency, frequency], color="C1", linewidth=1.2)
    axes.annotate(
        f"{words}, {frequency:.0f} Hz",
        (0.6, frequency),
        (0, 3),
        textcoords="offset points",
        fontsize="small",
    )


if __name__ == "__main__":
    run(main, snakemake)
