"""Which orders grow at which speed and in which curve, without and with absorbers."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import SymLogNorm
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
KMH = 3.6  # km/h per m/s
COLOURS = "PuOr_r"  # orange grows, purple diminishes; safe for the colour-blind
LINEAR = 0.01  # of the largest tendency: linear scale below, logarithmic above
ORDERS_SHOWN = (10, 15, 20, 25, 30, 40)


def main(*, pdf: str, png: str, code: str, cfg: dict, tendency_maps: str) -> None:
    """Draw the charts from the maps of the tendency."""
    with figures.style(STYLE):
        figure = draw(results.read(tendency_maps), cfg)
        figures.save(figure, pdf, png, f"Growing orders over speed: {cfg['label']}")


def draw(maps: dict[str, np.ndarray], cfg: dict) -> Figure:
    """Draw a row per wheel: over speed without and with the first absorber, over the radius."""
    wheels, absorbers = maps["wheel"], [str(name) for name in maps["absorber"]]
    figure = figures.canvas(figures.DOUBLE_COLUMN, 14 + 62 * len(wheels))
    panels = figure.subplots(len(wheels), 3, squeeze=False, sharey=True)
    none = absorbers.index("none")
    others = [k for k in range(len(absorbers)) if k != none] or [none]
    for row, wheel in enumerate(wheels):
        scale = 1e3 * float(maps["largest_speed_tendency"][row]) or 1.0
        norm = SymLogNorm(LINEAR * scale, vmin=-scale, vmax=scale)
        for axes, k in zip(panels[row], (none, others[0]), strict=False):
            image = draw_map(axes, maps, "speed", k, row, norm)
            draw_orders(axes, maps, 2.0 * np.pi * cfg["bogie"]["wheel"]["radius"])
            words = figures.design_name(absorbers[k])
            axes.set_title(words, fontsize="medium")
        draw_map(panels[row, 2], maps, "radius", none, row, norm)
        panels[row, 2].set_title("no absorber, over the radius", fontsize="medium")
        panels[row, 0].set_ylabel(f"{str(wheel).replace('_', ' ')}\nfrequency (Hz)")
        powers = [p for p in (0.1, 1.0, 10.0, 100.0, 1e3) if 1.5 * LINEAR * scale < p <= scale]
        figure.colorbar(
            image,
            ax=list(panels[row]),
            extend="both",
            ticks=[*(-p for p in powers[::-1]), 0.0, *powers],
            format="{x:g}",
            label="growth per 1000 revolutions",
        )
    for axes, name in zip(panels[-1], ("speed (km/h)", "speed (km/h)", "radius (m)"), strict=True):
        axes.set_xlabel(name)
    return figure


def draw_map(axes: Axes, maps: dict[str, np.ndarray], over: str, absorber: int, row: int, norm):
    """Draw growth over speed or radius and frequency."""
    place = maps[over] * (KMH if over == "speed" else 1.0)
    values = 1e3 * maps[f"{over}_tendency"][absorber, row].T
    image = axes.pcolormesh(
        place, maps["frequency"], values, cmap=COLOURS, norm=norm, shading="gouraud",
        rasterized=True,
    )  # fmt: skip
    failed = maps[f"{over}_status"][absorber] != "converged"
    if failed.all():
        figures.note(axes, "no equilibrium found")
    for k in np.flatnonzero(failed):
        axes.axvline(place[k], color="0.8", linewidth=2.0)
    axes.set_facecolor("0.85")
    axes.set(xlim=(place[0], place[-1]), ylim=(maps["frequency"][0], maps["frequency"][-1]))
    if over == "radius":
        axes.set_xscale("log")
        ticks = [r for r in (20, 30, 50, 100, 200, 500, 1000) if place[0] <= r <= place[-1]]
        axes.set_xticks(ticks, [str(r) for r in ticks])
        axes.minorticks_off()
    return image


def draw_orders(axes: Axes, maps: dict[str, np.ndarray], circumference: float) -> None:
    """Draw the frequencies of some orders over the speed."""
    speed, top = maps["speed"], maps["frequency"][-1]
    for order in ORDERS_SHOWN:
        frequency = order * speed / circumference
        axes.plot(speed * KMH, frequency, color="black", linewidth=0.5, linestyle=":")
        inside = frequency < 0.96 * top
        if inside[-1]:
            place = speed[-1] * KMH, frequency[-1]
            axes.annotate(
                str(order), place, (-2, 0), textcoords="offset points", ha="right", va="bottom",
                fontsize=6.5,
            )  # fmt: skip


if __name__ == "__main__":
    run(main, snakemake)
