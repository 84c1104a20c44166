"""Wear of a wheel by its own waves: two ways to the same number, filter, absorbers."""

import numpy as np
import pytest
from scipy.integrate import quad

from tramdva.bogie.names import WHEELS
from tramdva.evolution.tendency import linear_wear_response, order_of_frequency
from tramdva.route.any_absorber import class_ports
from tramdva.route.own_response import own_response, patch_filter
from tramdva.route.response import at_mean_speed
from tramdva.route.speeds import speed_points


@pytest.mark.parametrize("wheel", range(4))
def test_sum_over_modes_is_the_response_of_figure_10_to_waves_on_this_wheel_alone(
    line, middle, wheel
):
    bogie, wears = middle.node.bogie["none"], middle.node.wear["none"]
    frequency = np.linspace(5.0, 150.0, 60)
    speed, radius = line.track.speed, line.bogie.wheel.radius
    order = order_of_frequency(frequency, speed, radius)
    spin = speed / radius  # as figure 10 turns all wheels
    found = own_response(bogie, wears, wheel, spin).at(
        order, 2.0 * np.pi * frequency, point_contact=True
    )
    for law, wear in enumerate(wears):
        wanted = linear_wear_response(bogie, wear, frequency, speed, radius, (WHEELS[wheel],))
        np.testing.assert_allclose(found[law], wanted[:, wheel], rtol=1e-9, atol=1e-14)


def test_a_wheel_on_root_and_flank_has_the_phases_of_both(line, laws):
    """At 20 m the front outer wheel has two contacts, one ahead of the other."""
    from tramdva.route.classes import RunningClass

    sharp = at_mean_speed(
        line, RunningClass(1.0 / 20.0, 0.0, 3.6, 0.0, np.nan, 1.0), {"none": None}, laws[1:]
    )
    bogie, (wear,) = sharp.node.bogie["none"], sharp.node.wear["none"]
    assert bogie.touching[0].sum() == 2
    frequency = np.array([30.0, 55.0, 120.0])
    radius = line.bogie.wheel.radius
    order = order_of_frequency(frequency, 3.6, radius)
    own = own_response(bogie, [wear], 0, 3.6 / radius)
    assert np.abs(own.turn).max() > 1e-3
    wanted = linear_wear_response(bogie, wear, frequency, 3.6, radius, WHEELS[:1])[:, 0]
    found = own.at(order, 2.0 * np.pi * frequency, point_contact=True)[0]
    np.testing.assert_allclose(found, wanted, rtol=1e-9)


@pytest.mark.parametrize("u", [1e-3, 0.3, 1.0, 2.5])
def test_filter_is_the_mean_of_a_wave_under_the_pressure_of_an_ellipse(u):
    """The pressure sqrt(1 - x^2 - y^2), summed across the patch, weights the wave cos(u x)."""

    def across(x: float) -> float:
        edge = np.sqrt(1.0 - x * x)
        return quad(lambda y: np.sqrt(max(edge * edge - y * y, 0.0)), -edge, edge)[0]

    wave = quad(lambda x: across(x) * np.cos(u * x), -1.0, 1.0)[0]
    assert patch_filter(np.array(u)) == pytest.approx(wave / quad(across, -1, 1)[0], rel=1e-6)


def test_absorbers_by_their_places_are_absorbers_in_the_vehicle(line, middle, absorber):
    """A force at the places, or further coordinates of the vehicle: the same growth."""
    orders, points = np.arange(3.0, 68.0, 4.0), speed_points(0.05, 8)
    turns = points.share[:, None] * middle.node.spin
    revolutions = np.tile(points.weight, (4, 1))
    of_class = class_ports(
        middle.known.system, middle.known.equilibrium, middle.node.bogie["none"],
        middle.node.wear["none"][0], turns, orders, revolutions, absorber, 0.7,
    )  # fmt: skip
    for name, design in (("none", (np.nan, np.nan)), ("paper", (absorber.c_T, absorber.d_T))):
        found = of_class.growth(absorber.I_T, *design)
        bogie, wears = middle.node.bogie[name], middle.node.wear[name][:1]
        for wheel in range(4):
            own = own_response(bogie, wears, wheel, float(middle.node.spin[wheel]))
            answer = own.at(orders[:, None], orders[:, None] * turns[None, :, wheel])
            wanted = -answer[0].real @ points.weight
            np.testing.assert_allclose(found[wheel], wanted, rtol=1e-7, atol=1e-12)
        oscillating = bogie.eigenvalue[np.abs(bogie.eigenvalue.imag) > 2.0 * np.pi * 5.0]
        slow = oscillating[np.abs(oscillating.imag) < 2.0 * np.pi * 200.0]
        rate = of_class.rate(absorber.I_T, *design, 0)
        assert rate == pytest.approx(slow.real.max(), abs=1e-3)
