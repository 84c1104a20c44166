"""Numbers that sheet, charts and explorer print, as their stages conclude them."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from tramdva.evolution.growing_orders import FAST, growing_orders
from tramdva.robustness.spread import LOADS, QUANTILES, spread
from tramdva.stages.axes import best_design
from tramdva.stages.evolution_tendency import fastest_order

RADIUS = 0.3
TURN = 2.0 * np.pi * RADIUS  # m, so that order n at speed v stands at n v / TURN Hz


def maps(*curves: np.ndarray, status="converged", speed=(3.0, 4.0)) -> dict[str, np.ndarray]:
    """Tendencies of two wheels without absorbers: `curves` over 2 ... 150 Hz, at every speed."""
    frequency, speed = np.linspace(2.0, 150.0, 1481), np.array(speed)
    tendency = np.array([[[curve(frequency)] * speed.size for curve in curves]])
    return {
        "absorber": np.array(["none"]),
        "frequency": frequency,
        "speed": speed,
        "speed_tendency": tendency,
        "speed_status": np.full((1, speed.size), status),
    }


def hill(top: float):
    """Straight slopes to 1 at a frequency, zero 20 Hz beside it, negative beyond."""
    return lambda frequency: 1.0 - np.abs(frequency - top) / 20.0


def test_orders_grow_between_the_zeros_of_the_tendency():
    found = growing_orders(maps(hill(60.0), hill(30.0)), RADIUS)
    for k, speed in enumerate((3.0, 4.0)):
        hertz = found["order"] * speed / TURN
        inside = (hertz <= 150.0) & (hertz >= 2.0)
        expected = inside & ((np.abs(hertz - 60.0) < 20.0) | (np.abs(hertz - 30.0) < 20.0))
        assert_array_equal(found["order_grows"][0, k], expected)
        assert_array_equal(np.isfinite(found["speed_order_tendency"][0, k]), inside)
        fast = found["order"][found["order_fast"][0, k]] * speed / TURN
        top = found["speed_order_tendency"][0, k].max(where=inside, initial=-1.0)
        distance = np.minimum(np.abs(fast - 60.0), np.abs(fast - 30.0))
        assert distance.max() <= 20.0 * (1.0 - FAST * top)
        nearest = min(np.abs(hertz[inside] - 60.0).min(), np.abs(hertz[inside] - 30.0).min())
        from_top = np.abs(found["fastest_frequency"][k] - np.array([60.0, 30.0])).min()
        assert_allclose(from_top, nearest)
        assert_allclose(found["fastest_frequency"][k], found["fastest_order"][k] * speed / TURN)


@pytest.mark.parametrize("lost", ["nothing grows", "no steady running"])
def test_no_fastest_order_without_growth(lost):
    if lost == "nothing grows":
        found = growing_orders(maps(lambda frequency: -frequency), RADIUS)
    else:
        found = growing_orders(maps(hill(60.0), status="wheel_lifted"), RADIUS)
    assert np.isnan(found["fastest_order"]).all()
    assert not found["order_grows"].any()
    assert not found["order_fast"].any()


def test_fastest_order_lies_in_the_band_of_design():
    order = np.arange(1.0, 60.0)
    frequency = 2.0 * order
    tendency = np.array([hill(55.0)(frequency), hill(90.0)(frequency), np.full(59, np.nan)])
    band = {"min": 45.0, "max": 65.0}
    assert_array_equal(fastest_order(order, frequency, tendency, band), [27.0, 32.0, np.nan])
    beyond = {"min": 500.0, "max": 600.0}
    assert_array_equal(fastest_order(order, frequency, tendency, beyond), [27.0, 45.0, np.nan])


def test_best_design_is_the_bottom_of_a_bowl():
    c_T, d_T = np.linspace(1.0, 9.0, 9), np.linspace(10.0, 50.0, 5)
    bowl = (c_T[None, :] - 6.0) ** 2 + ((d_T[:, None] - 20.0) / 10.0) ** 2 + 0.25
    bowl[0, 0] = np.nan
    assert best_design(bowl, c_T, d_T) == (6.0, 20.0, 0.25)
    assert np.isnan(best_design(np.full_like(bowl, np.nan), c_T, d_T)).all()


def tuning(cases: int = 101) -> dict[str, np.ndarray]:
    """Cases 1, 2, ... drawn after the configured one, with factors 0.00, 0.01, ... in disorder."""
    order = np.random.default_rng(3).permutation(cases)
    factor = np.full((2, cases + 1, 2, 1), np.nan)
    factor[1, 1:, 0, 0], factor[1, 1:, 1, 0] = order / 100.0, 0.3
    load = np.full((2, cases + 1), np.nan)
    load[1] = np.arange(cases + 1.0)
    growth = np.where(np.arange(cases + 1) < 27, 1.0, -1.0)
    return {
        "varied": np.array(["none", *["all"] * cases]),
        "case_status": np.array(["converged"] * cases + ["wheel_lifted"]),
        "counted": np.arange(cases + 1) < 50,
        "growth_rate": np.tile(growth[:, None], (2, 1, 2)),
        "peak_factor": factor,
        **dict.fromkeys(LOADS, load),
        "added_mass": np.array([np.nan, 25.0]),
        "unsprung_mass": np.array(1000.0),
    }


def test_spread_counts_the_cases():
    found = spread(tuning(), ("converged", "wheel_lifted", "not_finite"))
    assert found["outcome_cases"].tolist() == [101, 1, 0]
    assert (found["sampled_cases"], found["sampled_steady_cases"]) == (101, 100)
    assert (found["counted_cases"], found["uncounted_cases"]) == (50, 51)
    assert_allclose(found["self_excited_share"], 0.26)  # 26 of the drawn ones that run
    assert_allclose(found["added_axle_mass"][1], 50.0)
    assert_allclose(found["added_axle_share"][1], 0.05)


def test_spread_of_even_factors_is_their_share():
    found = spread(tuning(), ("converged",))
    assert_allclose(found["peak_factor_quantile"][1, 0, 0], QUANTILES)
    assert_allclose(found["peak_factor_quantile"][1, 1, 0], 0.3)
    assert_allclose(found["worse_peak_factor_quantile"][1, 0], np.maximum(QUANTILES, 0.3))
    assert np.isnan(found["peak_factor_quantile"][0]).all()


def test_worst_load_is_that_of_the_cases_that_count():
    found = spread(tuning(), ("converged",))
    for name in LOADS:
        assert_array_equal(found[f"worst_{name}"], [np.nan, 49.0])
