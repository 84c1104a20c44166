"""Growth over kilometres: the wheel that is worn on revolution by revolution, limits, lives."""

import numpy as np
import pytest

from tramdva.route.growth import (
    distance_to_limit,
    grown,
    initial_amplitudes,
    peak_to_peak,
    wheel_life,
)
from tramdva.route.parameters import InitialSpectrum
from tramdva.route.search import damping, energy_distance

SPECTRUM = InitialSpectrum(level_dB=0.0, slope_dB_per_octave=-6.0, seed=3)


def test_two_conditions_in_any_sequence_grow_as_their_sum():
    """Each revolution takes away H of the wave; what counts is how many there were of each."""
    responses, revolutions = np.array([-2e-4 + 1e-4j, 5e-5 - 3e-4j]), np.array([3000, 7000])
    rng = np.random.default_rng(0)
    sequence = rng.permutation(np.repeat([0, 1], revolutions))
    wave = 1e-6 + 0j
    for condition in sequence:
        wave -= responses[condition] * wave
    growth = -(revolutions @ responses)  # in the distance of all of them: 1000 km, say
    (found,) = grown(np.array([1e-6 + 0j]), np.array([growth]), np.array([1000.0]))[0]
    # The product of (1 - H) is not quite exp(-H): by the square of H a revolution.
    assert found == pytest.approx(wave, rel=1e-3)


def test_a_single_order_reaches_its_limit_when_its_amplitude_is_half_of_it():
    found = distance_to_limit(
        np.array([20.0]), np.array([1e-6j]), np.array([0.5 + 0.2j]), 3e-4, 1e5
    )
    assert found.status == "reached"
    # 0.015 percent: the profile is sampled at 1024 angles, a crest may fall between two.
    assert found.km == pytest.approx(1000.0 / 0.5 * np.log(150.0), rel=1e-3)


def test_what_does_not_grow_reaches_no_limit_and_says_so():
    found = distance_to_limit(np.array([20.0]), np.array([1e-6]), np.array([-0.1]), 3e-4, 1e5)
    assert (np.isnan(found.km), found.status) == (True, "beyond_horizon")
    found = distance_to_limit(np.array([20.0]), np.array([1e-6]), np.array([np.nan]), 3e-4, 1e5)
    assert (np.isnan(found.km), found.status) == (True, "no_steady_answer")
    found = distance_to_limit(np.array([20.0]), np.array([1e-3]), np.array([0.1]), 3e-4, 1e5)
    assert found == (0.0, "beyond_at_once")


def test_peak_to_peak_of_waves_in_phase_and_apart():
    orders = np.array([3.0, 5.0])
    assert peak_to_peak(orders[:1], np.array([2e-6j])) == pytest.approx(4e-6, rel=1e-4)
    # cos 3x + cos 5x = 2 cos x cos 4x: from +2 at 0 to -2 at pi.
    assert peak_to_peak(orders, np.array([1e-6, 1e-6])) == pytest.approx(4e-6, rel=1e-4)


def test_initial_levels_fall_by_their_slope_and_phases_do_not_depend_on_other_orders():
    found = initial_amplitudes(np.array([1.0, 2.0, 16.0]), SPECTRUM)
    effective = np.abs(found) / np.sqrt(2.0)
    np.testing.assert_allclose(20.0 * np.log10(effective / 1e-6), [0.0, -6.0, -24.0], atol=1e-9)
    assert initial_amplitudes(np.array([16.0, 20.0]), SPECTRUM)[0] == found[2]


def test_energy_of_one_wave_is_that_of_the_limit_where_its_height_is():
    """For a single order both measures of a polygon are the same."""
    orders, initial, growth = np.array([20.0]), np.array([1e-6]), np.array([0.5])
    exact = distance_to_limit(orders, initial, growth, 3e-4, 1e5).km
    assert energy_distance(initial, growth, 3e-4, 1e5) == pytest.approx(exact, rel=1e-3)
    assert energy_distance(initial, -growth, 3e-4, 1e5) == 1e6


def test_a_wheel_that_is_turned_rarely_lives_by_its_wear_alone():
    assert wheel_life(1e9, 1e-3, 2.5e-8, 0.03) == pytest.approx(0.03 / 2.5e-8, rel=1e-3)
    assert wheel_life(1e4, 1.5e-3, 0.0, 0.03) == pytest.approx(2e5)


def test_loss_factor_is_the_lag_of_the_spring_at_the_own_frequency():
    c_T, inertia = 4.0e5, 2.0
    lag = np.angle(c_T + 1j * np.sqrt(c_T / inertia) * damping(inertia, c_T, 0.3))
    assert np.tan(lag) == pytest.approx(0.3)
