"""Steady rolling on the half-space: closed forms, limits, convergence, and CONTACT."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import dblquad, quad

from tramdva.contact import kalker, rolling

LIMIT, SHEAR_MODULUS = 12250.0, 82e9
CASES = [(0.3, 0.0, 0.0), (0.0, 0.4, 0.0), (0.0, 0.0, 0.5), (0.1, -0.2, 0.3), (0.3, 0.9, 1.5)]


def forces(ratio, creepages, cells=16, strips=12, poisson=0.28):
    """Extrapolated force_x, force_y, moment."""
    grids = [rolling.rolling_grid(ratio, n, strips, poisson) for n in (cells, cells // 2)]
    return rolling.extrapolated_forces(*grids, creepages)[0]


def reduced(case):
    """Reduced creepages of a row of CONTACT's cases."""
    mean = np.sqrt(case.a * case.b)
    scale = SHEAR_MODULUS * mean**2 / LIMIT
    return scale * case.nu_x, scale * case.nu_y, scale * mean * case.phi


@pytest.mark.parametrize("place", [(0.9, 0.4), (-0.3, 1.1), (2.0, -1.5)])
def test_influence_of_a_rectangle_is_the_integral_of_point_loads(place):
    nu = 0.28

    def point(component):
        def load(v, u):
            x, y = place[0] - u, place[1] - v
            r = np.hypot(x, y)
            kernel = [(1 - nu) / r + nu * x * x / r**3, nu * x * y / r**3]
            return [*kernel, (1 - nu) / r + nu * y * y / r**3][component] / np.pi

        return dblquad(load, -0.5, 0.5, -0.25, 0.25)[0]

    found = rolling.influence(*place, 1.0, 0.5, nu)
    assert_allclose(found, [point(i) for i in range(3)], rtol=1e-7)


def test_displacements_by_hertzian_traction_in_a_circle():
    """Closed form of Cattaneo and Mindlin for q_x = q_0 sqrt(1 - r^2) on two bodies."""
    nu, strips, cells = 0.28, 28, 28
    grid = rolling.rolling_grid(1.0, cells, strips, nu)
    # The slip is a difference of displacements over a cell: sum it along a middle strip.
    slip = (grid.xx @ grid.bound).reshape(strips, cells)[strips // 2]
    x = grid.x.reshape(strips, cells)[strips // 2]
    found = -np.cumsum(slip[:-1]) * (x[1] - x[0])
    q_0 = 1.5 / np.pi
    exact = np.pi * q_0 / 16.0 * -(4.0 - 3.0 * nu) * (x[1:] ** 2 - x[0] ** 2)
    assert_allclose(found, exact, atol=2e-3 * np.pi * q_0 / 4.0)


@pytest.mark.parametrize("poisson", [0.0, 0.25, 0.5])
@pytest.mark.parametrize("ratio", [0.1, 0.5, 1.0, 2.0, 10.0])
def test_kalkers_coefficients(ratio, poisson):
    """Printed with three digits and, at round patches, up to 1.6 % (C23) beside the limit."""
    coarse, fine = (
        rolling.linear_coefficients(rolling.rolling_grid(ratio, cells, 16, poisson))
        for cells in (12, 24)
    )
    expected = kalker.creep_coefficients(kalker.kalker_table(poisson), ratio)
    assert_allclose((2 * fine - coarse)[:3], expected, rtol=0.02)
    assert_allclose((2 * fine - coarse)[:2], expected[:2], rtol=0.012)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 4.0])
