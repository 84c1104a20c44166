"""Profiles: closed forms, tangent arcs, and measured files with their errors."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tramdva.contact import profiles
from tramdva.contact.measured_profile import measured_profile
from tramdva.contact.profiles import ProfileError


def test_s1002_sections_join_and_give_the_flange():
    wheel = profiles.s1002_wheel()
    assert_allclose(wheel.depth_at(0.0), 0.0, atol=1e-9)
    assert_allclose(np.degrees(np.arctan(-wheel.slope.min())), 70.0, atol=0.02)
    for joint in (-39.764473993, -38.426669071, -35.0, -26.0, 32.15796):
        left, right = (wheel.depth_at((joint + d) * 1e-3) for d in (-0.03, 0.03))
        before, after = (wheel.slope_at((joint + d) * 1e-3) for d in (-0.03, 0.03))
        assert_allclose(
            right - left, 0.03e-3 * (before + after), atol=1e-6
        )  # the 13 mm root bends within 30 um
        assert abs(after - before) < 0.06  # one kink of curvature, no kink of the profile


def test_uic60_is_tangent_upright_and_36_mm_wide():
    rail = profiles.uic60_rail(0.0)
    assert_allclose(rail.depth_at(-0.02), rail.depth_at(0.02), atol=1e-9)
    assert_allclose(rail.depth_at(0.01), 0.3 - np.sqrt(0.3**2 - 0.01**2), atol=1e-9)
    assert np.abs(np.diff(np.arctan(rail.slope))).max() < 1.05 * 25e-6 / 13e-3 * 5
    inclined = profiles.uic60_rail(1 / 40)
    assert_allclose(inclined.slope_at(0.0), 0.0, atol=1e-5)
    # The head leans inwards by 1/40: the 300 mm arc reaches 7.5 mm further to the gauge side.
    assert_allclose(inclined.slope_at(-0.0177), -0.0177 / 0.3, rtol=2e-3)


def test_an_inclined_rail_is_met_under_its_angle_elsewhere():
    """Where the upright rail has the angle of the inclined one, an arc's radius is between."""
    crown, angle = 0.3, 1 / 40
    upright = profiles.grooved_rail(crown)
    rail = profiles.inclined(upright, angle)
    assert_allclose(np.arctan(rail.slope_at(0.0)), -angle, atol=1e-9)
    # A wheel that stays, of slope 0 there, meets the arc `crown * sin(angle)` to the field side.
    assert_allclose(rail.slope_at(crown * np.sin(angle)), 0.0, atol=1e-6)
    # Points keep their distances from the origin.
    for place in (-0.02, 0.01):
        there = np.hypot(place, upright.depth_at(place))
        turn = np.arctan2(upright.depth_at(place), place) - angle
        assert_allclose(rail.depth_at(there * np.cos(turn)), there * np.sin(turn), atol=1e-9)
    assert profiles.inclined(upright, 0.0) is upright


def test_an_inclined_rail_turns_the_contact_of_a_coned_wheel():
    """A conical tread touches a circular crown where their slopes are equal."""
    cone, crown, angle = 0.05, 0.3, 1 / 40
    rail = profiles.inclined(profiles.grooved_rail(crown), angle)
    wheel = profiles.tram_wheel(conicity=cone)
    # Both slope alike where the gap between tread and rail is least.
    y = np.linspace(-0.015, 0.025, 40001)
    touching = y[np.argmin(rail.depth_at(y) - wheel.depth_at(y))]
    assert_allclose(rail.slope_at(touching), wheel.slope_at(touching), atol=1e-5)
    assert_allclose(wheel.slope_at(touching), -cone, atol=1e-6)
    upright = profiles.grooved_rail(crown)
    before = y[np.argmin(upright.depth_at(y) - wheel.depth_at(y))]
    # The centre of the crown's arc has moved by this, and with it every angle on the arc.
    assert_allclose(touching - before, crown * np.sin(angle), atol=2e-5)


def test_uic60_meets_the_published_points_of_the_manchester_profile(benchmark_rail, manchester):
    """Contact points printed by CONTACT lie on its rail profile."""
    right = manchester[manchester.side == "R"]
    depth = benchmark_rail.depth_at(right.y_rail.to_numpy() * 1e-3) * 1e3
    angle = np.arctan(np.abs(benchmark_rail.slope_at(right.y_rail.to_numpy() * 1e-3)))
    normal = np.abs(depth - right.z_rail) * np.cos(angle)
    assert normal.max() < 6e-3


