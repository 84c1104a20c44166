"""Figure 7: forced vibration of the rim over the frequency, without and with absorbers."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.figures import KILO, MILLI
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
BLUE = {"color": "C1", "linewidth": 1.4}  # without absorber, as in the paper
GREY = {"color": "0.55", "linewidth": 2.2}  # with the line's absorber, as in the paper
COLOURS = ("C0", "C2", "C3", "black", "C4")  # with the alternatives
ZOOM = (0.6, 1.45)  # of the frequency of the largest peak


def main(
    *, pdf: str, png: str, code: str, cfg: dict, frequency_response: str, absorber_tuning: str
) -> None:
    """Draw figure 7.

    Parameters
    ----------
    pdf, png : str
        The figure in two formats.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line.
    frequency_response, absorber_tuning : str
        Result files.
    """
    with figures.style(STYLE):
        figure = draw(results.read(frequency_response), results.read(absorber_tuning))
        figures.save(figure, pdf, png, f"Frequency response: {cfg['label']}")


def draw(response: dict[str, np.ndarray], tuning: dict[str, np.ndarray]) -> Figure:
    """Draw amplitude above phase: left the paper's two curves, right all designs near the peak."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 118)
    panels = figure.subplots(2, 2, height_ratios=[9, 5], width_ratios=[5, 4], sharex="col")
    for axes, name in zip(panels.flat, "abcd", strict=True):
        figures.letter(axes, name)
    whole = (0.0, float(response["frequency"][-1]))
    peak = float(tuning["reference_peak_frequency"])
    draw_column(panels[:, 0], response, tuning, whole, 2)
    entries = draw_column(
        panels[:, 1], response, tuning, (ZOOM[0] * peak, ZOOM[1] * peak), len(response["design"])
    )
    label_peaks(panels[0, 0], response, tuning)
    panels[0, 0].set_ylabel(r"$|y_R^\ast|\,/\,\eta$ (1/kN)")
    panels[1, 0].set_ylabel("phase (°)")
    scale_in_mm(panels[0, 1], response)
    figures.legend_below(figure, entries, 2)
    return figure


def draw_column(
    panels: Sequence[Axes],
    response: dict[str, np.ndarray],
    tuning: dict[str, np.ndarray],
    window: tuple[float, float],
    designs: int,
) -> list[Artist]:
    """Draw amplitude and phase of the first designs and return the entries of the legend."""
    top, bottom = panels
    shown = (response["frequency"] >= window[0]) & (response["frequency"] <= window[1])
    frequency = response["frequency"][shown]
    entries: list[Artist] = []
    for row, name in enumerate(response["design"][:designs]):
        look = design_look(row)
        top.plot(frequency, normalised(response, row)[shown], **look)
        phase = np.degrees(response["receptance_phase"][row][shown])
        bottom.plot(frequency, phase, **look)
        entries.append(figures.key(describe(tuning, str(name)), **look))
    top.set(yscale="log", xlim=window)
    top.margins(y=0.1)
    bottom.set(xlabel="frequency (Hz)", yticks=[-180, -90, 0], ylim=(-190, 10))
    return entries


def normalised(response: dict[str, np.ndarray], row: int) -> np.ndarray:
    """Amplitude of y_R / y_R0 per kN of the exciting force."""
    return response["receptance_amplitude"][row] / response["y_R_equilibrium"] * KILO


def design_look(row: int) -> dict:
    """Look of a design: none, then the line's own, then the alternatives."""
    if row < 2:
        return (BLUE, GREY)[row]
    colour, dashes = (looks[(row - 2) % len(looks)] for looks in (COLOURS, figures.DASHES))
    return {"color": colour, "linestyle": dashes, "linewidth": 1.1}


def describe(tuning: dict[str, np.ndarray], name: str) -> str:
    """Name a design with its largest peak, or with what is wrong with it."""
    words = figures.design_name(name)
    if name == "none":
        return f"{words}: {tuning['reference_peak_frequency']:.1f} Hz"
    row = int(np.flatnonzero(tuning["design"] == name)[0])
    if not np.isfinite(tuning["reduction"][row]):
        return f"{words}: there is none"
    words = f"{words}: {tuning['peak_frequency'][row]:.1f} Hz, {lower(tuning, row)}"
    failed = tuning["status"][row] != "converged"
    return f"{words}, {tuning['status'][row].replace('_', '-')}" if failed else words


def lower(tuning: dict[str, np.ndarray], row: int) -> str:
    """Reduction of the largest peak in words."""
    return f"{tuning['reduction'][row]:.1f}× lower"


def label_peaks(axes: Axes, response: dict[str, np.ndarray], tuning: dict[str, np.ndarray]) -> None:
    """Write frequencies at the peaks without absorber and the reduction by the line's absorber."""
    offset = {"textcoords": "offset points", "va": "center"}
    heights = response["peak_receptance"] / response["y_R_equilibrium"] * KILO
    for place in zip(response["peak_frequency"], heights, strict=True):
        axes.annotate(f"{place[0]:.0f} Hz", place, (5, 0), **offset)
    receptance = tuning["peak_receptance"][0] / response["y_R_equilibrium"] * KILO
    if np.isfinite(receptance):
        place = tuning["peak_frequency"][0], receptance
        axes.annotate(lower(tuning, 0), place, (14, 0), **offset)


def scale_in_mm(axes: Axes, response: dict[str, np.ndarray]) -> None:
    """Add a scale of the displacement per force."""
    y_R0 = float(response["y_R_equilibrium"]) / MILLI
    scale = axes.secondary_yaxis("right", functions=(lambda y: y * y_R0, lambda y: y / y_R0))
    scale.set_ylabel(r"$|y_R|\,/\,\eta$ (mm/kN)")
    axes.tick_params(which="both", right=False)


if __name__ == "__main__":
    run(main, snakemake)