def test_small_creepages_give_the_linear_theory(ratio):
    cells, strips = 24, 12
    coarse, fine = (
        rolling.linear_coefficients(rolling.rolling_grid(ratio, n, strips))
        for n in (cells // 2, cells)
    )
    c11, c22, c23, c33 = 2 * fine - coarse
    by = [forces(ratio, case, cells, strips) for case in 0.002 * np.eye(3)]
    assert_allclose(by[0] / 0.002, [-c11, 0.0, 0.0], rtol=2e-3, atol=1e-4)
    assert_allclose(by[1][1] / 0.002, -c22, rtol=2e-3)
    assert_allclose(by[2][1:] / 0.002, [-c23, -c33], rtol=0.01)
    # Reciprocity: the moment by lateral creepage is the force by spin.
    assert_allclose(by[1][2], -by[2][1], rtol=0.01)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("size", [0.3, 0.6, 1.0, 1.5])
def test_curve_of_vermeulen_and_johnson(axis, size):
    """1 - (1 - w/3)^3 for a round patch: an approximation, known to be some per cent low."""
    c11, c22 = 4.21, 3.68
    creepages = np.zeros(3)
    creepages[axis] = size / (c11, c22)[axis]
    excess = -forces(1.0, creepages)[axis] - (1.0 - (1.0 - size / 3.0) ** 3)
    assert -0.002 < excess < 0.03


@pytest.mark.parametrize(("axis", "factor"), [(0, 1 / (1 - 0.28)), (1, 1.0)])
@pytest.mark.parametrize("creep", [0.15, 0.35, 0.6])
def test_strips_of_carter_where_the_ellipse_is_short_along_rolling(axis, factor, creep):
    """Each strip is Carter's cylinder: sticks over d = a (y) - k a at its leading edge."""
    k = np.pi / 3.0 * factor * creep

    def stuck(y):
        return max(np.sqrt(1.0 - y * y) - k, 0.0) ** 2

    expected = 1.0 - quad(stuck, -1.0, 1.0)[0] / (4.0 / 3.0)
    creepages = np.zeros(3)
    creepages[axis] = creep
    found = forces(0.01, creepages, 16, 24)
    assert_allclose(-found[axis], expected, atol=0.008)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0])
def test_large_creepages_give_full_sliding(ratio):
    one = rolling.steady_rolling(rolling.rolling_grid(ratio, 6, 5), 3e7, -4e7, 0.0)[0]
    assert_allclose(one[:2], [-0.6, 0.8], rtol=1e-6)
    assert_allclose(one.sliding, 1.0)
    # Spin about the middle of a circle: the moment is the mean arm, 3 pi / 16 of the radius.
    spin = forces(1.0, (0.0, 0.0, 1e6), 24, 24)
    assert_allclose(spin, [0.0, 0.0, -3 * np.pi / 16], atol=2e-3)


@pytest.mark.parametrize("creepages", CASES)
def test_symmetries(creepages):
    X, Y, Z = creepages
    force = forces(0.6, creepages)
    assert_allclose(forces(0.6, (-X, -Y, -Z)), -force, atol=1e-6)
    assert_allclose(forces(0.6, (X, -Y, -Z)), force * [1, -1, -1], atol=1e-6)
    assert_allclose(forces(0.6, (-X, Y, Z)), force * [-1, 1, 1], atol=1e-6)


@pytest.mark.parametrize("creepages", CASES)
def test_every_cell_sticks_within_the_bound_or_slides_against_its_traction(creepages):
    grid = rolling.rolling_grid(2.0, 16, 10)
    found, state = rolling.steady_rolling(grid, *creepages)
    assert found.status == rolling.CONVERGED
    assert found.sliding > 0.0
    q, slides = state.traction, state.slides
    rigid = rolling.rigid_slip(grid, *creepages)
    slip = rigid + np.stack([grid.xx @ q[0] + grid.xy @ q[1], grid.xy @ q[0] + grid.yy @ q[1]])
    largest = np.hypot(*rigid).max()
    assert_allclose(slip[:, ~slides], 0.0, atol=1e-5 * largest)
    assert np.all(np.hypot(*q)[~slides] <= grid.bound[~slides] * (1 + 1e-6))
    assert_allclose(np.hypot(*q)[slides], grid.bound[slides], rtol=1e-6)
    power = (q * slip).sum(axis=0)[slides]
    assert_allclose(power, -(np.hypot(*q) * np.hypot(*slip))[slides], atol=1e-5 * largest)


