import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from tramdva.contact.creep_force import creep_force, creep_force_derivatives, friction_coefficient

V_0 = 3.9083267665715731
LAW = {"F_N": 35000.0, "mu_0": 0.35, "A": 0.36, "B": 0.7, "C_22": 5351976.0, "k_A": 1.0, "k_S": 1.0}


def force(w, V=V_0, **changes):
    return creep_force_derivatives(w, V, *{**LAW, **changes}.values())


def test_values_at_the_steady_slip_of_the_baseline():
    F, slope, *_ = force(0.04 * V_0)
    assert_allclose(F, 11435.802, rtol=1e-7)  # digits given by the source
    assert_allclose(slope, -4887.468, rtol=1e-7)


def test_friction_falls_from_mu_0_to_mu_infinity():
    assert friction_coefficient(0.0, 0.35, 0.36, 0.7) == pytest.approx(0.35, rel=1e-15)
    assert friction_coefficient(1e3, 0.35, 0.36, 0.7) == pytest.approx(0.35 * 0.36, rel=1e-15)
    assert friction_coefficient(-0.2, 0.35, 0.36, 0.7) == friction_coefficient(0.2, 0.35, 0.36, 0.7)


@pytest.mark.parametrize("w", [1e-3, 0.02, 0.1563, 0.7, -0.05, -0.4])
@pytest.mark.parametrize("k_S", [1.0, 0.4])
def test_each_derivative_is_the_complex_step_of_the_one_before(w, k_S):
    exact = force(w, k_S=k_S)
    stepped = force(w + 1e-30j, k_S=k_S)
    for order in range(3):
        assert_allclose(stepped[order].imag / 1e-30, exact[order + 1], rtol=1e-12)


@given(st.floats(1e-4, 5.0), st.floats(0.5, 20.0), st.floats(0.1, 1.0), st.floats(0.1, 1.0))
def test_short_and_long_form_agree(w, V, k_A, k_S):
    law = {**LAW, "k_A": k_A, "k_S": k_S}
    assert_allclose(
        creep_force(w, V, *law.values()),
        creep_force_derivatives(w, V, *law.values())[:2],
        rtol=1e-12,
        atol=1e-6,  # N and N s/m: the slope passes zero
    )


def test_force_is_odd_and_its_slope_even():
    plus, minus = force(0.12), force(-0.12)
    assert_allclose(minus, np.array([-1.0, 1.0, -1.0, 1.0]) * plus, rtol=1e-15)


def test_small_slip_gives_the_linear_creep_force():
    w = 1e-9
    assert_allclose(force(w)[0], LAW["C_22"] * w / V_0, rtol=1e-6)  # the next term is of order w
    assert_allclose(force(w, k_A=0.6, k_S=0.4)[0], 0.5 * LAW["C_22"] * w / V_0, rtol=1e-6)


def test_large_slip_gives_coulomb_friction():
    assert_allclose(force(1e4)[0], 0.35 * 0.36 * 35000.0, rtol=1e-6)


def test_a_smaller_adhesion_area_has_no_falling_slope():
    # Polach's reduction for a dry contact, k_S = 0.4: no self-excitation at the steady slip
    assert force(0.04 * V_0, k_S=0.4)[1] > 0.0
