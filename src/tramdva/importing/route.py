"""Make the table of a route from an alignment and logs of speed.

    python -m tramdva.importing.route alignment.xml [--speeds log ...] --out routes/mine.csv

The alignment is a LandXML file, or a GPX file whose track is measured then. Logs are GPX tracks or
tables of an odometer. Beside the table lies a picture of what was read.
"""

from __future__ import annotations

import argparse
import csv
import io
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from tramdva.importing import route_picture
from tramdva.results import atomically
from tramdva.route.alignment import Alignment, TrackSection, sections_of
from tramdva.route.landxml import read_landxml
from tramdva.route.measured_track import MeasuredTrack, measured_track
from tramdva.route.passes import SectionSpeed, on_alignment, speeds_of
from tramdva.route.safe_xml import LARGEST, RouteFileError
from tramdva.route.tracks import Run, read_gpx, read_odometer

COLUMNS = (
    "name", "length_m", "radius_m", "turn", "transition_m", "cant_mm", "speed_km_h",
    "speed_scatter_percent", "friction", "passages_per_lap",
)  # fmt: skip
MOST_SECTIONS = 2000
DOUBTFUL = 0.3  # of a radius
SLOWEST, WIDEST_SCATTER, LONGEST_TRANSITION = 1.8, 20.0, 500.0  # km/h, %, m
ASSUMED_ACCELERATION, ASSUMED_TOP, ASSUMED_SCATTER = 0.65, 50.0, 5.0  # m/s^2, km/h, %
GRAVITY, RAIL_DISTANCE = 9.81, 1.5  # m/s^2, m between the rails' contacts


class Row(NamedTuple):
    """A section and how fast it is run; km/h, % of the mean."""

    section: TrackSection
    speed: float
    scatter: float
    runs: int


