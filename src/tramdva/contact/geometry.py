"""Contact table of a wheel and a rail, and its evaluation inside a simulation.

The wheel's lateral shift u (outwards) and height h(u) at first touch form a curve, the locus, in
the plane of relative positions; it depends on roll and yaw. Its slope is the contact angle,
tan(delta) = -dh/du, and the distance of the actual position from it is the penetration: angle and
penetration come from one smooth function, so the elastic contact force has a potential. Tread and
flange have a locus each when the flange root is narrower than the rail's corner (two-point
contact); a conformal root has one.

Tables are tensor-product cubic B-splines: h has two continuous derivatives.
"""

import itertools
from typing import NamedTuple

import numpy as np
import scipy  # its parts load when they are used: many short jobs need none
from numba import njit

from tramdva.contact import locus
from tramdva.contact.profiles import MM, Profile, ProfileError

PADS = (8, 6, 3)
WHEEL_STRIDE = 4
SHEAR_ANGLE = np.radians(60.0)
SPLIT_BARRIER = 2.0
SPLIT_DISTANCE = 4e-3
RETREAT = 60.0  # 1/m, curvature of a zone's continuation beyond its split
SPLIT_TOLERANCE = 0.06e-3  # covers one step of shift at a jump from tread to flank
OUTSIDE_TABLE = 1
WINDOW = 6
FAR = 0.5e-3  # m


class ContactTable(NamedTuple):
    """Table of one zone (tread or flange) of a wheel on a rail; plain arrays and numbers.

    coefficients : (rolls, yaws, shifts, STRIDE) B-spline coefficients
    first, step : (3,) arrays, node 0 and spacing of shift in m, roll in rad, tan(yaw)^2
    low, high : (3,) arrays, range of validity
    wheel_radius : m, at the profile's origin
    shear : m, shift of the table per tan(yaw)^2: the flank of a yawed wheel comes forward by
    R tan(delta) tan(yaw)^2 / 2
    """

    coefficients: np.ndarray
    first: np.ndarray
    step: np.ndarray
    low: np.ndarray
    high: np.ndarray
    wheel_radius: float
    shear: float


def zone_splits(
    wheel: Profile,
    rail: Profile,
    wheel_radius: float,
    shift_range: tuple[float, float],
    gap_scale: float,
    yaw_angles: tuple[float, ...] = (0.0,),
) -> tuple[float, ...]:
    """Positions in m on the wheel that separate its zones, from the tread to the flange.

    For every yaw angle (rad; no roll) the shifts are searched at which two contacts touch at once:
    contact jumps there, and the split lies at the largest gap between them. Jumps over a gap below
    `SPLIT_BARRIER` times `gap_scale` are one wide patch under load and need no split.
    """
    splits: list[float] = []
    for yaw in yaw_angles:
        for position in _splits_at(wheel, rail, wheel_radius, shift_range, gap_scale, yaw):
            near = [other for other in splits if abs(position - other) <= SPLIT_DISTANCE]
            # Of those of one jump, the one that leaves the zone of the tread's side least.
            splits = [other for other in splits if other not in near] + [max([position, *near])]
    return tuple(sorted(splits, reverse=True))


def _splits_at(wheel, rail, wheel_radius, shift_range, gap_scale, yaw) -> list[float]:
    """Positions of the highest barriers at one yaw angle, `SPLIT_DISTANCE` apart."""
    curve, found = np.empty((2, wheel.position.size)), []
    tangent = np.tan(yaw) ** 2
    locus.silhouette(wheel.position, wheel.depth, wheel.slope, wheel_radius, tangent, 0.0, *curve)
    for shift in np.arange(*shift_range, 0.02 * MM):
        found += _two_point_barriers(curve, wheel.position, rail, shift)
    splits: list[float] = []
    for barrier, position in sorted(found, reverse=True):
        apart = all(abs(position - other) > SPLIT_DISTANCE for other in splits)
        if barrier > SPLIT_BARRIER * gap_scale and apart:
            splits.append(position)
    return splits


def _two_point_barriers(curve, wheel_position, rail, shift):
    """(gap, wheel position) between contacts that touch at nearly the same height."""
    keep = slice(None, None, WHEEL_STRIDE)
    o, d, y = curve[0, keep] + shift, curve[1, keep], wheel_position[keep]
    inside = (o > rail.position[0]) & (o < rail.position[-1])
    gap = np.interp(o[inside], rail.position, rail.depth) - d[inside]
    low = np.flatnonzero((gap[1:-1] < gap[:-2]) & (gap[1:-1] <= gap[2:])) + 1
    low = low[gap[low] < gap.min() + SPLIT_TOLERANCE]
    barriers = []
    for left, right in itertools.pairwise(low):
        top = left + int(np.argmax(gap[left:right]))
        barriers.append((gap[top] - max(gap[left], gap[right]), float(y[inside][top])))
    return barriers


