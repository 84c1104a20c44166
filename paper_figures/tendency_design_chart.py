"""Design chart: what is left of the growth of wheel orders with absorbers of any tuning."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import figures, job, results

STYLE = Path(__file__).parent / "tramdva.mplstyle"
LEVELS = np.arange(0.0, 1.01, 0.1)
STIFFNESS = 1e5  # N m/rad per unit of the axis


def main(*, pdf: str, png: str, code: str, cfg: dict, tendency_maps: str) -> None:
    """Draw the chart from the maps of the tendency."""
    with figures.style(STYLE):
        figure = draw(results.read(tendency_maps), cfg["study"]["design_band"])
        figures.save(figure, pdf, png, f"Absorbers against polygons: {cfg['label']}")


def draw(maps: dict[str, np.ndarray], band: dict[str, float]) -> Figure:
    """Draw a column per wheel: the peak in the band of design, and the largest of all."""
    wheels = maps["wheel"]
    figure = figures.canvas(figures.DOUBLE_COLUMN, 124)
    panels = figure.subplots(2, len(wheels), squeeze=False, sharex=True, sharey=True)
    for column, wheel in enumerate(wheels):
        title = str(wheel).replace("_", " ")
        for row, (name, words) in enumerate(
            (
                ("map_factor", f"peak in {band['min']:.0f} to {band['max']:.0f} Hz"),
                ("map_worst_factor", "largest of all peaks"),
            )
        ):
            axes = panels[row, column]
            image = draw_map(axes, maps, maps[name][column])
            axes.set_title(f"{title}: {words}", fontsize="medium")
            figures.letter(axes, "abcdefgh"[row * len(wheels) + column])
    for axes in panels[-1]:
        axes.set_xlabel("stiffness (10⁵ N m/rad)")
    for axes in panels[:, 0]:
        axes.set_ylabel("damping (N m s/rad)")
    figure.colorbar(image, ax=list(panels.flat), label="growth with over growth without absorbers")
    return figure


def draw_map(axes: Axes, maps: dict[str, np.ndarray], factor: np.ndarray):
    """Draw the factor over stiffness and damping with the line's absorbers as marks."""
    stiffness = maps["map_c_T"] / STIFFNESS
    image = axes.contourf(
        stiffness, maps["map_d_T"], factor, LEVELS, cmap=figures.SPREAD, extend="both"
    )
    axes.contour(stiffness, maps["map_d_T"], factor, LEVELS, colors="white", linewidths=0.3)
    for row, name in enumerate(map(str, maps["absorber"])):
        if not np.isfinite(maps["c_T"][row]):
            continue
        place = maps["c_T"][row] / STIFFNESS, maps["d_T"][row]
        axes.plot(*place, "s", markerfacecolor="white", markeredgecolor="black")
        words = figures.design_name(name).replace("line's absorber (Table 2)", "Table 3")
        axes.annotate(words, place, (5, 4), textcoords="offset points", color="white")
    low = np.unravel_index(np.argmin(factor), factor.shape)
    axes.plot(stiffness[low[1]], maps["map_d_T"][low[0]], "o", color="white", markersize=3)
    axes.annotate(
        f"best: {factor[low]:.2f}",
        (stiffness[low[1]], maps["map_d_T"][low[0]]),
        (5, -8),
        textcoords="offset points",
        color="white",
    )
    return image


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            pdf=snakemake.output.pdf,
            png=snakemake.output.png,
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            tendency_maps=snakemake.input.tendency_maps,
        )
