"""The nonlinear revolution beside the linear one, symmetry, what is proportional to an order."""

import numpy as np
import pytest
from wearing_wheels import ORDERS, wheel_of

from tramdva.route.nonlinear import revolution, source_of
from tramdva.wear.chart import CONSTANT, SMOOTHED


@pytest.fixture(scope="module", params=[CONSTANT, SMOOTHED])
def outer(request, middle, laws):
    return wheel_of(middle, laws[0], 0, request.param)


@pytest.mark.parametrize("order", [5, 10, 26, 34, 44, 56, 67])
def test_small_waves_grow_and_drift_as_the_linear_response_tells(outer, order):
    """Rate and drift within 2 % of the larger of both; either crosses zero over the orders."""
    running, small = outer
    wave = np.zeros(68, complex)
    wave[order - 1] = 1e-6 * np.exp(0.7j)
    found = revolution(running, ORDERS, wave)
    assert found.status == "periodic"
    ratio = found.depth[order - 1] / wave[order - 1] / small[order - 1]
    assert abs(ratio - 1.0) < 0.01


def test_several_small_waves_at_once_answer_as_each_alone(outer):
    """Combinations of two orders do not change their sign with the waves: the odd part is left."""
    running, small = outer
    place = np.array([5, 13, 26, 34, 43, 56, 67]) - 1
    wave = np.zeros(68, complex)
    wave[place] = 5e-7 * np.exp(1j * np.arange(7.0) ** 2)
    plus, minus = (revolution(running, ORDERS, sign * wave).depth for sign in (1.0, -1.0))
    ratio = (0.5 * (plus - minus))[place] / wave[place] / small[place]
    np.testing.assert_allclose(ratio, 1.0, atol=0.01)


@pytest.mark.parametrize(("wheel", "design"), [(1, "none"), (2, "none"), (0, "paper")])
def test_other_wheels_and_absorbers_as_well(middle, laws, wheel, design):
    running, small = wheel_of(middle, laws[0], wheel, CONSTANT, design)
    for order in (13, 30):
        wave = np.zeros(68, complex)
        wave[order - 1] = 1e-6
        found = revolution(running, ORDERS, wave).depth[order - 1] / 1e-6
        np.testing.assert_allclose(found, small[order - 1], rtol=0.01)


def test_a_turned_profile_wears_alike_at_the_turned_place(outer):
    """Where the angle of the wheel begins says nothing: all orders turn with the profile."""
    running, _ = outer
    rng = np.random.default_rng(3)
    wave = 3e-6 / np.sqrt(ORDERS) * np.exp(1j * rng.uniform(-np.pi, np.pi, 68))
    turn = np.exp(1j * ORDERS * 2.0 * np.pi * 37 / 256)  # whole intervals of the output
    still = revolution(running, ORDERS, wave)
    turned = revolution(running, ORDERS, wave * turn)
    size = np.abs(still.depth).max()
    np.testing.assert_allclose(turned.depth / turn, still.depth, atol=5e-3 * size)
    assert turned.mean == pytest.approx(still.mean, rel=1e-4)


def test_a_round_wheel_wears_evenly(outer):
    running, _ = outer
    found = revolution(running, ORDERS, np.full(68, 1e-12 + 0j))
    assert np.abs(found.depth).max() < 1e-4 * found.mean


def test_waves_reach_the_contact_of_their_wheel_only(outer):
    running, _ = outer
    source = source_of(running, ORDERS, np.full(68, 1e-6 + 0j))
    assert (source[:, 1:] == 0.0).all()
    np.testing.assert_allclose(np.abs(source[0, 0]), 1e-6, rtol=1e-3)  # long waves are felt whole
    assert np.abs(source[-1, 0]).min() < 0.96e-6


def test_large_waves_do_not_answer_as_small_ones(outer):
    """The model is not the linear one: where the modes respond, 20 um are too much."""
    running, small = outer
    wave = np.zeros(68, complex)
    wave[55] = 2e-5
    found = revolution(running, ORDERS, wave).depth[55] / 2e-5
    assert abs(found / small[55] - 1.0) > 0.05
