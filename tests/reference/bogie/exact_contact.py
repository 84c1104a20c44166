"""A wheel on a curved rail in closed form: where they touch, and how strongly. NumPy and SciPy.

Axes: x forward, y left, z up at the bogie's centre on the track; the curve turns about the vertical
through (0, R). Rails are swept about that axis without approximation: crown and gauge corner are
tubes about exact circles. The wheel is a body of revolution: cone (tread) and concave tube (flange
root). So a contact is a common normal of two circles, or of a circle and a cone, at any yaw:

* root on corner: the point p of the rail's circle whose distance to the wheel's circle is largest;
  penetration = distance - (root radius - corner radius);
* tread on crown: the point p of the rail's circle that is nearest to the cone;
  penetration = crown radius - distance.

Each is a Newton iteration for one angle. Relative curvatures come from both surfaces' principal
curvatures and directions; they are turned against the rolling direction on a yawed wheel.
"""

from functools import cache
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

ROUNDING = 1e-11  # m along the rail; 25 m leave 1e-14 m in places, 1e-12 m in that of a normal
UP = np.array([0.0, 0.0, 1.0])


class Touch(NamedTuple):
    """Where a wheel and a rail touch.

    depth : m, penetration; point : (3,) m; normal : (3,) from rail to wheel
    rolling : (3,) direction of the rail; relative : (2, 2) in 1/m, relative curvature along
        `rolling` and `normal x rolling`
    """

    depth: float
    point: np.ndarray
    normal: np.ndarray
    rolling: np.ndarray
    relative: np.ndarray


class Profiles(NamedTuple):
    """Arcs of wheel and rail; outwards from the tape circle or the top of the rail, downwards."""

    radius: float  # of the wheel on the tape circle
    conicity: float
    root: float  # radius of the flange root
    root_outward: float
    root_radius: float  # of the circle of the root's centres
    flank_angle: float
    crown: float
    corner: float
    corner_outward: float
    corner_down: float
    corner_angles: tuple
    top: float  # of the rail from the track's centre


def profiles(values):
    """Arcs from the parameters of a vehicle."""
    geometry, wheel_ = values["contact_geometry"], values["bogie"]["wheel"]
    wheel, rail = geometry["wheel"], geometry["rail"]
    if wheel["tape_circle_offset"]:
        raise ValueError("the tape circle lies in the middle of the wheel here")
    slope, start = (
        np.arctan(wheel["conicity"]),
        np.arcsin(rail["corner_start"] / rail["crown_radius"]),
    )
    root, crown, corner = wheel["flange_root_radius"], rail["crown_radius"], rail["corner_radius"]
    return Profiles(
        wheel_["radius"],
        wheel["conicity"],
        root,
        wheel["tread_inner"] + root * np.sin(slope),
        wheel_["radius"] - wheel["conicity"] * wheel["tread_inner"] + root * np.cos(slope),
        wheel["flange_angle"],
        crown,
        corner,
        -(crown - corner) * np.sin(start),
        crown - (crown - corner) * np.cos(start),
        (start, np.radians(76.0)),
        wheel_["half_distance"] + rail["lateral_position"],
    )


class Rail:
    """A circle of a rail's arc centres about the curve's vertical axis."""

    def __init__(self, curve_radius, lateral, down):
        self.centre = np.array([0.0, curve_radius, 0.0])
        self.radius, self.down = curve_radius - lateral, down

    def point(self, angle):
        """Point of the circle, its first and second derivative."""
        s, c, r = np.sin(angle), np.cos(angle), self.radius
        first = np.array([r * c, r * s, 0.0])
        return (
            self.centre + np.array([r * s, -r * c, -self.down]),
            first,
            np.array([-r * s, r * c, 0.0]),
        )

    def nearest_angle(self, place):
        """Angle of the point beside a place."""
        return np.arctan2(place[0], self.centre[1] - place[1])


