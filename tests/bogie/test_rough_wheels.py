"""Wheels out of round: linear response, simulation, wear and absorbers against each other."""

import numpy as np
import pytest
from wear_charts import MIDDLE, chart_with

from tramdva.bogie import revolutions
from tramdva.bogie import wheel_forces as running_module
from tramdva.bogie.absorber_ports import port_modes, ports, receptances
from tramdva.bogie.curving import linearise
from tramdva.bogie.names import WHEELS
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.rough_wheels import (
    contact_angles,
    deviation_forces,
    local_response,
    wheel_mask,
)
from tramdva.bogie.stored import stored_bogie, variables
from tramdva.bogie.tram import absorber, changed, transferred
from tramdva.contact import fastsim, patch
from tramdva.contact.patch import METHODS
from tramdva.evolution.out_of_roundness import radius_deviation
from tramdva.evolution.tendency import (
    Wearing,
    evolution_tendency,
    linear_wear_response,
    wear_rows,
    wear_sensitivity,
)
from tramdva.stages import bogie_simulation, wear

FRONT = ("front_outer", "front_inner")
V, R0 = 4.0, 0.3


def with_friction_decrease(line, B):
    """The line with another friction decrease in s/m."""
    return line._replace(friction=(*line.friction[:2], B))


SETTINGS = {"samples": 512, "revolutions": 2, "longest_transient": 40, "tolerance": 1e-3}


@pytest.fixture(scope="module")
def quiet(line, running):
    """The bogie without self-excitation, without and with the absorbers of Table 3."""
    stable = with_friction_decrease(line, 0.4)
    return {
        "none": changed(stable, None, running),
        "paper": changed(stable, absorber(stable, 1.74e5, 300.0), running),
    }


@pytest.fixture(scope="module")
def rough(quiet):
    """Linearised, by absorber."""
    return {name: rough_bogie(run.curve, run.equilibrium) for name, run in quiet.items()}


@pytest.fixture(scope="module")
def stored(quiet, rough):
    """As the file holds it, by absorber."""
    return {
        name: {
            "absorber": np.array(name),
            "status": np.array("converged"),
            **variables(rough[name], run.curve.contacts, R0, (12, 12)),
        }
        for name, run in quiet.items()
    }


def settings(amplitude=1e-6, wheels=FRONT, **wear_changes):
    numerics = SETTINGS | {"step_tolerance": 0.05, "wear_cells_along": 24, "wear_strips": 24}
    return {
        "out_of_roundness": {"amplitude": amplitude, "wheels": list(wheels), "measured": ""},
        "numerics": numerics,
        "wear": MIDDLE | {"method": "constant"} | wear_changes,
    }


def simulate(stored_values, tables, order, **changes):
    """Wear of a simulated order: response (wheels,), variables of both stages."""
    cfg = settings(**changes)
    contacts = bogie_simulation.compute(cfg, order, tables, stored_values)
    worn = wear.compute(cfg, contacts)
    return worn["wear_amplitude"] / worn["amplitude"] * np.exp(1j * worn["wear_phase"]), worn


def linear(rough_, run, frequency, wheels=FRONT, cells=24, **chart):
    wheels_of = chart_with(**({"method": "constant"} | chart))
    sensitivity = wear_sensitivity(
        rough_,
        run.curve.contacts.law,
        Wearing(wheels_of, fastsim.patch_grid(cells, cells), tuple(wheels)),
    )
    frequency = np.atleast_1d(frequency)
    response = linear_wear_response(rough_, sensitivity, frequency, V, R0, wheels)
    return response[:, [WHEELS.index(name) for name in wheels]]


@pytest.mark.parametrize("name", ["none", "paper"])
@pytest.mark.parametrize("order", [4, 9, 26, 34, 51, 67])
@pytest.mark.parametrize("method", ["constant", "smoothed"])
def test_simulated_and_linearised_wear_agree(stored, rough, quiet, tables, name, order, method):
    found, worn = simulate(stored[name], tables, order, method=method)
    frequency = float(worn["frequency"])
    expected = linear(rough[name], quiet[name], frequency, method=method)[0]
    assert str(worn["status"]) == "periodic"
    np.testing.assert_allclose(np.abs(found / expected), 1.0, atol=0.01)
    assert np.abs(np.degrees(np.angle(found / expected))).max() < 1.0


