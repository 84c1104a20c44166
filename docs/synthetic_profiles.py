"""Synthetic wheel and rail for the line `worn-40m`, in the form of measured files.

    python docs/synthetic_profiles.py config/profiles

Material is taken off a new wheel and a new rail along the normal: a hollow on the tread and a
thinner flange, a flatter crown and a gauge corner set back, and noise is added as gauges have it.
Around the wheel there are an eccentricity, a roughness that falls with the order, and a polygon.
"""

import sys
from pathlib import Path

import numpy as np

from tramdva.contact import profiles
from tramdva.contact.profiles import Profile

SPACING = 0.2e-3  # m along the profile
NOISE = 2e-6  # m, of the points of a profile
ORDERS = np.arange(1, 91)
POLYGON = 19  # what the second bending mode makes at 6 m/s


def bump(position: np.ndarray, centre: float, width: float) -> np.ndarray:
    """Smooth hollow of depth 1 around a centre, lengths in m."""
    return np.exp(-(((position - centre) / width) ** 2))


def ramp(position: np.ndarray, centre: float, width: float) -> np.ndarray:
    """Smooth step from 1 far at negative positions to 0, lengths in m."""
    return 0.5 * (1.0 - np.tanh((position - centre) / width))


def worn(profile: Profile, removed: np.ndarray) -> np.ndarray:
    """Points (n, 2) of a profile from which material is removed along the normal, lengths in m."""
    into = -1.0 if profile.kind == "wheel" else 1.0  # a wheel's material is above its profile
    length = np.hypot(1.0, profile.slope)
    position = profile.position - into * removed * profile.slope / length
    depth = profile.depth + into * removed / length
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(position), np.diff(depth)))])
    even = np.arange(0.0, arc[-1], SPACING)
    return np.column_stack([np.interp(even, arc, position), np.interp(even, arc, depth)])


def worn_wheel() -> np.ndarray:
    """Tram wheel with a tread 0.1 mm hollow and a flange 0.8 mm thinner."""
    wheel = profiles.tram_wheel(17e-3)
    y = wheel.position
    return worn(wheel, 0.1e-3 * bump(y, -3e-3, 14e-3) + 0.8e-3 * ramp(y, -28e-3, 6e-3))


def worn_rail() -> np.ndarray:
    """Grooved rail with a flatter crown and a gauge corner set back by 0.6 mm."""
    rail = profiles.grooved_rail(corner_start=15e-3)
    y = rail.position
    return worn(rail, 0.06e-3 * bump(y, 0.0, 12e-3) + 0.6e-3 * ramp(y, -20e-3, 6e-3))


def wheel_out_of_round() -> np.ndarray:
    """Points (360, 2) around a wheel: angle in degrees, radius deviation in um."""
    random = np.random.default_rng(3)
    amplitude = 20.0 * ORDERS**-1.4 + 1.5 * np.exp(-(((ORDERS - POLYGON) / 1.5) ** 2))
    phase = random.uniform(0.0, 2.0 * np.pi, ORDERS.size)
    angle = np.arange(360.0)
    waves = amplitude * np.cos(np.outer(np.radians(angle), ORDERS) + phase)
    return np.column_stack([angle, waves.sum(axis=1)])


def write(path: Path, what: str, columns: str, points: np.ndarray) -> None:
    """Write points as a measured file; the first lines say that it is none."""
    header = f"{what}: synthetic, made by docs/synthetic_profiles.py, not measured.\n{columns}"
    np.savetxt(path, points, "%.4f", ",", header=header)


def noisy(points: np.ndarray, seed: int) -> np.ndarray:
    """Points of a profile (m) with the noise of a gauge, in mm."""
    return 1e3 * (points + np.random.default_rng(seed).normal(0.0, NOISE, points.shape))


def main(folder: Path) -> None:
    """Write the three files."""
    columns = "y in mm, outwards from {}; z in mm, downwards"
    wheel, rail = noisy(worn_wheel(), 1), noisy(worn_rail(), 2)
    write(folder / "worn_wheel.csv", "Worn wheel", columns.format("the tape circle"), wheel)
    write(folder / "worn_rail.csv", "Worn rail", columns.format("the top of the rail"), rail)
    columns = "angle in degrees against the rotation; radius deviation in um, crest positive"
    write(folder / "out_of_round.csv", "Wheel out of round", columns, wheel_out_of_round())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
