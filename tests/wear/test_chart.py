"""KTH wear: Archard's limits, the chart, linearity, shares."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError
from wear_charts import chart_with

from tramdva.contact import fastsim, kalker, traction_field
from tramdva.wear.chart import wear_coefficient
from tramdva.wear.passages import AREAS, passage_depth

FLEXIBILITY = kalker.kalker_table(0.28)


def patch(load=35e3, creepages=(0.0, 0.04, 0.0), a=4e-3, b=4e-3, cells=20, friction=0.35):
    grid = fastsim.patch_grid(cells, cells)
    field = traction_field.empty_field(grid)
    flexibility = kalker.flexibilities(FLEXIBILITY, a, b, 82e9)
    traction_field.traction_field(a, b, load, friction, *creepages, flexibility, grid, field)
    return field


def depth(field, speed=4.0, **changes):
    chart = chart_with(**changes)
    strips = np.zeros(field.area.shape[1])
    slip = np.empty(field.area.shape)
    area = passage_depth(field, speed, chart, slip, strips, np.zeros(len(AREAS)))
    return strips, area


def region_shares(field, speed, chart):
    """Share of the patch in each region of the chart and in adhesion."""
    areas, strips = np.zeros(len(AREAS)), np.zeros(field.area.shape[1])
    passage_depth(field, speed, chart, np.empty(field.area.shape), strips, areas)
    return dict(zip(AREAS, areas / field.area.sum(), strict=True))


def test_full_sliding_is_archards_law():
    """Sliding distance 2 a |nu| under Hertz pressure: worn section k N |nu| / H."""
    load, creepage, k, hardness = 35e3, 10.0, 5e-4, 2.7e9
    field = patch(load, (0.0, creepage, 0.0))
    strips, area = depth(field, method="constant", coefficient_constant=k, hardness=hardness)
    assert_allclose(area, k * load * creepage / hardness, rtol=1e-3)
    peak = 1.5 * load / (np.pi * 16e-6)
    at = np.argmin(np.abs(field.position_y[0]) + (field.area[0] == 0))
    y = field.position_y[0, at] / 4e-3
    centre = k * peak * creepage * np.pi / 2 * 4e-3 * (1 - y**2) / hardness
    assert_allclose(strips[at], centre, rtol=1e-3)


def test_no_slip_no_wear():
    strips, area = depth(patch(creepages=(0.0, 0.0, 0.0)))
    assert area == 0.0
    assert_allclose(strips, 0.0, atol=0.0)


def test_wear_is_linear_in_load_at_a_given_patch_and_in_sliding_distance():
    full = {load: depth(patch(load, (0, 20.0, 0)), method="constant")[1] for load in (1e4, 2e4)}
    assert_allclose(full[2e4], 2 * full[1e4], rtol=1e-3)
    one, two = (depth(patch(35e3, (0, nu, 0)), method="constant")[1] for nu in (10.0, 20.0))
    assert_allclose(two, 2 * one, rtol=1e-3)
    # One passage does not depend on the speed as long as the region does not change.
    slow, fast = (depth(patch(), speed=v, method="constant")[1] for v in (1.0, 30.0))
    assert_allclose(slow, fast, rtol=1e-12)


def test_chart_regions_and_limits():
    chart = chart_with()
    p = 1e9
    for velocity, k in [(0.1, 5e-4), (0.19999, 5e-4), (0.2, 35e-4), (0.7, 35e-4), (0.70001, 5e-4)]:
        assert wear_coefficient(p, velocity, chart) == k
    for velocity in (0.1, 0.4, 2.0):
        assert wear_coefficient(0.8001 * 2.7e9, velocity, chart) == 350e-4


def test_smoothed_chart_is_continuous_and_meets_the_chart_away_from_the_limits():
    sharp, smooth = (chart_with(method=m) for m in ("chart", "smoothed"))
    for p, v in [(1e9, 0.1), (1e9, 0.45), (1e9, 1.5), (2.6e9, 0.3)]:
        assert_allclose(wear_coefficient(p, v, smooth), wear_coefficient(p, v, sharp), rtol=1e-12)
    assert_allclose(wear_coefficient(1e9, 0.2, smooth), 20e-4, rtol=1e-12)
    velocity = np.linspace(0.0, 1.0, 10001)
    k = np.array([wear_coefficient(1e9, v, smooth) for v in velocity])
    assert np.abs(np.diff(k)).max() < 1.6 * 30e-4 * 1e-4 / 0.1


def test_shares_of_the_patch_sum_to_one():
    chart = chart_with()
    inner = region_shares(patch(creepages=(0, 0.04, 0)), 4.0, chart)
    assert_allclose(sum(inner.values()), 1.0, rtol=1e-12)
    # 0.16 m/s, below the limit of 0.2 m/s except where traction is released at the edges.
    assert inner["mild"] > 0.97
    outer = region_shares(patch(43e3, (0, 0.053, 1.0), 5e-3, 4e-3), 4.0, chart)
    assert outer["severe"] > 0.5
    seizure = region_shares(patch(60e3, (0, 0.1, 0), 6e-3, 1e-3), 4.0, chart)
    assert seizure["seizure"] > 0.5
    stick = region_shares(patch(creepages=(0.0, 0.0, 0.0)), 4.0, chart)
    assert stick["adhesion"] == pytest.approx(1.0)


def test_the_steps_of_the_chart_leave_no_stairs_in_the_wear_of_a_patch():
    """Around 0.2 m/s, where single cells would jump sevenfold: coarse grids converge quickly."""
    creepage = np.linspace(0.045, 0.056, 56)

    def wear_areas(cells):
        return np.array([depth(patch(43e3, (0, nu, 2.0), cells=cells))[1] for nu in creepage])

    fine = wear_areas(96)
    errors = [np.abs(wear_areas(cells) / fine - 1.0).max() for cells in (12, 24, 48)]
    assert errors[0] < 0.05
    assert errors[1] < 0.5 * errors[0]
    assert errors[2] < 0.5 * errors[1]
    jumps = [np.abs(np.diff(wear_areas(cells))).max() for cells in (12, 96)]
    assert jumps[0] < 1.3 * jumps[1]


@pytest.mark.parametrize(
    "change",
    [{"method": "linear"}, {"hardness": -1.0}, {"coefficient_mild": float("nan")},
     {"velocity_low": 0.69}],
)  # fmt: skip
def test_bad_charts_are_refused(change):
    with pytest.raises(ValidationError):
        chart_with(**change)
