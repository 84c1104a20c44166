"""Wheel and rail profiles: S1002, UIC60, a parametric tram pair, measured files.

Axes of a profile (those of the standards and of CONTACT, for the right wheel): position outwards
from the track centre (to the field side), depth downwards. A wheel's origin lies on the tape
circle, its flange at negative positions; a rail's origin is its highest point, its gauge corner
at negative positions. Lengths in m. Profiles are sampled on a uniform grid of positions with
their slopes, so they are single-valued: steeper parts than `STEEPEST` are left out.
"""

from dataclasses import dataclass

import numpy as np
import scipy  # its parts load when they are used: many short jobs need none
from numpy.typing import ArrayLike

MM = 1e-3
SPACING = 0.025e-3
STEEPEST = np.tan(np.radians(78.0))


class ProfileError(ValueError):
    """A profile that cannot be used; the message names file, line, value and what is allowed."""


@dataclass(frozen=True, eq=False)
class Profile:
    """A wheel or rail profile on a uniform grid.

    Attributes
    ----------
    name : what it is, with its source
    kind : 'wheel' or 'rail'
    position, depth, slope : (n,) arrays: m outwards, m downwards, d depth / d position
    """

    name: str
    kind: str
    position: np.ndarray
    depth: np.ndarray
    slope: np.ndarray

    def depth_at(self, position: ArrayLike) -> np.ndarray:
        """Depth in m at positions in m (cubic Hermite interpolation)."""
        return scipy.interpolate.CubicHermiteSpline(self.position, self.depth, self.slope)(position)

    def slope_at(self, position: ArrayLike) -> np.ndarray:
        """Slope d depth / d position (m/m) at positions in m."""
        return scipy.interpolate.CubicHermiteSpline(self.position, self.depth, self.slope)(
            position, 1
        )


def resample(
    name: str,
    kind: str,
    position: np.ndarray,
    depth: np.ndarray,
    slope: np.ndarray,
    spacing: float = SPACING,
) -> Profile:
    """Profile on a uniform grid from points (k,) of increasing position; m, slopes m/m."""
    keep = np.abs(slope) <= STEEPEST
    first = np.argmax(keep)
    beyond = np.flatnonzero(~keep[first:])
    last = first + beyond[0] if beyond.size else keep.size
    part = slice(first, last)
    spline = scipy.interpolate.CubicHermiteSpline(position[part], depth[part], slope[part])
    count = int((position[last - 1] - position[first]) / spacing) + 1
    grid = position[first] + spacing * np.arange(count)
    return Profile(name, kind, grid, spline(grid), spline(grid, 1))


def turned(
    position: np.ndarray, depth: np.ndarray, inclination: float
) -> tuple[np.ndarray, np.ndarray]:
    """Points of a rail whose head leans to the track centre: its gauge side goes down.

    Parameters
    ----------
    position, depth : in one unit; inclination : rad

    Notes
    -----
    About the origin, so that the gauge stays: 14 mm below the top it changes by 0.3 mm per rail
    at 1 in 40.
    """
    c, s = np.cos(inclination), np.sin(inclination)
    return c * position + s * depth, -s * position + c * depth


def inclined(rail: Profile, inclination: float) -> Profile:
    """Rail profile that leans to the track centre by an angle in rad, about its origin."""
    if inclination == 0.0:
        return rail
    position, depth = turned(rail.position, rail.depth, inclination)
    slope = np.tan(np.arctan(rail.slope) - inclination)
    return resample(f"{rail.name}, inclined", rail.kind, position, depth, slope)


# Coefficients of the sections of S1002 (UIC 510-2), lengths in mm, ascending powers.
_S1002_A = (1.364323640, -0.066666667)
_S1002_B = (
    0.0,
    -3.358537058e-2,
    1.565681624e-3,
    -2.810427944e-5,
    5.844240864e-8,
    -1.562379023e-8,
    5.309217349e-15,
    -5.957839843e-12,
    2.646656573e-13,
)
_S1002_C = (
    -4.320221063e3,
    -1.038384026e3,
    -1.065501873e2,
    -6.051367875,
    -2.054332446e-1,
    -4.169739389e-3,
    -4.687195829e-5,
    -2.252755540e-7,
)
_S1002_E = (-93.576667419, -2.747477419)


