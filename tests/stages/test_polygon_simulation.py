"""A wheel that wears on: the condition that is chosen, what the file says together, no answer."""

import numpy as np
import pytest

from tramdva.route.growth import peak_to_peak
from tramdva.stages.polygon_simulation import Wheel, _nothing, fastest_place
from tramdva.variables.polygon_simulation import VARIABLES


@pytest.fixture(scope="module")
def simulated(read):
    return read("polygon_simulation")


@pytest.fixture(scope="module")
def response(read):
    return read("route_response")


def made_up(**changes):
    """Two classes, one absorber, four wheels, three orders, two speeds; wheel 2 grows most."""
    answer = np.zeros((1, 2, 1, 4, 3, 2))
    answer[0, :, 0, 2, 1] = [[-1e-3, -2e-3], [-4e-3, -1e-3]]
    answer[0, 0, 0, 1, 0] = 5e-3
    return {
        "absorber": np.array(["none"]),
        "wear_response_real": answer,
        "revolutions_per_1000_km": np.ones((2, 2, 4)),
        "speed": np.array([[3.0, 4.0], [5.0, 6.0]]),
    } | changes


def test_the_condition_and_the_speed_that_add_most_are_chosen():
    assert fastest_place(made_up(), 0) == (1, 2, 5.0)


def test_speeds_count_by_their_share_of_the_passages():
    rare = np.ones((2, 2, 4))
    rare[1, 0] = 0.1
    assert fastest_place(made_up(revolutions_per_1000_km=rare), 0) == (0, 2, 4.0)


def test_a_class_without_steady_running_is_not_chosen():
    answer = made_up()["wear_response_real"]
    answer[:, 1, :, :, :, 0] = np.nan
    assert fastest_place(made_up(wear_response_real=answer), 0) == (0, 2, 4.0)


@pytest.mark.parametrize("status", ["no_equilibrium", "self_excited"])
def test_where_nothing_runs_steadily_the_file_says_why(status):
    numerics = {
        "orders": {"first": 1, "last": 9, "step": 1}, "points": 5, "described_orders": 2,
        "wave_amplitudes": [1e-6, 1e-5],
    }  # fmt: skip
    found = _nothing({"numerics": numerics}, Wheel(None, np.full(9, np.nan + 0j), status))
    assert found["status"] == status
    sizes = {"point": 5, "order": 9, "rank": 2, "wave_amplitude": 2, "angle": 1440}
    for name, value in found.items():
        dimensions = VARIABLES.variables[name].dimensions
        assert dimensions[0] == "absorber", name
        assert np.shape(value) == tuple(sizes[one] for one in dimensions[1:]), name
        if VARIABLES.variables[name].kind == "real":
            assert np.isnan(value).all()


def test_the_condition_is_one_of_the_route(simulated, response):
    assert str(simulated["condition"]) in set(response["class"])
    place = list(response["class"]).index(str(simulated["condition"]))
    assert float(simulated["speed"]) in response["speed"][place]
    assert str(simulated["wheel"]) in set(response["wheel"])


def test_profile_levels_and_heights_say_the_same(simulated):
    waves = simulated["amplitude_real"] + 1j * simulated["amplitude_imag"]
    level = 20.0 * np.log10(np.abs(waves) / np.sqrt(2.0) / 1e-6)
    np.testing.assert_allclose(simulated["level"], level, rtol=1e-9)
    height = peak_to_peak(simulated["order"], waves)
    np.testing.assert_allclose(simulated["peak_to_peak"], height, rtol=1e-9)
    np.testing.assert_allclose(
        np.ptp(simulated["last_profile"], axis=1), height[:, -1], rtol=1e-2
    )  # fmt: skip


def test_small_waves_grow_as_the_linear_level_tells(simulated):
    """Ten or twenty km in the curve at the start: the profile is still small."""
    change = np.abs(simulated["level"] - simulated["small_wave_level"])
    assert change[:, 0].max() < 1e-9
    size = np.abs(simulated["level"]).max(axis=(1, 2))
    assert (change[:, 1, :] < 0.2).all(), size


def test_the_wheel_wears_in_the_mean_as_the_linear_level_tells_while_it_is_nearly_round(
    simulated, response
):
    law = list(response["wear_law"]).index(str(simulated["wear_law"]))
    place = list(response["class"]).index(str(simulated["condition"]))
    wheel = list(response["wheel"]).index(str(simulated["wheel"]))
    point = list(response["speed"][place]).index(float(simulated["speed"]))
    tread, flange = response["mean_wear_depth"][law, place, :, wheel, point]
    depth = response["wear_scale"][law] * (tread + response["flange_wear_ratio"][law] * flange)
    wanted = simulated["revolutions_per_km"] * depth
    found = simulated["mean_wear"][:, 1] / simulated["distance"][:, 1]
    np.testing.assert_allclose(found, wanted, rtol=0.02)
    assert (np.diff(simulated["mean_wear"], axis=1) > 0.0).all()
