"""Growth rate and critical friction decrease under other theories of contact."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
LOOKS = {
    "as configured": {"marker": "D", "color": "black"},
    "theory": {"marker": "o", "color": "C0"},
    "discretisation": {"marker": "s", "color": "0.5"},
    "comparison": {"marker": "x", "color": "C1"},
}
REACH = 2.0  # of the band that is in view; what lies farther is told by its number


def main(*, pdf: str, png: str, code: str, cfg: dict, growth_band: str) -> None:
    """Draw the figure from the growth rates of all variations."""
    with figures.style(STYLE):
        figure = draw(results.read(growth_band), cfg["creep_force"]["B"])
        figures.save(figure, pdf, png, f"How sure the growth rate is: {cfg['label']}")


def draw(band: dict[str, np.ndarray], operating_B: float) -> Figure:
    """Draw growth rates at the line's friction (a) and critical friction decreases (b)."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 84)
    left, right = figure.subplots(1, 2, sharey=True)
    if not np.isfinite(band["growth_rate"][0]):
        why = figures.status_words(band["status"][:1], "converged")
        for axes in (left, right):
            figures.nothing(axes, why)
        return figure
    names = [
        f"{name} (not in the band)" if kind == "comparison" else str(name)
        for name, kind in zip(band["variation"], band["kind"], strict=True)
    ]
    draw_values(left, band, "growth_rate", (band["growth_low"], band["growth_high"]))
    ends = (band["critical_low"], band["critical_high"])
    top = float(band["largest_friction_decrease"])
    draw_values(right, band, "critical_friction_decrease", ends, top)
    left.axvline(0.0, color="black", linewidth=0.6)
    right.axvline(operating_B, color="0.6", linewidth=0.8, linestyle=":", label="B of the line")
    left.set(xlabel=f"growth rate at B = {operating_B:g} s/m (1/s)")
    left.set_yticks(range(len(names)), names)
    left.invert_yaxis()
    right.set(xlabel="critical friction decrease B (s/m)")
    for axes, name in ((left, "a"), (right, "b")):
        figures.letter(axes, name)
    handles, labels = left.get_legend_handles_labels()
    more = right.get_legend_handles_labels()
    known = dict(zip(labels + more[1], handles + more[0], strict=True))
    figures.legend_below(figure, list(known.values()), 3)
    return figure


def draw_values(
    axes: Axes,
    band: dict[str, np.ndarray],
    name: str,
    ends: tuple[np.ndarray, np.ndarray],
    largest: float = np.nan,
) -> None:
    """Draw the values of all variations beside the band, with a word where there is none."""
    values, nominal = band[name], float(band[name][0])
    low, high = (float(end) for end in ends)
    view = _view(values, nominal, low, high)
    if np.isfinite(low):
        axes.axvspan(
            low, high if np.isfinite(high) else view[1], color="C0", alpha=0.15, linewidth=0.0,
            label="band",
        )  # fmt: skip
    for row, value in enumerate(values):
        kind = str(band["kind"][row])
        if np.isfinite(value) and view[0] <= value <= view[1]:
            axes.plot(
                value, row, linestyle="none", markersize=4, label=kind,
                **LOOKS[kind],
            )  # fmt: skip
            continue
        words = f"{value:.2f}" if np.isfinite(value) else _reason(band, row, largest)
        axes.annotate(words, (0.98, row), xycoords=("axes fraction", "data"), ha="right",
                      va="center", fontsize="small", color=LOOKS[kind]["color"])  # fmt: skip
    axes.set_xlim(*view)
    axes.grid(axis="y", linewidth=0.3)


def _reason(band: dict[str, np.ndarray], row: int, largest: float) -> str:
    status = str(band["status"][row])
    if status != "converged":
        return figures.status_words([status], "converged")
    return f"none up to {largest:g} s/m" if np.isfinite(largest) else ""


def _view(values: np.ndarray, nominal: float, low: float, high: float) -> tuple[float, float]:
    """Limits of the axis: the band and as much again on either side."""
    if not np.isfinite(nominal):
        finite = values[np.isfinite(values)]
        return (finite.min() - 0.1, finite.max() + 0.1) if finite.size else (0.0, 1.0)
    ends = [end for end in (low, high, nominal) if np.isfinite(end)]
    wide = max(max(ends) - min(ends), 0.02 * max(abs(nominal), 0.1))
    return min(ends) - REACH * wide / 2, max(ends) + REACH * wide / 2


if __name__ == "__main__":
    run(main, snakemake)
