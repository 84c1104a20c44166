import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq, minimize_scalar
from wheelset_lines import paper, reference, sections

from tramdva.stages import critical_hopf_curve, hopf_curves
from tramdva.wheelset import stability
from tramdva.wheelset.critical import critical_point_at, largest_growth
from tramdva.wheelset.hopf import solve_hopf_point

CURVES = {
    "study": {
        "d_T": [1000.0, 7500.0],
        "c_A": {"min": 1e7, "max": 2.5e8},
        "c_T": {"min": 1e5, "max": 1.5e8},
    },
    "numerics": {"max_points": 1000, "tolerance": 1e-10},
}
CRITICAL = {
    "study": {"d_T": {"min": 100.0, "max": 1.2e5}, "c_A": {"min": 1e6, "max": 1e9}},
    "numerics": {"max_points": 600, "tolerance": 1e-10, "check_points": 200},
}


@pytest.fixture(scope="module")
def curves():
    return hopf_curves.compute({**sections(paper()), **CURVES})


@pytest.fixture(scope="module")
def critical(curves):
    return critical_hopf_curve.compute({**sections(paper()), **CRITICAL}, curves)


def growth_peak(c_T, d_T):
    """Largest growth rate over c_A near the tangency, by direct search."""
    found = minimize_scalar(
        lambda c_A: -float(stability.growth_rate(paper(c_A=c_A, c_T=c_T, d_T=d_T), True)),
        bounds=(6e7, 1.6e8),
        method="bounded",
        options={"xatol": 1.0},
    )
    return -found.fun, found.x


def test_hopf_curve_of_the_reference(curves):
    here = curves["d_T"] == 7500.0
    assert np.unique(curves["curve"][here]).size == 1
    ours = np.column_stack([curves["c_A"][here], curves["c_T"][here]])
    assert (curves["first_lyapunov_coefficient"][here] < 0.0).all()
    for row in reference("auto/hopf_curve_dT_7500.csv")[::20]:
        c_A, c_T = float(row["c_A"]), float(row["c_T"])
        start, end = ours[:-1], ours[1:]
        along = np.sum(([c_A, c_T] - start) * (end - start), axis=1)
        share = np.clip(along / np.sum((end - start) ** 2, axis=1), 0.0, 1.0)
        foot = start + share[:, None] * (end - start)
        assert np.hypot(*(foot - [c_A, c_T]).T).min() < 3e-3 * c_T  # chord of the drawn curve
        if row["freq_Hz"] and abs(c_T / 17125790.0 - 1) > 1e-3:  # a fold in c_A at the merging
            point = solve_hopf_point(paper(c_A=1.0001 * c_A, c_T=c_T, d_T=7500.0), True, "c_A")
            assert_allclose(point.values.c_A, c_A, rtol=2e-9)  # printed c_T: 0.01 N/m
            assert_allclose(point.frequency, float(row["freq_Hz"]), rtol=2e-9)


def test_points_of_the_hopf_curve_have_no_growth(curves):
    values = paper()._replace(c_A=curves["c_A"], c_T=curves["c_T"], d_T=curves["d_T"])
    leading = stability.leading_eigenvalues(values, True)
    assert_allclose(leading.real, 0.0, atol=1e-7)  # 1/s, beside 300 rad/s
    assert_allclose(leading.imag / (2 * np.pi), curves["frequency"], rtol=1e-9)


def test_hopf_points_merge_where_the_paper_and_the_reference_say(curves):
    here = (curves["special_kind"] == "critical") & (curves["special_d_T"] == 7500.0)
    assert_allclose(curves["special_c_T"][here], [17125790.1384], rtol=1e-10)
    assert_allclose(curves["special_c_A"][here], [84530519.7437], rtol=1e-8)


