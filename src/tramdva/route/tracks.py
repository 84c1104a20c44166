"""Read how trams ran: GPX tracks, and logs of an odometer as tables.

A run is one passage of the track. Speeds of a GPX track are those that its receiver measured
(`speed`), or follow from its places by cubics over some seconds: single places err by metres. What
their noise adds to the scatter of speeds is estimated from how they leave the cubics.
"""

from __future__ import annotations

import csv
import itertools
import math
from datetime import datetime
from typing import NamedTuple

import numpy as np

from tramdva.route.safe_xml import Element, RouteFileError, kept_elements

LARGEST_TABLE = 50_000_000  # bytes
MOST_ROWS = 1_000_000
FASTEST = 150.0 / 3.6  # m/s
LONGEST_GAP = 60.0  # s without a place end a run
SMOOTHING = 2.0  # s, standard deviation of the weights of places around one
STANDING = 0.5  # m/s, below which places that wander count as none
FEWEST_POINTS = 20
NEW_RUN = 50.0  # m, by which the distance falls where a new run begins
JITTER = 2.0  # m, by which it may fall otherwise
TABLES = (("distance_m", "speed_km_h"), ("time_s", "distance_m"))
EARTH = (6378137.0, 6.69437999014e-3)  # m, semi-major axis and squared eccentricity of WGS 84


class Run(NamedTuple):
    """A passage.

    place : (k,) m from its start, not falling
    speed : (k - 1,) m/s between the places
    points : (k, 2) m to the east and north; none in the log of an odometer
    noise : (k - 1,) m^2/s^2, variance of the speeds by errors of the places; none without them
    """

    place: np.ndarray
    speed: np.ndarray
    points: np.ndarray | None = None
    noise: np.ndarray | None = None

    def reversed(self) -> Run:
        """The same run in the other direction."""
        points = None if self.points is None else self.points[::-1]
        noise = None if self.noise is None else self.noise[::-1]
        return Run(self.place[-1] - self.place[::-1], self.speed[::-1], points, noise)


def read_gpx(data: bytes, origin: str) -> list[Run]:
    """Runs of a GPX file: every segment of its tracks, divided at gaps of a minute.

    Parameters
    ----------
    data : of the file; origin : its name, for messages

    Raises
    ------
    RouteFileError
        With file, line, element and what is allowed.
    """
    tracks = kept_elements(data, origin, "gpx", ("trkseg",))
    segments = [[_fix(origin, point) for point in track.all("trkpt")] for track in tracks]
    fixes = [np.array(segment) for segment in segments if len(segment) >= FEWEST_POINTS]
    if not fixes:
        raise RouteFileError(
            f"{origin}: has no track segment of {FEWEST_POINTS} points; "
            "<trkseg> with <trkpt> are read"
        )
    middle = np.concatenate(fixes)[:, :2].mean(axis=0)
    runs = []
    for segment in fixes:
        _check_times(origin, segment[:, 2])
        points = _plane(segment[:, :2], middle)
        for part in np.split(
            np.arange(len(segment)), 1 + np.flatnonzero(np.diff(segment[:, 2]) > LONGEST_GAP)
        ):
            if part.size >= FEWEST_POINTS:
                runs.append(_run_of_places(origin, points[part], *segment[part, 2:].T))
    if not runs:
        raise RouteFileError(f"{origin}: no track runs for {FEWEST_POINTS} points without a gap")
    return runs


def _fix(origin: str, point: Element) -> tuple[float, float, float, float]:
    """Latitude, longitude (degrees), time (s) and speed (m/s, NaN where it is not told)."""
    where = f"{origin}, line {point.line}: <trkpt>"
    latitude, longitude = (
        _number(where, name, point.attributes.get(name, "")) for name in ("lat", "lon")
    )
    if not (abs(latitude) <= 85.0 and abs(longitude) <= 180.0):
        raise RouteFileError(f"{where}: lat must be within 85, lon within 180 degrees")
    time = point.first("time")
    if time is None:
        raise RouteFileError(f"{where}: has no <time>, so that it tells no speed")
    try:
        moment = datetime.fromisoformat(time.words()[:40].replace("Z", "+00:00"))
        seconds = moment.timestamp() if moment.tzinfo else moment.replace(tzinfo=_UTC).timestamp()
    except (ValueError, OverflowError):
        raise RouteFileError(
            f"{where}: <time> {time.words()[:40]!r} is no time as 2026-05-04T12:00:00Z"
        ) from None
    told = _descendant(point, "speed")
    speed = math.nan if told is None else _number(where, "speed", told.words())
    if not (math.isnan(speed) or 0.0 <= speed <= FASTEST):
        raise RouteFileError(f"{where}: speed is {speed:g} m/s; allowed: 0 to {FASTEST:.1f}")
    return latitude, longitude, seconds, speed