def _relative(normal, rolling, point, centre, axis, hub, rail_across, wheel_across):
    """Relative curvature (2, 2) along `rolling` and across.

    Rail and wheel are surfaces of revolution: along the sweep their curvature is that of Meusnier,
    n . e_r / r, across it that of the profile (concave: negative).
    """
    across = np.cross(normal, rolling)
    basis = np.array([rolling, across])
    out = np.zeros((2, 2))
    for n, origin, about, profile in (
        (normal, centre, UP, rail_across),
        (-normal, hub, axis, wheel_across),
    ):
        arm = point - origin
        arm = arm - (arm @ about) * about
        distance = np.linalg.norm(arm)
        sweep = np.cross(about, arm / distance)
        meridian = np.cross(n, sweep)
        for curvature, direction in ((n @ arm / distance**2, sweep), (profile, meridian)):
            d = basis @ direction
            out += curvature * np.outer(d, d)
    return out


REACH = 0.08  # m, along the rail from the hub, where root and corner may touch


class _RootGap:
    """Distance of a point of the rail's circle from the circle of the root's centres."""

    def __init__(self, p, rail, side, hub, axis):
        self.p, self.rail, self.axis = p, rail, axis
        self.centre = hub + side * p.root_outward * axis

    def at(self, angle):
        """Vector (3,) between the circles, and slope and curvature of its square's half."""
        place, first, second = self.rail.point(angle)
        u = place - self.centre
        u = u - (u @ self.axis) * self.axis
        length = np.linalg.norm(u)
        u = u / length
        gap = place - self.centre - self.p.root_radius * u
        flat = first - (first @ self.axis) * self.axis
        turn = self.p.root_radius / length * (flat - (flat @ u) * u)
        return gap, gap @ first, (first - turn) @ first + gap @ second

    def farthest(self, start):
        """Angle of the largest distance, by Newton's method; None without one."""
        angle, reach = start, REACH / self.rail.radius
        for _ in range(12):
            _, slope, bend = self.at(angle)
            if bend >= 0.0 or abs(angle - start) > reach:
                break
            step = slope / bend
            angle -= step
            if abs(step) * self.rail.radius < ROUNDING:
                return angle
        return self._searched(start, reach)

    def _searched(self, start, reach):
        grid = start + np.linspace(-reach, reach, 81)
        slope = np.array([self.at(angle)[1] for angle in grid])
        falls = np.flatnonzero((slope[:-1] > 0.0) & (slope[1:] <= 0.0))
        if not falls.size:
            return None
        found = [brentq(lambda t: self.at(t)[1], grid[i], grid[i + 1], xtol=1e-13) for i in falls]
        return max(found, key=lambda angle: np.linalg.norm(self.at(angle)[0]))


def root_contact(p, curve_radius, side, hub, axis):
    """Flange root on gauge corner of the wheel at `hub` (m) with `axis` to the left; or None."""
    rail = Rail(curve_radius, side * (p.top + p.corner_outward), p.corner_down)
    distances = _RootGap(p, rail, side, hub, axis)
    start = rail.nearest_angle(hub)
    gap = distances.at(start)[0]
    if -side * gap @ axis < 0.0 or np.linalg.norm(gap) < 0.5 * (p.root - p.corner):
        return None  # far apart: no yaw within reach closes half of the difference of the radii
    angle = distances.farthest(start)
    if angle is None:
        return None
    gap = distances.at(angle)[0]
    place, first, _ = rail.point(angle)
    distance = np.linalg.norm(gap)
    normal, depth = gap / distance, distance - (p.root - p.corner)
    on_rail = np.arctan2(-side * normal[1], normal[2])
    on_wheel = np.arcsin(-side * normal @ axis)
    if not (
        p.corner_angles[0] < on_rail < p.corner_angles[1]
        and np.arctan(p.conicity) < on_wheel < p.flank_angle
    ):
        return None  # beyond the arcs
    rolling = first / np.linalg.norm(first)
    point = place + (p.corner - 0.5 * depth) * normal
    curvature = _relative(
        normal, rolling, point, rail.centre, axis, hub, 1.0 / p.corner, -1.0 / p.root
    )
    return Touch(depth, point, normal, rolling, curvature)


