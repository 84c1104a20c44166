"""The route, and which of its sections makes the wheels grow."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
MOST = 14  # sections that are named


def main(*, pdf: str, png: str, code: str, cfg: dict, polygon_growth: str) -> None:
    """Draw the plan of the route and the shares of its sections."""
    with figures.style(STYLE):
        figure = draw(results.read(polygon_growth))
        figures.save(figure, pdf, png, f"Route: {cfg['label']}")


def draw(growth: dict[str, np.ndarray]) -> Figure:
    """Draw the plan (a) and shares in the growth of the fastest order beside the distance (b)."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 84)
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    law = list(growth["wear_law"]).index(str(growth["shown_wear_law"]))
    none = list(growth["absorber"]).index("none")
    wheel = int(growth["first_wheel"][law, none])
    if wheel < 0:
        for axes in (left, right):
            figures.nothing(axes, "a section has no steady answer")
        return figure
    order = growth["fastest_order"][law, none, wheel]
    row = int(np.flatnonzero(growth["order"] == order)[0])
    share = growth["section_share"][law, none, wheel, row]
    draw_plan(figure, left, growth, share)
    draw_shares(right, growth, share)
    wheel_name = str(growth["wheel"][wheel]).replace("_", " ")
    right.set_title(f"order {order:.0f}, {wheel_name} wheel", fontsize="medium")
    for axes, name in ((left, "a"), (right, "b")):
        figures.letter(axes, name)
    return figure


def draw_plan(figure: Figure, axes: Axes, growth: dict[str, np.ndarray], share) -> None:
    """Draw the way there, coloured by the share of its sections."""
    points = np.column_stack([growth["section_x"], growth["section_y"]]) / 1000.0
    number = growth["plan_section"].astype(int)[1:]
    lines = LineCollection(
        np.stack([points[:-1], points[1:]], axis=1),
        array=100.0 * share[number],
        cmap="cividis_r",
        norm=Normalize(0.0, max(100.0 * share.max(), 1.0)),
        linewidth=3.0,
        capstyle="round",
    )
    axes.add_collection(lines)
    axes.autoscale()
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="km", ylabel="km")
    figure.colorbar(lines, ax=axes, label="share of the growth (%)", shrink=0.8)


def draw_shares(axes: Axes, growth: dict[str, np.ndarray], share: np.ndarray) -> None:
    """Draw the shares of the sections in growth and distance, the largest first."""
    chosen = np.argsort(-np.abs(share), kind="stable")[:MOST]
    place = np.arange(chosen.size)
    axes.barh(place - 0.2, 100.0 * share[chosen], 0.38, color="C1", label="growth")
    axes.barh(
        place + 0.2, 100.0 * growth["distance_share"][chosen], 0.38, color="0.6", label="distance"
    )
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.set_yticks(place, [figures.verbatim(str(growth["section"][k])) for k in chosen])
    axes.invert_yaxis()
    axes.set_xlabel("share (%)")
    axes.legend(fontsize="small", loc="lower left")


if __name__ == "__main__":
    run(main, snakemake)
