"""The orders of the wheel that is turned first, over the kilometres of the route."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)  # of the distance to the limit
FLOOR = -40.0  # dB, below which levels are not shown


def main(*, pdf: str, png: str, code: str, cfg: dict, polygon_growth: str) -> None:
    """Draw levels over the distance and the growth of the orders."""
    with figures.style(STYLE):
        figure = draw(results.read(polygon_growth))
        figures.save(figure, pdf, png, f"Orders over kilometres: {cfg['label']}")


def draw(growth: dict[str, np.ndarray]) -> Figure:
    """Draw the spectrum without absorbers (a) and growth with every absorber (b)."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 78)
    left, right = figure.subplots(1, 2)
    law = list(growth["wear_law"]).index(str(growth["shown_wear_law"]))
    none = list(growth["absorber"]).index("none")
    if growth["hindrance"][none]:
        why = no_answer(str(growth["hindrance"][none]))
        for axes in (left, right):
            figures.nothing(axes, why)
        return figure
    wheel = int(growth["first_wheel"][law, none])
    draw_levels(left, growth, (law, none, wheel))
    draw_growth(right, growth, law, wheel)
    figures.legend_below(figure, right.get_legend_handles_labels()[0], 5)
    for axes, name in ((left, "a"), (right, "b")):
        figures.letter(axes, name)
    return figure


def no_answer(hindrance: str) -> str:
    """Say where there is no steady answer to waves."""
    status, _, where = hindrance.partition(": ")
    return f"{figures.status_words([status], '')}\non {where}"


def draw_levels(axes: Axes, growth: dict[str, np.ndarray], place: tuple[int, int, int]) -> None:
    """Draw the levels of the orders at parts of the way to the limit."""
    reached = float(growth["turning_distance"][place[:2]])
    end = reached if np.isfinite(reached) else float(growth["distance"][-1])
    order, rate = growth["order"], growth["growth_per_1000_km"][place]
    for share, colour in zip(SHARES, figures.shades(SHARES), strict=True):
        # Exactly as the file's levels grow: by the growth of the order in dB.
        level = growth["initial_level"] + 20.0 / np.log(10.0) * rate * share * end / 1000.0
        axes.plot(order, level, color=colour, marker=".", label=f"{share * end:,.0f} km")
    axes.set(xlabel="order", ylabel="level (dB re 1 µm)", xlim=(0.0, order[-1]))
    axes.set_ylim(bottom=FLOOR)
    axes.legend(fontsize="small", title=str(growth["wheel"][place[2]]).replace("_", " "))


def draw_growth(axes: Axes, growth: dict[str, np.ndarray], law: int, wheel: int) -> None:
    """Draw the growth of the orders of a wheel with every absorber."""
    looks = ({"color": "C1", "linewidth": 1.6}, {"color": "0.55"}, {"color": "C0"},
             {"color": "C2", "linestyle": "--"}, {"color": "black", "linestyle": ":"})  # fmt: skip
    for k, (name, look) in enumerate(zip(growth["absorber"], looks, strict=False)):
        axes.plot(
            growth["order"],
            growth["growth_per_1000_km"][law, k, wheel],
            label=figures.design_name(str(name)),
            **look,
        )
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set(xlabel="order", ylabel="growth in 1000 km (e-folds)", xlim=(0.0, growth["order"][-1]))


if __name__ == "__main__":
    run(main, snakemake)