def tread_contact(p, curve_radius, side, hub, axis):
    """Tread on crown, as `root_contact`."""
    rail = Rail(curve_radius, side * p.top, p.crown)
    outward, slant = side * axis, np.hypot(1.0, p.conicity)
    angle = rail.nearest_angle(hub)
    for _ in range(30):
        place, first, second = rail.point(angle)
        along = (place - hub) @ outward
        u = place - hub - along * outward
        length = np.linalg.norm(u)
        u = u / length
        gradient = (u + p.conicity * outward) / slant
        flat = first - (first @ outward) * outward
        bend = (flat @ flat - (flat @ u) ** 2) / length / slant
        step = (gradient @ first) / (gradient @ second + bend)
        angle -= step
        if abs(step) * rail.radius < ROUNDING:
            break
    else:
        raise ArithmeticError("no common normal of tread and crown")
    distance = (length - p.radius + p.conicity * along) / slant
    depth, normal = p.crown - distance, -gradient
    rolling = first / np.linalg.norm(first)
    point = place + (p.crown - 0.5 * depth) * normal
    curvature = _relative(normal, rolling, point, rail.centre, axis, hub, 1.0 / p.crown, 0.0)
    return Touch(depth, point, normal, rolling, curvature)


def flank_gap(p, curve_radius, side, hub, axis):
    """Gap in m between the straight flank, extended, and the gauge corner."""
    rail = Rail(curve_radius, side * (p.top + p.corner_outward), p.corner_down)
    outward = side * axis
    s, c = np.sin(p.flank_angle), np.cos(p.flank_angle)
    # The flank passes the end of the root: centre of the root plus its radius along the normal.
    line = p.root_outward * s + (p.root_radius) * c - p.root

    def distance(angle):
        place = rail.point(angle)[0] - hub
        along = place @ outward
        return along * s + np.linalg.norm(place - along * outward) * c - line - p.corner

    middle = rail.nearest_angle(hub)
    angles = middle + np.linspace(-0.1, 0.1, 4001) / curve_radius
    return min(map(distance, angles))


@cache
def _shape(ratio):
    """Flatness minor/major of the ellipse for a ratio of curvatures >= 1 (Johnson 1985, ch. 4)."""

    def excess(logarithm):
        g = np.exp(logarithm)
        k, e = ellipk(1.0 - g * g), ellipe(1.0 - g * g)
        return np.log((e / g**2 - k) / (k - e)) - np.log(ratio)

    return np.exp(brentq(excess, -12.0, -1e-4, xtol=1e-14, rtol=1e-14))


class Ellipse(NamedTuple):
    """Normal force in N and the patch: form (2, 2) with x' form x <= 1 in m."""

    force: float
    form: np.ndarray


def hertz(depth, relative, modulus):
    """Normal contact of a gap x' relative x / 2 at a penetration (m); E* in Pa."""
    (low, high), directions = np.linalg.eigh(relative)
    g = _shape(max(high / low, 1.0 + 1e-6))
    m = 1.0 - g * g
    k, e = ellipk(m), ellipe(m)
    major = np.sqrt(2.0 * depth * (k - e) / (low * k * m))
    minor = g * major
    force = 2.0 / 3.0 * np.pi * major * minor * depth * modulus / (minor * k)
    return Ellipse(force, directions @ np.diag([major**-2, minor**-2]) @ directions.T)


def silhouette(relative):
    """The relative curvature that a section by planes across the rail would show.

    Curvatures along and across are then taken as principal ones.
    """
    (along, both), (_, across) = relative
    return np.diag([along, across - both**2 / along])
