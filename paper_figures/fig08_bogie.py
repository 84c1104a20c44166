"""Figure 8: the bogie in three views, drawn from its parameters, with the absorbers."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from tramdva.report import figures
from tramdva.report.script import run

STYLE = Path(__file__).parent / "tramdva.mplstyle"
# Dashed: bodies of which the model has mass and joints, but no outline.
BODY = {"facecolor": "0.95", "edgecolor": "0.45", "linewidth": 0.7, "linestyle": "--"}
RIM = {"facecolor": "0.80", "edgecolor": "black", "linewidth": 0.8}
AXLE = {"color": "C1", "linewidth": 2.6, "solid_capstyle": "round"}
PRIMARY = {"color": "C2", "linewidth": 1.4}
SECONDARY = {"color": "C4", "linewidth": 1.4}
ABSORBER = {"facecolor": "C0", "edgecolor": "black", "linewidth": 0.6, "zorder": 6}
RAIL = {"color": "0.4", "linewidth": 0.8}
TREAD, BLOCK = 0.11, 0.10  # m, drawn width of a rim, side of an absorber
FLOOR, OVERHANG = 0.12, 0.35  # m, drawn height of the car body and length of the frame beyond axles


def main(*, pdf: str, png: str, code: str, cfg: dict) -> None:
    """Draw figure 8 from the parameters of the bogie."""
    with figures.style(STYLE):
        figures.save(draw(cfg["bogie"]), pdf, png, f"Bogie: {cfg['label']}")


def draw(bogie: dict) -> Figure:
    """Draw an axle from behind, the bogie from its side, and its plan, all to one scale."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 112)
    grid = figure.add_gridspec(2, 2, width_ratios=[26, 21])
    panels = [figure.add_subplot(place) for place in (grid[0, 0], grid[1, 0], grid[:, 1])]
    half = bogie["half_wheelbase"] + bogie["wheel"]["radius"] + 0.15
    for axes, name, draw_view in zip(panels, "abc", (behind, side, plan), strict=True):
        figures.letter(axes, name)
        draw_view(axes, bogie)
        axes.set_aspect("equal")
    for axes in panels[:2]:
        axes.set(xlim=(-half, half), ylim=(-0.28, 0.86), ylabel="height (m)")
    panels[0].set_xlabel("to the right, outwards (m)")
    panels[1].set_xlabel("forward (m)")
    panels[2].set(
        xlim=(-1.05, 1.05), ylim=(-half, half), xlabel="to the right, outwards (m)",
        ylabel="forward (m)",
    )  # fmt: skip
    entries = [
        figures.key("axle bridge", **AXLE),
        figures.key("primary suspension", **PRIMARY),
        figures.key("secondary suspension", **SECONDARY),
        figures.key(
            describe(bogie["absorber"]), color="C0", marker="s", linestyle="none",
            markeredgecolor="black",
        ),
        figures.key("rim", color="0.80", marker="s", linestyle="none", markeredgecolor="black"),
        figures.key("frame, car body (no outline in the model)", color="0.45", linestyle="--"),
    ]  # fmt: skip
    figures.legend_below(figure, entries, 3)
    return figure


