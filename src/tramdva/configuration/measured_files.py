"""Measured files of the lines: where they are, what they hold, and what is wrong with them.

Their names are relative to the folder of the configuration, so that they ship with the lines.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from tramdva.configuration.line import Line

if TYPE_CHECKING:
    import numpy as np

    from tramdva.contact.parameters import ContactGeometry

    Named = tuple[str, np.ndarray]

LARGEST = 10_000_000  # bytes; nothing larger is hashed

# Measurements of a line and the keys that name their files.
KEYS = {
    "wheel": ("contact_geometry", "wheel", "measured"),
    "rail": ("contact_geometry", "rail", "measured"),
    "out_of_roundness": ("out_of_roundness", "measured"),
    "route": ("route", "file"),
}


class MeasuredFile(NamedTuple):
    """A measured file: its path and the SHA-256 of its content."""

    path: str
    sha256: str


class UnusableFileError(ValueError):
    """A file that cannot be read at all."""


def names(line: Line) -> dict[str, str]:
    """Names of the files of a line by what they measure; only those that are given."""
    given = {}
    for what, key in KEYS.items():
        value = line
        for part in key:
            value = getattr(value, part)
        if value:
            given[what] = value
    return given


def found(folder: Path, name: str) -> MeasuredFile:
    """Find a file and hash its content.

    Parameters
    ----------
    folder : Path
        Of the configuration.
    name : str
        As in the line.

    Returns
    -------
    MeasuredFile
        The content, not the date, tells whether results are current.

    Raises
    ------
    UnusableFileError
        With what is wrong, without the name.
    """
    path = Path(os.path.normpath(folder / name))
    if not path.is_file():  # a device may have no end
        raise UnusableFileError(f"there is no file {path}")
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise UnusableFileError(f"{path} cannot be read: {error.strerror}") from None
    if len(content) > LARGEST:
        raise UnusableFileError(f"{path} is larger than {LARGEST} bytes")
    return MeasuredFile(path.as_posix(), hashlib.sha256(content).hexdigest())


def check_or_exit(
    files: Mapping[str, Mapping[str, MeasuredFile]], lines: Mapping[str, Line]
) -> None:
    """End the program where measured files are wrong, with a line for each, before a run.

    Parameters
    ----------
    files : mapping
        By line and by what they measure.
    lines : mapping
        The lines by name.
    """
    problems = [
        problem
        for name, of_line in files.items()
        if of_line
        for problem in _problems(lines[name], of_line)
    ]
    if problems:
        raise SystemExit("\n".join(dict.fromkeys(problems)))


def _problems(line: Line, files: Mapping[str, MeasuredFile]) -> Iterator[str]:
    # NumPy is loaded only by runs that have such files.
    from tramdva.contact.measured_profile import check_pair, read_profile
    from tramdva.evolution.out_of_roundness import read_measurement
    from tramdva.route.sections import read_sections

    shape, profiles = line.contact_geometry, {}
    for what, file in files.items():
        try:
            if what == "out_of_roundness":
                read_measurement(file.path)
            elif what == "route":
                read_sections(file.path)
            else:
                noise = getattr(shape, what).measured_noise
                profiles[what] = file.path, read_profile(file.path, what, noise)
        except ValueError as error:
            yield str(error)
    if profiles and set(profiles) == set(files) - {"out_of_roundness", "route"}:
        try:
            check_pair(*_pair(shape, profiles), shape.rail.lateral_position)
        except ValueError as error:
            yield str(error)


def _pair(shape: ContactGeometry, profiles: Mapping[str, Named]) -> Iterator[Named]:
    """Names and points in mm of wheel and rail, measured or made of their parameters."""
    leans = shape.rail.inclination != 0.0
    if leans or len(profiles) < 2:
        from tramdva.contact import tables  # with Numba: only where it is needed
    for kind in ("wheel", "rail"):
        if kind in profiles:
            name, points = profiles[kind]
            turns = leans and kind == "rail"
            yield name, tables.turned_in_track(points, shape.rail) if turns else points
            continue
        made = {"wheel": tables.parametric_wheel, "rail": tables.parametric_rail}[kind]
        profile = made(getattr(shape, kind))
        yield f"the {kind} of the parameters", tables.points_in_mm(profile)
