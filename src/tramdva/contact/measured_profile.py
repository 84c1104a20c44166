"""Measured profiles: where the points of a file must lie, and the smoothing spline."""

from pathlib import Path

import numpy as np
import scipy  # its parts load when they are used: checking a file needs none

from tramdva.contact import profile_checks
from tramdva.contact.profiles import MM, STEEPEST, Profile, ProfileError, resample
from tramdva.contact.two_columns import Layout, read_columns

LAYOUT = Layout("y and z in mm", ProfileError, fewest=20, most=20_000, largest=1_000_000)
SMALLEST_EXTENT_MM = 20.0
LARGEST_EXTENT_MM = 250.0
LARGEST_GAP_MM = 5.0
REACH_MM = 8.0  # on either side of the origin
SMALLEST_RISE_MM = 4.0  # of flange or gauge corner


def read_points(path: str | Path) -> np.ndarray:
    """Read and check a profile file.

    Parameters
    ----------
    path : text file; two columns y (outwards) and z (downwards) in mm, as `read_columns` reads
        them; y strictly monotone

    Returns
    -------
    (n, 2) array in mm, y increasing.
    """
    array, lines = read_columns(path, LAYOUT)
    _check_extent(path, array)
    if array[-1, 0] < array[0, 0]:
        array, lines = array[::-1].copy(), lines[::-1]
    _check_order(path, array, lines)
    return array


def read_profile(path: str | Path, kind: str, noise: float | None = None) -> np.ndarray:
    """Read points as `read_points` does and check that they lie as a wheel's or a rail's must.

    `kind` is 'wheel' or 'rail'; the flange, or the gauge corner, is at negative y, and z points
    downwards: both lie deeper than the origin. `noise` in m is that which is expected of the
    points; if it is given, theirs must not be much larger.
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
    if kind == "rail":
        _check_top(path, points)
    if noise is not None:
        _check_noise(path, points, noise / MM)
    return points


def check_pair(
    wheel: tuple[str, np.ndarray], rail: tuple[str, np.ndarray], lateral_position: float
) -> None:
    """Refuse a wheel and a rail whose flange has no play, or more than the tables reach.

    Parameters
    ----------
    wheel, rail : name and points (n, 2) in mm of each
    lateral_position : m, top of the rail outside the tape circle of the centred wheelset
    """
    (wheel_name, flange), (rail_name, corner) = wheel, rail
    play = profile_checks.flange_play(flange, corner, lateral_position / MM)
    if not 0.0 < play <= profile_checks.LARGEST_PLAY_MM:
        raise ProfileError(
            f"{wheel_name} on {rail_name}: the flange has a play of {play:.3g} mm to the gauge "
            f"corner; it must be between 0 and {profile_checks.LARGEST_PLAY_MM:g} mm (y = 0 must "
            "be the wheel's tape circle and the rail's top; rail.lateral_position = "
            f"{lateral_position:g} m is between them)"
        )


def _check_top(path, points):
    place, above = profile_checks.top_of_rail(points)
    far = abs(place) > profile_checks.FARTHEST_TOP_MM
    if far and above > profile_checks.LEAST_RISE_MM:
        raise ProfileError(
            f"{path}: the highest point is at y = {place:.3g} mm, {above:.2g} mm above that at "
            f"y = 0; y = 0 must be the top of the rail, up to {profile_checks.FARTHEST_TOP_MM:g} "
            "mm beside it (a wheel, or a shifted profile?)"
        )


def _check_noise(path, points, expected):
    found = profile_checks.noise_of(points)
    most = max(profile_checks.NOISE_FACTOR * expected, profile_checks.ALWAYS_ALLOWED_MM)
    most = min(most, profile_checks.NEVER_ALLOWED_MM)
    if found > most:
        raise ProfileError(
            f"{path}: the points scatter by {1e3 * found:.2g} um; at most {1e3 * most:.2g} um are "
            f"allowed with measured_noise = {expected * MM:g} m (never more than "
            f"{1e3 * profile_checks.NEVER_ALLOWED_MM:g} um)"
        )


def _check_extent(path, array):
    extent = np.ptp(array[:, 0])
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
    points = read_profile(path, kind, noise) * MM
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
