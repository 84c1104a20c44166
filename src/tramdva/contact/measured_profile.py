"""Measured profiles: reader of two-column files and the smoothing spline."""

from pathlib import Path

import numpy as np
import scipy  # its parts load when they are used: checking a file needs none

from tramdva.contact.profiles import MM, STEEPEST, Profile, ProfileError, resample

FEWEST_POINTS = 20
SMALLEST_EXTENT_MM = 20.0
LARGEST_EXTENT_MM = 250.0
LARGEST_GAP_MM = 5.0
REACH_MM = 8.0  # on either side of the origin
SMALLEST_RISE_MM = 4.0  # of flange or gauge corner
GREATEST_SIZE = 1_000_000  # bytes
MOST_POINTS = 20_000


def read_points(path: str | Path) -> np.ndarray:
    """Read and check a profile file.

    Parameters
    ----------
    path : text file; two columns y (outwards) and z (downwards) in mm, separated by blanks,
        commas or semicolons; `#`, `!` and `%` start comments; y strictly monotone

    Returns
    -------
    (n, 2) array in mm, y increasing.
    """
    path = Path(path)
    points, lines = [], []
    for number, line in enumerate(_text(path).split("\n"), start=1):
        values = _parse(path, number, line)
        if values is not None:
            points.append(values)
            lines.append(number)
    _check_size(path, points)
    array = np.array(points)
    if array[-1, 0] < array[0, 0]:
        array, lines = array[::-1].copy(), lines[::-1]
    _check_order(path, array, lines)
    return array


def read_profile(path: str | Path, kind: str) -> np.ndarray:
    """Read points as `read_points` does and check that they lie as a wheel's or a rail's must.

    `kind` is 'wheel' or 'rail'; the flange, or the gauge corner, is at negative y, and z points
    downwards: both lie deeper than the origin.
    """
    if kind not in ("wheel", "rail"):
        raise ProfileError(f"{path}: kind '{kind}' is unknown; allowed: wheel, rail")
    points = read_points(path)
    y, z = points.T
    origin, part = {
        "wheel": ("the tape circle", "the flange"),
        "rail": ("the top of the rail", "the gauge corner"),
    }[kind]
    if y[0] > -REACH_MM or y[-1] < REACH_MM:
        raise ProfileError(
            f"{path}: y runs from {y[0]:g} to {y[-1]:g} mm; it must reach {REACH_MM:g} mm beyond "
            f"y = 0, {origin}, on both sides"
        )
    rise = z[y < 0.0].max() - np.interp(0.0, y, z)
    if rise < SMALLEST_RISE_MM:
        raise ProfileError(
            f"{path}: at negative y the profile lies at most {rise:.3g} mm below that at y = 0; "
            f"{part} must be there and reach {SMALLEST_RISE_MM:g} mm "
            "(y outwards to the field side, z downwards)"
        )
    return points


def _text(path):
    if not path.is_file():
        raise ProfileError(f"{path}: there is no such file")
    try:
        with path.open("rb") as file:
            raw = file.read(GREATEST_SIZE + 1)
        if len(raw) > GREATEST_SIZE:
            raise ProfileError(f"{path}: is larger than {GREATEST_SIZE} bytes")
        return raw.decode("utf-8-sig")
    except OSError as error:
        raise ProfileError(f"{path}: cannot be read: {(error.strerror or '').lower()}") from None
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise ProfileError(f"{path}, line {line}: is not UTF-8 text") from None


def _parse(path, number, line):
    for comment in "#!%":
        line = line.split(comment)[0]
    fields = line.replace(",", " ").replace(";", " ").split()
    if not fields:
        return None
    if len(fields) != 2:
        raise ProfileError(
            f"{path}, line {number}: {len(fields)} columns; two are needed, y and z in mm"
        )
    try:
        values = _number(fields[0]), _number(fields[1])
    except ValueError:
        raise ProfileError(
            f"{path}, line {number}: {line.strip()[:60]!r} is not a pair of numbers y z in mm"
        ) from None
    if not np.all(np.isfinite(values)):
        raise ProfileError(f"{path}, line {number}: {line.strip()[:60]!r} must be finite")
    return values


def _number(field):
    if "_" in field:  # float() reads 1_000 as a number
        raise ValueError
    return float(field)