def dimension(
    axes: Axes, start: tuple[float, float], end: tuple[float, float], word: str, beside: float = 0.0
) -> None:
    """Draw a dimension line with its length in mm between two points, its text `beside` it (m)."""
    axes.annotate(
        "", end, start,
        arrowprops={"arrowstyle": "<->", "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip
    axes.text(
        0.5 * (start[0] + end[0]) + beside, 0.5 * (start[1] + end[1]),
        f"{word} {1e3 * np.hypot(end[0] - start[0], end[1] - start[1]):.0f} mm",
        ha="left" if beside else "center", va="center", fontsize="small", zorder=7,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
    )  # fmt: skip


def describe(absorber: dict) -> str:
    """Name the absorber by motion and values."""
    unit = "kg m²" if absorber["motion"] == "rotation" else "kg"
    axis = max("xyz", key=lambda name: abs(absorber["direction"][name]))
    kind = f"{absorber['motion']} {'about' if unit == 'kg m²' else 'along'} {axis}"
    return f"absorber, {kind}, {absorber['I_T']:g} {unit}"


def spring(axes: Axes, start: tuple[float, float], end: tuple[float, float], look: dict) -> None:
    """Draw a zigzag between two points."""
    (x, y), (u, v) = start, end
    along = np.linspace(0.0, 1.0, 12)
    zigzag = 0.025 * np.array([0, 0, 1, -1, 1, -1, 1, -1, 1, -1, 0, 0])
    length = np.hypot(u - x, v - y)
    axes.plot(
        x + along * (u - x) - zigzag * (v - y) / length,
        y + along * (v - y) + zigzag * (u - x) / length,
        **look,
    )


def block(axes: Axes, x: float, y: float) -> None:
    """Draw an absorber around its point."""
    axes.add_patch(Rectangle((x - BLOCK / 2, y - BLOCK / 2), BLOCK, BLOCK, **ABSORBER))


def levels(bogie: dict) -> tuple[float, float, float]:
    """Heights (m) of the axle bridge's middle, and of frame and floor clear of their springs."""
    bottom = bogie["wheel"]["radius"] - bogie["axle"]["drop"]
    return bottom, bogie["primary"]["height"] + 0.08, bogie["secondary"]["height"] + 0.1


def behind(axes: Axes, bogie: dict) -> None:
    """Draw an axle from behind: rims, dropped beam with arms, primary springs, absorbers."""
    wheel, absorber = bogie["wheel"], bogie["absorber"]
    radius, half, end = wheel["radius"], wheel["half_distance"], bogie["axle"]["half_length"]
    primary, secondary = bogie["primary"], bogie["secondary"]
    bottom, frame, floor = levels(bogie)
    axes.axhline(0.0, **RAIL)
    axes.add_patch(Rectangle((-0.65, frame), 1.3, 0.07, **BODY))
    axes.add_patch(Rectangle((-1.15, floor), 2.3, FLOOR, **BODY))
    for side_ in (-1, 1):
        axes.add_patch(Rectangle((side_ * half - TREAD / 2, 0), TREAD, 2 * radius, **RIM))
        axes.plot([side_ * end, side_ * end, side_ * half], [bottom, radius, radius], **AXLE)
        y = side_ * primary["lateral_position"]
        spring(axes, (y, radius), (y, frame), PRIMARY)
        y = side_ * secondary["lateral_position"]
        spring(axes, (y, frame + 0.07), (y, floor), SECONDARY)
        block(axes, side_ * absorber["lateral_position"], absorber["height"])
    axes.plot([-end, end], [bottom, bottom], **AXLE)
    dimension(axes, (-half, -0.19), (half, -0.19), "wheels")
    place = absorber["lateral_position"]
    dimension(axes, (-place, -0.08), (place, -0.08), "absorbers")
    axes.plot([-half, half], [radius, radius], color="0.4", linewidth=0.5, linestyle="-.")
    dimension(axes, (-0.28, bottom), (-0.28, radius), "drop", 0.02)


def side(axes: Axes, bogie: dict) -> None:
    """Draw the bogie from its right side."""
    radius, a, absorber = bogie["wheel"]["radius"], bogie["half_wheelbase"], bogie["absorber"]
    bottom, frame, floor = levels(bogie)
    axes.axhline(0.0, **RAIL)
    axes.add_patch(Rectangle((-a - OVERHANG, frame), 2 * (a + OVERHANG), 0.07, **BODY))
    axes.add_patch(Rectangle((-2 * a, floor), 4 * a, FLOOR, **BODY))
    spring(axes, (0, frame + 0.07), (0, floor), SECONDARY)
    for x in (-a, a):
        axes.add_patch(Circle((x, radius), radius, **RIM))
        axes.add_patch(Circle((x, radius), 0.72 * radius, facecolor="white", edgecolor="0.4"))
        axes.plot([x, x], [bottom, radius], **AXLE)
        spring(axes, (x, radius), (x, frame), PRIMARY)
        block(axes, x, absorber["height"])
    dimension(axes, (-a, -0.12), (a, -0.12), "wheelbase")
    dimension(axes, (-a + radius + 0.05, 0.0), (-a + radius + 0.05, radius), "radius", 0.03)
    axes.annotate("", (0.35, 0.3), (-0.05, 0.3), arrowprops={"arrowstyle": "-|>", "color": "0.3"})
    axes.text(0.15, 0.32, "running direction", ha="center", va="bottom", fontsize="small")


def plan(axes: Axes, bogie: dict) -> None:
    """Draw the bogie from above, forward up."""
    wheel, a, absorber = bogie["wheel"], bogie["half_wheelbase"], bogie["absorber"]
    radius, half = wheel["radius"], wheel["half_distance"]
    primary, secondary = bogie["primary"]["lateral_position"], bogie["secondary"]
    place = absorber["lateral_position"]
    for y in (-half, half):
        axes.axvline(y, **RAIL)
    axes.add_patch(Rectangle((-0.65, -a - OVERHANG), 1.3, 2 * (a + OVERHANG), **BODY))
    for x, word in ((-a, "rear"), (a, "front")):
        axes.plot([-half, half], [x, x], **AXLE)
        axes.text(0.0, x - 0.06, f"{word} axle", ha="center", va="top", fontsize="small")
        for side_ in (-1, 1):
            rim = (side_ * half - TREAD / 2, x - radius)
            axes.add_patch(Rectangle(rim, TREAD, 2 * radius, **RIM))
            block(axes, side_ * place, x)
            ring = Circle((side_ * primary, x), 0.085, fill=False, zorder=7, **PRIMARY)
            axes.add_patch(ring)
    for side_ in (-1, 1):
        middle = (side_ * secondary["lateral_position"], 0)
        axes.add_patch(Circle(middle, 0.085, fill=False, **SECONDARY))
    axes.annotate(
        "curve to the left", (-0.3, 0.5), (0.05, 0.2), ha="center", va="top", fontsize="small",
        arrowprops={"arrowstyle": "-|>", "color": "0.3", "connectionstyle": "arc3,rad=0.25"},
    )  # fmt: skip
    axes.text(-half - 0.18, 0.0, "inner", rotation=90, va="center", ha="center", fontsize="small")
    axes.text(half + 0.18, 0.0, "outer", rotation=90, va="center", ha="center", fontsize="small")


if __name__ == "__main__":
    run(main, snakemake)
