"""A page of absorber designs that holds its data and the plotting library, all compressed."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import bokeh.embed
import numpy as np
from bokeh.plotting import figure

from tramdva.report import packed_arrays, stamp

LIBRARY = Path(bokeh.__file__).parent / "server/static/js/bokeh.min.js"


class Shown(NamedTuple):
    """A plot and what stands above and below it; a wide one takes a row for itself."""

    name: str
    title: str
    caption: str
    plot: figure
    wide: bool = False

    def place(self) -> str:
        """Return the place of the plot on the page."""
        return (
            f"<figure{' class=wide' if self.wide else ''}><h3>{html.escape(self.title)}</h3>"
            f'<div class="plot" id="{self.name}"></div>'
            f"<figcaption>{html.escape(self.caption)}</figcaption></figure>"
        )


class Part(NamedTuple):
    """The part of one model: its sliders, table and plots.

    best : words of the button that chooses the best design
    data : for the page's script, plain numbers and texts
    """

    name: str
    title: str
    best: str
    data: dict[str, Any]
    plots: Sequence[Shown]

    def content(self) -> dict[str, Any]:
        """Return all data of the part, plots included."""
        return self.data | {"plots": {p.name: bokeh.embed.json_item(p.plot) for p in self.plots}}


def filled(folder: Path, label: str, parts: Sequence[Part]) -> str:
    """Fill the parts of all models into the page.

    Parameters
    ----------
    folder : path
        Holds ``explorer.html``, ``explorer.css`` and ``explorer.js``.
    label : str
        Label of the line, which may hold anything.
    parts : sequence of Part

    Returns
    -------
    str
        The page, which asks nothing of a network.
    """
    data = json.dumps({part.name: part.content() for part in parts}, allow_nan=False)
    blobs = {
        "library": packed_arrays.deflated(LIBRARY.read_bytes()),
        "data": packed_arrays.deflated(data.encode()),
    }
    text = (folder / "explorer.html").read_text(encoding="utf-8")
    for name, content in {
        "style": (folder / "explorer.css").read_text(encoding="utf-8"),
        "sections": "\n".join(section(part) for part in parts),
        "data": json.dumps(blobs),
        "script": (folder / "explorer.js").read_text(encoding="utf-8"),
        "title": f"Absorber explorer: {html.escape(label)}",
        "made": html.escape(stamp.words()),
        "label": html.escape(label),  # last: a label cannot stand for another part
    }.items():
        text = text.replace(f"@{name}@", content)
    return text


def row(name: str, unit: str, form: str, values: np.ndarray, none: float) -> dict:
    """Row of the table: texts of all designs and without absorber."""
    return {
        "name": name,
        "unit": unit,
        "cells": [[number(value, form) for value in line] for line in values],
        "none": number(none, form),
    }


def row_of(found: Mapping[str, np.ndarray], variable: str, name: str, unit: str, form: str) -> dict:
    """Row of a variable of a result file that also stands there without absorber."""
    return row(name, unit, form, found[variable], found[f"none_{variable}"])


def number(value: float, form: str) -> str:
    """Write a number, or a dash where there is none."""
    return form.format(value) if np.isfinite(value) else "–"


def verdicts(kinds: np.ndarray, words: Mapping[str, tuple[str, str]], B: float) -> dict:
    """Say of every design whether it is stable."""
    names = list(words)
    return {
        "verdicts": [[tone, text.format(B=B)] for tone, text in words.values()],
        "verdict": [[names.index(str(kind)) for kind in line] for line in kinds],
    }


def section(part: Part) -> str:
    """Return the part of the page for one model."""
    name, places = part.name, "\n".join(shown.place() for shown in part.plots)
    return f"""<section id="{name}">
<div class="panel">
<h2>{html.escape(part.title)}</h2>
<label class="slider"><span>Stiffness c_T <output class="stiffness"></output></span>
<input type="range" class="c_T" min="0" step="1" aria-label="{name}: stiffness of the absorber">
<small class="tuned"></small></label>
<label class="slider"><span>Damping d_T <output class="damping"></output></span>
<input type="range" class="d_T" min="0" step="1" aria-label="{name}: damping of the absorber">
<small class="ratio"></small></label>
<div class="choices"><button type="button" class="own">line's absorber</button>
<button type="button" class="best">{html.escape(part.best)}</button></div>
<p class="verdict" role="status"></p>
<table><thead><tr><th></th><th>this</th><th>line's</th><th>none</th></tr></thead>
<tbody></tbody></table>
<p class="note"></p>
</div>
<div class="plots">
{places}
</div>
</section>"""
