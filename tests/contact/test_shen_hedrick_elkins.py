"""The saturated linear law: its limits, its symmetries, and an implementation made apart."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from reference.bogie.creep_laws import CreepLaw

from tramdva.contact import kalker
from tramdva.contact.kalker import saturated_forces

YOUNGS, POISSON, LIMIT = 2.1e11, 0.28, 12250.0
SHEAR_MODULUS = 0.5 * YOUNGS / (1.0 + POISSON)
TABLE = kalker.kalker_table(POISSON)


def by_law(a, b, *creepages):
    """Forces and moment on a patch with 35 kN and a friction of 0.35."""
    coefficients = kalker.creep_coefficients(TABLE, a / b)
    return np.array(saturated_forces(a, b, 35e3, 0.35, *creepages, coefficients, SHEAR_MODULUS))


@pytest.mark.parametrize("creepages", [(1e-3, 0.0, 0.0), (2e-3, -3e-3, 1.5), (0.0, 0.04, -2.0)])
@pytest.mark.parametrize(("a", "b"), [(4e-3, 4e-3), (6e-3, 2e-3)])
def test_the_law_of_the_independent_vehicle(a, b, creepages):
    other = CreepLaw(YOUNGS, POISSON, kind="she")
    expected = other.forces(np.diag([a**-2, b**-2]), LIMIT, creepages)
    # Kalker's coefficients between their nodes come from splines over other variables.
    assert_allclose(by_law(a, b, *creepages), expected, rtol=2e-3)


def test_linear_at_first_and_coulombs_in_the_end():
    mean = np.sqrt(5e-3 * 3e-3)
    c11, c22, c23 = kalker.creep_coefficients(TABLE, 5 / 3)
    scale = SHEAR_MODULUS * mean**2
    slopes = 1e7 * np.array([by_law(5e-3, 3e-3, *case) for case in 1e-7 * np.eye(3)])
    assert_allclose(slopes[0], [-scale * c11, 0.0, 0.0], rtol=1e-3)
    assert_allclose(slopes[1], [0.0, -scale * c22, scale * mean * c23], rtol=1e-3)
    # Reciprocity: force by spin is moment by lateral creepage.
    assert_allclose(slopes[2], [0.0, -scale * mean * c23, 0.0], rtol=1e-3)
    for creepages in ((1.0, 0.0, 0.0), (0.3, -0.4, 0.0), (0.0, 1.0, 3.0)):
        assert_allclose(np.hypot(*by_law(5e-3, 3e-3, *creepages)[:2]), LIMIT, rtol=1e-12)


def test_the_curve_of_vermeulen_and_johnson_goes_smoothly_into_sliding():
    """mu N (1 - (1 - e/3)^3): two derivatives vanish where the whole patch slides."""
    c22 = kalker.creep_coefficients(TABLE, 1.0)[1]
    e = np.linspace(0.0, 4.0, 81)
    nu_y = e * LIMIT / (SHEAR_MODULUS * 16e-6 * c22)
    found = np.array([by_law(4e-3, 4e-3, 0.0, nu, 0.0)[1] for nu in nu_y])
    assert_allclose(-found / LIMIT, 1.0 - np.maximum(1.0 - e / 3.0, 0.0) ** 3, atol=1e-12)


def test_no_load_no_force():
    assert saturated_forces(4e-3, 4e-3, 0.0, 0.35, 0.1, 0.1, 1.0, (4.0, 3.7, 1.5), 8e10) == (
        0.0, 0.0, 0.0,
    )  # fmt: skip
