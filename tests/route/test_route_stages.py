"""The files of the route: what stands in one follows from the other."""

import numpy as np
import pytest


@pytest.fixture(scope="module")
def response(read):
    return read("route_response")


@pytest.fixture(scope="module")
def growth(read):
    return read("polygon_growth")


def test_growth_follows_from_responses_and_revolutions(response, growth):
    wanted = np.zeros_like(growth["growth_per_1000_km"])
    for law, scale in enumerate(response["wear_scale"]):
        for wheel in range(response["wheel"].size):
            turned = response["revolutions_per_1000_km"][:, :, wheel]
            answer = response["wear_response_real"][law, :, :, wheel]
            wanted[law, :, wheel] = -scale * np.einsum("cp,caop->ao", turned, answer)
    np.testing.assert_allclose(growth["growth_per_1000_km"], wanted, rtol=1e-9)


def test_revolutions_are_those_of_wheels_of_nearly_the_nominal_radius(response):
    """1000 km over the circumference of 0.3 m, whatever the conditions: within a few per cent."""
    total = response["revolutions_per_1000_km"].sum(axis=(0, 1))
    np.testing.assert_allclose(total, 1e6 / (2.0 * np.pi * 0.3), rtol=0.02)


def test_distances_add_up(response):
    assert response["distance_share"].sum() == pytest.approx(1.0)
    np.testing.assert_allclose(response["section_share"].sum(axis=0), response["distance_share"])


def test_shares_of_sections_add_up(growth):
    total = growth["section_share"].sum(axis=-1)
    known = np.isfinite(total)
    np.testing.assert_allclose(total[known], 1.0, rtol=1e-6)


def test_wear_of_tread_and_flange_is_what_was_measured(growth):
    """All laws are scaled to the same workshop: 0.25 mm of both in 10 000 km, mean of wheels."""
    wear = growth["mean_wear_per_10000_km"].mean(axis=1)
    np.testing.assert_allclose(wear, 0.25, rtol=1e-9)


def test_a_tram_that_reverses_wears_both_axles_alike(growth):
    rate = growth["growth_per_1000_km"]
    np.testing.assert_allclose(rate[:, :, :2], rate[:, :, 2:], rtol=1e-6, atol=1e-9)


def test_levels_start_at_the_turned_wheel_and_rise_as_the_growth(growth):
    level, start = growth["level"], growth["initial_level"]
    np.testing.assert_allclose(level[..., 0], np.broadcast_to(start, level[..., 0].shape))
    slope = (level[..., 1] - level[..., 0]) / growth["distance"][1] * 1000.0
    np.testing.assert_allclose(slope, 20.0 / np.log(10.0) * growth["growth_per_1000_km"], atol=1e-6)


def test_the_wheel_that_is_turned_has_the_height_of_the_limit(growth):
    height = np.ptp(growth["turned_profile"], axis=-1).max(axis=-1)
    reached = growth["turning_status"] == "reached"
    # At 1024 angles a crest of 68 waves may be missed by half a step: 1 - cos(pi/15).
    np.testing.assert_allclose(height[reached], float(growth["limit"]), rtol=0.022)
