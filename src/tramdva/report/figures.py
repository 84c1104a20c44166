"""What all figures share: sizes, colours, scales, notes inside axes, files without dates.

For the scripts in `paper_figures/` only: the model knows nothing of figures.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.style
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text

from tramdva.report import stamp
from tramdva.report.design_names import design_name as design_name  # for the scripts
from tramdva.results import atomically
from tramdva.variables.shared import CURVING_WORDS

SINGLE_COLUMN = 84.0  # mm
DOUBLE_COLUMN = 174.0  # mm
STRIP = 2.6  # mm, of the stamp below a figure
SIGNED = 4.5  # pt
MARK = "tramdva origin"
MEGA = 1e6
KILO = 1e3
MILLI = 1e-3

STABLE = "0.68"  # dark grey
OSCILLATORY = "0.90"  # light grey
MONOTONE = "0.45"
NO_ABSORBER = "black"
ONSET = "#C1121F"  # the red line of the critical Hopf points
SPREAD = "cividis"  # for ordered values: its lightness is monotone, so it survives in grey
DASHES = ("--", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (1.5, 0.8)), (0, (8, 2)), (0, (3, 1)))
MARKERS = "osD^vP"

# Absorbers of the bogie; without and with the paper's as in the paper.
ABSORBER_COLOURS = {"none": "C1", "paper": "0.55", "tuned": "C2"}


MODES = {
    "_front": ", front axle",
    "_rear": ", rear axle",
    "_in_phase": ", axles in phase",
    "_opposed": ", axles opposed",
    "_both_axles": ", both axles",
}


def mode_name(mode: str) -> str:
    """Name a mode of the bogie for readers."""
    for ending, words in MODES.items():
        mode = mode.removesuffix(ending) + words if mode.endswith(ending) else mode
    return mode.replace("_", " ")


# How a simulation or an equilibrium ended, for readers.
STATUS_WORDS = CURVING_WORDS | {
    "no_equilibrium": CURVING_WORDS["not_converged"],
    "self_excited": "vibrates by itself, no order was simulated",
    "not_periodic": "did not become periodic",
    "contact_lost": "a wheel loses contact",
    "not_finite": "the simulation failed",
}


def status_words(status: Iterable[str], good: str) -> str:
    """Say why there is no result; nothing where some ended well.

    Parameters
    ----------
    status : iterable of str
        How each part ended.
    good : str
        The status of what ended well.
    """
    ended = list(dict.fromkeys(map(str, status)))
    if good in ended:
        return ""
    return "; ".join(STATUS_WORDS.get(each, each.replace("_", " ")) for each in ended)


# Stiffness per unit of an axis, labels of stiffness and damping of the bogie's absorber.
ABSORBER_AXES = {
    "rotation": (1e5, "stiffness (10⁵ N m/rad)", "damping (N m s/rad)"),
    "translation": (1e6, "stiffness (10⁶ N/m)", "damping (N s/m)"),
}


def style(path: str | Path) -> AbstractContextManager[None]:
    """Return the context in which the figure is drawn and saved.

    Parameters
    ----------
    path : path
        A style sheet of matplotlib.
    """
    return mpl.style.context(["default", str(path)])


def canvas(width: float, height: float) -> Figure:
    """Return an empty figure of a width and height in mm."""
    return Figure(figsize=(width / 25.4, height / 25.4))


def save(figure: Figure, pdf: str | Path, png: str | Path, title: str) -> None:
    """Write a figure as PDF and as PNG.

    The same figure gives the same bytes: neither file holds a date.

    Parameters
    ----------
    figure : Figure
        The figure.
    pdf, png : path
        The files.
    title : str
        Stands in the metadata of both.
    """
    sign(figure)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # both files get the same layout, worked out once
    made = stamp.current()
    mark = {MARK: made.origin, "Source": made.words()} if made else {}
    about = {"Title": title, "CreationDate": None} | ({"Subject": made.words()} if made else {})
    metadata = {"pdf": about, "png": {"Title": title, **mark}}
    for path, kind in ((pdf, "pdf"), (png, "png")):
        with atomically(path) as part:
            figure.savefig(part, format=kind, metadata=metadata[kind])


def sign(figure: Figure) -> None:
    """Write the current stamp below everything else, in a strip of its own at the lower right."""
    if not (words := stamp.words()):
        return
    height = figure.get_figheight() + STRIP / 25.4
    figure.set_figheight(height)
    if (engine := figure.get_layout_engine()) is not None:
        engine.set(rect=(0.0, STRIP / 25.4 / height, 1.0, 1.0 - STRIP / 25.4 / height))
    coarse = stamp.current().resolution != "full"
    figure.text(
        0.995, 0.002, words, ha="right", va="bottom", fontsize=SIGNED,
        color=ONSET if coarse else "0.45",
    )  # fmt: skip


def letter(axes: Axes, name: str) -> Text:
    """Write the letter of a panel above its upper left corner."""
    return axes.set_title(f"({name})", loc="left", fontsize="medium", fontweight="bold")


def note(axes: Axes, words: str, place: tuple[float, float] = (0.5, 0.5)) -> Text:
    """Say inside the axes what happened, in parts of their width and height."""
    box = {"boxstyle": "square", "facecolor": "white", "edgecolor": "0.7", "linewidth": 0.6}
    return axes.text(
        *place,
        words,
        transform=axes.transAxes,
        ha="center",
        va="center",
        linespacing=1.4,
        bbox=box,
        zorder=10,
    )


def nothing(axes: Axes, words: str) -> Text:
    """Say in axes without data why there are none; scales would be invented."""
    axes.set(xticks=[], yticks=[])
    axes.minorticks_off()
    return note(axes, words)


def verbatim(label: str) -> str:
    """Return a label of the configuration so that no letter of it means mathematics."""
    return label.replace("$", r"\$")


def labels(cfg: Mapping[str, Any]) -> dict[str, str]:
    """Labels of the absorber variants by name, in the order of the configuration."""
    return {entry["name"]: verbatim(entry["label"]) for entry in cfg["absorber_variants"]}


def pieces(mask: np.ndarray) -> Iterator[slice]:
    """Cut where a truth changes; each piece but the last ends with the first point of the next.

    Parameters
    ----------
    mask : (n,) array of bool
        A truth along a curve.

    Yields
    ------
    slice
        A stretch whose first point decides for all of it.
    """
    edges = [0, *(np.flatnonzero(np.diff(mask)) + 1).tolist(), len(mask)]
    for start, stop in itertools.pairwise(edges):
        if stop > start:
            yield slice(start, stop + 1)


def critical_pieces(critical: Mapping[str, np.ndarray]) -> Iterator[np.ndarray]:
    """Rows of connected pieces of the critical Hopf curve, each safe below or not at all.

    The curve has no points where c_T would be negative; there it is cut.

    Parameters
    ----------
    critical : mapping
        Variables of `critical_hopf_curve.nc`.

    Yields
    ------
    array of int
        Rows of one piece in their order along the curve.
    """
    for number in np.unique(critical["piece"]):
        part = np.flatnonzero(critical["piece"] == number)
        for piece in pieces(critical["stabilises_all_c_A"][part]):
            yield part[piece]


def critical_look(critical: Mapping[str, np.ndarray], rows: np.ndarray) -> dict[str, Any]:
    """Look and name of a piece of the critical Hopf curve: dotted where it promises too much."""
    if critical["stabilises_all_c_A"][rows[0]]:
        return {"color": "black", "linestyle": "-", "linewidth": 1.6, "label": "critical"}
    return {
        "color": "0.4",
        "linestyle": (0, (1, 1)),
        "linewidth": 1.6,
        "label": "only locally critical",
    }


def limits(axis: np.ndarray) -> tuple[float, float]:
    """Return the ends of an axis; one that begins at next to nothing begins at zero."""
    low, high = float(axis[0]), float(axis[-1])
    return (0.0 if 0.0 < low < 0.01 * high else low), high


def shades(values: Sequence[float]) -> list[Any]:
    """Colours for values in their order, from dark to light but never too light for white paper."""
    places = np.linspace(0.0, 0.78, len(values)) if len(values) > 1 else [0.0]
    return [mpl.colormaps[SPREAD](place) for place in places]


def key(label: str, **look: Any) -> Line2D:
    """Return an entry of a legend that stands for no single artist."""
    return Line2D([], [], label=label, **look)


def legend_below(figure: Figure, handles: Sequence[Artist], columns: int) -> None:
    """Put a legend without frame below all panels."""
    figure.legend(handles=handles, loc="outside lower center", ncols=columns, frameon=False)