class Imported(NamedTuple):
    """What was read.

    alignment : Alignment; rows : Row
    unsure : share by which the radius of each section is unsure, 0 where it is given
    notes : what had to be assumed, a line each
    """

    alignment: Alignment
    rows: list[Row]
    unsure: list[float]
    notes: list[str]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; the result is the exit status."""
    options = _options(arguments)
    try:
        imported = import_route(options.alignment, options.speeds, options.name)
        write_table(options.out, imported, [options.alignment, *options.speeds])
        picture = options.out.with_suffix(".png")
        route_picture.save(picture, imported.alignment, imported.rows)
    except RouteFileError as error:
        print(f"tramdva: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"tramdva: {error.filename}: {(error.strerror or '').lower()}", file=sys.stderr)
        return 1
    for line in summary(imported):
        print(line)
    print(f"written: {options.out}, {picture}")
    return 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python3 run.py route", description="make the table of a route"
    )
    parser.add_argument("alignment", type=Path, help="LandXML (.xml), or a GPX track (.gpx)")
    parser.add_argument(
        "--speeds", type=Path, nargs="+", default=[], help="logs: .gpx, or .csv of an odometer"
    )
    parser.add_argument("--alignment", dest="name", help="its name, where the file has several")
    parser.add_argument("--out", type=Path, required=True, help="table to write, .csv")
    options = parser.parse_args(arguments)
    if options.out.suffix != ".csv":
        parser.error(f"--out {options.out}: must end in .csv")
    return options


def import_route(track: Path, logs: Sequence[Path], name: str | None = None) -> Imported:
    """Sections of a track with the speeds of logs, or assumed ones.

    Raises
    ------
    RouteFileError
        With file, line and what is allowed.
    """
    runs: list[Run] = []
    if track.suffix.lower() == ".gpx":
        paths = [track, *(path for path in logs if path.suffix.lower() == ".gpx")]
        places = [run for path in paths for run in read_gpx(_bytes(path), str(path))]
        measured = measured_track(places, str(track))
        alignment, runs = measured.alignment, list(measured.runs)
        logs = [path for path in logs if path not in paths]
    else:
        measured, alignment = None, read_landxml(_bytes(track), str(track), name)
    for path in logs:
        read = read_gpx if path.suffix.lower() == ".gpx" else read_odometer
        runs += read(_bytes(path), str(path))
    sections = sections_of(alignment)
    if not 1 <= len(sections) <= MOST_SECTIONS:
        raise RouteFileError(f"{track}: {len(sections)} sections; 1 to {MOST_SECTIONS} are allowed")
    notes = list(alignment.notes)
    if not runs:
        notes.append(
            f"ASSUME: no log of speeds; {ASSUMED_ACCELERATION:g} m/s^2 of lateral acceleration "
            f"not made up by cant, at most {ASSUMED_TOP:g} km/h, scatter {ASSUMED_SCATTER:g} %"
        )
        speeds = [SectionSpeed(math.nan, math.nan, math.nan, 0)] * len(sections)
    else:
        if measured is None:
            runs, found = on_alignment(runs, alignment)
            notes += found
        speeds = speeds_of(runs, sections)
    rows = [_row(str(track), *pair) for pair in zip(sections, speeds, strict=True)]
    notes += _limits_noted(rows, speeds, bool(runs))
    unsure = _unsure(sections, measured)
    if doubtful := sum(share > DOUBTFUL for share in unsure):
        notes.append(
            f"radii of {doubtful} curves are unsure by more than {100 * DOUBTFUL:.0f} %: "
            "more runs, a better receiver or an alignment would tell"
        )
    return Imported(alignment, rows, unsure, notes)


def _bytes(path: Path) -> bytes:
    if not path.is_file():  # a device may have no end
        raise RouteFileError(f"{path}: there is no such file")
    with path.open("rb") as file:
        return file.read(LARGEST + 1)


def _row(origin: str, section: TrackSection, speed: SectionSpeed) -> Row:
    if section.transition > LONGEST_TRANSITION:
        raise RouteFileError(
            f"{origin}: a transition of {section.transition:.0f} m; "
            f"{LONGEST_TRANSITION:g} m at most"
        )
    if speed.runs == 0:
        return Row(section, assumed_speed(section), ASSUMED_SCATTER, 0)
    scatter = 100.0 * speed.scatter / speed.mean if speed.mean > 0.0 else math.inf
    return Row(section, max(3.6 * speed.mean, SLOWEST), min(scatter, WIDEST_SCATTER), speed.runs)


def assumed_speed(section: TrackSection) -> float:
    """Speed in km/h at a usual lateral acceleration."""
    if section.turn == "straight":
        return ASSUMED_TOP
    acceleration = ASSUMED_ACCELERATION + GRAVITY * section.cant / RAIL_DISTANCE
    return min(3.6 * math.sqrt(acceleration * section.radius), ASSUMED_TOP)


def _limits_noted(rows: Sequence[Row], speeds: Sequence[SectionSpeed], logged: bool) -> list[str]:
    notes = []
    without = sum(row.runs == 0 for row in rows)
    if logged and without:
        notes.append(f"ASSUME: no run passes {without} sections; their speeds are assumed")
    wide = sum(
        speed.runs > 0 and speed.scatter > 0.01 * WIDEST_SCATTER * speed.mean for speed in speeds
    )
    if wide:
        notes.append(f"scatter of {wide} sections is above {WIDEST_SCATTER:g} %, written as that")
    return notes


def _unsure(sections: Sequence[TrackSection], measured: MeasuredTrack | None) -> list[float]:
    """By how much each radius is unsure: that of the stretch in the middle of the section."""
    if measured is None:
        return [0.0] * len(sections)
    ends, end = [], 0.0
    for stretch in measured.alignment.stretches:
        end += stretch.length
        ends.append(end)
    found = []
    for section in sections:
        middle = 0.5 * (section.start + section.end)
        number = next(k for k, each in enumerate(ends) if middle <= each)
        found.append(measured.uncertainty[number])
    return found


def write_table(path: Path, imported: Imported, sources: Sequence[Path]) -> None:
    """Write the table of sections, with what it was made from as comments."""
    text = io.StringIO()
    text.write(f"# Route from {', '.join(_printable(source.name) for source in sources)}\n")
    if imported.alignment.name:
        text.write(f"# Alignment: {_printable(imported.alignment.name)}\n")
    for note in imported.notes:
        text.write(f"# {_printable(note)}\n")
    for number, share in enumerate(imported.unsure, start=1):
        if share > 0.0:
            text.write(f"# radius of section {number}: +-{100.0 * share:.0f} %\n")
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for number, row in enumerate(imported.rows, start=1):
        table.writerow(_fields(number, row))
    with atomically(path) as part:
        part.write_text(text.getvalue(), encoding="utf-8")


def _printable(text: str) -> str:
    return "".join(letter if letter.isprintable() else "?" for letter in text)[:200]


def _fields(number: int, row: Row) -> list[str]:
    section = row.section
    straight = section.turn == "straight"
    name = f"{number} straight" if straight else f"{number} {section.turn} {section.radius:.0f} m"
    return [
        name,
        f"{section.length:.3f}",
        "" if straight else f"{section.radius:.3f}",
        section.turn,
        "0" if straight else f"{section.transition:.3f}",
        f"{1000.0 * section.cant:.1f}",
        f"{row.speed:.2f}",
        f"{row.scatter:.2f}",
        "",
        "1",
    ]


def summary(imported: Imported) -> list[str]:
    """What was read, in a few lines."""
    sections = [row.section for row in imported.rows]
    curves = [section for section in sections if section.turn != "straight"]
    lines = [
        f"{imported.alignment.length:.0f} m in {len(sections)} sections, {len(curves)} of them "
        f"curves ({sum(c.turn == 'left' for c in curves)} left, "
        f"{sum(c.turn == 'right' for c in curves)} right)"
    ]
    if curves:
        share = sum(c.end - c.start for c in curves) / imported.alignment.length
        radii = sorted(c.radius for c in curves)
        lines.append(
            f"curves are {100.0 * share:.0f} % of the way, radii {radii[0]:.1f} to "
            f"{radii[-1]:.0f} m; the sharpest: {_listed(imported)}"
        )
    speeds = [row.speed for row in imported.rows]
    scatters = [row.scatter for row in imported.rows]
    runs = max(row.runs for row in imported.rows)
    lines.append(
        f"speeds {min(speeds):.1f} to {max(speeds):.1f} km/h, scatter {min(scatters):.1f} to "
        f"{max(scatters):.1f} %, " + (f"by {runs} runs" if runs else "assumed")
    )
    return lines + [f"note: {_printable(note)}" for note in imported.notes]


def _listed(imported: Imported) -> str:
    """The three sharpest curves."""
    curves = [
        (row.section.radius, row.section.start, row.speed, share)
        for row, share in zip(imported.rows, imported.unsure, strict=True)
        if row.section.turn != "straight"
    ]
    words = []
    for radius, start, speed, share in sorted(curves)[:3]:
        unsure = f" +-{100.0 * share:.0f} %" if share > 0.0 else ""
        words.append(f"{radius:.1f} m{unsure} at {start:.0f} m, {speed:.0f} km/h")
    return "; ".join(words)


if __name__ == "__main__":
    sys.exit(main())
