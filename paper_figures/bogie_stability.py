"""Self-excitation of the bogie over the friction decrease, and the map of its absorber."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
LOOKS = (
    {"color": "C1", "linewidth": 1.4},
    {"color": "0.55", "linewidth": 2.0},
    {"color": "C2", "linewidth": 1.2, "linestyle": "--"},
)


def main(*, pdf: str, png: str, code: str, cfg: dict, bogie_modes: str) -> None:
    """Draw the figure from the modes of the bogie."""
    with figures.style(STYLE):
        motion = cfg["bogie"]["absorber"]["motion"]
        figure = draw(results.read(bogie_modes), cfg["creep_force"]["B"], motion)
        figures.save(figure, pdf, png, f"Stability of the bogie: {cfg['label']}")


def draw(modes: dict[str, np.ndarray], operating_B: float, motion: str = "rotation") -> Figure:
    """Draw growth rate over B, and growth rate over stiffness and damping of the absorber."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 92)
    left, right = figure.subplots(1, 2)
    draw_growth(left, modes, operating_B)
    draw_map(figure, right, modes, motion)
    for axes, name in ((left, "a"), (right, "b")):
        figures.letter(axes, name)
    entries = [*left.get_legend_handles_labels()[0], *right.get_legend_handles_labels()[0]]
    figures.legend_below(figure, entries, 2)
    return figure


def draw_growth(axes: Axes, modes: dict[str, np.ndarray], operating_B: float) -> None:
    """Draw the largest growth rate of each absorber over the friction decrease."""
    growth = modes["largest_growth_rate"]
    if np.isnan(growth).all():
        why = figures.status_words(modes["status"], "converged")
        figures.note(axes, f"not computed:\n{why or 'no oscillation in the band'}")
    for row, name in enumerate(modes["absorber"]):
        words = figures.design_name(str(name))
        critical = modes["critical_friction_decrease"][row]
        if np.isfinite(critical):
            words += f": unstable from {critical:.2f} s/m"
        axes.plot(modes["friction_decrease"], growth[row], label=words, **LOOKS[row])
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.axvline(operating_B, color="0.6", linewidth=0.6, linestyle=":")
    axes.set(
        xlabel="friction decrease B (s/m)", ylabel="growth rate (1/s)",
        xlim=(0.0, modes["friction_decrease"][-1]),
    )  # fmt: skip
    axes.annotate(
        f"B = {operating_B:g} s/m", (operating_B, 0.02), (3, 0), xycoords=("data", "axes fraction"),
        textcoords="offset points", fontsize="small", color="0.35",
    )  # fmt: skip


def draw_map(figure: Figure, axes: Axes, modes: dict[str, np.ndarray], motion: str) -> None:
    """Draw the growth rate over stiffness and damping of the absorber; stable is grey."""
    unit, stiffness_label, damping_label = figures.ABSORBER_AXES[motion]
    stiffness, growth = modes["map_c_T"] / unit, modes["map_growth_rate"]
    levels = np.arange(-18.0, 1.1, 1.0)
    if np.isnan(growth).all():
        why = figures.status_words([modes["map_status"]], "converged")
        figures.note(axes, f"not computed:\n{why or 'no oscillation in the band'}")
    else:
        image = axes.contourf(
            stiffness, modes["map_d_T"], growth, levels, cmap=figures.SPREAD, extend="both"
        )
        figure.colorbar(image, ax=axes, label="growth rate (1/s)")
        axes.contour(stiffness, modes["map_d_T"], growth, [0.0], colors=figures.ONSET)
    for row, marker in ((1, "s"), (2, "o")):
        axes.plot(
            modes["c_T"][row] / unit, modes["d_T"][row], marker, markerfacecolor="white",
            markeredgecolor="black", label=figures.design_name(str(modes["absorber"][row])),
        )  # fmt: skip
    axes.set(xlabel=stiffness_label, ylabel=damping_label)


if __name__ == "__main__":
    run(main, snakemake)
