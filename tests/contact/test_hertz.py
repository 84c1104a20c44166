"""Hertz: integrals of the pressure over the patch, limits, and the inverse."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad

from tramdva.contact import hertz

TABLE = hertz.hertz_table()
MODULUS = hertz.effective_modulus(2.06e11, 0.27)


def test_sphere_is_the_textbook_case():
    radius, penetration = 0.3, 5e-5
    normal, a, b = hertz.hertz_ellipse(TABLE, 1 / radius, 1 / radius, MODULUS, penetration)
    assert_allclose(normal, 4 / 3 * MODULUS * np.sqrt(radius) * penetration**1.5, rtol=1e-9)
    assert_allclose([a, b], np.sqrt(radius * penetration), rtol=1e-9)


@pytest.mark.parametrize("ratio", [0.01, 0.2, 1.0, 3.0, 60.0])
def test_surface_displacement_of_the_pressure_closes_the_gap(ratio):
    """Second way: displacement integrals of an ellipsoidal pressure, no elliptic functions."""
    long_curvature, lateral_curvature = 3.3, 3.3 * ratio
    penetration = 4e-5
    normal, a, b = hertz.hertz_ellipse(
        TABLE, long_curvature, lateral_curvature, MODULUS, penetration
    )

    # Potential of an ellipsoidal pressure (Johnson 1985, eq. 3.27), substitution u = a b t^2.
    def potential(power_a, power_b):
        def kernel(t):
            u = a * b * t * t
            return (
                2
                * a
                * b
                / ((a * a + u) ** (0.5 + power_a) * (b * b + u) ** (0.5 + power_b))
                / np.sqrt(a * b)
            )

        return quad(kernel, 0, np.inf, epsabs=0, epsrel=1e-11, limit=400)[0]

    factor = 1.5 * normal / (np.pi * MODULUS) / 2
    assert_allclose(factor * potential(0, 0), penetration, rtol=2e-7)
    assert_allclose(factor * potential(1, 0), long_curvature / 2, rtol=2e-7)
    assert_allclose(factor * potential(0, 1), lateral_curvature / 2, rtol=2e-7)


def test_table_between_its_nodes_meets_the_elliptic_integrals():
    for log_ratio in np.linspace(-9.97, 9.97, 37):
        exact = hertz.ellipse_functions(log_ratio)
        found = hertz.hertz_ellipse(TABLE, 1.0, np.exp(log_ratio), 1.0, 1.0)
        length = np.sqrt(2.0 / (1.0 + np.exp(log_ratio)))
        assert_allclose(np.array(found) / length, exact, rtol=1e-7)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.5, 10.0), st.floats(0.05, 200.0), st.floats(1e-7, 3e-4))
def test_exchange_of_directions_and_inverse(kx, ky, penetration):
    normal, a, b = hertz.hertz_ellipse(TABLE, kx, ky, MODULUS, penetration)
    swapped, b2, a2 = hertz.hertz_ellipse(TABLE, ky, kx, MODULUS, penetration)
    assert_allclose([normal, a, b], [swapped, a2, b2], rtol=1e-7)
    back = hertz.penetration_of_force(TABLE, kx, ky, MODULUS, normal)
    assert_allclose(back, penetration, rtol=1e-9)
    assert (a >= b) == (kx <= ky) or abs(np.log(kx / ky)) < 1e-6


def test_no_force_and_no_jump_at_loss_of_contact():
    assert hertz.hertz_ellipse(TABLE, 3.3, 11.0, MODULUS, 0.0) == (0.0, 0.0, 0.0)
    assert hertz.hertz_ellipse(TABLE, 3.3, 11.0, MODULUS, -1e-5) == (0.0, 0.0, 0.0)
    tiny = hertz.hertz_ellipse(TABLE, 3.3, 11.0, MODULUS, 1e-12)
    assert 0.0 < tiny[0] < 1e-5
    for rate in (-1.0, 1.0):
        assert hertz.damped_normal_force(0.0, rate, 0.5) == 0.0
    assert hertz.damped_normal_force(1000.0, -5.0, 0.5) == 0.0
    assert_allclose(hertz.damped_normal_force(1000.0, 0.1, 0.5), 1050.0, rtol=1e-12)
