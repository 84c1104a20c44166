"""Design chart: what is left of the growth of wheel orders with absorbers of any tuning."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
LEVELS = np.arange(0.0, 1.01, 0.1)


def main(
    *, pdf: str, png: str, code: str, cfg: dict, tendency_maps: str, basic_model: str | None = None
) -> None:
    """Draw the chart from the maps of the tendency."""
    cfg = results.completed(cfg, results.read(basic_model) if basic_model else None)
    with figures.style(STYLE):
        motion = cfg["bogie"]["absorber"]["motion"]
        figure = draw(results.read(tendency_maps), cfg["study"]["design_band"], motion)
        figures.save(figure, pdf, png, f"Absorbers against polygons: {cfg['label']}")


def draw(maps: dict[str, np.ndarray], band: dict[str, float], motion: str = "rotation") -> Figure:
    """Draw a panel per wheel, and one of the wheel with the larger factor."""
    best = zip(maps["best_c_T"], maps["best_d_T"], maps["best_factor"], strict=True)
    words = [str(wheel).replace("_", " ") for wheel in maps["wheel"]]
    charts = list(zip(words, maps["map_factor"], best, strict=True))
    if len(charts) > 1:
        compromise = maps["compromise_c_T"], maps["compromise_d_T"], maps["compromise_factor"]
        charts.append(("all wheels together", maps["map_worst_factor"], compromise))
    figure = figures.canvas(figures.DOUBLE_COLUMN, 78)
    panels = figure.subplots(1, len(charts), squeeze=False, sharey=True)[0]
    unit, stiffness_label, damping_label = figures.ABSORBER_AXES[motion]
    for axes, name, (words, factor, low) in zip(panels, "abcde", charts, strict=False):
        image = draw_map(axes, maps, factor, low, unit)
        figures.letter(axes, name)
        least = f"\nleast: {low[2]:.2f}" if np.isfinite(low[2]) else ""
        axes.set_title(f"{words}{least}", fontsize="medium")
        axes.set_xlabel(stiffness_label)
    panels[0].set_ylabel(damping_label)
    label = f"peak in {band['min']:.0f} to {band['max']:.0f} Hz:\nwith over without absorbers"
    figure.colorbar(image, ax=list(panels), label=label)
    figures.legend_below(figure, legend(maps), 3)
    return figure


def legend(maps: dict[str, np.ndarray]) -> list[Line2D]:
    """Entries of the legend: the absorbers of the line and the best of each map."""
    square = {"linestyle": "none", "marker": "s", "markerfacecolor": "white"}
    entries = [
        figures.key(figures.design_name(str(name)), markeredgecolor="black", **square)
        for name, stiffness in zip(maps["absorber"], maps["c_T"], strict=True)
        if np.isfinite(stiffness)
    ]
    least = {"marker": "o", "markerfacecolor": "white", "markeredgecolor": "0.4"}
    return [*entries, figures.key("least of the map", linestyle="none", markersize=4, **least)]


def reason(maps: dict[str, np.ndarray]) -> str:
    """Say why there is no chart where no speed has a steady running."""
    none = list(maps["absorber"]).index("none")
    return figures.status_words(maps["speed_status"][none], "converged").replace("; ", "\n")


def draw_map(
    axes: Axes,
    maps: dict[str, np.ndarray],
    factor: np.ndarray,
    best: tuple[float, float, float],
    unit: float,
):
    """Draw the factor over stiffness and damping; marks: the line's absorbers and the best."""
    stiffness = maps["map_c_T"] / unit
    if not np.isfinite(factor).any():
        figures.note(axes, "not computed:\n" + (reason(maps) or "no growth without absorbers"))
    image = axes.contourf(
        stiffness, maps["map_d_T"], factor, LEVELS, cmap=figures.SPREAD, extend="both"
    )
    axes.contour(stiffness, maps["map_d_T"], factor, LEVELS, colors="white", linewidths=0.3)
    for place in zip(maps["c_T"] / unit, maps["d_T"], strict=True):
        if not np.isfinite(place).all():
            continue
        axes.plot(*place, "s", markerfacecolor="white", markeredgecolor="black")
    c_T, d_T, smallest = best
    if np.isfinite(smallest):
        place = c_T / unit, d_T
        axes.plot(*place, "o", color="white", markersize=3)
    return image


if __name__ == "__main__":
    run(main, snakemake)
