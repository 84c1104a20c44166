"""Where a yawed wheel touches: a search in space, and the work of its normal force."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq, minimize

from tramdva.contact import geometry, locus, patch, profiles, yawed_wheel

RADIUS, ROOT = 0.3, 1
ROWS = np.zeros((geometry.WINDOW, locus.STRIDE))
ATTITUDES = [(0.0, 0.02), (0.0, 0.04), (0.006, 0.04), (-0.008, 0.03), (0.006, -0.03)]


@pytest.fixture(scope="module")
def pair():
    """The tram pair with a wider root, conformal up to 0.05 rad, and its tables."""
    wheel, rail = profiles.tram_wheel(flange_root_radius=17e-3), profiles.grooved_rail()
    tables = geometry.contact_tables(
        wheel, rail, RADIUS, shift_range=(-4e-3, 3e-3), gap_scale=2e-6, shift_step=2.5e-5,
        yaw_limit=0.055, yaw_nodes=31,
    )  # fmt: skip
    return wheel, rail, tables[ROOT]


def point_of_wheel(wheel, s, theta, roll, yaw):
    """Point (x, y, z) of a right wheel's surface from its centre; s outwards, theta from below.

    The wheel is turned about z, then about x, by rotation matrices of its own here.
    """
    r = RADIUS + wheel.depth_at(s)
    c, d, e, f = np.cos(yaw), np.sin(yaw), np.cos(roll), np.sin(roll)
    about_z = np.array([[c, -d, 0.0], [d, c, 0.0], [0.0, 0.0, 1.0]])
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, e, -f], [0.0, f, e]])
    return about_x @ about_z @ np.array([r * np.sin(theta), -s, -r * np.cos(theta)])


def touching_point(wheel, rail, lateral, roll, yaw, start, curvature=0.0):
    """Lowest gap of the wheel's surface, and its point from the centre.

    The rail may be a circle in plan: its profile then stands along the radii.
    """

    def across(x, y):
        if curvature == 0.0:
            return y
        return (1.0 - np.hypot(curvature * x, 1.0 - curvature * y)) / curvature

    def gap(x):
        x, y, z = point_of_wheel(wheel, x[0] * 1e-3, x[1], roll, yaw)
        return 1e3 * (rail.depth_at(-across(x, y + lateral)) + z + RADIUS)

    found = minimize(gap, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-13})
    return 1e-3 * found.fun, point_of_wheel(wheel, found.x[0] * 1e-3, found.x[1], roll, yaw)


def touching_place(table, angle, roll, yaw):
    """Place (y, z) of a right wheel's centre at which it just touches under an angle."""

    def at(y):
        found = patch.contact_point(table, -1.0, (y, 0.0), (roll, yaw), 0.0, 0.0, ROWS)[0]
        z = found[0] / np.cos(found[1])
        for _ in range(30):
            found = patch.contact_point(table, -1.0, (y, z), (roll, yaw), 0.0, 0.0, ROWS)[0]
            z += found[0] / np.cos(found[1])
        return found[1], z

    sway = RADIUS * np.sin(roll)
    y = brentq(lambda y: at(y)[0] - angle, -1.2e-3 - sway, 3.9e-3 - sway, xtol=1e-9)
    return y, at(y)[1]


@pytest.mark.parametrize(("roll", "yaw"), ATTITUDES)
def test_contact_lies_where_a_search_in_space_finds_it(pair, roll, yaw):
    """Right wheel; the lead has two parts of opposite sign, and the roll moves it by 2 %."""
    wheel, rail, table = pair
    for angle in (0.5, 0.7):
        y, z = touching_place(table, angle, roll, yaw)
        guess = patch.contact_point(table, -1.0, (y, z), (roll, yaw), 0.0, 0.0, ROWS)
        start = (1e3 * guess[0][2], guess[1] / RADIUS)
        gap, point = touching_point(wheel, rail, y, roll, yaw, start)
        found, *arm, _, _ = patch.contact_point(table, -1.0, (y, -gap), (roll, yaw), 0.0, 0.0, ROWS)
        # A soft minimum of 2 um; positions within what its mean differs from the lowest point.
        assert_allclose(found[0], 0.0, atol=4e-6)
        assert_allclose(arm[0], point[0], atol=2e-5 + 0.01 * abs(point[0]))
        assert_allclose(arm[1:], point[1:], atol=1.5e-4)


@pytest.mark.parametrize("curvature", [0.04, -0.06])
@pytest.mark.parametrize(("roll", "yaw"), ATTITUDES)
def test_contact_on_a_circle_is_that_of_the_search(pair, roll, yaw, curvature):
    """The change by the curvature: gap, place and direction of the rail under the contact."""
    wheel, rail, table = pair
    y, z = touching_place(table, 0.6, roll, yaw)
    guess = patch.contact_point(table, -1.0, (y, z), (roll, yaw), 0.0, 0.0, ROWS)
    start = (1e3 * guess[0][2], guess[1] / RADIUS)
    straight, before = touching_point(wheel, rail, y, roll, yaw, start)
    curved, point = touching_point(wheel, rail, y, roll, yaw, start, curvature)
    found, *arm, _, turn = patch.contact_point(
        table, -1.0, (y, z), (roll, yaw), 0.0, curvature, ROWS
    )
    change = -(found[0] / np.cos(found[1]) - guess[0][0] / np.cos(guess[0][1]))
    assert_allclose(change, curved - straight, atol=0.02 * abs(curved - straight) + 2e-8)
    assert_allclose(turn, curvature * point[0], rtol=0.03)
    ahead = arm[0] - turn * arm[1]  # back in the axes of the search
    assert_allclose(ahead - guess[1], point[0] - before[0], atol=0.07 * abs(point[0] - before[0]))


