"""Which places of the bogie each wheel has on a route: symmetry of the vehicle decides."""

import itertools

import numpy as np
import pytest

from tramdva.route.alignment import plan_of_route
from tramdva.route.classes import OWN_WHEELS, cases_of, classes_of, lap_length, places_of_wheels
from tramdva.route.parameters import RouteSection


def section(turn="left", radius=25.0, length=40.0, **more) -> RouteSection:
    given = {"name": "x", "length_m": length, "turn": turn, "speed_km_h": 14.4}
    if turn != "straight":
        given["radius_m"] = radius
    return RouteSection.model_validate(given | more)


def exposure(sections, way, ends) -> np.ndarray:
    """Share of the distance (wheel, class, place) of each wheel in each place of each class."""
    classes, passages = classes_of(sections, way, ends)
    out = np.zeros((4, len(classes), 4))
    for case in cases_of(passages):
        for wheel, place in enumerate(case.places):
            out[wheel, case.running, place] += case.share
    return out


def test_in_a_left_curve_the_right_wheels_are_outside():
    wheels = dict(zip(OWN_WHEELS, places_of_wheels("left", "A"), strict=True))
    assert wheels == {"front_left": 1, "front_right": 0, "rear_left": 3, "rear_right": 2}


@pytest.mark.parametrize(("turn", "leading"), list(itertools.product(("left", "right"), "AB")))
def test_every_wheel_has_a_place_of_its_own(turn, leading):
    assert sorted(places_of_wheels(turn, leading)) == [0, 1, 2, 3]


def test_turning_the_tram_round_is_turning_it_twice_back():
    """A tram turned round has its left wheels where the right ones were, at the other end."""
    for turn in ("left", "right"):
        there, back = places_of_wheels(turn, "A"), places_of_wheels(turn, "B")
        assert [there[3 - k] for k in range(4)] == back


@pytest.mark.parametrize(("way", "ends"), [("lap", "loop"), ("there_and_back", "reverse")])
def test_a_mirrored_route_swaps_left_and_right_wheels(way, ends):
    sections = [section("left"), section("right", 50.0), section("straight")]
    mirrored = [section("right"), section("left", 50.0), section("straight")]
    found, other = exposure(sections, way, ends), exposure(mirrored, way, ends)
    curves = [0, 1]  # on straight track left and right are alike, whatever they are called
    np.testing.assert_allclose(found[:, curves], other[[1, 0, 3, 2]][:, curves])


def test_there_and_back_with_a_loop_evens_out_the_sides():
    found = exposure([section("left"), section("right", 40.0)], "there_and_back", "loop")
    np.testing.assert_allclose(found[[0, 2]], found[[1, 3]])


def test_reversing_at_the_ends_evens_out_the_axles_only():
    """The same side is outside on both ways, while the axle that leads changes."""
    found = exposure([section("left")], "there_and_back", "reverse")
    np.testing.assert_allclose(found[[0, 1]], found[[2, 3]])
    assert not np.allclose(found[0], found[1])


def test_splitting_and_reordering_sections_changes_nothing():
    whole = [section("left", length=60.0), section("straight", length=500.0)]
    parts = [section("left", length=20.0), section("straight", length=500.0),
             section("left", length=40.0)]  # fmt: skip
    np.testing.assert_allclose(exposure(whole, "lap", "loop"), exposure(parts, "lap", "loop"))
    shuffled = exposure(whole[::-1], "lap", "loop")[:, ::-1]
    np.testing.assert_allclose(exposure(whole, "lap", "loop"), shuffled)


def test_length_of_a_lap_counts_passages_and_both_ways():
    sections = [section("left", transition_m=10.0), section("straight", passages_per_lap=2)]
    _, passages = classes_of(sections, "there_and_back", "reverse")
    assert lap_length(passages) == pytest.approx(2 * (50.0 + 80.0))


def test_plan_of_a_circle_closes_and_a_clothoid_turns_by_half_its_length_over_the_radius():
    x, y, _ = plan_of_route([section("left", 30.0, length=2.0 * np.pi * 30.0)])
    np.testing.assert_allclose([x[-1], y[-1]], 0.0, atol=1e-9)
    np.testing.assert_allclose(np.ptp(y), 60.0, rtol=1e-2)
    x, y, _ = plan_of_route([section("right", 100.0, length=1e-9 + 0.1, transition_m=40.0)])
    heading = np.arctan2(y[-1] - y[-2], x[-1] - x[-2])
    assert heading == pytest.approx(-(40.0 + 0.1) / 100.0, abs=0.01)