def test_simulated_and_linearised_wear_agree_with_the_sharp_chart(stored, rough, quiet, tables):
    """On the grid of the full run, by waves of 0.2 um.

    The outer wheel slips at 0.199 m/s: waves of 1 um move the chart's step at 0.2 m/s through so
    much of the patch that the response is no longer linear.
    """
    for order in (26, 51):
        cfg = settings(amplitude=2e-7, method="chart")
        cfg["numerics"] |= {"wear_cells_along": 40, "wear_strips": 40}
        contacts = bogie_simulation.compute(cfg, order, tables, stored["none"])
        worn = wear.compute(cfg, contacts)
        found = worn["wear_amplitude"] / worn["amplitude"] * np.exp(1j * worn["wear_phase"])
        frequency = float(worn["frequency"])
        expected = linear(rough["none"], quiet["none"], frequency, cells=40, method="chart")[0]
        np.testing.assert_allclose(np.abs(found / expected), 1.0, atol=0.015)
        assert np.abs(np.degrees(np.angle(found / expected))).max() < 1.0


def test_response_is_linear_up_to_five_micrometres_beside_the_peaks(stored, tables):
    small, _ = simulate(stored["none"], tables, 34, amplitude=1e-6)
    double, _ = simulate(stored["none"], tables, 34, amplitude=2e-6)
    large, worn = simulate(stored["none"], tables, 34, amplitude=2e-5)
    np.testing.assert_allclose(double, small, rtol=1e-3)
    assert np.abs(large / small - 1.0).max() > 1e-3  # the simulation is not the linear model
    assert worn["harmonic_distortion"].max() > 0.05


def test_shifting_the_waves_shifts_the_wear_and_leaves_the_response(stored, tables, tmp_path):
    angle = 2.0 * np.pi * np.arange(1440) / 1440
    responses, phases = [], []
    for shift in (0.0, 1.3):
        wave = radius_deviation([26], [1e-6 * np.exp(1j * shift)], angle)
        np.savetxt(tmp_path / "wave.csv", np.column_stack([np.degrees(angle), 1e6 * wave]))
        cfg = settings()
        cfg["out_of_roundness"]["measured"] = "wave.csv"
        contacts = bogie_simulation.compute(cfg, 26, tables, stored["paper"], tmp_path.joinpath)
        worn = wear.compute(cfg, contacts)
        responses.append(worn["wear_amplitude"] * np.exp(1j * worn["wear_phase"]))
        spectrum = np.fft.rfft(worn["wear_depth"], axis=1)[:, 26]
        phases.append(np.angle(spectrum))
    np.testing.assert_allclose(responses[1], responses[0], rtol=1e-4)
    turned = np.angle(np.exp(1j * (phases[1] - phases[0] - 1.3)))
    np.testing.assert_allclose(turned, 0.0, atol=1e-3)


def test_mean_wear_is_that_of_the_equilibrium(stored, rough, quiet, tables):
    _, worn = simulate(stored["paper"], tables, 34, method="smoothed")
    sensitivity = wear_sensitivity(
        rough["paper"],
        quiet["paper"].curve.contacts.law,
        Wearing(chart_with(method="smoothed"), fastsim.patch_grid(24, 24), FRONT),
    )
    np.testing.assert_allclose(worn["mean_wear_depth"], sensitivity.mean_depth()[:2], rtol=1e-3)
    np.testing.assert_allclose(worn["wear_depth"].mean(axis=1), worn["mean_wear_depth"], rtol=1e-9)


