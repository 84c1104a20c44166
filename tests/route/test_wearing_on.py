"""Wearing on: closed forms of amplitude equations, halved steps, invariance, harmonics."""

import numpy as np
import pytest
from wearing_wheels import ORDERS, wheel_of

from tramdva.route import wearing_on
from tramdva.route.nonlinear import Revolution
from tramdva.route.wearing_on import Bounds, own_rates, step_at, wear_on, worn_on
from tramdva.wear.chart import CONSTANT

FEW = np.array([10.0, 20.0, 26.0])
SMALL = np.array([-0.01 + 0.03j, 0.02 - 0.05j, -0.001 + 0.1j])
INITIAL = np.array([1e-6, 2e-6 * np.exp(1j), 1e-6j])
FREE = Bounds(horizon=1000.0, limit=1.0, tolerance=1e-3, most_steps=1000)


def stuart_landau(amplitude):
    """Order 10 saturates at 20 um and drives order 20 by its square; order 26 is linear."""
    size = np.abs(amplitude[0]) / 2e-5
    depth = SMALL * amplitude
    depth[0] += (0.01 + 0.02j) * size**2 * amplitude[0]
    depth[1] -= 1e3 * amplitude[0] ** 2
    return Revolution(depth, 1e-9, 0.0, "periodic")


def landau(u):
    """Amplitude of order 10 in closed form: a logistic in its square, and the phase from it."""
    square = 1.0 / (1.0 + (20.0**2 - 1.0) * np.exp(-0.02 * u))
    # The integral of the square over u, for the drift by 0.02 of it.
    integral = np.log((np.exp(0.02 * u) + 399.0) / 400.0) / 0.02
    return 2e-5 * np.sqrt(square) * np.exp(-1j * (0.03 * u + 0.02 * integral))


def test_growth_saturation_and_drift_have_their_closed_form():
    run = worn_on(stuart_landau, FEW, INITIAL, SMALL, FREE._replace(horizon=800.0))
    u = np.linspace(0.0, run.end, 50)
    found = run.at(u)
    np.testing.assert_allclose(np.abs(found[:, 0]), np.abs(landau(u)), rtol=3e-3)
    np.testing.assert_allclose(np.angle(found[:, 0] / landau(u)), 0.0, atol=2e-2)
    np.testing.assert_allclose(found[:, 2], INITIAL[2] * np.exp(-SMALL[2] * u), rtol=1e-6)


def test_an_order_that_only_decays_costs_no_steps_and_is_exact():
    run = worn_on(
        lambda a: Revolution(SMALL * a, 0.0, 0.0, "periodic"), FEW, INITIAL, SMALL,
        FREE._replace(horizon=200.0),
    )  # fmt: skip
    np.testing.assert_allclose(run.steps[-1].amplitude, INITIAL * np.exp(-SMALL * 200.0), rtol=1e-9)
    assert len(run.steps) < 12
    middle = run.at(np.array([77.7]))[0]
    np.testing.assert_allclose(middle, INITIAL * np.exp(-SMALL * 77.7), rtol=1e-9)


def test_halved_steps_leave_the_levels(monkeypatch):
    """The pair is of third order: half of the step leaves an eighth of the error."""
    exact, errors = landau(np.array([400.0]))[0], []
    for most in (20.0, 10.0, 5.0):
        monkeypatch.setattr(wearing_on, "LONGEST", 0.01 * most)
        monkeypatch.setattr(wearing_on, "FIRST", most * np.abs(SMALL).max())
        free = FREE._replace(horizon=400.0, tolerance=1e9)
        run = worn_on(stuart_landau, FEW, INITIAL, SMALL, free)
        errors.append(abs(np.abs(run.steps[-1].amplitude[0]) / abs(exact) - 1.0))
    assert 20.0 * np.log10(1.0 + errors[0]) < 0.1
    assert errors[2] < errors[1] / 5.0 < errors[0] / 25.0


def test_harmonics_are_told_from_orders_that_grow():
    run = worn_on(stuart_landau, FEW, INITIAL, SMALL, FREE._replace(horizon=400.0))
    now = step_at(stuart_landau, run, 350.0, SMALL)
    total, own = own_rates(stuart_landau, now, np.array([0, 1]))
    assert total[0] == pytest.approx(own[0])
    assert own[1] == pytest.approx(-SMALL[1])  # it decays by itself
    assert total[1].real > own[1].real + 0.01  # what it gains is its neighbour's
    assert np.isnan(total[2])


def test_a_run_ends_where_it_saturates_at_a_limit_and_where_nothing_runs_steadily():
    def alone(amplitude):
        return stuart_landau(np.append(amplitude, [0.0, 0.0]))._replace(
            depth=stuart_landau(np.append(amplitude, [0.0, 0.0])).depth[:1]
        )

    one = (FEW[:1], INITIAL[:1], SMALL[:1])
    saturated = worn_on(alone, *one, FREE._replace(horizon=1e5))
    assert saturated.status == "saturated"
    assert abs(saturated.steps[-1].amplitude[0]) == pytest.approx(2e-5, rel=0.03)
    limited = worn_on(alone, *one, FREE._replace(limit=2e-5))
    assert limited.status == "limit_reached"
    at = limited.reaches(2e-5)  # 10 um of amplitude: a logistic of 1/4
    assert at == pytest.approx(np.log(399.0 / 3.0) / 0.02, rel=3e-3)

    def shaking(amplitude):
        if abs(amplitude[0]) > 1e-5:
            return Revolution(np.full(1, np.nan + 0j), np.nan, np.nan, "not_periodic")
        return alone(amplitude)

    ended = worn_on(shaking, *one, FREE)
    assert ended.status == "not_periodic"
    assert 0.8e-5 < abs(ended.steps[-1].amplitude[0]) <= 1e-5
    assert worn_on(alone, *one, FREE._replace(most_steps=3)).status == "step_limit"


def test_mileage_times_coefficient_is_what_counts(middle, laws):
    """Twice the constant coefficient: the same profile after half of the revolutions."""
    ends = []
    wave = np.zeros(68, complex)
    wave[[25, 33, 55]] = 4e-6, 1e-6, 2e-6j
    for factor in (1.0, 2.0):
        coefficient = factor * laws[0].chart.coefficient_constant
        running, small = wheel_of(middle, laws[0], 0, CONSTANT, coefficient_constant=coefficient)
        bounds = Bounds(200.0 / factor, 1.0, 2e-2, 40)
        ends.append(wear_on(running, ORDERS, wave, small, bounds))
    assert [one.status for one in ends] == ["horizon", "horizon"]
    once, twice = (one.steps[-1].amplitude for one in ends)
    np.testing.assert_allclose(twice, once, atol=2e-3 * np.abs(once).max())
    lost = [one.mean_depth(np.array([one.end]))[0] for one in ends]
    assert lost[1] == pytest.approx(lost[0], rel=1e-3)