def test_critical_curve_of_the_reference(critical):
    for row in reference("auto/critical_hopf_curve.csv"):
        guess = paper(
            d_T=float(row["d_T"]),
            c_T=1.01 * float(row["c_T"]),
            c_A=1.02 * float(row["c_A"]),
        )
        found = critical_point_at(guess)
        assert_allclose(found.d_T, float(row["d_T"]), rtol=1e-14)
        assert_allclose(found.c_T, float(row["c_T"]), rtol=1e-11)
        assert_allclose(found.c_A, float(row["c_A"]), rtol=1e-10)


def test_tangency_agrees_with_a_direct_search():
    # (15) against the root in c_T of the largest growth rate over c_A
    c_T = brentq(lambda c: growth_peak(c, 7500.0)[0], 1.6e7, 1.8e7, xtol=1.0)
    assert_allclose(c_T, 17125790.1384, rtol=1e-6)  # tolerance of the search
    assert_allclose(growth_peak(c_T, 7500.0)[1], 84530519.7, rtol=1e-4)  # flat maximum


def test_shape_of_the_critical_curve(critical):
    special = dict(zip(critical["special_kind"], critical["special_d_T"], strict=True))
    assert_allclose(special["largest_c_T"], 58.1e3, atol=100.0)
    assert_allclose(special["fold"], 110.02e3, atol=10.0)
    upper, lower = critical["branch"] == "upper", critical["branch"] == "lower"
    order = np.argsort(critical["d_T"][upper])
    d_T, c_T = critical["d_T"][upper][order], critical["c_T"][upper][order]
    top = critical["special_c_T"][critical["special_kind"] == "largest_c_T"][0]
    assert_allclose(np.interp(50e3, d_T, c_T) / top, 1 - 0.009, atol=1e-3)
    # the lower branch returns to positive c_T: a vanishing spring suffices above that damping
    small = lower & (critical["d_T"] < 20e3)
    limit = critical["d_T"][small].max()
    c_A = np.geomspace(1e6, 1e9, 2000)
    rates = [largest_growth(paper(c_T=1e3, d_T=d_T), c_A) for d_T in (limit - 2.0, limit + 2.0)]
    assert rates[0] > 0.0 > rates[1]
    assert 2800.0 < limit < 2900.0
    order = np.argsort(critical["d_T"][small])
    at_1000 = np.interp(1000.0, critical["d_T"][small][order], critical["c_T"][small][order])
    assert_allclose(at_1000, 3.3936e6, rtol=2e-2)  # linear between points
    assert_allclose(np.interp(1000.0, d_T, c_T), 9.4247e6, rtol=2e-3)


def test_global_check_refuses_the_local_tangency_at_small_damping(critical):
    upper = critical["branch"] == "upper"
    d_T, good = critical["d_T"][upper], critical["stabilises_all_c_A"][upper]
    assert not good[d_T < 185.0].any()
    assert good[d_T > 250.0].all()
    for k in np.flatnonzero(upper)[::20]:
        values = paper(c_T=critical["c_T"][k], d_T=critical["d_T"][k])
        c_A = np.geomspace(1e6, 1e9, 3000)
        rates = stability.growth_rate(values._replace(c_A=c_A), True)
        assert (rates.max() < 1e-5) == critical["stabilises_all_c_A"][k]


def test_absorber_inside_the_curve_stabilises_and_outside_does_not():
    for c_T, unstable in ((0.95 * 17125790.0, False), (1.05 * 17125790.0, True)):
        values = paper(c_T=c_T, d_T=7500.0)
        largest = largest_growth(values, np.geomspace(1e6, 1e9, 400))
        assert (largest > 0.0) == unstable


def test_without_self_excitation_there_is_nothing_to_continue():
    cfg = {**sections(paper(B=0.3)), **CURVES}
    out = hopf_curves.compute(cfg)
    assert all(len(value) == 0 for value in out.values())
    empty = critical_hopf_curve.compute({**cfg, **CRITICAL}, out)
    assert all(len(value) == 0 for value in empty.values())