def _polynomial(coefficients, s):
    poly = np.polynomial.Polynomial(coefficients)
    return poly(s), poly.deriv()(s)


def _arc(s, centre, height, radius, sign):
    root = np.sqrt(radius**2 - (s - centre) ** 2)
    return height + sign * root, -sign * (s - centre) / root


def s1002_wheel() -> Profile:
    """Wheel profile S1002 (UIC 510-2) in closed form, flange flank up to the tip side; m."""
    s = np.arange(-55.0, 60.0 + 1e-9, 0.01)
    depth, slope = np.empty_like(s), np.empty_like(s)
    sections = (
        (s > 32.15796, lambda u: _polynomial(_S1002_A, u)),
        ((s <= 32.15796) & (s >= -26.0), lambda u: _polynomial(_S1002_B, u)),
        ((s < -26.0) & (s >= -35.0), lambda u: _polynomial(_S1002_C, u)),
        ((s < -35.0) & (s >= -38.426669071), lambda u: _arc(u, -26.210665, 16.446, 13.0, -1)),
        ((s < -38.426669071) & (s >= -39.764473993), lambda u: _polynomial(_S1002_E, u)),
        (s < -39.764473993, lambda u: _arc(u, -58.558326413, 8.834924130, 20.0, 1)),
    )
    for where, section in sections:
        depth[where], slope[where] = section(s[where])
    return resample("S1002 (UIC 510-2)", "wheel", s * MM, depth * MM, slope)


def _chain_of_arcs(start, angle, pieces):
    """Points along tangent arcs and straights.

    Parameters
    ----------
    start : (position, depth) in m, angle : direction of travel in rad (0 = outwards, > 0 down)
    pieces : (radius in m, end angle in rad) per arc; radius infinite with a length instead of
        the angle is a straight. The sign of curvature follows from the angles.

    Returns
    -------
    position, depth, slope : arrays in direction of travel.
    """
    x, z, out = start[0], start[1], []
    for radius, end in pieces:
        if np.isinf(radius):
            run = np.linspace(0.0, end, 200)
            px, pz = x + run * np.cos(angle), z + run * np.sin(angle)
            slope = np.full_like(run, np.tan(angle))
        else:
            turn = np.sign(end - angle) * radius
            theta = np.linspace(angle, end, 4000)
            px = x + turn * (np.sin(theta) - np.sin(angle))
            pz = z - turn * (np.cos(theta) - np.cos(angle))
            slope, angle = np.tan(theta), end
        out.append(np.column_stack([px, pz, slope])[1 if out else 0 :])
        x, z = px[-1], pz[-1]
    return np.vstack(out).T


def _rail_from_half(name, gauge_side, field_side, inclination):
    """Join two halves, rotate by the inclination, and put the origin on the highest point.

    The halves run outwards from the crown, given as positions > 0.
    """
    y = np.concatenate([-gauge_side[0][::-1], field_side[0][1:]])
    z = np.concatenate([gauge_side[1][::-1], field_side[1][1:]])
    slope = np.concatenate([-gauge_side[2][::-1], field_side[2][1:]])
    c, s = np.cos(inclination), np.sin(inclination)
    # The head leans to the track centre: its gauge side goes down.
    angle = np.arctan(slope) - inclination
    y, z = c * y + s * z, -s * y + c * z
    top = np.argmin(np.abs(angle))
    keep = np.abs(np.tan(angle)) < 50.0
    return resample(name, "rail", (y - y[top])[keep], (z - z[top])[keep], np.tan(angle)[keep])


def uic60_rail(
    inclination: float = 1.0 / 40.0,
    crown_half_width: float = 10.228e-3,
    shoulder_half_width: float = 26.0265e-3,
) -> Profile:
    """Head of UIC60 / 60E1 from arcs of 300, 80 and 13 mm.

    Parameters
    ----------
    inclination : rad, rail foot to track plane (1/40 or 1/20; 0 for the upright rail)
    crown_half_width, shoulder_half_width : m, where the 300 and 80 mm arcs end

    Notes
    -----
    Arcs end at 10.228 and 26.0265 mm from the axis (EN 13674-1: 20.456 and 52.053 mm); the
    construction is tangent and ends on the 1:20 side at 36.0 mm, half the head's width. The
    profile of the Manchester benchmark is met within 6 um with 10.5 and 25.985 mm.
    """
    side = np.pi / 2.0 - np.arctan(1.0 / 20.0)
    first = np.arcsin(crown_half_width / (300 * MM))
    second = np.arcsin(np.sin(first) + (shoulder_half_width - crown_half_width) / (80 * MM))
    half = _chain_of_arcs((0.0, 0.0), 0.0, [(300 * MM, first), (80 * MM, second), (13 * MM, side)])
    name = f"UIC60 head, inclination {inclination:.4f} rad"
    return _rail_from_half(name, half, half, inclination)


