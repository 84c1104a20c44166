"""Grids of absorber designs against the models built with each absorber, and their packing."""

import base64
import zlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from tramdva.bogie import tram
from tramdva.bogie.curving import linearise
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.evolution.tendency import (
    evolution_tendency,
    linear_wear_response,
    wear_sensitivity,
)
from tramdva.report import packed_arrays
from tramdva.stages import bogie_designs, contact_geometry, wheelset_designs
from tramdva.stages.axes import design_axis
from tramdva.stages.bogie_sections import bogie_line, quiet_bogie_line
from tramdva.stages.wheels_out_of_round import wearing
from tramdva.wheelset.model import linearised, wheelset_parameters
from tramdva.wheelset.stability import characteristic_polynomial, hurwitz_determinants

ROOT_CONFIG = Path(__file__).resolve().parents[2] / "config"
LIMITS = {"min": 10.0, "max": 1000.0}


@pytest.fixture(scope="module")
def configuration():
    return load(ROOT_CONFIG)


def wheelset_cfg(configuration, **forced):
    cfg = used_values(configuration, "paper", "wheelset_designs")
    cfg["numerics"] = {
        "c_T_points": 7, "d_T_points": 5, "frequency_points": 120, "map_points": 6,
    }  # fmt: skip
    cfg["forced_excitation"] |= forced
    return cfg


@pytest.fixture(scope="module")
def wheelset(configuration):
    return wheelset_designs.compute(wheelset_cfg(configuration))


def test_axis_has_equal_ratios_and_the_own_value():
    axis = design_axis(LIMITS, 21, 10.0 ** (1 + 2 * 0.3))

    np.testing.assert_allclose(axis[1:] / axis[:-1], 10.0**0.1, rtol=1e-12)
    moved = design_axis(LIMITS, 21, 97.0)
    assert moved.size == 21
    assert 97.0 in moved
    assert np.count_nonzero(np.abs(moved / axis - 1.0) > 1e-12) == 1
    assert (np.diff(moved) > 0.0).all()


@pytest.mark.parametrize(("own", "place"), [(3.0, 0), (5000.0, -1)])
def test_own_value_beyond_the_limits_is_one_more(own, place):
    axis = design_axis(LIMITS, 8, own)

    assert axis.size == 9
    assert axis[place] == own
    assert (np.diff(axis) > 0.0).all()


@pytest.mark.parametrize(("i", "j"), [(0, 0), (2, 3), (4, 6), (1, 5)])
def test_wheelset_designs_equal_the_wheelset_built_with_them(configuration, wheelset, i, j):
    """Growth by the roots of the characteristic polynomial, response by the state matrix."""
    cfg = wheelset_cfg(configuration)
    cfg["absorber"] |= {"c_T": wheelset["c_T"][j], "d_T": wheelset["d_T"][i]}
    built = wheelset_parameters(cfg)
    roots = np.roots(characteristic_polynomial(built, True).ravel()) / 1e-3
    assert wheelset["growth_rate"][i, j] == pytest.approx(roots.real.max(), rel=1e-7)
    top = roots[np.argmax(roots.real)]
    assert wheelset["leading_frequency"][i, j] == pytest.approx(abs(top.imag) / 2 / np.pi, rel=1e-7)

    quiet = linearised(built._replace(B=0.4), True).matrices[0]
    force = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0 / built.m_R])  # on y_R'
    turn = 2j * np.pi * wheelset["frequency"]
    expected = [np.linalg.solve(s * np.eye(6) - quiet, force)[2] for s in turn]
    np.testing.assert_allclose(wheelset["receptance_amplitude"][i, j], np.abs(expected), rtol=1e-9)
    assert wheelset["peak_receptance"][i, j] >= wheelset["receptance_amplitude"][i, j].max()


def test_stability_maps_agree_with_routh_and_hurwitz(configuration, wheelset):
    own = wheelset_parameters(wheelset_cfg(configuration))
    plane = {"c_A": wheelset["c_A"][None, :], "c_R": wheelset["c_R"][:, None]}
    for i, d in enumerate(wheelset["d_T"]):
        for j, c in enumerate(wheelset["c_T"]):
            coefficients = characteristic_polynomial(own._replace(**plane, c_T=c, d_T=d), True)
            stable = (hurwitz_determinants(coefficients) > 0.0).all(axis=-1)
            np.testing.assert_array_equal(wheelset["map_growth_rate"][i, j] < 0.0, stable)
    bare = characteristic_polynomial(own._replace(**plane), False)
    stable = (hurwitz_determinants(bare) > 0.0).all(axis=-1)
    np.testing.assert_array_equal(wheelset["none_map_growth_rate"] < 0.0, stable)
    assert 0 < np.count_nonzero(stable) < stable.size


