"""The laws of wear: balances of energy, limits, and derivatives against differences."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError
from wear_charts import chart_with

from tramdva.contact import complex_step, fastsim, kalker, traction_field
from tramdva.wear.chart import wear_coefficient
from tramdva.wear.energy import energy_wear_rate
from tramdva.wear.gradient import worn_area_gradient
from tramdva.wear.laws import LAWS, with_method
from tramdva.wear.passages import AREAS, ContactHistory, passage_depth, passages

TABLE, SHEAR_MODULUS, SPEED = kalker.kalker_table(0.28), 8.2e10, 4.0
# Semi-axes, load, friction, creepages, spin: tread, flange root, long flank, hardly sliding.
CONTACTS = np.array(
    [
        [5.0e-3, 4.0e-3, 40e3, 0.30, 0.004, 0.030, 0.4],
        [4.5e-3, 3.0e-3, 36e3, 0.30, 0.010, 0.048, -1.2],
        [7.5e-3, 1.7e-3, 43e3, 0.25, -0.030, 0.050, 6.0],
        [4.0e-3, 4.0e-3, 35e3, 0.35, 0.0004, 0.0009, 0.1],
    ]
)
# The rate of the mild regime, whatever the work.
ONLY_MILD = {"method": "energy", "energy_severe": 50.0, "energy_limit": 1e10}


def area_of(contact, chart, cells=20, speed=SPEED):
    history = ContactHistory(*np.reshape(contact, (7, 1)))
    grid = fastsim.patch_grid(cells, cells)
    return passages(history, TABLE, SHEAR_MODULUS, grid, speed, chart).area[0]


def power(contact, cells=20):
    """Friction power over speed in N by the creep forces, which know nothing of cells' slip."""
    grid = fastsim.patch_grid(cells, cells)
    flexibility = kalker.flexibilities(TABLE, contact[0], contact[1], SHEAR_MODULUS)
    forces = fastsim.fastsim_forces(*contact, flexibility, grid, fastsim.workspace(grid))
    return -np.dot(forces, contact[4:])


@pytest.mark.parametrize("contact", CONTACTS)
@pytest.mark.parametrize("cells", [8, 20, 40])
def test_in_the_mild_regime_the_mass_worn_is_in_proportion_to_the_friction_power(contact, cells):
    chart = chart_with(**ONLY_MILD)
    mass = chart.density * area_of(contact, chart, cells)  # per metre of rail
    assert_allclose(mass, 5.3e-9 * power(contact, cells), rtol=1e-12)


@pytest.mark.parametrize(
    ("work", "rate"), [(5.0, 26.5), (20.0, 55.0), (77.2, 55.0), (100.0, 1466.32)]
)
def test_rates_as_printed(work, rate):
    """N/mm^2 and ug per m and mm^2: of a wheel of 7800 kg/m^3 in metres per metre."""
    per_metre = rate * 1e-9 / 1e-6 / 7800.0
    assert_allclose(
        energy_wear_rate(work * 1e6, chart_with(method="energy")), per_metre, rtol=1e-12
    )


def test_the_regimes_join_without_a_jump():
    chart = chart_with(method="energy")
    work = np.linspace(0.0, 120e6, 24001)
    rate = np.array([energy_wear_rate(w, chart) for w in work])
    assert np.all(np.diff(rate) >= 0.0)
    assert np.diff(rate).max() < 1.001 * 61.9e-9 * 5e3 / 7800.0


def test_where_every_cell_is_severe_only_the_area_of_the_patch_counts():
    chart = chart_with(method="energy", energy_limit=1e10)
    contact = np.array([5e-3, 3e-3, 40e3, 0.3, 0.0, 0.0, 0.0])
    for creepage, rtol in ((1.0, 0.03), (10.0, 3e-3)):  # the rim stays below the plateau
        contact[5] = creepage
        whole = chart.energy_severe / chart.density * np.pi * 5e-3 * 3e-3
        assert_allclose(area_of(contact, chart, 40), whole, rtol=rtol)


def test_far_in_the_catastrophic_regime_more_power_wears_at_its_slope():
    chart = chart_with(method="energy")
    slow, fast = (np.array([5e-3, 3e-3, 40e3, 0.3, 0.0, nu, 0.0]) for nu in (50.0, 60.0))
    more = area_of(fast, chart, 40) - area_of(slow, chart, 40)
    expected = 61.9e-9 * (power(fast, 40) - power(slow, 40)) / chart.density
    assert_allclose(more, expected, rtol=2e-3)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("contact", CONTACTS)
def test_what_the_strips_lose_is_what_the_passage_removes(law, contact):
    chart, grid = chart_with(method=law), fastsim.patch_grid(16, 14)
    field = traction_field.empty_field(grid)
    flexibility = kalker.flexibilities(TABLE, contact[0], contact[1], SHEAR_MODULUS)
    traction_field.traction_field(*contact, flexibility, grid, field)
    depth, slip = np.zeros(grid.offset.size), np.zeros(field.area.shape)
    area = passage_depth(field, SPEED, chart, slip, depth, np.zeros(len(AREAS)))
    assert area > 0.0
    assert_allclose(contact[1] * grid.strip_weight @ depth, area, rtol=1e-12)


