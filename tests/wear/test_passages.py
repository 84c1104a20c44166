"""Wear of histories, its derivative, and its orders around the wheel."""

import numpy as np
import pytest
from scipy.special import jv
from wear_charts import chart_with

from tramdva.contact import fastsim, patch
from tramdva.wear.chart import WearChart, _share_above
from tramdva.wear.gradient import worn_area_gradient
from tramdva.wear.laws import LAWS
from tramdva.wear.passages import ContactHistory, depth_around, passages, wear_orders

LAW = patch.contact_law(0.35, 0.36, 0.4)
SPEED = 4.0
# A flange root that slides at 0.2 m/s, with spin: the chart's step cuts through the patch.
STATE = np.array([4.5e-3, 3e-3, 36e3, 0.3, 0.01, 0.048, -1.2])


def area_of(state: np.ndarray, cells: int, chart: WearChart, speed: float = SPEED) -> float:
    history = ContactHistory(*(np.array([value]) for value in state))
    grid = fastsim.patch_grid(cells, cells)
    return float(passages(history, LAW.kalker_table, LAW.shear_modulus, grid, speed, chart).area[0])


@pytest.mark.parametrize("method", LAWS)
@pytest.mark.parametrize("speed", [4.0, 9.0, 17.0])
def test_the_complex_step_gives_the_same_wear_and_the_derivative(method, speed):
    chart = chart_with(method=method)
    grid = fastsim.patch_grid(13, 13)
    value, gradient = worn_area_gradient(
        STATE, LAW.kalker_table, LAW.shear_modulus, grid, speed, chart
    )
    np.testing.assert_allclose(value, area_of(STATE, 13, chart, speed), rtol=1e-12)
    step = 1e-6 * np.abs(STATE)
    for k in range(STATE.size):
        up, down = STATE.copy(), STATE.copy()
        up[k], down[k] = up[k] + step[k], down[k] - step[k]
        difference = area_of(up, 13, chart, speed) - area_of(down, 13, chart, speed)
        scale = value / abs(STATE[k])
        np.testing.assert_allclose(
            gradient[k] / scale, difference / (2.0 * step[k]) / scale, atol=2e-5
        )


def test_derivative_in_seizure_pressure():
    chart = chart_with(hardness=8e8)  # peak pressure 1.27 GPa: the middle seizes
    value, gradient = worn_area_gradient(
        STATE, LAW.kalker_table, LAW.shear_modulus, fastsim.patch_grid(16, 16), SPEED, chart
    )
    up, down = STATE.copy(), STATE.copy()
    up[2], down[2] = 1.00001 * up[2], 0.99999 * down[2]
    difference = (area_of(up, 16, chart) - area_of(down, 16, chart)) / (up[2] - down[2])
    np.testing.assert_allclose(gradient[2], difference, rtol=1e-3)
    assert gradient[2] * STATE[2] / value > 1.2  # more than in proportion: the core grows


def test_the_share_of_a_cell_above_a_limit_is_that_of_a_linear_field():
    u = (np.arange(2000) + 0.5) / 2000 - 0.5
    for along, across in ((1.0, 0.4), (0.2, 0.9), (0.7, 0.0)):
        for excess in (-0.6, -0.2, 0.0, 0.1, 0.55):
            field = excess + along * u[:, None] + across * u[None, :]
            share = _share_above(excess, along, across)
            np.testing.assert_allclose(share, np.mean(field > 0.0), atol=2e-3)


def test_wear_has_no_stairs_in_the_slip():
    """The slope of the wear over the slip, which a sharp step per cell would make 0 or endless."""
    chart = chart_with()
    slopes = []
    for cells in (12, 24, 48):
        creepages = np.linspace(0.047, 0.053, 61)
        states = [np.concatenate([STATE[:5], [c], STATE[6:]]) for c in creepages]
        areas = np.array([area_of(state, cells, chart) for state in states])
        slopes.append(np.diff(areas) / np.diff(creepages) * 0.05 / areas[:-1])
    assert slopes[1].min() > 3.0
    np.testing.assert_allclose(slopes[1], slopes[2], rtol=0.06)
    np.testing.assert_allclose(slopes[0], slopes[2], rtol=0.12)


def test_full_sliding_wears_by_load_times_slip():
    """Archard's law by hand: k N s / H, where every cell slides at the same velocity."""
    chart = chart_with(method="constant")
    state = np.array([4e-3, 4e-3, 35e3, 0.3, 0.0, 0.04, 0.0])
    expected = chart.coefficient_constant * 35e3 * 0.04 / chart.hardness
    # The slip loses what adhesion at the leading edge takes.
    np.testing.assert_allclose(area_of(state, 40, chart), expected, rtol=0.05)
    slower = area_of(np.array([4e-3, 4e-3, 35e3, 0.3, 0.0, 0.4, 0.0]), 40, chart)
    np.testing.assert_allclose(slower, 10.0 * expected, rtol=0.006)


def test_apart_there_is_no_wear():
    history = ContactHistory(*np.vstack([STATE, STATE]).T)
    history.normal_force[1] = 0.0
    found = passages(
        history,
        LAW.kalker_table,
        LAW.shear_modulus,
        fastsim.patch_grid(8, 8),
        SPEED,
        chart_with(),
    )
    assert found.area[0] > 0.0
    assert found.area[1] == 0.0
    np.testing.assert_allclose(found.shares.sum(axis=1), [1.0, 0.0])


def test_a_contact_that_moves_spreads_its_wear_and_loses_nothing():
    """Constant wear, angle theta + e sin(n theta): Bessel's functions of whole orders."""
    theta = 2.0 * np.pi * np.arange(2048) / 2048
    order, swing = 6, 0.05
    found = wear_orders(np.full(2048, 3e-9), theta + swing * np.sin(order * theta), 30)
    np.testing.assert_allclose(found[0], 3e-9)
    for multiple in (1, 2, 3):
        expected = 2.0 * 3e-9 * jv(-multiple, multiple * order * swing)
        np.testing.assert_allclose(found[multiple * order], expected, rtol=1e-9)


def test_wear_of_several_revolutions_is_averaged():
    theta = 2.0 * np.pi * np.arange(3 * 256) / 256
    area = 1e-9 * (2.0 + np.cos(5.0 * theta + 0.4) + 0.3 * np.cos(theta / 3.0))
    found = wear_orders(area, theta, 8)
    np.testing.assert_allclose(found[[0, 5]], [2e-9, 1e-9 * np.exp(0.4j)], atol=1e-20)
    depth = depth_around(found, np.array([0.0, 1.0]))
    np.testing.assert_allclose(depth, 1e-9 * (2.0 + np.cos([0.4, 5.4])), rtol=1e-9)
