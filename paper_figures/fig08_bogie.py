"""Figure 8: the bogie in three views, drawn from its parameters, with the absorbers."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from tramdva import figures, job

STYLE = Path(__file__).parent / "tramdva.mplstyle"
BODY = {"facecolor": "0.92", "edgecolor": "0.35", "linewidth": 0.8}
RIM = {"facecolor": "0.75", "edgecolor": "black", "linewidth": 0.8}
AXLE = {"color": "C1", "linewidth": 2.6, "solid_capstyle": "round"}
PRIMARY = {"color": "C2", "linewidth": 1.6}
SECONDARY = {"color": "C4", "linewidth": 1.6}
ABSORBER = {"facecolor": "C0", "edgecolor": "black", "linewidth": 0.6, "zorder": 6}
TREAD = 0.11  # m, drawn width of a rim


def main(*, pdf: str, png: str, code: str, cfg: dict) -> None:
    """Draw figure 8 from the parameters of the bogie."""
    with figures.style(STYLE):
        figures.save(draw(cfg["bogie"]), pdf, png, f"Bogie: {cfg['label']}")


def draw(bogie: dict) -> Figure:
    """Draw front view (an axle), side view and plan."""
    figure = figures.canvas(figures.DOUBLE_COLUMN, 118)
    grid = figure.add_gridspec(2, 2, width_ratios=[10, 13], height_ratios=[10, 9])
    panels = [figure.add_subplot(place) for place in (grid[0, 0], grid[0, 1], grid[1, 1])]
    for axes, name, draw_view in zip(panels, "abc", (front, side, plan), strict=True):
        figures.letter(axes, name)
        draw_view(axes, bogie)
        axes.set_aspect("equal")
        axes.autoscale_view()
        axes.margins(0.05)
    panels[0].set(xlabel="to the right, outwards (m)", ylabel="height over the rail (m)")
    panels[1].set(xlabel="forward (m)", ylabel="height (m)")
    panels[2].set(xlabel="forward (m)", ylabel="to the left (m)")
    entries = [
        figures.key("axle bridge", **AXLE),
        figures.key("primary suspension", **PRIMARY),
        figures.key("secondary suspension", **SECONDARY),
        figures.key(
            describe(bogie["absorber"]), color="C0", marker="s", linestyle="none",
            markeredgecolor="black",
        ),
        figures.key("rim, frame, car body", color="0.5", marker="s", linestyle="none"),
    ]  # fmt: skip
    empty = figure.add_subplot(grid[1, 0])
    empty.axis("off")
    empty.legend(handles=entries, loc="center", frameon=False)
    return figure


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


def front(axes: Axes, bogie: dict) -> None:
    """Draw an axle from the front: rims, dropped beam with arms, primary springs, absorbers."""
    wheel, axle, absorber = bogie["wheel"], bogie["axle"], bogie["absorber"]
    radius, half, end = wheel["radius"], wheel["half_distance"], axle["half_length"]
    bottom = radius - axle["drop"]
    primary = bogie["primary"]
    secondary = bogie["secondary"]
    frame = bogie["frame"]["height"]
    axes.axhline(0.0, color="0.4", linewidth=0.8)
    axes.add_patch(Rectangle((-0.7, frame + 0.02), 1.4, 0.07, **BODY))
    floor = secondary["height"] + 0.1
    axes.add_patch(Rectangle((-1.15, floor), 2.3, 0.12, **BODY))
    for side in (-1, 1):
        axes.add_patch(Rectangle((side * half - TREAD / 2, 0), TREAD, 2 * radius, **RIM))
        axes.plot([side * end, side * end, side * half], [bottom, radius, radius], **AXLE)
        y = side * primary["lateral_position"]
        spring(axes, (y, primary["height"] - 0.06), (y, frame + 0.02), PRIMARY)
        y = side * secondary["lateral_position"]
        spring(axes, (y, frame + 0.09), (y, floor), SECONDARY)
        place = (side * absorber["lateral_position"] - 0.05, absorber["height"] - 0.04)
        axes.add_patch(Rectangle(place, 0.1, 0.08, **ABSORBER))
    axes.plot([-end, end], [bottom, bottom], **AXLE)


def side(axes: Axes, bogie: dict) -> None:
    """Draw the bogie from its side."""
    radius, a = bogie["wheel"]["radius"], bogie["half_wheelbase"]
    frame, secondary = bogie["frame"]["height"], bogie["secondary"]
    bottom, absorber = radius - bogie["axle"]["drop"], bogie["absorber"]
    floor = secondary["height"] + 0.1
    axes.axhline(0.0, color="0.4", linewidth=0.8)
    axes.add_patch(Rectangle((-a - 0.35, frame + 0.02), 2 * a + 0.7, 0.07, **BODY))
    axes.add_patch(Rectangle((-a - 0.75, floor), 2 * a + 1.5, 0.12, **BODY))
    spring(axes, (0, frame + 0.09), (0, floor), SECONDARY)
    for x in (-a, a):
        axes.add_patch(Circle((x, radius), radius, **RIM))
        axes.add_patch(Circle((x, radius), 0.55 * radius, fill=False, edgecolor="0.4", lw=0.6))
        axes.plot([x, x], [bottom, radius], **AXLE)
        spring(axes, (x, bogie["primary"]["height"] - 0.06), (x, frame + 0.02), PRIMARY)
        axes.add_patch(Rectangle((x - 0.05, absorber["height"] - 0.04), 0.1, 0.08, **ABSORBER))


def plan(axes: Axes, bogie: dict) -> None:
    """Draw the bogie from above."""
    radius, half, a = bogie["wheel"]["radius"], bogie["wheel"]["half_distance"], bogie[
        "half_wheelbase"
    ]  # fmt: skip
    end, absorber = bogie["axle"]["half_length"], bogie["absorber"]["lateral_position"]
    primary, secondary = bogie["primary"]["lateral_position"], bogie["secondary"]
    for y in (-half, half):
        axes.axhline(y, color="0.4", linewidth=0.8)
    axes.add_patch(Rectangle((-a - 0.3, -0.45), 2 * a + 0.6, 0.9, **BODY))
    for x in (-a, a):
        axes.plot([x, x], [-half, half], **AXLE)
        for side_ in (-1, 1):
            rim = (x - radius, side_ * half - TREAD / 2)
            axes.add_patch(Rectangle(rim, 2 * radius, TREAD, **RIM))
            spring(axes, (x - 0.16, side_ * primary), (x, side_ * primary), PRIMARY)
            place = (x - 0.05, side_ * absorber - 0.05)
            axes.add_patch(Rectangle(place, 0.1, 0.1, **ABSORBER))
    for y in (-secondary["lateral_position"], secondary["lateral_position"]):
        axes.add_patch(Circle((0, y), 0.08, fill=False, edgecolor="C4", linewidth=1.6))
    axes.annotate(
        "running direction", (a + 0.55, 0.0), (a - 0.35, 0.0), va="center", ha="right",
        fontsize="small", arrowprops={"arrowstyle": "->"},
    )  # fmt: skip
    axes.plot([-end, end], [0, 0], alpha=0.0)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            pdf=snakemake.output.pdf,
            png=snakemake.output.png,
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
        )
