"""Contact tables of a line's parametric profiles against exact contacts, under one wheel load.

    python benchmarks/two_point.py [line] [load in N]

For lateral shifts of the flange through 3 mm and yaw angles up to 0.06 rad the height, the load on
tread, root and flank and the mean contact angle are compared with rigid contacts: all local minima
of the gap of silhouette and rail, each a Hertz contact with the curvatures that it has there. They
have no gap scale, and where two of them merge, in a root that conforms, there is one.
"""

import itertools
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from tramdva.configuration.reading import load
from tramdva.contact import geometry, hertz, locus, tables, yawed_wheel

CONFIG = Path(__file__).resolve().parents[1] / "config"
HERTZ, ROWS = hertz.hertz_table(), np.zeros((geometry.WINDOW, locus.STRIDE))
MODULUS = hertz.effective_modulus(2.06e11, 0.27)
YAWS = np.array([0.0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06])


def rigid_contacts(wheel, rail, radius, yaw, shifts):
    """Contacts (shift, height, angle, position on the wheel, force at unit penetration) per shift.

    A list per shift; local minima of the exact gap.
    """
    y = np.arange(wheel.position[0] + 1e-3, wheel.position[-1] - 1e-3, 1e-5)
    z, slope = wheel.depth_at(y), wheel.slope_at(y)
    curvature = -np.gradient(slope, y) / (1.0 + slope**2) ** 1.5
    tangent, r = np.tan(yaw), radius + z
    hidden = np.sqrt(np.maximum(1.0 - (slope * tangent) ** 2, 0.0))
    outward = y * np.cos(yaw) - r * slope * tangent**2 * np.cos(yaw)
    downward = r * hidden - radius
    angle = np.arctan2(-slope / np.cos(yaw), hidden)
    rail_curvature = np.gradient(rail.slope, rail.position) / (1.0 + rail.slope**2) ** 1.5
    out = []
    for shift in shifts:
        o = outward + shift
        inside = (o > rail.position[0]) & (o < rail.position[-1]) & (np.gradient(o) > 0.0)
        gap = np.where(inside, rail.depth_at(np.clip(o, *rail.position[[0, -1]])) - downward, 1.0)
        low = 1 + np.flatnonzero((gap[1:-1] < gap[:-2]) & (gap[1:-1] <= gap[2:]))
        rows = []
        for i in low[gap[low] < gap.min() + 3e-4]:
            axis = yawed_wheel.wheel_axis(0.0, -yaw)
            normal = (np.sin(angle[i]), np.cos(angle[i]))
            along, mixed, _ = yawed_wheel.relative_curvatures(
                axis, normal, r[i], curvature[i], 1.0, 0.0
            )
            circle = np.sqrt(1.0 - (normal[0] * axis[1]) ** 2) / r[i]
            across = np.interp(o[i], rail.position, rail_curvature) + curvature[i] + circle - along
            unit = hertz.turned_ellipse(HERTZ, along, mixed, across, MODULUS, 1.0)[0]
            rows.append((shift, gap[i], angle[i], y[i], unit))
        out.append(rows)
    return out


def exact(found, shift, height):
    """Penetration, angle, wheel position and normal force of the contacts at a place."""
    out = []
    for before, after in itertools.pairwise(found):
        for a in before:
            near = [b for b in after if abs(b[3] - a[3]) < 0.4e-3]
            if not near:
                continue
            b = min(near, key=lambda row: abs(row[3] - a[3]))
            beside = [
                (shift - row[0]) * np.cos(row[2]) - (height - row[1]) * np.sin(row[2])
                for row in (a, b)
            ]
            if beside[0] * beside[1] > 0.0 or beside[0] == beside[1]:
                continue
            t = beside[0] / (beside[0] - beside[1])
            u, h, delta, y, unit = (1.0 - t) * np.array(a) + t * np.array(b)
            p = (height - h) * np.cos(delta) + (shift - u) * np.sin(delta)
            if p > 0.0 and np.isfinite(unit):
                out.append((p, delta, y, unit * p**1.5))
    return out


