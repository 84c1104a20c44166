"""Figure 10: evolution tendency of the front wheels without and with absorbers."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
STYLES = {
    "none": {"linewidth": 1.2},
    "paper": {"linewidth": 1.8},
    "tuned": {"linewidth": 1.2, "linestyle": "--"},
}
LOOKS = {
    name: {"color": colour, **STYLES[name]} for name, colour in figures.ABSORBER_COLOURS.items()
}
MARKERS = {"none": "o", "paper": "s", "tuned": "D"}
DETAIL = 0.3  # of the frequency axis: the low peaks are small


def main(*, pdf: str, png: str, code: str, cfg: dict, evolution_tendency: str) -> None:
    """Draw figure 10 from the evolution tendency."""
    with figures.style(STYLE):
        figure = draw(results.read(evolution_tendency))
        figures.save(figure, pdf, png, f"Evolution tendency: {cfg['label']}")


def draw(tendency: dict[str, np.ndarray]) -> Figure:
    """Draw a row per wheel: all frequencies, and the lowest enlarged."""
    wheels = tendency["wheel"]
    figure = figures.canvas(figures.DOUBLE_COLUMN, 30 + 48 * len(wheels))
    panels = figure.subplots(len(wheels), 2, width_ratios=[5, 3], squeeze=False)
    for row, wheel in enumerate(wheels):
        whole, detail = panels[row]
        if not np.isfinite(tendency["linearised_normalised"][:, row]).any():
            figures.nothing(whole, "no growth was computed:\n" + reasons(tendency))
            figures.nothing(detail, "not computed")
        draw_wheel(whole, tendency, row)
        label_peaks(whole, tendency, row)
        draw_wheel(detail, tendency, row)
        enlarge(detail, tendency, row)
        figures.letter(whole, f"{'abcd'[row]}")
        title = str(wheel).replace("_", " ")
        whole.set_title(f"{title} wheel", fontsize="medium")
        detail.set_title(f"{title} wheel, detail", fontsize="medium")
        whole.set_ylabel("evolution tendency\n(1: largest at an order)")
    for axes in panels[-1]:
        axes.set_xlabel("frequency (Hz)")
    figures.legend_below(figure, legend(tendency), 2)
    return figure


def draw_wheel(axes: Axes, tendency: dict[str, np.ndarray], row: int) -> None:
    """Draw the linearised vehicle as lines and the simulated orders as marks."""
    axes.axhline(0.0, color="black", linewidth=0.6)
    for k, name in enumerate(map(str, tendency["absorber"])):
        axes.plot(
            tendency["frequency_axis"], tendency["linearised_normalised"][k, row], **LOOKS[name]
        )
        axes.plot(
            tendency["frequency"],
            tendency["evolution_tendency_normalised"][k, row],
            MARKERS[name],
            color=LOOKS[name]["color"],
            markersize=2.6,
        )
    axes.set_xlim(figures.limits(tendency["frequency_axis"]))


def enlarge(axes: Axes, tendency: dict[str, np.ndarray], row: int) -> None:
    """Show the lower part of the axis, on a scale of its own."""
    axis = tendency["frequency_axis"]
    end = axis[0] + DETAIL * (axis[-1] - axis[0])
    low = tendency["linearised_normalised"][:, row][:, axis <= end]
    if not np.isfinite(low).any():
        axes.set(xlim=(axis[0], end))
        return
    bottom, top = np.nanmin(low), np.nanmax(low)
    margin = 0.08 * (top - bottom)
    axes.set(xlim=(axis[0], end), ylim=(bottom - margin, top + margin))


def label_peaks(axes: Axes, tendency: dict[str, np.ndarray], row: int) -> None:
    """Write frequency of the peaks without absorber and the factor of the absorbers."""
    none = list(tendency["absorber"]).index("none")
    for k, _ in enumerate(tendency["peak"]):
        height = tendency["peak_tendency_normalised"][none, row, k]
        if not height > 0.03:
            continue
        words = f"{tendency['peak_frequency'][none, row, k]:.0f}"
        axes.annotate(
            words,
            (tendency["peak_frequency"][none, row, k], height),
            (0, 3),
            textcoords="offset points",
            ha="center",
            va="bottom",
        )
    axes.margins(y=0.14)


def reasons(tendency: dict[str, np.ndarray]) -> str:
    """Say why each absorber has no simulated order."""
    return "\n".join(
        f"{figures.design_name(str(name))}: {figures.status_words(status, 'periodic')}"
        for name, status in zip(tendency["absorber"], tendency["status"], strict=True)
    )


def legend(tendency: dict[str, np.ndarray]) -> list:
    """Entries of the legend: absorbers as lines, simulations as marks."""
    entries = []
    for name in map(str, tendency["absorber"]):
        words = figures.design_name(name)
        entries.append(figures.key(f"{words}, linearised", **LOOKS[name]))
        if why := figures.status_words(tendency["status"][len(entries) // 2], "periodic"):
            entries.append(figures.key(f"{words}: {why}", linestyle="none"))
            continue
        mark = {"color": LOOKS[name]["color"], "marker": MARKERS[name], "markersize": 2.6}
        entries.append(figures.key(f"{words}, simulated orders", linestyle="none", **mark))
    return entries


if __name__ == "__main__":
    run(main, snakemake)
