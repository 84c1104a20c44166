"""Sections of a route from a table: a line each, the names of the columns at its head.

Columns are the keys of `parameters.RouteSection`. Only name, length, turn and speed have to be
there, and the radius of curves; an empty field is one that says nothing.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Mapping
from pathlib import Path

from pydantic import ValidationError

from tramdva.route.parameters import MOST_SECTIONS, SILENT, RouteSection

LARGEST = 2_000_000  # bytes
COLUMNS = tuple(RouteSection.model_fields)
TEXTS = ("name", "turn")


class RouteError(ValueError):
    """A file is no table of sections."""


def read_sections(path: str | Path) -> tuple[RouteSection, ...]:
    """Read a table of sections, separated by commas or semicolons.

    Parameters
    ----------
    path : text file in UTF-8; lines that begin with ``#`` are comments

    Raises
    ------
    RouteError
        With file, line, column and what is allowed.
    """
    rows = list(_rows(Path(path)))
    if not rows:
        raise RouteError(f"{path}: is empty; a line of column names and sections are needed")
    head = _head(path, rows[0])
    found = tuple(_section(path, number, head, fields) for number, fields in rows[1:])
    if not 1 <= len(found) <= MOST_SECTIONS:
        raise RouteError(f"{path}: {len(found)} sections; 1 to {MOST_SECTIONS} are allowed")
    return found


def _rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Numbers of lines and their fields."""
    if not path.is_file():  # a device may have no end
        raise RouteError(f"{path}: there is no such file")
    raw = path.read_bytes()[: LARGEST + 1]
    if len(raw) > LARGEST:
        raise RouteError(f"{path}: is larger than {LARGEST} bytes")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise RouteError(f"{path}, line {line}: is not UTF-8 text") from None
    separator = ";" if text.count(";") > text.count(",") else ","
    for number, line in enumerate(io.StringIO(text), start=1):
        if line.strip() and not line.lstrip().startswith("#"):
            (fields,) = csv.reader([line.rstrip("\r\n")], delimiter=separator)
            yield number, [field.strip() for field in fields]


def _head(path: str | Path, row: tuple[int, list[str]]) -> list[str]:
    number, names = row
    for name in names:
        if name not in COLUMNS:
            raise RouteError(
                f"{path}, line {number}: there is no column {name[:40]!r}; "
                f"there are: {', '.join(COLUMNS)}"
            )
        if names.count(name) > 1:
            raise RouteError(f"{path}, line {number}: column {name} is given twice")
    missing = [name for name in COLUMNS if name not in SILENT and name not in names]
    if missing:
        raise RouteError(f"{path}, line {number}: column {missing[0]} is missing")
    return names


def _section(path: str | Path, number: int, head: list[str], fields: list[str]) -> RouteSection:
    where = f"{path}, line {number}"
    if len(fields) != len(head):
        raise RouteError(f"{where}: {len(fields)} fields; the head names {len(head)} columns")
    given = {}
    for name, field in zip(head, fields, strict=True):
        if field or name not in SILENT:
            given[name] = field if name in TEXTS else _number(where, name, field)
    try:
        return RouteSection.model_validate(given)
    except ValidationError as error:
        slip = error.errors(include_url=False)[0]
        name = str(slip["loc"][0]) if slip["loc"] else ""
        raise RouteError(f"{where}: {name}{': ' if name else ''}{_allowed(name, slip)}") from None


def _number(where: str, name: str, field: str) -> float | None:
    if name == "radius_m" and field.lower() in ("inf", "straight"):
        return None
    try:
        value = math.nan if "_" in field else float(field)  # float() reads 1_000 as a number
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise RouteError(f"{where}: {name} = {field[:40]!r} is no number")
    return value


def _allowed(name: str, slip: Mapping) -> str:
    """What was given, and what is allowed there."""
    field = RouteSection.model_fields.get(name)
    bounds = {
        key: getattr(item, key)
        for item in (field.metadata if field else ())
        for key in ("ge", "le")
        if hasattr(item, key)
    }
    if bounds:
        return f"{slip['input']} must be between {bounds['ge']:g} and {bounds['le']:g}"
    if field is not None and name in TEXTS:
        return f"{str(slip['input'])[:40]!r} must be {field.description}"
    return str(slip["msg"]).removeprefix("Value error, ")