def test_a_vehicle_that_does_not_move_wears_by_the_load_of_hertz(rough, quiet):
    """By hand, constant k and full sliding: depth over its mean follows N ~ penetration^1.5."""
    bogie, law = rough["none"], quiet["none"].curve.contacts.law
    sensitivity = wear_sensitivity(
        bogie, law, Wearing(chart_with(method="constant"), fastsim.patch_grid(24, 24), FRONT)
    )
    rows = wear_rows(bogie, sensitivity, np.array([1e-3]), V, R0, FRONT)
    # The conformal flange root changes its curvature as the wheel sinks, the tread does not.
    for wheel, zone, tolerance in ((0, 1, 0.04), (1, 0, 0.01)):
        result = bogie.results[wheel, zone]
        cosine = np.cos(result[patch.CONTACT_ANGLE])
        stiffness = 1.5 * cosine / result[patch.PENETRATION]
        by_hand = sensitivity.mean_depth()[wheel] * stiffness
        np.testing.assert_allclose(rows.direct[0, wheel].real, by_hand, rtol=tolerance)


@pytest.mark.parametrize("name", ["none", "paper"])
def test_modal_response_is_that_of_the_full_matrices(rough, quiet, name):
    bogie, run = rough[name], quiet[name]
    order = np.array([3.0, 26.4, 60.0])
    turn = order * V / R0
    source = np.exp(1j * order[:, None, None] * contact_angles(bogie, R0, V))
    source = source * wheel_mask(FRONT)[None, :, None]
    found = local_response(bogie, turn, source)
    model = linearise(run.curve, run.equilibrium.state)
    for k in range(3):
        force = deviation_forces(bogie, turn[k : k + 1], source[k : k + 1])[0]
        load = model.input @ (run.curve.vehicle.force_input @ force)
        state = np.linalg.solve(1j * turn[k] * np.eye(load.size) - model.matrix, load)
        expected = model.output @ state
        np.testing.assert_allclose(found[k], expected, atol=1e-9 * np.abs(expected).max())


def test_sensitivities_do_not_depend_on_the_steps(rough, quiet):
    run, bogie = quiet["none"], rough["none"]
    system = run.curve
    local = system.local(run.equilibrium.state)
    other = running_module.radius_sensitivity(system.contacts, system.curvatures, local, 3.0)
    touching = bogie.touching
    for fine, coarse in zip(bogie.sensitivity, other, strict=True):
        scale = np.abs(fine[touching]).max(axis=0)
        np.testing.assert_allclose(
            fine[touching] / np.where(scale > 0, scale, 1),
            coarse[touching] / np.where(scale > 0, scale, 1),
            atol=5e-3,
        )


def test_file_holds_the_whole_linearised_bogie(stored, rough, quiet):
    back = stored_bogie(stored["paper"])
    response = local_response(
        back.bogie, np.array([300.0]), np.ones((1, 4, len(rough["paper"].results[0])))
    )
    expected = local_response(
        rough["paper"], np.array([300.0]), np.ones((1, 4, len(rough["paper"].results[0])))
    )
    np.testing.assert_array_equal(response, expected)
    assert back.places.spin_rate == pytest.approx(V / R0)
    law = quiet["paper"].curve.contacts.law
    assert back.law.friction == law.friction
    assert back.law.method == law.method == METHODS["half_space"]
    np.testing.assert_array_equal(back.law.creep_table.linear, law.creep_table.linear)


def test_wheels_in_phase_matter_at_the_inner_wheel(rough, quiet):
    """With waves on the inner wheel alone, its peak at the second bending nearly vanishes."""
    frequency = np.arange(50.0, 60.0, 0.1)
    both = evolution_tendency(linear(rough["none"], quiet["none"], frequency))
    alone = linear(rough["none"], quiet["none"], frequency, wheels=("front_inner",))
    assert evolution_tendency(alone).max() < 0.4 * both[:, 1].max()


def attached(run, rough_, absorber_, inertia, c_T, d_T, frequency):
    sensitivity = wear_sensitivity(
        rough_,
        run.curve.contacts.law,
        Wearing(chart_with(method="constant"), fastsim.patch_grid(24, 24), FRONT),
    )
    rows = wear_rows(rough_, sensitivity, frequency, V, R0, FRONT)
    turn = 2.0 * np.pi * frequency
    bare = receptances(run.curve, run.equilibrium, rough_, absorber_, turn, rows.source)
    found = ports(bare, inertia, rows.output([0, 1]), rows.direct[:, :2])
    return port_modes(found).response(inertia, c_T, d_T)


