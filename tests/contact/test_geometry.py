"""Contact geometry: known loci, a search in space, smoothness, and CONTACT's positions."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from tramdva.contact import geometry, hertz, locus, profiles

ROWS = np.zeros((geometry.WINDOW, locus.STRIDE))


def at(table, shift, height, roll=0.0, yaw=0.0):
    return np.array(geometry.locate_contact(table, shift, height, roll, yaw, ROWS))


def touch(table, shift, roll=0.0, yaw=0.0):
    """Height of first touch."""
    return geometry.touch_height(table, shift, roll, yaw, ROWS)


def test_conformal_root_moves_on_the_arc_of_the_difference_of_radii(tram_tables):
    """13 mm in 15.2 mm: the sine of the contact angle grows by du / 2.2 mm."""
    shift = np.linspace(-0.4e-3, 0.3e-3, 15)
    found = np.array([at(tram_tables[1], u, touch(tram_tables[1], u)) for u in shift])
    slope = np.polyfit(shift, np.sin(found[:, 1]), 1)[0]
    assert_allclose(slope, 1 / 2.2e-3, rtol=2e-3)
    assert_allclose(found[:, 6], 1 / 13e-3 - 1 / 15.2e-3, rtol=5e-3)
    assert_allclose(np.diff(found[:, 2]) / np.diff(shift), -15.2 / 2.2, rtol=5e-3)
    assert_allclose(np.diff(found[:, 4]) / np.diff(shift), -13.0 / 2.2, rtol=5e-3)


def test_tread_of_a_cone_on_the_crown(tram_tables):
    table = tram_tables[0]
    found = at(table, 0.5e-3, touch(table, 0.5e-3))
    assert_allclose(np.tan(found[1]), 0.025, rtol=1e-4)
    assert_allclose(found[4], -0.3 * np.sin(np.arctan(0.025)), rtol=1e-3)
    assert_allclose(found[6], 1 / 0.3, rtol=2e-3)


def test_two_point_contact_is_found(tram_tables, manchester_tables):
    assert len(tram_tables) == 2
    shift = brentq(lambda u: touch(tram_tables[0], u) - touch(tram_tables[1], u), -0.8e-3, 0.3e-3)
    height = touch(tram_tables[0], shift) + 30e-6
    tread, flange = (at(table, shift, height) for table in tram_tables)
    assert tread[0] > 20e-6
    assert flange[0] > 20e-6
    assert flange[4] < tread[4] - 0.012
    assert flange[1] > tread[1] + 0.3
    # S1002: the well-known jump at 5 mm of wheelset shift, -16.7 to -28 mm on the wheel.
    assert len(manchester_tables) == 3
    heights = [touch(table, -5.53e-3) for table in manchester_tables[:2]]
    assert abs(heights[0] - heights[1]) < 40e-6


def brute_force(wheel, rail, radius, shift, roll, yaw):
    """Lowest gap of the wheel's surface over a grid of profile points and angles in space."""
    s = np.arange(-36.0, -22.0, 0.02) * 1e-3
    r = radius + wheel.depth_at(s)
    theta = np.linspace(-0.02, 0.3, 1601)[:, None]
    x, o, d = r * np.sin(theta), np.broadcast_to(s, (1601, s.size)), r * np.cos(theta) - radius
    o = o * np.cos(yaw) + x * np.sin(yaw)
    o, d = o * np.cos(roll) - d * np.sin(roll), o * np.sin(roll) + d * np.cos(roll)
    o = o + shift
    gap = np.interp(o, rail.position, rail.depth, left=1, right=1) - d
    k, i = np.unravel_index(gap.argmin(), gap.shape)
    forward = x[k, i] * np.cos(yaw) - s[i] * np.sin(yaw)
    return gap.min(), s[i], o[k, i], forward


@pytest.mark.parametrize(("yaw", "shift"), [(0.0, 0.1e-3), (0.02, -0.1e-3), (0.04, -0.66e-3)])
@pytest.mark.parametrize("roll", [0.0, 0.006])
def test_yawed_flange_contact_against_a_search_in_space(yaw, shift, roll):
    wheel, rail = profiles.tram_wheel(), profiles.grooved_rail()
    sharp = geometry.contact_tables(
        wheel, rail, 0.3, shift_range=(-2e-3, 1e-3), gap_scale=1e-6, roll_step=2e-3
    )[-1]
    height, on_wheel, on_rail, forward = brute_force(wheel, rail, 0.3, shift, roll, yaw)
    found = at(sharp, shift, height, roll, yaw)
    # epsilon log(curvature) of the soft minimum is below 1.5 um here, the search grid 1 um.
    assert_allclose(found[0], 0.0, atol=4e-6)
    assert_allclose(found[2], on_wheel, atol=0.25e-3)
    assert_allclose(found[4], on_rail, atol=0.25e-3)
    lead = (0.3 + found[3]) * np.tan(found[1]) * np.tan(yaw)
    # The search measures from the wheel's centre plane of the tape circle.
    assert_allclose(lead - found[2] * np.sin(yaw), forward, atol=1.2e-3)