def test_line_and_its_own_absorber_are_on_the_grid(configuration, wheelset):
    cfg = wheelset_cfg(configuration)
    assert cfg["absorber"]["c_T"] in wheelset["c_T"]
    assert cfg["absorber"]["d_T"] in wheelset["d_T"]
    assert wheelset["none_growth_rate"] > 0.0  # the paper's wheelset vibrates without absorber


def test_self_excited_wheelsets_have_a_status_and_no_response(configuration):
    """At the friction decrease of operation the response is sought where some designs vibrate."""
    found = wheelset_designs.compute(wheelset_cfg(configuration, B=0.7))

    stable = found["growth_rate"] < 0.0
    assert 0 < np.count_nonzero(~stable) < stable.size
    np.testing.assert_array_equal(found["forced_instability"] == 0, stable)
    np.testing.assert_array_equal(found["instability"] == 0, stable)
    for name in ("peak_receptance", "peak_frequency"):
        np.testing.assert_array_equal(np.isfinite(found[name]), stable)
    np.testing.assert_array_equal(np.isfinite(found["receptance_amplitude"]).all(axis=-1), stable)
    assert np.isnan(found["none_peak_receptance"])
    assert found["none_forced_instability"] != 0


# --------------------------------------------------------------------------------------- bogie


@pytest.fixture(scope="module")
def bogie_cfg():
    quick = load(ROOT_CONFIG, [ROOT_CONFIG / "quick.yaml"])
    cfg = used_values(quick, "paper", "bogie_designs")
    cfg["numerics"] |= {"c_T_points": 3, "d_T_points": 3, "frequency_points": 75}
    return cfg


@pytest.fixture(scope="module")
def tables():
    quick = load(ROOT_CONFIG, [ROOT_CONFIG / "quick.yaml"])
    return contact_geometry.compute(used_values(quick, "paper", "contact_geometry"))


@pytest.fixture(scope="module")
def bogie(bogie_cfg, tables):
    return bogie_designs.compute(bogie_cfg, tables)


@pytest.fixture(scope="module")
def running_without(bogie_cfg, tables):
    """Line and run without absorbers, by prefix of the variables; the quiet one last."""
    lines = {
        "": bogie_line(bogie_cfg, tables),
        "quiet_": quiet_bogie_line(bogie_cfg, tables),
    }
    return {prefix: (line, tram.run_through(line)) for prefix, line in lines.items()}


@pytest.mark.parametrize(("i", "j"), [(0, 0), (1, 1), (2, 1)])
def test_bogie_designs_equal_the_bogie_built_with_them(bogie_cfg, running_without, bogie, i, j):
    """Tendency and growth rates of a vehicle that is assembled with the absorber."""
    for prefix, (line, without) in running_without.items():
        design = tram.absorber(line, bogie["c_T"][j], bogie["d_T"][i])
        run = tram.changed(line, design, without)
        values = np.linalg.eigvals(linearise(run.curve, run.equilibrium.state).matrix)
        inside = (values.imag > 2 * np.pi * 30.0) & (values.imag < 2 * np.pi * 200.0)
        growth = bogie[f"{prefix}growth_rate"][i, j]
        assert growth == pytest.approx(values.real[inside].max(), rel=1e-5)
        assert (bogie[f"{prefix}self_excitation"][i, j] == "stable") == (growth < 0.0)
    rough = rough_bogie(run.curve, run.equilibrium)
    wheels = wearing(bogie_cfg)
    worn = wear_sensitivity(rough, run.curve.contacts.law, wheels)
    response = linear_wear_response(rough, worn, bogie["frequency"], 4.0, 0.3, wheels.wheels)
    expected = evolution_tendency(response[:, wheels.places].T)
    size = np.abs(bogie["none_tendency"]).max()
    np.testing.assert_allclose(bogie["tendency"][i, j], expected, atol=1e-5 * size)
    # Maxima in the band, with and without the absorber, on an axis so fine that no peak is missed.
    dense, largest = np.linspace(45.0, 65.0, 2001), []
    for state in (run, without):
        rough = rough_bogie(state.curve, state.equilibrium)
        worn = wear_sensitivity(rough, state.curve.contacts.law, wheels)
        response = linear_wear_response(rough, worn, dense, 4.0, 0.3, wheels.wheels)
        largest.append(evolution_tendency(response[:, wheels.places]).max(axis=0))
    np.testing.assert_allclose(bogie["none_band_tendency"], largest[1], rtol=0.02)
    np.testing.assert_allclose(bogie["band_factor"][i, j], largest[0] / largest[1], rtol=0.03)