def _zone(wheel: Profile, inner: float | None, outer: float | None):
    """Wheel profile between two splits, continued beyond them by parabolas that turn away."""
    y, z, slope = wheel.position, wheel.depth.copy(), wheel.slope.copy()
    for split, beyond in ((inner, y < (inner or 0.0)), (outer, y > (outer or 0.0))):
        if split is not None:
            tangent, distance = float(wheel.slope_at(split)), y[beyond] - split
            # On a steep flank a short distance across is a long way along the profile.
            bend = RETREAT * (1.0 + tangent**2) ** 1.5
            z[beyond] = wheel.depth_at(split) + tangent * distance - 0.5 * bend * distance**2
            slope[beyond] = tangent - bend * distance
    return y, z, slope, -np.gradient(slope, y) / (1.0 + slope**2) ** 1.5


def contact_tables(
    wheel: Profile,
    rail: Profile,
    wheel_radius: float,
    shift_range: tuple[float, float] = (-10e-3, 10e-3),
    roll_limit: float = 0.015,
    yaw_limit: float = 0.05,
    gap_scale: float = 8e-6,
    shift_step: float = 0.05e-3,
    roll_step: float = 2.5e-3,
    yaw_nodes: int = 11,
    splits: tuple[float, ...] | None = None,
    split_yaw: tuple[float, ...] = (0.0,),
) -> tuple[ContactTable, ...]:
    """Contact tables of a wheel on a rail: one per zone, tread first, then towards the flange.

    Parameters
    ----------
    wheel, rail : profiles
    wheel_radius : m
    shift_range : m, lateral shift of the wheel on the rail, outwards positive (the flange of the
        wheel comes to the gauge corner at positive shifts)
    roll_limit, yaw_limit : rad, largest magnitudes
    gap_scale : m, epsilon of the quasi-elastic averaging (`locus`); 8 um suits 35 kN
    shift_step : m; roll_step : rad; yaw_nodes : nodes in tan(yaw)^2
    splits : m, positions on the wheel between zones, from tread to flange; () for a single zone
        (a jump is then bridged within gap_scale); None: found by `zone_splits`
    split_yaw : rad, yaw angles at which `zone_splits` looks for jumps

    Returns
    -------
    Tables in the order of the zones.
    """
    _check(wheel, rail, wheel_radius, gap_scale)
    if splits is None:
        splits = zone_splits(wheel, rail, wheel_radius, shift_range, gap_scale, split_yaw)
    axes = (
        _axis(*shift_range, shift_step, PADS[0]),
        _axis(-roll_limit, roll_limit, roll_step, PADS[1]),
        _axis(0.0, np.tan(yaw_limit) ** 2, np.tan(yaw_limit) ** 2 / (yaw_nodes - 1), PADS[2]),
    )
    ends = (None, *splits, None)
    zones = [_zone(wheel, inner, outer) for outer, inner in itertools.pairwise(ends)]
    flank = float(0.5 * wheel_radius * np.tan(SHEAR_ANGLE))
    shears = [0.0] * (len(zones) - 1) + [flank]
    return tuple(
        _table(zone, rail, wheel_radius, shear, axes, gap_scale)
        for zone, shear in zip(zones, shears, strict=True)
    )


def _check(wheel, rail, wheel_radius, gap_scale):
    if wheel.kind != "wheel" or rail.kind != "rail":
        raise ProfileError(f"'{wheel.name}' and '{rail.name}' must be a wheel and a rail")
    if not 0.05 <= wheel_radius <= 1.0:
        raise ProfileError(f"wheel radius {wheel_radius:g} m is outside 0.05 .. 1 m")
    if not 1e-7 <= gap_scale <= 1e-4:
        raise ProfileError(f"gap scale {gap_scale:g} m is outside 1e-7 .. 1e-4 m")


def _axis(low, high, step, pads):
    """Nodes from low to high in equal steps close to `step`, and `pads` more on either side."""
    count = max(int(np.ceil((high - low) / step - 1e-9)), 1)
    step = (high - low) / count
    return low + step * np.arange(-pads, count + pads + 1), low, high, step