_UTC = datetime.fromisoformat("2000-01-01T00:00:00+00:00").tzinfo


def _descendant(element: Element, name: str) -> Element | None:
    for child in element.children:
        if child.name == name:
            return child
        if (found := _descendant(child, name)) is not None:
            return found
    return None


def _number(where: str, name: str, given: str) -> float:
    try:
        value = math.nan if "_" in given else float(given)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise RouteFileError(f"{where}: {name} = {given[:40]!r} is no number")
    return value


def _check_times(origin: str, time: np.ndarray) -> None:
    if (np.diff(time) < 0.0).any():
        raise RouteFileError(f"{origin}: times of a track segment go back")


def _plane(angles: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """Metres east and north of a middle (degrees): an error of 1e-4 within 20 km of it."""
    axis, eccentricity = EARTH
    root = 1.0 - eccentricity * math.sin(math.radians(middle[0])) ** 2
    north = axis * (1.0 - eccentricity) / root**1.5
    east = axis / math.sqrt(root) * math.cos(math.radians(middle[0]))
    away = np.radians(angles - middle)
    return np.column_stack([east * away[:, 1], north * away[:, 0]])


def _run_of_places(origin, points, time, told) -> Run:
    keep = np.concatenate([[True], np.diff(time) > 0.0])
    points, time, told = points[keep], time[keep], told[keep]
    _, velocity, noise = smoothed(points, time)
    is_told = ~np.isnan(told)
    speed = np.where(is_told, told, np.hypot(*velocity.T))
    noise = np.where(is_told, 0.0, noise)
    speed = np.where(speed < STANDING, 0.0, speed)
    if speed.max() > FASTEST:
        raise RouteFileError(
            f"{origin}: places are {3.6 * speed.max():.0f} km/h apart; "
            f"allowed: {3.6 * FASTEST:.0f} km/h"
        )
    between = 0.5 * (speed[1:] + speed[:-1])
    place = np.concatenate([[0.0], np.cumsum(between * np.diff(time))])
    return Run(place, between, points, 0.5 * (noise[1:] + noise[:-1]))


def smoothed(points: np.ndarray, time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places (k, 2) in m and velocities (k, 2) in m/s by a cubic around each place.

    Also the variance (k,) in m^2/s^2 that independent errors of the places give a velocity.

    Notes
    -----
    Weights fall with the time from a place (a bell of 2 s). A mean would cut the curve, a parabola
    take an eighth of the speed off one of 25 m at 5 m/s; a cubic takes 0.3 %.
    """
    count = len(time)
    reach = min(count - 1, max(3, math.ceil(3.0 * SMOOTHING / np.median(np.diff(time)))), 60)
    matrix, squares = np.zeros((2, count, 4, 4))
    right = np.zeros((count, 4, 2))
    for offset in range(-reach, reach + 1):
        other = np.arange(count) + offset
        inside = (other >= 0) & (other < count)
        other = np.clip(other, 0, count - 1)
        away = (time[other] - time) / SMOOTHING
        weight = np.where(inside, np.exp(-0.5 * np.minimum(np.abs(away), 30.0) ** 2), 0.0)
        powers = away[:, None] ** np.arange(4)
        products = weight[:, None, None] * powers[:, :, None] * powers[:, None, :]
        matrix += products
        squares += weight[:, None, None] * products
        right += weight[:, None, None] * powers[:, :, None] * points[other][:, None, :]
    inverse = np.linalg.inv(matrix + np.diag([0.0, 1e-9, 1e-7, 1e-5]))  # few places may be near
    found = inverse @ right
    spread = np.einsum("kij,kjl,klm->kim", inverse, squares, inverse)
    # Of independent errors s a place keeps 1 - 2 h + sum l^2, with its own weight h and all l.
    left = np.mean((points - found[:, 0]) ** 2, axis=1)
    error = left.sum() / np.maximum(1.0 - 2.0 * inverse[:, 0, 0] + spread[:, 0, 0], 1e-3).sum()
    return found[:, 0], found[:, 1] / SMOOTHING, error * spread[:, 1, 1] / SMOOTHING**2


def read_odometer(data: bytes, origin: str) -> list[Run]:
    """Runs of a table with the columns distance_m and speed_km_h, or time_s and distance_m.

    Notes
    -----
    Further columns are passed over. A new run begins where the distance falls by 50 m.

    Raises
    ------
    RouteFileError
        With file, line, column and what is allowed.
    """
    names, rows = _table(data, origin)
    pair = next((each for each in TABLES if set(each) <= set(names)), None)
    if pair is None:
        ways = " or ".join(", ".join(each) for each in TABLES)
        raise RouteFileError(f"{origin}: the columns {ways} are needed; it has {', '.join(names)}")
    columns = [names.index(name) for name in pair]
    lines, values = [], []
    for line, fields in rows:
        if len(fields) != len(names):
            raise RouteFileError(
                f"{origin}, line {line}: {len(fields)} fields; the head names {len(names)} columns"
            )
        where = f"{origin}, line {line}"
        values.append([_number(where, names[k], fields[k]) for k in columns])
        lines.append(line)
    if len(values) < 2:
        raise RouteFileError(f"{origin}: {len(values)} rows; at least two are needed")
    return _runs_of_table(origin, pair, np.array(lines), np.array(values))


def _table(data: bytes, origin: str) -> tuple[list[str], list[tuple[int, list[str]]]]:
    if len(data) > LARGEST_TABLE:
        raise RouteFileError(f"{origin}: is larger than {LARGEST_TABLE} bytes")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise RouteFileError(f"{origin}, line {line}: is not UTF-8 text") from None
    head = text[:1000].split("\n")[0]
    separator = max(",;\t", key=head.count)
    rows = []
    for number, line in enumerate(text.split("\n"), start=1):
        if line.strip() and not line.lstrip().startswith("#"):
            if len(rows) > MOST_ROWS:
                raise RouteFileError(f"{origin}: has more than {MOST_ROWS} rows")
            try:
                (fields,) = csv.reader([line.rstrip("\r\n")], delimiter=separator)
            except (csv.Error, ValueError):
                raise RouteFileError(f"{origin}, line {number}: is no row of a table") from None
            rows.append((number, [field.strip() for field in fields]))
    if not rows:
        raise RouteFileError(f"{origin}: is empty; a line of column names and rows are needed")
    return [name[:40] for name in rows[0][1]], rows[1:]


def _runs_of_table(origin, pair, lines, values) -> list[Run]:
    place = values[:, pair.index("distance_m")]
    steps = np.diff(place)
    begins = np.concatenate([[0], 1 + np.flatnonzero(steps < -NEW_RUN), [place.size]])
    back = np.flatnonzero((steps < -JITTER) & (steps >= -NEW_RUN))
    if back.size:
        raise RouteFileError(
            f"{origin}, line {lines[back[0] + 1]}: the distance falls by {-steps[back[0]]:g} m; "
            f"{JITTER:g} m are noise, {NEW_RUN:g} m begin a new run"
        )
    runs = []
    for first, last in itertools.pairwise(begins):
        if last - first < 2:
            continue
        own = np.maximum.accumulate(place[first:last])
        if pair[1] == "speed_km_h":
            speed = values[first:last, 1] / 3.6
            between = 0.5 * (speed[1:] + speed[:-1])
        else:
            seconds = np.diff(values[first:last, 0])
            if (seconds <= 0.0).any():
                line = lines[first + 1 + int(np.argmax(seconds <= 0.0))]
                raise RouteFileError(f"{origin}, line {line}: time_s does not rise")
            between = np.diff(own) / seconds
        wrong = ~((between >= 0.0) & (between <= FASTEST))
        if wrong.any():
            at = int(np.argmax(wrong))
            raise RouteFileError(
                f"{origin}, line {lines[first + 1 + at]}: the speed is {3.6 * between[at]:g} km/h; "
                f"allowed: 0 to {3.6 * FASTEST:g}"
            )
        runs.append(Run(own, between))
    if not runs:
        raise RouteFileError(f"{origin}: no run has two rows")
    return runs