def test_attached_absorbers_respond_as_the_vehicle_built_with_them(line, quiet, rough):
    frequency = np.array([8.0, 21.0, 50.0, 55.5, 73.0, 117.0])
    own = line.bogie.absorber
    found = attached(quiet["none"], rough["none"], own, own.I_T, 1.74e5, 300.0, frequency)
    expected = linear(rough["paper"], quiet["paper"], frequency)
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def test_translating_absorbers_respond_alike_at_the_same_equilibrium(line, quiet, rough):
    frequency = np.array([8.0, 21.0, 50.0, 55.5, 73.0, 117.0])
    change = {"motion": "translation", "I_T": 20.0, "c_T": 2e6, "d_T": 1500.0}
    direction = line.bogie.absorber.direction.model_copy(update={"x": 0.1, "y": 0.3, "z": 1.0})
    own = line.bogie.absorber.model_copy(update={**change, "direction": direction})
    found = attached(quiet["none"], rough["none"], own, 20.0, 2e6, 1500.0, frequency)
    base = quiet["none"]
    built = changed(with_friction_decrease(line, 0.4), own, base)
    state = base.equilibrium._replace(state=transferred(base.curve, base.equilibrium, built.curve))
    built = built._replace(equilibrium=state)
    expected = linear(rough_bogie(built.curve, state), built, frequency)
    np.testing.assert_allclose(found, expected, rtol=1e-6)


@pytest.fixture(scope="module")
def unstable(line, running) -> dict:
    """The linearised bogie at a friction decrease at which it vibrates by itself."""
    run = changed(with_friction_decrease(line, 1.2), None, running)
    return {
        "absorber": np.array("none"),
        "status": np.array("converged"),
        **variables(rough_bogie(run.curve, run.equilibrium), run.curve.contacts, R0, (12, 12)),
    }


def test_a_self_excited_bogie_is_not_simulated(tables, unstable, monkeypatch):
    """The linear analysis knows what the simulation would find after minutes."""
    cfg = settings()
    cfg["numerics"]["longest_transient"] = 8
    with monkeypatch.context() as patched:
        patched.setattr(bogie_simulation, "hindrance", lambda *_: "")
        simulated = bogie_simulation.compute(cfg, 30, tables, unstable)
    assert str(simulated["status"]) == "not_periodic"

    monkeypatch.setattr(bogie_simulation, "simulate_wave", None)  # calling it would fail
    found = bogie_simulation.compute(cfg, 30, tables, unstable)
    assert str(found["status"]) == "self_excited"
    assert np.isnan(found["normal_force"]).all()
    assert found["normal_force"].shape == simulated["normal_force"].shape
    np.testing.assert_allclose(found["time"], simulated["time"])
    assert np.isfinite(found["time"]).all()


def test_a_bogie_without_steady_running_is_not_simulated(tables, unstable, monkeypatch):
    monkeypatch.setattr(bogie_simulation, "simulate_wave", None)
    lost = unstable | {"status": np.array("outside_profile")}
    assert str(bogie_simulation.compute(settings(), 30, tables, lost)["status"]) == "no_equilibrium"


def test_waves_of_a_millimetre_lose_the_contact(stored, tables):
    cfg = settings(amplitude=2e-4)
    cfg["numerics"]["longest_transient"] = 2
    found = bogie_simulation.compute(cfg, 55, tables, stored["none"])
    assert str(found["status"]) in {"contact_lost", "not_periodic"}
    assert found["normal_force"].min() == 0.0


@pytest.mark.parametrize(
    ("differences", "limit"), [([], np.inf), ([0.2], 0.2), ([0.4, 0.2], 0.2), ([0.4, 0.1], 0.1 / 3)]
)
def test_distance_from_the_limit_of_a_geometric_sequence(differences, limit):
    assert revolutions._remaining(differences) == pytest.approx(limit)
