"""Where a wheel touches a rail: one column of the contact table, computed directly.

A wheel yawed by gamma touches a prismatic rail on its silhouette along the rail: of the circle
through profile point s with radius r and slope r' the point at the forward angle theta with
sin(theta) = -r' tan(gamma). So contact in space becomes contact of two plane curves. Axes: x
forward, o outwards (field side), d downwards; yaw gamma > 0 turns the heading outwards, towards
flange contact; roll > 0 lowers the outer side, about the profile's origin.

Along the wheel the gap G of the two curves is averaged with the weights
exp(-(G - min G) cos(delta) / epsilon) ("quasi-elastic" contact): the mean position stands for the
centre of the patch, the variance for the curvature that the patch sees, and the soft minimum of the
gap, -epsilon log(integral of the weights), makes a smooth height at touch, whose slope in the shift
is the contact angle.

That soft minimum lies (epsilon / 2) log(curvature) off the lowest gap, another amount on tread and
root. So the height is that of epsilon and epsilon / 2, extrapolated to epsilon = 0 (Richardson):
exact where the curvature is constant, of second order in epsilon elsewhere. Between two places that
touch at once the height rises above the lowest gap by at most 0.19 epsilon.
`epsilon` belongs to a load: a Hertz pressure whose patch closes a gap h at its rim has the variance
of epsilon = 2 h / 5.
"""

import numpy as np
from numba import njit

CUT = 20.0  # weights below exp(-CUT) are left out
COARSE = 5  # points of the wheel per stretch of the first search
MARGIN = 4e-3  # m, gap above the lowest beyond which a stretch is left out
REFERENCE_CURVATURE = 10.0
(
    HEIGHT, WHEEL_POSITION, WHEEL_DEPTH, RAIL_POSITION, RAIL_DEPTH, LOG_CURVATURE,
    MERIDIAN_CURVATURE,
) = range(7)  # fmt: skip
COLUMNS = 7
STRIDE = 8  # columns per table entry, padded to whole vector registers


@njit(cache=True, nogil=True, error_model="numpy")
def silhouette(position, depth, slope, radius, yaw_tangent_squared, roll, outward, downward):
    """Plane curve of a yawed and rolled wheel, seen along the rail.

    Parameters
    ----------
    position, depth, slope : (n,) arrays of the wheel profile, m
    radius : m, at the origin of the profile
    yaw_tangent_squared : tan(gamma)^2; small negative values continue the table smoothly
    roll : rad
    outward, downward : (n,) arrays, receive the curve relative to the profile origin, m
    """
    t = yaw_tangent_squared
    cosine = 1.0 / np.sqrt(1.0 + t)
    roll_cosine, roll_sine = np.cos(roll), np.sin(roll)
    for i in range(position.size):
        local = radius + depth[i]
        sine_squared = slope[i] * slope[i] * t
        o = position[i] * cosine - local * slope[i] * t * cosine
        d = local * np.sqrt(max(1.0 - sine_squared, 0.0)) - radius
        outward[i] = o * roll_cosine - d * roll_sine
        downward[i] = o * roll_sine + d * roll_cosine