def test_paper_bogie_vibrates_without_absorbers_and_not_with_them(bogie):
    own = np.argmin(np.abs(bogie["d_T"] - 300.0)), np.argmin(np.abs(bogie["c_T"] - 1.74e5))
    assert bogie["none_self_excitation"] == "self_excited"
    assert bogie["none_leading_frequency"] == pytest.approx(54.7, abs=1.0)
    assert bogie["self_excitation"][own] == "stable"
    assert (bogie["band_factor"][own] < 0.7).all()


def test_without_equilibrium_there_is_a_status_and_no_number(bogie_cfg, tables, monkeypatch):
    lifted = SimpleNamespace(equilibrium=SimpleNamespace(status="wheel_lifted"))
    monkeypatch.setattr(bogie_designs, "run_through", lambda line: lifted)

    found = bogie_designs.compute(bogie_cfg, tables)

    assert found["status"] == "wheel_lifted"
    for prefix in ("", "quiet_", "none_", "none_quiet_"):
        assert set(np.ravel(found[f"{prefix}self_excitation"])) == {"no_equilibrium"}
    for name in ("growth_rate", "quiet_growth_rate", "tendency", "none_tendency", "band_factor"):
        assert np.isnan(found[name]).all(), name
    assert set(found["band_status"]) == {"no_peak"}


# ------------------------------------------------------------------------------------- packing


def unpacked(packed: dict) -> np.ndarray:
    """The inverse in other words: whole numbers by cumulative sums."""
    planes = np.frombuffer(zlib.decompress(base64.b64decode(packed["data"])), np.uint8)
    folded = planes[: planes.size // 2] + 256 * planes[planes.size // 2 :].astype(int)
    whole = np.where(folded % 2, -(folded + 1) // 2, folded // 2).reshape(packed["shape"]) % 65536
    for axis in reversed(packed["differences"]):
        whole = np.cumsum(whole, axis=axis) % 65536
    plain = {"linear": np.asarray, "log": np.exp, "asinh": np.sinh}[packed["kind"]]
    values = packed["scale"] * plain((whole + packed["lowest"]) * packed["step"])
    return np.where(whole == packed_arrays.MISSING, np.nan, values)


@pytest.mark.parametrize("differences", [(), (0,), (2, 2, 1), (0, 1, 2)])
def test_packed_arrays_come_back_within_half_a_step(differences):
    rng = np.random.default_rng(5)
    values = np.cumsum(rng.normal(size=(4, 5, 60)), axis=2)
    values[1, 2, 30:40] = np.nan
    for step, kind, scale in ((1e-3, "linear", 2.0), (1e-2, "asinh", 0.1), (1e-3, "log", 1.0)):
        given = np.exp(values) if kind == "log" else values
        found = unpacked(packed_arrays.pack(given, step, differences, kind, scale))
        plain = {"linear": np.asarray, "asinh": np.arcsinh, "log": np.log}[kind]
        np.testing.assert_array_equal(np.isnan(found), np.isnan(given))
        np.testing.assert_allclose(plain(found / scale), plain(given / scale), atol=0.5001 * step)


def test_nothing_but_missing_values_comes_back():
    assert np.isnan(unpacked(packed_arrays.pack(np.full((2, 3), np.nan), 0.1, (1,)))).all()


def test_values_that_need_more_than_16_bits_are_refused():
    with pytest.raises(ValueError, match="more than 65535 steps"):
        packed_arrays.pack(np.array([0.0, 70.0]), 1e-3, ())
    with pytest.raises(ValueError, match="more than 65535 steps"):
        packed_arrays.pack(np.array([0.0, 1.0]), 1e-3, (), "log")