def _table(zone, rail, wheel_radius, shear, axes, gap_scale):
    nodes = [axis[0] for axis in axes]
    values = np.zeros((*(axis.size for axis in nodes), locus.STRIDE))
    points = np.ascontiguousarray(np.array(zone)[:, ::WHEEL_STRIDE])
    spacing = rail.position[1] - rail.position[0]
    locus.fill_table(
        points,
        wheel_radius,
        shear,
        (rail.position[0], spacing),
        np.array([rail.depth, rail.slope]),
        *nodes,
        gap_scale,
        values,
    )
    if not np.all(np.isfinite(values)):
        raise ProfileError("contact table: the profiles do not meet within the range of shifts")
    for axis in range(3):
        values = scipy.ndimage.spline_filter1d(values, order=3, axis=axis, mode="mirror")
    return ContactTable(
        coefficients=np.ascontiguousarray(np.moveaxis(values, 0, 2)),
        first=np.array([axis[0] for axis in nodes]),
        step=np.array([axis[3] for axis in axes]),
        low=np.array([axis[1] for axis in axes]),
        high=np.array([axis[2] for axis in axes]),
        wheel_radius=wheel_radius,
        shear=shear,
    )


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _weights(t):
    """Cubic B-spline weights of four neighbouring coefficients at fraction t."""
    s = 1.0 - t
    return (
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    )


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _cell(table, axis, value):
    """First coefficient, fraction and status on an axis; held at the ends, also for NaN."""
    held = value if value > table.low[axis] else table.low[axis]
    held = held if held < table.high[axis] else table.high[axis]
    scaled = (held - table.first[axis]) / table.step[axis]
    index = int(scaled)
    return index - 1, scaled - index, held != value


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "reassoc", "nsz"})
def _collapse(coefficients, start, roll_cell, roll_weights, yaw_cell, yaw_weights, rows):
    """Contract roll and yaw for as many shift coefficients from `start` on as there are rows.

    The shifts with all columns are one contiguous stretch of the flat table: with unsigned
    offsets and the length read from the array the loop compiles to vector instructions.
    """
    flat, stack = coefficients.reshape(-1), rows.reshape(-1)
    shape = coefficients.shape
    length = np.uint64(stack.size)
    stack[:] = 0.0
    for k in range(4):
        for m in range(4):
            weight = roll_weights[k] * yaw_weights[m]
            row = ((roll_cell + k) * shape[1] + yaw_cell + m) * shape[2] + start
            source = flat[row * locus.STRIDE :]
            for c in range(length):
                stack[c] += weight * source[c]


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _height(rows, i, t, step):
    """Height of the locus and its first and second derivative in the shift, from row i on."""
    a, b, c, d = rows[i, 0], rows[i + 1, 0], rows[i + 2, 0], rows[i + 3, 0]
    s = 1.0 - t
    w = _weights(t)
    value = w[0] * a + w[1] * b + w[2] * c + w[3] * d
    first = 0.5 * (s * s * (b - a) + 2.0 * (t * s + 0.5) * (c - b) + t * t * (d - c))
    second = s * (a - 2.0 * b + c) + t * (b - 2.0 * c + d)
    return value, first / step, second / (step * step)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _column(rows, i, w, column):
    """Value of a column from row i on."""
    return (
        w[0] * rows[i, column]
        + w[1] * rows[i + 1, column]
        + w[2] * rows[i + 2, column]
        + w[3] * rows[i + 3, column]
    )


@njit(cache=True, nogil=True, error_model="numpy")
def touch_height(table, shift, roll, yaw, rows):
    """Height in m (downwards) of the wheel's origin at first touch; arguments as `locate_contact`.

    Held at the ends of the table outside its range.
    """
    tangent = np.tan(yaw)
    roll_cell, roll_fraction, _ = _cell(table, 1, roll)
    yaw_cell, yaw_fraction, _ = _cell(table, 2, tangent * tangent)
    start, t, _ = _cell(table, 0, shift + table.shear * tangent * tangent)
    _collapse(
        table.coefficients,
        start,
        roll_cell,
        _weights(roll_fraction),
        yaw_cell,
        _weights(yaw_fraction),
        rows,
    )
    return _height(rows, 0, t, table.step[0])[0]