@pytest.mark.parametrize(("roll", "yaw"), ATTITUDES)
def test_the_normal_force_turns_the_wheel_as_the_penetration_changes(pair, roll, yaw):
    """A potential of the penetration: the moments about z and x follow from its derivatives."""
    table, step = pair[2], 1e-5
    y, z = touching_place(table, 0.65, roll, yaw)
    place = (y, z - 60e-6)

    def penetration(d_roll, d_yaw):
        angles = (roll + d_roll, yaw + d_yaw)
        return patch.contact_point(table, -1.0, place, angles, 0.0, 0.0, ROWS)[0][0]

    by_yaw = (penetration(0.0, step) - penetration(0.0, -step)) / (2.0 * step)
    by_roll = (penetration(step, 0.0) - penetration(-step, 0.0)) / (2.0 * step)
    found, x, y, z, *_ = patch.contact_point(table, -1.0, place, (roll, yaw), 0.0, 0.0, ROWS)
    n_y, n_z = np.sin(found[1]), np.cos(found[1])
    # Wheel against rail moves by the rotation times the arm; along the normal that is a gap. The
    # yaw comes first: it turns about an axis that the roll has tilted.
    assert_allclose(by_yaw, -(n_y * np.cos(roll) + n_z * np.sin(roll)) * x, rtol=4e-3)
    assert_allclose(by_roll, n_y * z - n_z * y, rtol=4e-3)


@pytest.mark.parametrize("curvature", [0.0, 0.04])
@pytest.mark.parametrize(("roll", "yaw"), ATTITUDES)
def test_relative_curvatures_are_those_of_the_gap_in_space(pair, roll, yaw, curvature):
    """A paraboloid through gaps along the normal around the touching point, of both surfaces."""
    wheel, rail, table = pair
    y, z = touching_place(table, 0.6, roll, yaw)
    found, *arm, heading, _ = patch.contact_point(
        table, -1.0, (y, z), (roll, yaw), 0.0, curvature, ROWS
    )
    start = (1e3 * found[2], arm[0] / RADIUS)
    gap, centre = touching_point(wheel, rail, y, roll, yaw, start, curvature)
    n = np.array([0.0, np.sin(found[1]), np.cos(found[1])])
    axes = np.array([[1.0, 0.0, 0.0], [0.0, n[2], -n[1]], n])
    places, distances = [], []
    for s, theta in np.random.default_rng(1).uniform(-1.0, 1.0, (60, 2)):
        point = point_of_wheel(
            wheel, found[2] + 3e-4 * s, np.arcsin(arm[0] / RADIUS) + 2e-3 * theta, roll, yaw
        )
        x, t, height = axes @ (point - centre)
        across = point[1] + y
        if curvature:
            across = (1.0 - np.hypot(curvature * point[0], 1.0 - curvature * across)) / curvature
        vertical = rail.depth_at(-across) + point[2] + RADIUS - gap
        # Along the normal, at the wheel's point; the rail's slope there turns it in second order.
        distances.append(vertical / np.hypot(1.0, rail.slope_at(-across)))
        places.append((x, t, height))
    x, t, _ = np.array(places).T
    monomials = np.column_stack(
        [0.5 * x**2, x * t, 0.5 * t**2, x, t, np.ones_like(x), x**3, x**2 * t, x * t**2, t**3]
    )
    expected = np.linalg.lstsq(monomials, np.array(distances), rcond=None)[0][:3]
    axis = yawed_wheel.wheel_axis(roll, heading)
    tensor = yawed_wheel.relative_curvatures(
        axis, n[1:], RADIUS + found[3], found[8], found[6], curvature
    )
    assert_allclose(tensor, expected, rtol=0.03, atol=0.02 * abs(expected).max())


@pytest.mark.parametrize(("roll", "yaw"), ATTITUDES)
def test_normals_of_a_wheel_meet_its_axis(roll, yaw):
    """The lead of a point on a cone: the plane of axis and normal holds the arm."""
    slope, s = np.tan(0.6), -0.021
    wheel = profiles.Profile("cone", "wheel", np.array([-0.03, 0.0]), slope * np.array([0.03, 0.0]),
                             np.array([-slope, -slope]))  # fmt: skip
    sine = slope * np.tan(-yaw)  # of the silhouette's forward angle; heading outwards is -yaw here
    point = point_of_wheel(wheel, s, np.arcsin(sine), roll, yaw)
    n_y = np.cos(roll) * slope / np.cos(yaw) - np.sin(roll) * np.sqrt(1.0 - sine**2)
    n_z = np.cos(roll) * np.sqrt(1.0 - sine**2) + np.sin(roll) * slope / np.cos(yaw)
    size = np.hypot(n_y, n_z)
    axis = yawed_wheel.wheel_axis(roll, yaw)
    x = yawed_wheel.forward_shift(axis, (n_y / size, n_z / size), point[1], point[2])
    assert_allclose(x, point[0], rtol=1e-12)
    lead = yawed_wheel.lead_on_wheel(roll, yaw, *point)
    assert_allclose(lead, (RADIUS + wheel.depth_at(s)) * sine, rtol=1e-12)
