"""The wheels when they are turned: their polygons, magnified."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
SHOWN = ("none", "route")  # absorbers, as far as there are
MICRO = 1e6


def main(*, pdf: str, png: str, code: str, cfg: dict, polygon_growth: str) -> None:
    """Draw the radius deviations of the wheels when the first is at the limit."""
    with figures.style(STYLE):
        figure = draw(results.read(polygon_growth))
        figures.save(figure, pdf, png, f"Wheels when they are turned: {cfg['label']}")


def draw(growth: dict[str, np.ndarray]) -> Figure:
    """Draw a row per absorber, a wheel in each panel."""
    law = list(growth["wear_law"]).index(str(growth["shown_wear_law"]))
    names = list(growth["absorber"])
    rows = [names.index(name) for name in SHOWN if name in names]
    wheels = growth["wheel"]
    figure = figures.canvas(figures.DOUBLE_COLUMN, 8 + 46 * len(rows))
    panels = figure.subplots(
        len(rows), wheels.size, squeeze=False, subplot_kw={"projection": "polar"}
    )
    limit = MICRO * float(growth["limit"])
    for line, absorber in zip(panels, rows, strict=True):
        distance = float(growth["turning_distance"][law, absorber])
        for axes, name, profile in zip(
            line, wheels, growth["turned_profile"][law, absorber], strict=True
        ):
            draw_wheel(axes, growth["angle"], MICRO * profile, limit)
            axes.set_title(str(name).replace("_", " "), fontsize="small")
        far = f"{distance:,.0f} km" if np.isfinite(distance) else "no limit reached"
        words = f"{figures.design_name(names[absorber])}\n{far}"
        line[0].text(-0.35, 0.5, words, transform=line[0].transAxes, ha="center", va="center",
                     rotation=90, fontsize="small")  # fmt: skip
    return figure


def draw_wheel(axes: PolarAxes, angle: np.ndarray, profile: np.ndarray, limit: float) -> None:
    """Draw a profile around a circle that stands for the round wheel."""
    axes.set(xticks=[], yticks=[])
    if not np.isfinite(profile).all():
        figures.note(axes, "no steady\nanswer")
        return
    axes.plot(angle, np.zeros_like(angle), color="0.6", linewidth=0.6)
    axes.plot(angle, profile, color="black", linewidth=0.8)
    axes.set_rorigin(-2.5 * limit)
    axes.set_ylim(-limit, limit)
    axes.text(0.5, 0.5, f"{np.ptp(profile):.0f} µm", transform=axes.transAxes, ha="center",
              va="center", fontsize="small")  # fmt: skip


if __name__ == "__main__":
    run(main, snakemake)
