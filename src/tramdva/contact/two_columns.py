"""Read measured files: two columns of numbers, whatever they measure."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

COMMENTS = "#!%"


class Layout(NamedTuple):
    """What a file of two columns may hold.

    columns : both columns and their units, in words
    error : class of what is raised
    fewest, most : points
    largest : bytes
    """

    columns: str
    error: type[ValueError]
    fewest: int
    most: int
    largest: int


def read_columns(path: str | Path, layout: Layout) -> tuple[np.ndarray, list[int]]:
    """Read a text file of two columns.

    Parameters
    ----------
    path : a number each, separated by blanks, commas or semicolons; `#`, `!` and `%` start
        comments; a byte-order mark is no content
    layout : Layout

    Returns
    -------
    points : (n, 2) array
    lines : list of n numbers of the lines that hold them

    Raises
    ------
    ValueError
        Of the class of the layout, with file, line and what is wrong.
    """
    path = Path(path)
    points, lines = [], []
    for number, line in enumerate(_text(path, layout).split("\n"), start=1):
        values = _parse(path, number, line, layout)
        if values is not None:
            points.append(values)
            lines.append(number)
    if len(points) > layout.most:
        raise layout.error(f"{path}: {len(points)} points; at most {layout.most}")
    if len(points) < layout.fewest:
        raise layout.error(f"{path}: {len(points)} points; at least {layout.fewest} are needed")
    return np.array(points), lines


def _text(path: Path, layout: Layout) -> str:
    if not path.is_file():  # a device may have no end
        raise layout.error(f"{path}: there is no such file")
    try:
        with path.open("rb") as file:
            raw = file.read(layout.largest + 1)
    except OSError as error:
        raise layout.error(f"{path}: cannot be read: {(error.strerror or '').lower()}") from None
    if len(raw) > layout.largest:
        raise layout.error(f"{path}: is larger than {layout.largest} bytes")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise layout.error(f"{path}, line {line}: is not UTF-8 text") from None


def _parse(path: Path, number: int, line: str, layout: Layout) -> tuple[float, float] | None:
    for comment in COMMENTS:
        line = line.split(comment)[0]
    fields = line.replace(",", " ").replace(";", " ").split()
    if not fields:
        return None
    if len(fields) != 2:
        raise layout.error(
            f"{path}, line {number}: {len(fields)} columns; two are needed, {layout.columns}"
        )
    try:
        values = _number(fields[0]), _number(fields[1])
    except ValueError:
        raise layout.error(
            f"{path}, line {number}: {line.strip()[:60]!r} is not a pair of numbers, "
            f"{layout.columns}"
        ) from None
    if not all(map(math.isfinite, values)):
        raise layout.error(f"{path}, line {number}: {line.strip()[:60]!r} must be finite")
    return values


def _number(field: str) -> float:
    if "_" in field:  # float() reads 1_000 as a number
        raise ValueError
    return float(field)