def tram_wheel(
    flange_root_radius: float = 15.2e-3,
    flange_angle: float = np.radians(70.0),
    conicity: float = 0.025,
    tread_inner: float = -0.020,
    tread_outer: float = 0.045,
    flank_length: float = 8e-3,
) -> Profile:
    """Tram wheel: cylindrical or conical tread, flange root arc, straight flank.

    Parameters
    ----------
    flange_root_radius : m; 15.2 mm on a 13 mm rail corner is the conformal pair of the bogie
    flange_angle : rad, of the flank
    conicity : slope of the tread, 0 for a cylinder
    tread_inner, tread_outer : m, ends of the tread from the tape circle (flange side negative)
    flank_length : m, straight flank above the root
    """
    _require(0.0 < flange_root_radius < 0.1, "flange_root_radius", flange_root_radius, "0 .. 0.1 m")
    _require(0.9 < flange_angle < 1.35, "flange_angle", flange_angle, "0.9 .. 1.35 rad")
    _require(0.0 <= conicity < 0.2, "conicity", conicity, "0 .. 0.2")
    _require(tread_inner < 0.0 < tread_outer, "tread_inner", tread_inner, "< 0 < tread_outer")
    tread = np.arctan(conicity)
    length = (tread_outer - tread_inner) / np.cos(tread)
    # Travel from the field side to the flange: mirrored positions, angles downwards.
    x, z, slope = _chain_of_arcs(
        (-tread_outer, -tread_outer * conicity),
        tread,
        [(np.inf, length), (flange_root_radius, flange_angle), (np.inf, flank_length)],
    )
    name = f"tram wheel, root {flange_root_radius / MM:.1f} mm, {np.degrees(flange_angle):.0f} deg"
    return resample(name, "wheel", -x[::-1], z[::-1], -slope[::-1])


def grooved_rail(
    crown_radius: float = 0.3,
    corner_radius: float = 13e-3,
    corner_start: float = 0.022,
    groove_wall_angle: float = np.radians(76.0),
    field_half_width: float = 0.028,
) -> Profile:
    """Head of a grooved rail: crown arc and gauge-corner arc down to the groove wall.

    Parameters
    ----------
    crown_radius, corner_radius : m
    corner_start : m, where the corner arc begins, from the crown's top; at crown_radius times the
        wheel's conicity contact goes from the tread into a wider flange root without a jump
    groove_wall_angle : rad, steepest angle of the corner arc
    field_half_width : m, extent of the crown to the field side

    Notes
    -----
    59R2 and 60R2 have such heads (crown 225 to 300 mm, corner 13 mm). ASSUME: coordinates are not
    public, the start of the corner follows from the width of the head.
    """
    _require(crown_radius > corner_radius > 0.0, "corner_radius", corner_radius, "0 .. crown")
    _require(0.0 < corner_start < 0.05, "corner_start", corner_start, "0 .. 0.05 m")
    start = np.arcsin(corner_start / crown_radius)
    gauge = _chain_of_arcs(
        (0.0, 0.0), 0.0, [(crown_radius, start), (corner_radius, groove_wall_angle)]
    )
    field = _chain_of_arcs(
        (0.0, 0.0), 0.0, [(crown_radius, np.arcsin(field_half_width / crown_radius))]
    )
    name = f"grooved rail, crown {crown_radius / MM:.0f} mm, corner {corner_radius / MM:.0f} mm"
    return _rail_from_half(name, gauge, field, 0.0)


def _require(condition: bool, name: str, value: float, allowed: str) -> None:
    if not condition:
        raise ProfileError(f"profile parameter {name} = {value:g} is outside {allowed}")