def test_tram_pair_has_the_stated_arcs():
    wheel = profiles.tram_wheel(15.2e-3, np.radians(70.0), 0.025)
    assert_allclose(wheel.depth_at(0.0), 0.0, atol=1e-8)
    assert_allclose(wheel.slope_at(0.02), -0.025, rtol=1e-6)
    bend = np.gradient(wheel.slope, wheel.position) / (1 + wheel.slope**2) ** 1.5
    root = (wheel.slope < -0.5) & (wheel.slope > -2.0)
    assert_allclose(bend[root], 1 / 15.2e-3, rtol=2e-3)
    rail = profiles.grooved_rail(0.3, 13e-3)
    bend = np.gradient(rail.slope, rail.position) / (1 + rail.slope**2) ** 1.5
    corner = (rail.slope < -0.5) & (rail.slope > -2.0)
    assert_allclose(bend[corner], 1 / 13e-3, rtol=2e-3)


@pytest.mark.parametrize(
    "change", [{"flange_root_radius": 15.2}, {"conicity": -0.1}, {"flange_angle": 70.0}]
)
def test_wrong_parameters_are_named(change):
    with pytest.raises(ProfileError, match=next(iter(change))) as error:
        profiles.tram_wheel(**change)
    assert "\n" not in str(error.value)


def write(path, y, z, separator=" "):
    lines = [f"{a:.5f}{separator}{b:.5f}" for a, b in zip(y, z, strict=True)]
    path.write_text("# y z in mm\n" + "\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize(("reverse", "separator"), [(False, " "), (True, ","), (False, ";\t")])
def test_measured_profile_recovers_a_noisy_s1002(tmp_path, reverse, separator):
    wheel = profiles.s1002_wheel()
    y = np.arange(-45.0, 50.0, 0.4)
    noise = np.random.default_rng(7).normal(0.0, 0.01, y.size)
    z = wheel.depth_at(y * 1e-3) * 1e3 + noise
    if reverse:
        y, z = y[::-1], z[::-1]
    found = measured_profile(write(tmp_path / "w.txt", y, z, separator), "wheel", noise=0.0095e-3)
    inner = np.arange(-38.0, 45.0, 0.5) * 1e-3
    error = (found.depth_at(inner) - wheel.depth_at(inner)) / np.hypot(1, wheel.slope_at(inner))
    assert np.sqrt(np.mean(error**2)) < 0.006e-3  # below the noise: it is smoothed
    assert np.abs(np.arctan(found.slope_at(inner)) - np.arctan(wheel.slope_at(inner))).max() < 0.05


GOOD = (np.arange(-40.0, 40.0, 1.0), 0.001 * np.arange(-40.0, 40.0, 1.0) ** 2)


@pytest.mark.refuses
@pytest.mark.parametrize(
    ("text", "needle"),
    [
        ("1 2 3\n" * 30, "line 1: 3 columns"),
        ("0 1\nx 2\n", "line 2: 'x 2'"),
        ("0 nan\n", "must be finite"),
        ("0 1e999\n", "must be finite"),
        ("0 1_000\n", "'0 1_000' is not a pair"),
        ("0 2*3\n", r"'0 2\*3' is not a pair"),
        ("0 \x1b[2J\n", r"'0 \\x1b\[2J' is not a pair"),
        ("0 \x00\n", "is not a pair"),
        ("0 " + "9" * 5000 + "x\n", "is not a pair"),
        ("# \x0b \u2028\n0 x\n", "line 2: '0 x'"),
        ("# " + "x" * 1_000_000, "is larger than 1000000 bytes"),
        ("\n".join(f"{y} 0" for y in range(20_001)), "20001 points; at most 20000"),
        ("0 0\n1 1\n2 2\n", "3 points; at least 20"),
        ("\n".join(f"{y / 1000:.5f} 0" for y in range(-40, 40)), "must be in mm"),
        ("\n".join(f"{y * 10} 0" for y in range(-40, 40)), "must be in mm"),
        ("\n".join(f"{y} 0" for y in [*range(-40, 10), 5, *range(10, 40)]), "out of order"),
        ("\n".join(f"{y} 0" for y in [*range(-40, 10), 9, *range(10, 40)]), "overlaps"),
        ("\n".join(f"{y} 0" for y in [*range(-40, 0), *range(20, 40)]), "gap of 21"),
    ],
)
def test_bad_files_give_one_clear_line(tmp_path, text, needle):
    path = tmp_path / "bad.txt"
    path.write_text(text)
    with pytest.raises(ProfileError, match=needle) as error:
        measured_profile(path, "wheel")
    assert "\n" not in str(error.value)
    assert "bad.txt" in str(error.value)


def test_missing_file_binary_file_and_wrong_kind(tmp_path):
    for path in (tmp_path / "none.txt", tmp_path, Path("/dev/zero")):
        with pytest.raises(ProfileError, match=f"{path}: there is no such file"):
            measured_profile(path, "wheel")
    binary = tmp_path / "b.txt"
    binary.write_bytes(b"0 0\n" + bytes(range(128, 256)))
    with pytest.raises(ProfileError, match="line 2: is not UTF-8 text"):
        measured_profile(binary, "wheel")
    with pytest.raises(ProfileError, match="kind 'tyre'"):
        measured_profile(write(tmp_path / "w.txt", *GOOD), "tyre")