def test_penetration_is_a_distance_and_its_gradient_the_normal(tram_tables):
    """The force along the contact angle is the gradient of a potential: no energy is made."""
    step = 1e-8
    for shift in (-0.35e-3, 0.0, 0.2e-3):
        for depth in (10e-6, 60e-6):
            height = touch(tram_tables[1], shift) + depth
            centre = at(tram_tables[1], shift, height)
            right, left = (at(tram_tables[1], shift + d, height)[0] for d in (step, -step))
            down, up = (at(tram_tables[1], shift, height + d)[0] for d in (step, -step))
            assert_allclose((right - left) / (2 * step), np.sin(centre[1]), atol=2e-5)
            assert_allclose((down - up) / (2 * step), np.cos(centre[1]), atol=2e-5)


def test_work_of_the_normal_force_on_closed_loops(tram_tables):
    """N(p, curvature) has a potential where the curvature is constant, nearly so elsewhere."""
    table = hertz.hertz_table()

    def work(centre, radius):
        angle = np.linspace(0, 2 * np.pi, 401)
        shift = centre[0] + radius * np.cos(angle)
        height = centre[1] + radius * np.sin(angle)
        force = []
        for u, z in zip(shift, height, strict=True):
            p, delta, _, depth, _, _, lateral, *_ = at(tram_tables[1], u, z)
            normal = hertz.hertz_ellipse(table, np.cos(delta) / (0.3 + depth), lateral, 1.1e11, p)
            force.append([-normal[0] * np.sin(delta), -normal[0] * np.cos(delta)])
        middle = 0.5 * (np.array(force)[1:] + np.array(force)[:-1])
        path = np.column_stack([np.diff(shift), np.diff(height)])
        return np.sum(middle * path), np.sum(np.abs(middle * path))

    root = -0.1e-3
    net, gross = work((root, touch(tram_tables[1], root) + 40e-6), 20e-6)
    assert abs(net) < 2e-3 * gross


def test_contact_quantities_are_continuous(tram_tables):
    """Steps of 0.2 um of shift through tread, root and flank: no jump in any quantity."""
    shift = np.arange(-1.0e-3, 0.9e-3, 2e-7)
    for table, low in zip(tram_tables, (-1.0e-3, -0.45e-3), strict=True):
        part = shift[shift > low]
        height = np.interp(part, part[::50], [touch(table, u, yaw=0.01) for u in part[::50]])
        found = np.array([at(table, u, z, yaw=0.01) for u, z in zip(part, height, strict=True)])
        assert np.abs(np.diff(found[:, 1])).max() < 1e-3  # angle, rad
        assert np.abs(np.diff(found[:, 4])).max() < 8e-6  # position on the rail, m
        assert np.abs(np.diff(np.log(found[:, 6]))).max() < 6e-3  # curvature


@pytest.mark.parametrize("zone", [0, 1])
def test_table_against_direct_evaluation(tram_tables, zone):
    """Random places; the largest errors sit where root and flank contact change over."""
    wheel, rail = profiles.tram_wheel(), profiles.grooved_rail()
    split = geometry.zone_splits(wheel, rail, 0.3, (-10e-3, 10e-3), 8e-6)[0]
    ends = (None, split, None)
    part = np.ascontiguousarray(np.array(geometry._zone(wheel, ends[zone + 1], ends[zone]))[:, ::4])
    grid = (rail.position[0], rail.position[1] - rail.position[0])
    rng, errors = np.random.default_rng(3), []
    for _ in range(200):
        u, roll, yaw = rng.uniform(-3e-3, 1e-3), rng.uniform(-0.012, 0.012), rng.uniform(0, 0.045)
        out = np.zeros((1, 1, 1, locus.STRIDE))
        locus.fill_table(
            part, 0.3, 0.0, grid, np.array([rail.depth, rail.slope]), np.array([u]),
            np.array([roll]), np.array([np.tan(yaw) ** 2]), 8e-6, out,
        )  # fmt: skip
        exact = out[0, 0, 0]
        found = at(tram_tables[zone], u, exact[0], roll, yaw)
        errors.append(np.abs([found[0], found[4] - exact[3]]))
    height, position = np.array(errors).T
    assert np.median(height) < 2e-8
    # Extrapolated heights turn as sharply as those of half the gap scale.
    assert np.percentile(height, 95) < 0.7e-6
    assert height.max() < 4e-6
    assert np.percentile(position, 95) < 0.1e-3


def test_outside_the_table_and_nan_are_reported(tram_tables):
    assert at(tram_tables[0], 0.0, 0.0)[7] == 0
    for place in [(0.02, 0.0), (0.0, 0.0, 0.05), (0.0, 0.0, 0.0, 0.2), (np.nan, 0.0)]:
        assert at(tram_tables[0], *place)[7] == geometry.OUTSIDE_TABLE


def test_wrong_use_gives_one_clear_line():
    wheel, rail = profiles.tram_wheel(), profiles.grooved_rail()
    for arguments in [(rail, wheel, 0.3), (wheel, rail, 300.0)]:
        with pytest.raises(profiles.ProfileError, match=r"^[^\n]+$"):
            geometry.contact_tables(*arguments)


def test_tables_are_small(tram_tables, manchester_tables):
    for tables in (tram_tables, manchester_tables):
        assert sum(table.coefficients.nbytes for table in tables) < 70e6
    assert sum(table.coefficients.nbytes for table in tram_tables) < 50e6
