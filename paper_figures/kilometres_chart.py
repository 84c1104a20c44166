"""Kilometres between two turnings: by absorber and law of wear, over mass and detuning."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.design_names import WEAR_LAWS
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
KM = 1000.0


def main(
    *, pdf: str, png: str, code: str, cfg: dict, polygon_growth: str, route_tuning: str
) -> None:
    """Draw the kilometres that absorbers buy."""
    with figures.style(STYLE):
        figure = draw(results.read(polygon_growth), results.read(route_tuning))
        figures.save(figure, pdf, png, f"Kilometres: {cfg['label']}")


def draw(growth: dict[str, np.ndarray], tuning: dict[str, np.ndarray]) -> Figure:
    """Draw kilometres by absorber (a), over the mass (b) and over the detuning (c)."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 80)
    first, second, third = figure.subplots(1, 3, width_ratios=(2, 1, 1))
    draw_absorbers(first, growth)
    draw_mass(second, tuning)
    draw_detuning(third, tuning)
    for axes, name in ((first, "a"), (second, "b"), (third, "c")):
        figures.letter(axes, name)
    figures.legend_below(figure, first.get_legend_handles_labels()[0], 4)
    return figure


def draw_absorbers(axes: Axes, growth: dict[str, np.ndarray]) -> None:
    """Draw the distance between turnings with every absorber, by the laws of wear."""
    laws, count = growth["wear_law"], growth["absorber"].size
    height = 0.8 / laws.size
    top = np.nanmax(np.append(growth["turning_distance"], 1.0)) / KM
    for k, (law, colour) in enumerate(zip(laws, figures.shades(laws), strict=True)):
        place = np.arange(count) + (k - 0.5 * (laws.size - 1)) * height
        distance = growth["turning_distance"][k] / KM
        axes.barh(
            place,
            np.nan_to_num(distance),
            height,
            color=colour,
            label=WEAR_LAWS.get(str(law), str(law)),
        )
        for where, km, status in zip(place, distance, growth["turning_status"][k], strict=True):
            if not np.isfinite(km):
                words = "beyond the horizon" if status == "beyond_horizon" else "no steady answer"
                axes.text(0.02 * top, where, words, va="center", fontsize="x-small")
    names = [figures.design_name(str(name)) for name in growth["absorber"]]
    axes.set_yticks(np.arange(count), names)
    axes.invert_yaxis()
    axes.set_xlabel("distance between turnings (1000 km)")


def draw_mass(axes: Axes, tuning: dict[str, np.ndarray]) -> None:
    """Draw the distance over the inertia of the best absorber."""
    if not np.isfinite(tuning["mass_distance"]).any():
        figures.nothing(axes, why(tuning))
        return
    axes.plot(tuning["mass_share"], tuning["mass_distance"] / KM, marker="o", color="C0")
    reference(axes, tuning)
    axes.set(xlabel="mass over the line's", ylabel="distance (1000 km)")
    axes.set_ylim(bottom=0.0)


def draw_detuning(axes: Axes, tuning: dict[str, np.ndarray]) -> None:
    """Draw the distance over the stiffness of the best absorber."""
    if not np.isfinite(tuning["detuned_distance"]).any():
        figures.nothing(axes, why(tuning))
        return
    axes.semilogx(tuning["stiffness_share"], tuning["detuned_distance"] / KM, color="C0")
    axes.set_xticks([0.5, 1.0, 2.0], ["0.5", "1", "2"])
    axes.minorticks_off()
    reference(axes, tuning)
    axes.set(xlabel="stiffness over the best")
    axes.set_ylim(bottom=0.0)


def reference(axes: Axes, tuning: dict[str, np.ndarray]) -> None:
    """Draw the distance without absorbers."""
    axes.axhline(tuning["bare_distance"] / KM, color="C1", linewidth=0.8)
    axes.annotate(
        "no absorber", (0.03, tuning["bare_distance"] / KM), (0, -3),
        xycoords=("axes fraction", "data"), textcoords="offset points", va="top",
        fontsize="small", color="C1",
    )  # fmt: skip


def why(tuning: dict[str, np.ndarray]) -> str:
    """Say why there is no absorber for the route."""
    words = {
        "no_steady_answer": "a section has\nno steady answer",
        "no_design": "every design\nvibrates by itself",
    }
    return words.get(str(tuning["status"]), "no design")


if __name__ == "__main__":
    run(main, snakemake)