@pytest.mark.parametrize("creepages", CASES)
def test_start_does_not_matter(creepages):
    grid = rolling.rolling_grid(1.0, 12, 10)
    afresh = rolling.steady_rolling(grid, *creepages)[0]
    other = rolling.steady_rolling(grid, 0.05, 0.02, -0.1)[1]
    assert_allclose(rolling.steady_rolling(grid, *creepages, other)[0][:3], afresh[:3], atol=1e-5)


@pytest.mark.parametrize("creepages", CASES)
def test_convergence_is_of_first_order_and_extrapolation_better(creepages):
    raw = {
        n: np.array(rolling.steady_rolling(rolling.rolling_grid(1.0, n, 14), *creepages)[0][:3])
        for n in (8, 12, 16, 24)
    }
    finest = 2 * raw[24] - raw[12]
    error = {n: np.linalg.norm(raw[n] - finest) for n in (8, 16)}
    assert 0.7 < np.log2(error[8] / error[16]) < 1.4
    assert np.abs(2 * raw[16] - raw[8] - finest).max() < 0.006
    assert np.abs(finest - forces(1.0, creepages, 24, 15)).max() < 0.004  # other strips


def grid_of_contact(cells):
    """Round patch as in CONTACT: equal squares whose centre is inside, pressure of the centre."""
    centre = (np.arange(cells) + 0.5) * 2.0 / cells - 1.0
    x, y = (v.ravel() for v in np.meshgrid(centre, centre))
    x, y = x[x * x + y * y < 1.0], y[x * x + y * y < 1.0]
    side = np.full(x.size, 2.0 / cells)
    bound = np.sqrt(1.0 - x * x - y * y)
    bound /= bound.sum() * side[0] ** 2
    slips = [np.empty((x.size, x.size)) for _ in range(3)]
    rolling._fill_slips(x, y, side, side, side, 0.28, *slips)
    return rolling.RollingGrid(x, y, bound, side**2, x + 0.5 * side, *slips)


def test_on_its_grid_the_numbers_of_contact(contact_cases):
    """Without spin, where both solve the same equations: 0.1 % of mu N on 40 x 40 cells."""
    grid = grid_of_contact(40)
    rows = contact_cases[(contact_cases.phi == 0) & (contact_cases.a == contact_cases.b)]
    for case in rows[rows.nu_y.isin([0.0, 0.002])].iloc[1:3].itertuples():
        found = rolling.steady_rolling(grid, *reduced(case))[0]
        error = np.hypot(found.force_x - case.Fx / LIMIT, found.force_y - case.Fy / LIMIT)
        assert error < 1e-3


def test_against_contact(contact_cases):
    """CONTACT's own error of first order, about 1 % on 40 cells, is what is left."""
    grids = {}
    found = []
    for case in contact_cases.itertuples():
        ratio = case.a / case.b
        if ratio not in grids:
            grids[ratio] = [rolling.rolling_grid(ratio, cells, 12) for cells in (20, 10)]
        force = rolling.extrapolated_forces(*grids[ratio], reduced(case))[0]
        found.append(np.hypot(force[0] - case.Fx / LIMIT, force[1] - case.Fy / LIMIT))
    assert np.mean(found) < 0.0065
    assert np.max(found) < 0.017


def test_no_creepage_gives_no_force():
    found, state = rolling.steady_rolling(rolling.rolling_grid(1.0, 6, 6), 0.0, 0.0, 0.0)
    assert found == (0.0, 0.0, 0.0, 0.0, rolling.CONVERGED)
    assert not state.slides.any()


def test_a_case_that_does_not_converge_has_no_numbers(monkeypatch):
    monkeypatch.setattr(rolling, "MOST_STEPS", 1)
    found, _ = rolling.steady_rolling(rolling.rolling_grid(1.0, 8, 8), 0.1, 0.1, 0.3)
    assert found.status == rolling.NOT_CONVERGED
    assert np.isnan(found[:3]).all()


@pytest.mark.parametrize("wrong", [(0.0, 8, 8), (1.0, 1, 8), (1.0, 8, 1), (np.nan, 8, 8)])
def test_bad_grids_are_refused_in_one_line(wrong):
    with pytest.raises(ValueError, match=r"^[^\n]+$"):
        rolling.rolling_grid(*wrong)
