"""Tendency, peaks and normalisation; what the sign means is shown by wearing a wheel on."""

import numpy as np
import pytest

from tramdva.evolution.out_of_roundness import order_amplitudes, radius_deviation
from tramdva.evolution.tendency import (
    evolution_tendency,
    excitation_frequency,
    highest_peak,
    normalised,
    order_of_frequency,
)


def test_frequency_of_an_order_by_equation_18():
    # Orders 17 to 20 of wheels of 0.27 to 0.3 m at 15 to 19 km/h come near 50 Hz.
    frequency = excitation_frequency(20, 16 / 3.6, 0.285)
    np.testing.assert_allclose(frequency, 49.64, atol=0.01)
    np.testing.assert_allclose(order_of_frequency(frequency, 16 / 3.6, 0.285), 20)


@pytest.mark.parametrize("phase", [0.0, 0.7, 2.0, np.pi, -2.6])
def test_an_order_grows_by_its_tendency_when_the_wheel_is_worn_on(phase):
    """Closed loop: every revolution takes away the wear that the linear response tells."""
    order, response, angle = 7, 2e-3 * np.exp(1j * phase), np.linspace(0, 2 * np.pi, 721)[:-1]
    radius = radius_deviation([order], [5e-6 * np.exp(0.3j)], angle)
    start = order_amplitudes(angle, radius, [order])[0]
    for _ in range(100):
        wave = order_amplitudes(angle, radius, [order])[0]
        radius = radius - radius_deviation([order], [response * wave], angle)
    end = order_amplitudes(angle, radius, [order])[0]
    tendency = evolution_tendency(response)
    np.testing.assert_allclose(np.log(abs(end / start)) / 100, tendency, atol=3e-6)
    np.testing.assert_allclose(np.angle(end / start) / 100, -response.imag, atol=5e-6)


def test_tendency_is_positive_when_more_is_worn_in_the_troughs():
    assert evolution_tendency(-0.3 + 0.1j) == pytest.approx(0.3)
    assert evolution_tendency(0.3j) == pytest.approx(0.0)


def test_normalised_by_the_largest_of_each_wheel_without_absorber():
    tendency = np.array([[[0.1, -0.4], [2.0, 1.0]], [[0.2, 0.1], [np.nan, 4.0]]])
    found = normalised(tendency, tendency[0])
    np.testing.assert_allclose(found, [[[0.25, -1.0], [1.0, 0.5]], [[0.5, 0.25], [np.nan, 2.0]]])


def test_peak_between_grid_points():
    frequency = np.linspace(40.0, 60.0, 81)
    place, height = highest_peak(frequency, 3.0 - (frequency - 51.37) ** 2)
    np.testing.assert_allclose([place, height], [51.37, 3.0])


@pytest.mark.parametrize("tendency", [np.arange(9.0), -np.abs(np.arange(9.0) - 4.0) - 0.1])
def test_no_peak_at_an_end_or_below_zero(tendency):
    assert np.isnan(highest_peak(np.arange(9.0), tendency)).all()