@njit(cache=True, nogil=True, error_model="numpy")
def _rail_depth(first, spacing, depth, slope, position):
    """Cubic Hermite value on the rail's grid; straight beyond its ends."""
    scaled = (position - first) * (1.0 / spacing)
    last = depth.size - 1
    if scaled <= 0.0:
        return depth[0] + slope[0] * (position - first)
    if scaled >= last:
        return depth[last] + slope[last] * (position - first - last * spacing)
    i = int(scaled)
    t = scaled - i
    left, right = slope[i] * spacing, slope[i + 1] * spacing
    jump = depth[i + 1] - depth[i]
    return depth[i] + t * (
        left + t * (3.0 * jump - 2.0 * left - right + t * (left + right - 2.0 * jump))
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _chord_depth(first, spacing, depth, slope, position):
    """Value of `_rail_depth` but for the bend between two points of the grid, in half the time."""
    scaled = (position - first) * (1.0 / spacing)
    last = depth.size - 1
    if scaled <= 0.0:
        return depth[0] + slope[0] * spacing * scaled
    if scaled >= last:
        return depth[last] + slope[last] * spacing * (scaled - last)
    i = int(scaled)
    return depth[i] + (scaled - i) * (depth[i + 1] - depth[i])


@njit(cache=True, nogil=True, error_model="numpy")
def _gap_minimum(outward, downward, shift, first, spacing, depth, slope, reach, gap):
    """Fill the gap G at the wheel points that can matter, infinity between them.

    Every COARSE-th point is looked at first; a stretch whose gap at both ends is further above the
    lowest than its `reach` (`_reaches`) is left out.

    Returns
    -------
    Index of the lowest gap; first point and last but one that can matter.
    """
    count = outward.size
    lowest = np.inf
    for i in range(0, count, COARSE):
        gap[i] = _chord_depth(first, spacing, depth, slope, shift + outward[i]) - downward[i]
        lowest = min(lowest, gap[i])
    best, begin, end, least = 0, count, 0, np.inf
    for stretch in range(reach.size):
        start = stretch * COARSE
        stop = min(start + COARSE, count)
        limit = lowest + reach[stretch]
        if gap[start] > limit and (stop == count or gap[stop] > limit):
            if end > 0:
                for i in range(start, stop):
                    gap[i] = np.inf
            continue
        begin, end = min(begin, start), stop
        for i in range(start, stop):
            own = _rail_depth(first, spacing, depth, slope, shift + outward[i]) - downward[i]
            gap[i] = own
            if own < least:
                best, least = i, own
    return best, begin, end


@njit(cache=True, nogil=True, error_model="numpy")
def _largest_bend(spacing, depth, slope):
    """Largest magnitude in 1/m of the second derivative of a profile's cubics between its points.

    Parameters
    ----------
    spacing : m; depth, slope : (n,) m and m/m on the grid
    """
    bend = 0.0
    for i in range(depth.size - 1):
        jump = 3.0 * (depth[i + 1] - depth[i]) / spacing
        left, right = jump - 2.0 * slope[i] - slope[i + 1], slope[i] + 2.0 * slope[i + 1] - jump
        bend = max(bend, abs(left), abs(right))
    return 2.0 * bend / spacing


@njit(cache=True, nogil=True, error_model="numpy")
def _reaches(curve, bend, spacing, epsilon, reach):
    """How far above the lowest gap both ends of a stretch may lie where its points still matter, m.

    A point matters up to CUT epsilon / cos(delta) above the lowest gap. Inside a stretch the gap is
    below its chord by no more than the wheel's curve is above its own, plus bend / 8 times the
    square of the stretch, by which the rail can be below its chord; and the chords of
    `_chord_depth` miss as much on the rail's grid. Where the curve runs backwards there is no such
    bound, and MARGIN stands.
    """
    last = curve.shape[1] - 1
    for stretch in range(reach.size):
        start = stretch * COARSE
        stop = min(start + COARSE, last)
        width, rise = curve[0, stop] - curve[0, start], curve[1, stop] - curve[1, start]
        needed, above, forward = 0.0, 0.0, start + COARSE <= last and width > 0.0
        for i in range(start, stop + 1):
            needed = max(needed, CUT * epsilon / max(curve[3, i], 1e-9))
            ahead = curve[0, i] - curve[0, start]
            forward = forward and 0.0 <= ahead <= width
            if forward:
                above = max(above, curve[1, i] - curve[1, start] - rise * ahead / width)
        below = 0.125 * bend * (width * width + 2.0 * spacing * spacing)
        reach[stretch] = min(MARGIN, 1.001 * (needed + above + below)) if forward else MARGIN


@njit(cache=True, nogil=True, error_model="numpy")
def arc_lengths(outward, downward, length, cosine):
    """Length along the silhouette and cosine of its inclination at every point.

    Points on the hidden loop of a narrow root at large yaw run backwards and get length zero.
    """
    last = outward.size - 1
    for i in range(outward.size):
        before, after = max(i - 1, 0), min(i + 1, last)
        spread = 0.5 * (outward[after] - outward[before])
        rise = 0.5 * (downward[after] - downward[before])
        arc = np.sqrt(spread * spread + rise * rise)
        length[i] = arc if spread > 0.0 else 0.0
        cosine[i] = max(spread / arc, 0.0)


@njit(cache=True, nogil=True, error_model="numpy")
def contact_column(curve, wheel, shift, rail_grid, rail, epsilon, reach, gap, out):
    """Quasi-elastic contact of a wheel shifted by `shift` on a rail.

    Parameters
    ----------
    curve : (4, n) silhouette: outwards, downwards, length, cosine
    wheel : (4, n) position, depth, slope and curvature of the profile at the silhouette's points
    shift : m, lateral position of the wheel's origin relative to the rail's, outwards
    rail_grid : (first, spacing) in m; rail : (2, k) depth and slope on it
    epsilon : m, gap scale of the averaging
    reach : (stretches,) of `_reaches`; gap : (n,) scratch array
    out : (COLUMNS,) array, receives height of the wheel's origin at touch (downwards), contact
        position and depth on the wheel (its own axes) and on the rail, ln of the lateral
        curvature sum of the silhouette in 1/m, and the curvature of the wheel's profile in 1/m
    """
    first, spacing = rail_grid
    best, begin, end = _gap_minimum(
        curve[0], curve[1], shift, first, spacing, rail[0], rail[1], reach, gap
    )
    lowest, centre, inverse = gap[best], curve[0, best], 1.0 / epsilon
    # Sums over the weights; those that end in 2 with the squared ones, of half the scale.
    total = position = depth = offset = square = steepness = curvature = 0.0
    total2 = steepness2 = 0.0
    for i in range(begin, end):
        if gap[i] - lowest > MARGIN or curve[2, i] == 0.0:
            continue
        exponent = (gap[i] - lowest) * curve[3, i] * inverse
        if exponent > CUT:
            continue
        share = np.exp(-exponent)
        distance = curve[0, i] - centre
        weight, weight2 = curve[2, i] * share, curve[2, i] * (share * share)
        total += weight
        position += weight * wheel[0, i]
        depth += weight * wheel[1, i]
        offset += weight * distance
        square += weight * distance * distance
        steepness += weight * curve[3, i]
        curvature += weight * wheel[3, i]
        total2 += weight2
        steepness2 += weight2 * curve[3, i]
    offset, cosine = offset / total, steepness / total
    variance = max(square / total - offset**2, spacing * spacing)
    width = np.sqrt(2.0 * np.pi * epsilon / REFERENCE_CURVATURE)
    soft = epsilon / cosine * np.log(total / width)
    softer = epsilon / (steepness2 / total2) * np.log(total2 / (width * np.sqrt(0.5)))
    out[HEIGHT] = lowest - (softer - soft)
    out[WHEEL_POSITION] = position / total
    out[WHEEL_DEPTH] = depth / total
    out[RAIL_POSITION] = shift + centre + offset
    out[RAIL_DEPTH] = _rail_depth(first, spacing, rail[0], rail[1], out[RAIL_POSITION])
    out[LOG_CURVATURE] = np.log(epsilon * cosine * cosine / variance)
    out[MERIDIAN_CURVATURE] = curvature / total


@njit(cache=True, nogil=True, error_model="numpy")
def fill_table(
    wheel, radius, shear, rail_grid, rail, shifts, rolls, yaw_tangents_squared, epsilon, table
):
    """Fill `table` of shape (shifts, rolls, yaws, STRIDE) by `contact_column`.

    `wheel` is a (4, n) array: position, depth, slope and curvature (1/m, where convex positive) of
    the profile; the table's shift is the lateral shift plus `shear` (m) times tan(yaw)^2.
    """
    curve = np.empty((4, wheel.shape[1]))
    gap = np.empty(wheel.shape[1])
    reach = np.empty((wheel.shape[1] + COARSE - 1) // COARSE)
    bend = _largest_bend(rail_grid[1], rail[0], rail[1])
    for k in range(rolls.size):
        for m in range(yaw_tangents_squared.size):
            tangent = yaw_tangents_squared[m]
            silhouette(wheel[0], wheel[1], wheel[2], radius, tangent, rolls[k], curve[0], curve[1])
            arc_lengths(curve[0], curve[1], curve[2], curve[3])
            _reaches(curve, bend, rail_grid[1], epsilon, reach)
            for i in range(shifts.size):
                contact_column(
                    curve,
                    wheel,
                    shifts[i] - shear * tangent,
                    rail_grid,
                    rail,
                    epsilon,
                    reach,
                    gap,
                    table[i, k, m],
                )
