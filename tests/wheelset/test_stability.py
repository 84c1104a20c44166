import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from wheelset_lines import paper, sections

from tramdva.stages import stability_map
from tramdva.wheelset import stability
from tramdva.wheelset.model import linearised

VARIANTS = [(4e7, 7500.0), (3e7, 7500.0), (2e7, 7500.0), (1e7, 7500.0)]


def growth(with_absorber=False, **values):
    return float(stability.growth_rate(paper(**values), with_absorber))


def test_the_baseline_is_barely_unstable_at_48_hertz():
    leading = stability.leading_eigenvalues(paper(), with_absorber=False)
    assert 0.1 < float(leading.real) < 0.2
    assert_allclose(float(leading.imag) / (2 * np.pi), 48.4, atol=0.05)


def test_critical_friction_decrease():
    critical = brentq(lambda B: growth(B=B), 0.4, 0.7, xtol=1e-10)
    assert_allclose(critical, 0.68005, atol=5e-6)  # digits given by the source
    assert_allclose(stability.critical_friction_decrease(paper(), False), critical, rtol=1e-6)
    quiet, rough = paper(mu_0=0.05), paper(d_A=-1e5)
    assert np.isnan(stability.critical_friction_decrease(quiet, False))
    assert stability.critical_friction_decrease(rough, False) == 0.0


def test_variants_of_figure_2():
    # The paper calls the first one unstable; at the baseline's creep stiffness it is just stable.
    rates = [growth(True, c_T=c_T, d_T=d_T) for c_T, d_T in VARIANTS]
    assert_allclose(rates[0], -0.029, atol=5e-4)
    assert_allclose(rates, sorted(rates, reverse=True))  # a softer absorber stabilises more


@given(
    st.lists(
        st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0)), min_size=1, max_size=3, unique=True
    )
)
def test_hurwitz_determinants_decide_the_signs_of_the_roots(pairs):
    roots = np.array([[complex(re, im), complex(re, -im)] for re, im in pairs]).ravel()
    assume(np.min(np.abs(roots.real)) > 1e-2)
    determinants = stability.hurwitz_determinants(np.poly(roots).real)
    assert bool(np.all(determinants > 0.0)) == bool(np.all(roots.real < 0.0))


def test_last_but_one_determinant_vanishes_with_a_pair_on_the_axis():
    # Orlando's formula: H_(n-1) is the product of all sums of two roots, up to its sign
    roots = np.array([2j, -2j, -1.0, -3.0, -0.5 + 1j, -0.5 - 1j])
    determinants = stability.hurwitz_determinants(np.poly(roots).real)
    sums = [roots[i] + roots[j] for i in range(6) for j in range(i)]
    assert_allclose(determinants[4], (-1) ** 15 * np.prod(sums).real, atol=1e-9)
    shifted = roots - 0.1
    sums = [shifted[i] + shifted[j] for i in range(6) for j in range(i)]
    determinants = stability.hurwitz_determinants(np.poly(shifted).real)
    assert_allclose(determinants[4], -np.prod(sums).real, rtol=1e-9)


@pytest.mark.parametrize("mounted", [True, False])
def test_characteristic_polynomial_has_the_eigenvalues_as_roots(mounted):
    values = paper(c_T=2e7, d_T=7500.0)
    coefficients = stability.characteristic_polynomial(values, mounted)
    matrix = linearised(values, mounted).matrices[0] * 1e-3
    assert_allclose(coefficients, np.poly(matrix).real, rtol=1e-9)


def test_map_agrees_with_eigenvalues_at_every_grid_point():
    axis = {"min": 1e5, "max": 2.5e8}
    cfg = {
        **sections(paper()),
        "absorber_variants": [
            {"name": f"case_{i}", "c_T": c_T, "d_T": d_T} for i, (c_T, d_T) in enumerate(VARIANTS)
        ],
        "study": {
            "c_A": axis,
            "c_R": axis,
            "d_T": {"min": 0.0, "max": 2e4},
            "c_T": {"min": 1e5, "max": 6e7},
        },
        "numerics": {"points": 41},
    }
    out = stability_map.compute(cfg)
    assert out["growth_rate"].shape == (5, 41, 41)
    for prefix in ("", "absorber_"):
        assert out[f"{prefix}routh_hurwitz_agrees"].all()
        stable = out[f"{prefix}growth_rate"] < 0.0
        assert_allclose(stable, out[f"{prefix}instability"] == stability.STABLE)
        # H5 = 0 is the boundary of oscillatory stability as long as a6 stays positive
        assert np.all(out[f"{prefix}coefficient_a6"] > 0.0)
        assert np.all(out[f"{prefix}hurwitz_h5"][stable] > 0.0)
    assert 0.05 < stable.mean() < 0.95


def test_divergence_needs_a_stiffness_of_the_order_of_the_centripetal_term():
    # a_n changes its sign where c_A c_R is about Omega^2 (m_A + m_R) c_R, some 10 N/m
    p = paper()
    softest = (p.m_A + p.m_R) * p.Omega**2
    below, above = (
        stability.characteristic_polynomial(p._replace(c_A=factor * softest), False)[-1]
        for factor in (0.99, 1.01)
    )
    assert below < 0.0 < above
    assert softest < 20.0


def test_no_equilibrium_is_no_number():
    # at 10 N/m the creep force of 11 kN finds no steady state within the curve
    leading = stability.leading_eigenvalues(paper(c_A=10.0), with_absorber=False)
    assert np.isnan(leading)
    assert stability.classify(leading) == stability.NO_EQUILIBRIUM