def _check_size(path, points):
    if len(points) > MOST_POINTS:
        raise ProfileError(f"{path}: {len(points)} points; at most {MOST_POINTS}")
    if len(points) < FEWEST_POINTS:
        raise ProfileError(
            f"{path}: {len(points)} points; at least {FEWEST_POINTS} are needed for a profile"
        )
    y = [point[0] for point in points]
    extent = max(y) - min(y)
    if not SMALLEST_EXTENT_MM <= extent <= LARGEST_EXTENT_MM:
        raise ProfileError(
            f"{path}: the profile is {extent:g} wide; lengths must be in mm, "
            f"{SMALLEST_EXTENT_MM:g} to {LARGEST_EXTENT_MM:g}"
        )


def _check_order(path, array, lines):
    step = np.diff(array[:, 0])
    if np.any(step <= 0.0):
        bad = int(np.argmax(step <= 0.0))
        here, before = array[bad + 1, 0], array[bad, 0]
        what = "repeats or overlaps" if here == before else "is out of order after"
        raise ProfileError(
            f"{path}, line {lines[bad + 1]}: y = {here:g} {what} y = {before:g}; "
            "y must increase or decrease throughout"
        )
    if np.any(step > LARGEST_GAP_MM):
        bad = int(np.argmax(step > LARGEST_GAP_MM))
        raise ProfileError(
            f"{path}, line {lines[bad + 1]}: gap of {step[bad]:g} mm in y; "
            f"at most {LARGEST_GAP_MM:g} mm"
        )


def measured_profile(path: str | Path, kind: str, noise: float = 0.01e-3) -> Profile:
    """Profile from a measured file, smoothed.

    Parameters
    ----------
    path : see `read_points` and `read_profile`; y = 0 is the tape circle or the rail's top
    kind : 'wheel' or 'rail'
    noise : m, expected standard deviation of the measured points; 0 interpolates

    Notes
    -----
    A cubic smoothing spline over the arc length of the points, position and depth each, with the
    penalty (of the second derivative) chosen by bisection so that the rms distance of spline and
    points equals `noise`. What lies beyond parts that are steeper than 78 degrees or turn back is
    left out. Depths count from that of a wheel at y = 0 and from a rail's highest point, wherever
    the file's z is zero.
    """
    points = read_profile(path, kind) * MM
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    fine = np.linspace(0.0, arc[-1], max(2000, 20 * arc.size))
    y_spline, z_spline = _smooth(arc, points, noise)
    dy, dz = y_spline(fine, 1), z_spline(fine, 1)
    part = _around_the_origin(y_spline(fine), (dy > 0.0) & (np.abs(dz) <= STEEPEST * dy))
    position, depth = y_spline(fine)[part], z_spline(fine)[part]
    if position[0] > -REACH_MM * MM or position[-1] < REACH_MM * MM:
        raise ProfileError(
            f"{path}: the smoothed profile is upright or turns back within {REACH_MM:g} mm of "
            "y = 0; smooth it more (measured_noise) or cut undercut parts"
        )
    depth -= depth.min() if kind == "rail" else np.interp(0.0, position, depth)
    return resample(f"measured {Path(path).name}", kind, position, depth, (dz / dy)[part])


def _around_the_origin(position, gentle):
    """The stretch of gentle slopes that holds the origin: no groove wall, no keeper."""
    steep = np.flatnonzero(~gentle)
    origin = np.argmin(np.abs(position))
    inner, outer = steep[steep < origin], steep[steep >= origin]
    return slice(inner[-1] + 1 if inner.size else 0, outer[0] if outer.size else None)


def _smooth(arc, points, noise):
    """Smoothing splines y(arc), z(arc) whose rms distance from the points is `noise`."""
    scale = arc[-1] / arc.size
    spline = scipy.interpolate.make_smoothing_spline

    def fit(log_penalty):
        penalty = 10.0**log_penalty * scale**3
        pair = [spline(arc / scale, p, lam=penalty / scale**3) for p in points.T]
        off = np.hypot(*(pair[i](arc / scale) - points[:, i] for i in range(2)))
        return pair, np.sqrt(np.mean(off**2))

    low, high = -8.0, 8.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fit(middle)[1] < noise else (low, middle)
    pair = fit(low)[0]
    return tuple(_rescaled(spline, scale) for spline in pair)


def _rescaled(spline, scale):
    return lambda arc, order=0: spline(arc / scale, order) / scale**order
