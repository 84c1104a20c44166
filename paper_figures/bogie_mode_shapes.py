"""Mode shapes of the front axle in the curve, with their strain energy."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tramdva import results
from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
AMPLITUDE = 0.12  # m, drawn size of the largest displacement
AXLE = {"color": "C1", "linewidth": 1.8}
REST = {"color": "0.75", "linewidth": 1.0}


def main(*, pdf: str, png: str, code: str, cfg: dict, bogie_modes: str) -> None:
    """Draw the figure from the modes of the bogie."""
    with figures.style(STYLE):
        figure = draw(results.read(bogie_modes), cfg["bogie"]["wheel"]["radius"])
        figures.save(figure, pdf, png, f"Mode shapes: {cfg['label']}")


def draw(modes: dict[str, np.ndarray], wheel_radius: float) -> Figure:
    """Draw the axle from behind, outer wheel to the right, in each of its modes."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 100)
    panels = figure.subplots(2, 2, sharex=True, sharey=True).flat
    for row, (axes, name) in enumerate(zip(panels, modes["shape_mode"], strict=True)):
        axes.set_aspect("equal")
        axes.set_title(figures.mode_name(str(name)), loc="left", fontsize="medium")
        if np.isnan(modes["shape_frequency"][row]):
            why = figures.status_words(modes["status"][:1], "converged")
            figures.note(axes, (why and f"not computed:\n{why}") or "no such mode")
            continue
        draw_mode(axes, modes, row, wheel_radius)
        axes.text(
            0.5, 0.03, facts(modes, row), transform=axes.transAxes, ha="center", fontsize="small",
            linespacing=1.3,
        )  # fmt: skip
    for axes in figure.axes[2:]:
        axes.set_xlabel("to the right, outwards (m)")
    for axes in figure.axes[::2]:
        axes.set_ylabel("height (m)")
    figure.axes[0].set(xlim=(-1.15, 1.15), ylim=(-0.42, 0.78), yticks=(0.0, 0.3, 0.6))
    return figure


def facts(modes: dict[str, np.ndarray], row: int) -> str:
    """Name frequency and damping, and the two largest shares of the strain energy."""
    share = modes["strain_energy_share"][row]
    largest = np.argsort(share)[::-1][:2]
    energies = ", ".join(
        f"{str(modes['energy_class'][k]).replace('_', ' ')} {100 * share[k]:.0f} %" for k in largest
    )
    frequency, damping = modes["shape_frequency"][row], 100 * modes["shape_damping_ratio"][row]
    return f"{frequency:.1f} Hz, damping {damping:.1f} %\n{energies}"


def draw_mode(axes: Axes, modes: dict[str, np.ndarray], row: int, wheel_radius: float) -> None:
    """Draw the axle at rest and at the instant of its largest displacement."""
    rest = modes["point_position"][:, 1:].copy()
    motion = modes["shape_real"][row] + 1j * modes["shape_imag"][row]
    plane = motion[:, 1:3].ravel()
    turn = np.exp(-0.5j * np.angle(np.sum(plane**2)))
    displacement = AMPLITUDE * (motion * turn).real
    for shift, look, rim in ((0.0, REST, "0.8"), (1.0, AXLE, "black")):
        place = rest + shift * displacement[:, 1:3]
        hubs = [0, len(place) - 1]
        axes.plot(-place[1:-1, 0], place[1:-1, 1], **look)
        for hub, end in zip(hubs, (1, -2), strict=True):
            axes.plot(-place[[hub, end], 0], place[[hub, end], 1], **look)
            lean = shift * displacement[hub, 3]
            spoke = wheel_radius * np.array([-np.sin(lean), np.cos(lean)])
            ends = place[hub] + np.outer([-1.0, 1.0], spoke)
            axes.plot(-ends[:, 0], ends[:, 1], color=rim, linewidth=2.4)
    axes.axhline(0.0, color="0.4", linewidth=0.6)


if __name__ == "__main__":
    run(main, snakemake)
