"""Describing functions: closed forms, saturation, and the vehicle's own beside the full loop."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from wearing_wheels import wheel_of

from tramdva.bogie.revolutions import Settings
from tramdva.route.saturation import Describing, describing, saturating, saturation_amplitude
from tramdva.route.wearing_on import Bounds, wear_on
from tramdva.wear.chart import SMOOTHED

SIZES = np.array([1e-6, 1e-5, 1e-4])


def test_constant_rates_are_exponentials():
    rate = np.array([[-0.02 + 0.3j] * 3, [0.01 - 0.1j] * 3])
    initial = np.array([5e-5j, 2e-6])
    distance = np.linspace(0.0, 150.0, 31)
    wanted = initial * np.exp(np.outer(distance, rate[:, 0]))
    np.testing.assert_allclose(saturating(initial, distance, SIZES, rate), wanted, rtol=1e-9)


def test_rates_over_the_amplitude_are_integrated_as_another_integrator_does():
    rate = np.array([0.03 + 0.2j, 0.02 - 0.1j, -0.01 + 0.05j])
    distance = np.linspace(0.0, 800.0, 81)

    def slope(_, y):
        x = np.clip(y[0], np.log(SIZES[0]), None)
        return [np.interp(x, np.log(SIZES), rate.real), np.interp(x, np.log(SIZES), rate.imag)]

    start = np.log(3e-7), 0.4
    wanted = solve_ivp(slope, (0, 800), start, t_eval=distance, rtol=1e-10, atol=1e-12, max_step=1)
    found = saturating(np.array([np.exp(start[0] + 0.4j)]), distance, SIZES, rate[None])[:, 0]
    np.testing.assert_allclose(np.log(np.abs(found)), wanted.y[0], atol=1e-6)
    turned = np.angle(found * np.exp(-1j * wanted.y[1]))
    np.testing.assert_allclose(turned, 0.0, atol=1e-5)
    end = np.log(SIZES[1]) + 2.0 / 3.0 * np.log(10.0)  # where the rate is zero
    assert np.log(abs(found[-1])) == pytest.approx(end, abs=0.02)


def test_from_above_saturation_an_order_falls_to_it():
    rate = np.array([[0.03 + 0j, 0.02, -0.01]])
    found = saturating(np.array([9e-5 + 0j]), np.array([0.0, 5000.0]), SIZES, rate)[:, 0]
    assert found[0] == pytest.approx(9e-5)
    assert abs(found[1]) == pytest.approx(1e-5 * 10 ** (2.0 / 3.0), rel=1e-6)


def test_nothing_is_told_beyond_known_amplitudes():
    rate = np.array([[0.03 + 0j, 0.02, np.nan]])
    found = saturating(np.array([5e-6 + 0j]), np.array([0.0, 10.0, 100.0]), SIZES, rate)[:, 0]
    assert np.isfinite(found[:2]).all()
    assert np.isnan(found[2])


def table(*rows):
    response = -np.array(rows, complex)
    shape = response.shape
    status = np.full(shape, "periodic")
    return Describing(np.arange(shape[0]), SIZES, response, np.zeros(shape), status)


def test_saturation_is_where_a_tenth_of_the_growth_is_left():
    small = -np.array([0.01, 0.01, 0.01, -0.01, 0.01], complex)
    found = saturation_amplitude(
        table([0.01, 0.01, -0.008], [0.01] * 3, [0.0005, 0.0, 0.0], [0.1] * 3,
              [0.01, np.nan, np.nan]), small,
    )  # fmt: skip
    assert found[0] == pytest.approx(1e-5 * np.sqrt(10.0))
    assert np.isnan(found[[1, 3, 4]]).all()
    assert found[2] == SIZES[0]


def test_one_order_by_its_describing_function_grows_as_in_the_full_loop(middle, laws):
    """An order alone, up to where its growth is another than that of small waves: levels."""
    running, small = wheel_of(middle, laws[0], 0, SMOOTHED)
    running = running._replace(settings=Settings(256, 1, 40, 1e-3, 0.2))
    sizes = 1e-6 * np.array([1.0, 2.0, 3.0, 5.0, 7.0, 10.0])
    orders, place = np.array([56.0, 112.0]), 55
    known = describing(running, orders[:1], sizes)
    assert (known.status == "periodic").all()
    assert known.harmonics[0, -1] > 0.05
    np.testing.assert_allclose(known.response[0, 0], small[place], rtol=0.02)
    growth = -small[place].real
    fall = known.response[0, -1].real / small[place].real
    assert abs(fall - 1.0) > 0.1
    initial = np.array([1.2e-6, 1e-9 + 0j])
    both = np.array([small[place], 0.1 * small[place]])
    run = wear_on(running, orders, initial, both, Bounds(1.7 / growth, 1.0, 5e-3, 40))
    u = np.linspace(0.0, run.end, 8)
    found = saturating(initial[:1], u, sizes, -known.response)[:, 0]
    level = 20.0 * np.log10(np.abs(run.at(u)[:, 0] / found))
    np.testing.assert_allclose(level, 0.0, atol=0.2)