@pytest.mark.parametrize("law", ["constant", "energy"])
def test_these_laws_do_not_know_the_speed(law):
    slow, fast = (area_of(CONTACTS[1], chart_with(method=law), speed=v) for v in (1.0, 15.0))
    assert_allclose(slow, fast, rtol=1e-13)


def test_a_negative_rolling_speed_wears_as_a_positive_one():
    for law in LAWS:
        there, back = (area_of(CONTACTS[1], chart_with(method=law), speed=v) for v in (4.0, -4.0))
        assert there == back


def test_narrow_smooth_steps_are_the_chart_away_from_its_steps():
    sharp = chart_with(method="chart")
    for width in (1e-1, 1e-2, 1e-3):
        smooth = chart_with(method="smoothed", velocity_width=width, pressure_width_share=width)
        for velocity in np.linspace(0.0, 1.2, 61):
            for pressure in np.linspace(0.2e9, 2.6e9, 25):
                near = min(abs(velocity - 0.2), abs(velocity - 0.7)) < width
                near = near or abs(pressure / 2.7e9 - 0.8) < width
                if not near:
                    k = wear_coefficient(pressure, velocity, smooth)
                    assert_allclose(k, wear_coefficient(pressure, velocity, sharp), rtol=1e-12)


def test_narrow_smooth_steps_wear_a_patch_as_the_chart():
    """The cell average of the sharp steps and steps narrower than it: two ways to one limit."""
    for contact in CONTACTS[:3]:
        smooth = chart_with(method="smoothed", velocity_width=4e-3, pressure_width_share=4e-3)
        sharp = area_of(contact, chart_with(method="chart"), 120)
        assert_allclose(area_of(contact, smooth, 120), sharp, rtol=0.02)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("contact", CONTACTS)
def test_derivatives_are_those_of_differences_extrapolated_to_none(law, contact):
    """Central differences at h and h / 2, Richardson: their error falls with h^4."""
    chart, grid = chart_with(method=law), fastsim.patch_grid(12, 12)
    value, gradient = worn_area_gradient(contact, TABLE, SHEAR_MODULUS, grid, SPEED, chart)
    assert_allclose(value, area_of(contact, chart, 12), rtol=1e-13)
    for k in range(7):
        found = []
        for part in (2e-5, 1e-5):
            up, down = contact.copy(), contact.copy()
            up[k], down[k] = up[k] * (1.0 + part), down[k] * (1.0 - part)
            difference = area_of(up, chart, 12) - area_of(down, chart, 12)
            found.append(difference / (up[k] - down[k]))
        expected = (4.0 * found[1] - found[0]) / 3.0
        assert abs(gradient[k] - expected) * abs(contact[k]) < 2e-6 * value


def test_the_derivative_of_a_kalker_flexibility_ends_with_its_table():
    step = complex_step.STEP
    for a, b in ((5e-3, 3e-3), (1e-3, 6e-3), (0.5, 1e-3)):
        moved = kalker.complex_flexibilities(
            TABLE, complex(a, step), complex(b, 0.0), SHEAR_MODULUS
        )
        around = [kalker.flexibilities(TABLE, a * f, b, SHEAR_MODULUS) for f in (1.00001, 0.99999)]
        slope = (np.array(around[0]) - around[1]) / (2e-5 * a)
        assert_allclose(np.imag(moved) / step, slope, rtol=1e-7)
        assert_allclose(
            np.real(moved), kalker.flexibilities(TABLE, a, b, SHEAR_MODULUS), rtol=1e-14
        )


def test_apart_there_is_neither_wear_nor_a_derivative():
    apart = CONTACTS[0].copy()
    apart[2] = 0.0
    grid = fastsim.patch_grid(8, 8)
    value, gradient = worn_area_gradient(apart, TABLE, SHEAR_MODULUS, grid, SPEED, chart_with())
    assert value == 0.0
    assert not gradient.any()


def test_one_contact_under_every_law():
    chart = chart_with()
    assert len({with_method(chart, law).method for law in LAWS}) == len(LAWS)
    for law in LAWS:
        other = chart_with(method=law)
        assert area_of(CONTACTS[0], with_method(chart, law)) == area_of(CONTACTS[0], other)
    with pytest.raises(ValueError, match="allowed: chart, smoothed, constant, energy"):
        with_method(chart, "linear")


@pytest.mark.parametrize(
    "change", [{"energy_severe": 0.5}, {"density": 0.0}, {"energy_mild": -1.0}]
)
def test_impossible_regimes_are_refused(change):
    with pytest.raises(ValidationError):
        chart_with(**change)