def tabulated(tables, shift, height, yaw):
    """As `exact`, from the tables of the zones."""
    out = []
    for table in tables:
        found = geometry.locate_contact(table, shift, height, 0.0, yaw, ROWS)
        if found[0] <= 0.0:
            continue
        normal = (np.sin(found[1]), np.cos(found[1]))
        tensor = yawed_wheel.relative_curvatures(
            yawed_wheel.wheel_axis(0.0, -yaw), normal, 0.3 + found[3], found[8], found[6], 0.0
        )
        force = hertz.turned_ellipse(HERTZ, *tensor, MODULUS, found[0])[0]
        out.append((found[0], found[1], found[2], force))
    return out


def loaded(contacts_at, low, load):
    """Height at which the vertical force is the load, and the contacts there.

    Not a number where the contacts jump past the load: a rigid contact has no height then.
    """

    def excess(z):
        return sum(c[3] * np.cos(c[1]) for c in contacts_at(z)) - load

    ends = low - 5e-5, low + 6e-4
    if not excess(ends[0]) * excess(ends[1]) < 0.0:
        return np.nan, []
    z = brentq(excess, *ends, xtol=1e-10)
    if abs(excess(z)) > 1e-3 * load:
        return np.nan, []
    return z, contacts_at(z)


def shares(contacts):
    """Normal force on tread, root and flank in N, mean angle by load."""
    out = np.zeros(3)
    for _, delta, y, force in contacts:
        out[0 if y > -20.35e-3 else 1 if delta < np.radians(58.0) else 2] += force
    total = sum(c[3] for c in contacts)
    return out, sum(c[3] * c[1] for c in contacts) / total


def main(name: str, force: float) -> None:
    """Print the differences per yaw angle."""
    shape = load(CONFIG, overrides={"lines": [name]}).lines[name].contact_geometry
    wheel, rail = tables.parametric_wheel(shape.wheel), tables.parametric_rail(shape.rail)
    zones = tables.zone_tables(shape, 0.3, yaw_limit=0.062)
    print(f"{len(zones)} zones; differences to exact contacts at {force:g} N")
    print("yaw/rad  contacts  height/um mean max  share/kN mean max  angle/deg mean max")
    for yaw in YAWS:
        fine = np.arange(0.5e-3, 10.5e-3, 1e-5)
        found = rigid_contacts(wheel, rail, 0.3, yaw, fine)
        lowest = [min((row[1] for row in rows), default=np.inf) for rows in found]
        angle = np.array(
            [min(rows, key=lambda row: row[1])[2] if rows else np.inf for rows in found]
        )
        first = fine[np.flatnonzero(angle > 0.1)[0]]  # the flange begins to touch
        off, skipped = [], 0
        for shift in first - 0.3e-3 + np.arange(0.0, 3.0e-3, 0.05e-3):
            low = np.interp(shift, fine, lowest)
            if np.interp(shift, fine, angle) > np.radians(71.0):
                break
            z, one = loaded(lambda h, u=shift, f=found: exact(f, u, h), low, force)
            y, two = loaded(lambda h, u=shift, g=yaw: tabulated(zones, u, h, g), low, force)
            if np.isnan(z) or np.isnan(y):
                skipped += 1
                continue
            (a, mean), (b, other) = shares(one), shares(two)
            off.append((len(one), 1e6 * abs(z - y), 1e-3 * np.abs(a - b).max(),
                        np.degrees(abs(mean - other)), shift))  # fmt: skip
        count, height, share, turned, _ = np.array(off).T
        print(
            f"{yaw:.3f}  {int(count.min())}-{int(count.max())} ({len(off)}, {skipped} without)  "
            f"{height.mean():.1f} {height.max():.1f}  {share.mean():.2f} {share.max():.2f}  "
            f"{turned.mean():.2f} {turned.max():.2f}"
        )


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "paper", float((sys.argv[2:] or ["4e4"])[0]))