@njit(cache=True, nogil=True, error_model="numpy")
def approximate_contact(table, shift, height, roll, yaw):
    """Slope of the locus and position on the wheel (m) at a relative position, after one step.

    For what is small beside the contact itself; arguments as `locate_contact`.
    """
    coefficients, step = table.coefficients, table.step[0]
    tangent = np.tan(yaw)
    roll_cell, roll_fraction, _ = _cell(table, 1, roll)
    yaw_cell, yaw_fraction, _ = _cell(table, 2, tangent * tangent)
    start, t, _ = _cell(table, 0, shift + table.shear * tangent * tangent)
    roll_weights, yaw_weights, w = _weights(roll_fraction), _weights(yaw_fraction), _weights(t)
    a = b = c = d = position = 0.0
    for k in range(4):
        for m in range(4):
            weight = roll_weights[k] * yaw_weights[m]
            rows = coefficients[roll_cell + k, yaw_cell + m]
            a += weight * rows[start, 0]
            b += weight * rows[start + 1, 0]
            c += weight * rows[start + 2, 0]
            d += weight * rows[start + 3, 0]
            position += weight * (w[1] * rows[start + 1, 1] + w[2] * rows[start + 2, 1])
    s = 1.0 - t
    value = w[0] * a + w[1] * b + w[2] * c + w[3] * d
    slope = 0.5 * (s * s * (b - a) + 2.0 * (t * s + 0.5) * (c - b) + t * t * (d - c)) / step
    bend = (s * (a - 2.0 * b + c) + t * (b - 2.0 * c + d)) / (step * step)
    above = min(max(value - height, -FAR), FAR)  # farther apart there is no contact
    slope -= bend * above * slope / max(1.0 + slope * slope + above * bend, 0.5)
    return slope, position / (w[1] + w[2])


@njit(cache=True, nogil=True, error_model="numpy")
def locate_contact(table, shift, height, roll, yaw, rows):
    """Contact of one zone at a relative position.

    Parameters
    ----------
    table : ContactTable
    shift, height : m, wheel's profile origin relative to the rail's, outwards and downwards
    roll, yaw : rad, outer side down and heading outwards positive
    rows : (WINDOW, STRIDE) scratch array

    Returns
    -------
    penetration : m, along the contact normal; negative: distance
    contact_angle : rad, positive at the flange
    wheel_position, wheel_depth, rail_position, rail_depth : m
    curvature_lateral : 1/m, of the wheel's silhouette and the rail
    status : 0, or OUTSIDE_TABLE if shift, roll or yaw were held at the ends of the table
    meridian_curvature : 1/m, of the wheel's profile, positive where it is convex

    Notes
    -----
    The foot of the perpendicular from the position to the locus is found by three Newton steps
    that start at the shift itself; penetration is the signed distance. Lifted by more than FAR,
    where there is no force, the distance is taken along the tangent at the shift.
    """
    roll_cell, roll_fraction, roll_out = _cell(table, 1, roll)
    tangent = np.tan(yaw)
    yaw_cell, yaw_fraction, yaw_out = _cell(table, 2, tangent * tangent)
    roll_weights, yaw_weights = _weights(roll_fraction), _weights(yaw_fraction)
    shift += table.shear * tangent * tangent
    cell, t, shift_out = _cell(table, 0, shift)
    room = rows.shape[0] - 4  # rows beyond the four that are needed: the foot may move so far
    start = cell - room // 2
    _collapse(table.coefficients, start, roll_cell, roll_weights, yaw_cell, yaw_weights, rows)
    foot, step = shift, table.step[0]
    value, slope, bend = _height(rows, cell - start, t, step)
    steps = 3 if height > value - FAR else 0
    for _ in range(steps):
        residual = foot - shift + (value - height) * slope
        stiffness = 1.0 + slope * slope + (value - height) * bend
        foot -= residual / max(stiffness, 0.5)
        cell, t, shift_out = _cell(table, 0, foot)
        if cell < start or cell > start + room:
            start = cell - room // 2
            _collapse(
                table.coefficients, start, roll_cell, roll_weights, yaw_cell, yaw_weights, rows
            )
        value, slope, bend = _height(rows, cell - start, t, step)
    cosine = 1.0 / np.sqrt(1.0 + slope * slope)
    penetration = (height - value - slope * (shift - foot)) * cosine
    i, w = cell - start, _weights(t)
    return (
        penetration,
        -np.arctan(slope),
        _column(rows, i, w, 1),
        _column(rows, i, w, 2),
        _column(rows, i, w, 3),
        _column(rows, i, w, 4),
        np.exp(_column(rows, i, w, 5)),
        OUTSIDE_TABLE if (roll_out or yaw_out or shift_out) else 0,
        _column(rows, i, w, 6),
    )
