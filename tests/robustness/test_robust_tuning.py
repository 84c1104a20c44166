"""Robustness sample and robust tuning: known answers, limits, and parts that make the whole."""

from pathlib import Path

import numpy as np
import pytest

from tramdva.bogie.absorber_ports import PortModes
from tramdva.bogie.conditions import Conditions
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.tram import run_through
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.evolution.tendency import (
    evolution_tendency,
    linear_wear_response,
    wear_sensitivity,
)
from tramdva.robustness import criterion, larger_mass
from tramdva.robustness.criterion import Criterion, Fleet
from tramdva.robustness.sample import assembled, cases, ranges, stored_ports
from tramdva.stages import contact_geometry, robust_tuning, robustness_sample
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.stages.robust_tuning import FORCED, NOMINAL, PAPER, ROBUST
from tramdva.stages.wheels_out_of_round import wearing

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def loaded():
    return load(ROOT / "config", [ROOT / "config/quick.yaml"])


@pytest.fixture(scope="module")
def geometry(loaded):
    return contact_geometry.compute(used_values(loaded, "paper", "contact_geometry"))


def sample_settings(loaded, parts: int = 1) -> dict:
    values = used_values(loaded, "paper", "robustness_sample")
    values["numerics"]["parts"] = parts
    return values


@pytest.fixture(scope="module")
def sample(loaded, geometry):
    return robustness_sample.compute(sample_settings(loaded), geometry, 0)


@pytest.fixture(scope="module")
def settings(loaded):
    return used_values(loaded, "paper", "robust_tuning")


@pytest.fixture(scope="module")
def tuned(settings, sample):
    return robust_tuning.compute(settings, [sample])


def test_cases_are_the_line_then_single_ranges_then_a_sequence(loaded):
    study = sample_settings(loaded)["study"]
    limits = np.array(list(ranges(study).values()))
    varied, shares = cases(study, 6, 1)
    single, count = 2 * len(Conditions._fields), len(limits)

    assert varied[0] == "none"
    assert (shares[0] == 1.0).all()
    for k in range(single):
        (changed,) = np.flatnonzero(shares[1 + k] != 1.0)
        assert shares[1 + k, changed] == limits[changed, k % 2]
        assert varied[1 + k] == f"{Conditions._fields[changed]}_{('min', 'max')[k % 2]}"
    drawn = shares[1 + single :]
    assert drawn.shape == (6, count)
    assert (drawn >= limits[:, 0]).all()
    assert (drawn <= limits[:, 1]).all()
    again, more, other = (
        cases(study, number, seed)[1][1 + single :] for number, seed in ((6, 1), (40, 1), (6, 2))
    )
    np.testing.assert_array_equal(again, drawn)
    np.testing.assert_array_equal(more[:6], drawn)
    assert (other != drawn).all()


def test_sequence_fills_the_ranges_evenly(loaded):
    study = sample_settings(loaded)["study"]
    limits = np.array(list(ranges(study).values()))
    _, shares = cases(study, 64, 1)
    place = (shares[-64:] - limits[:, 0]) / (limits[:, 1] - limits[:, 0])
    # Each of 64 equal intervals of each range holds one point: that is what a Sobol net means.
    cells = np.sort(np.floor(64 * place), axis=0)
    np.testing.assert_array_equal(cells, np.tile(np.arange(64.0)[:, None], place.shape[1]))


def test_parts_make_the_whole_bit_for_bit(loaded, geometry, sample):
    cfg = sample_settings(loaded, parts=11)
    for part in (4, 10):
        own = robustness_sample.compute(cfg, geometry, part)
        rows = own["case"].astype(int)
        assert rows.size
        for name, values in own.items():
            whole = sample[name]
            if name not in ("range", "wheel", "friction", "unsprung_mass"):
                whole = whole[rows]
            np.testing.assert_array_equal(values, whole, err_msg=name)
    halves = [{n: v[k::2] if n == "case" or v.shape[:1] == sample["case"].shape else v
               for n, v in sample.items()} for k in (1, 0)]  # fmt: skip
    for name, values in assembled(halves).items():
        np.testing.assert_array_equal(values, sample[name], err_msg=name)


def test_case_is_the_line_computed_directly(loaded, geometry, sample):
    (row,) = np.flatnonzero(sample["varied"] == "radius_max")
    cfg = sample_settings(loaded)
    absorber = cfg["bogie"]["absorber"] | {"c_T": 1.0, "d_T": 0.0}
    share = cfg["study"]["conditions"]["radius"]["max"]
    direct = {
        **cfg,
        "track": cfg["track"] | {"radius": share * cfg["track"]["radius"]},
        "bogie": cfg["bogie"] | {"absorber": absorber},
    }
    line = quiet_bogie_line(direct, geometry)
    run = run_through(line)
    bogie = rough_bogie(run.curve, run.equilibrium)
    wheels = wearing(cfg)
    worn = wear_sensitivity(bogie, run.curve.contacts.law, wheels)
    frequency, speed = sample["frequency"][row], line.track.speed
    response = linear_wear_response(bogie, worn, frequency, speed, 0.3, wheels.wheels)
    expected = response[:, wheels.places]
    found = stored_ports(sample).without_absorbers[row]
    np.testing.assert_allclose(found, expected, rtol=1e-5)


def test_unsprung_mass_is_that_of_the_parts(loaded, sample):
    bogie = loaded.lines["paper"].bogie
    axle, wheel = bogie.axle, bogie.wheel
    beam = 2.0 * axle.middle.mass_per_length * axle.middle_half_length
    beam += 2.0 * axle.outer.mass_per_length * (axle.half_length - axle.middle_half_length)
    fixed = 2.0 * (bogie.stub.mass + wheel.hub.mass + wheel.rim.mass)
    assert sample["unsprung_mass"] == pytest.approx(beam + fixed, rel=0.01)


def oscillator(frequency: np.ndarray, damping_ratio: float = 1e-3) -> Fleet:
    """A mass of 1 on a spring of 1, whose wear is its own motion; one absorber sits on it."""
    turn = frequency[None]
    receptance = 1.0 / (1.0 - turn**2 + 2j * damping_ratio * turn)
    others = np.zeros((*turn.shape, 3))
    modes = PortModes(
        turn,
        receptance[..., None],
        np.concatenate([receptance[..., None], others], axis=2),
        np.concatenate([receptance[..., None] ** 2, others], axis=2)[:, :, None],
        np.zeros((*turn.shape, 4, 4)),
    )
    still = np.zeros((*turn.shape, 4))
    bare = modes.output_by_wave
    return Fleet(np.zeros(1, int), bare, still, modes, frequency[None], 0.05, np.ones(1, bool))


def test_optimum_for_one_mass_is_that_of_chatter_suppression():
    # Sims, J. Sound Vib. 301 (2007): absorber for the least negative real part of a receptance.
    mu = 0.05
    one = oscillator(np.linspace(0.5, 1.8, 4001))
    reference = criterion.references(one.largest(None), one.steady)
    quiet = Criterion(one, reference, np.ones(1, bool), ((1.0, 1.0),), lambda case, design: -1.0)
    grid_c, grid_d = np.linspace(0.02, 0.12, 15), np.linspace(0.001, 0.05, 15)
    best, _ = criterion.optimum(quiet, grid_c, grid_d, [])

    ratio = np.sqrt((mu + 2.0 + np.sqrt(2.0 * mu + mu**2)) / (2.0 * (1.0 + mu) ** 2))
    assert best.status == "converged"
    assert np.sqrt(best.design[0] / mu) == pytest.approx(ratio, rel=0.01)
    damping = best.design[1] / (2.0 * np.sqrt(best.design[0] * mu))
    assert damping == pytest.approx(np.sqrt(3.0 * mu / (8.0 * (1.0 + mu))), rel=0.1)
    fine = min(
        quiet.worst((c, d))
        for c in np.linspace(0.04, 0.07, 61)
        for d in np.linspace(0.006, 0.03, 49)
    )
    assert best.factor <= fine * (1.0 + 1e-9)
    assert best.factor == pytest.approx(fine, rel=0.02)


def test_tolerance_ends_where_the_factor_exceeds_its_share():
    one = oscillator(np.linspace(0.5, 1.8, 2001))
    reference = criterion.references(one.largest(None), one.steady)
    quiet = Criterion(one, reference, np.ones(1, bool), ((1.0, 1.0),), lambda case, design: -1.0)
    c_T, d_T = np.linspace(0.02, 0.12, 15), np.linspace(0.001, 0.012, 15)
    best, _ = criterion.optimum(quiet, c_T, d_T, [])
    band = criterion.tolerance(quiet, best, 0.1, c_T, d_T, [])

    for end in band[0]:
        assert quiet.worst((end, best.design[1])) == pytest.approx(1.1 * best.factor, rel=2e-3)
    assert band[0, 0] < best.design[0] < band[0, 1]
    assert np.isnan(band[1, 1])  # beyond the grid

    # A case that begins to vibrate by itself ends the band as well.
    end = best.design[0] + 0.3 * (band[0, 1] - best.design[0])
    restless = quiet._replace(growth=lambda case, design: design[0] - end)
    narrow = criterion.tolerance(restless, best, 0.1, c_T, d_T, [0])
    assert narrow[0, 1] == pytest.approx(end, rel=1e-3)
    assert narrow[0, 0] == pytest.approx(band[0, 0], rel=1e-3)


def test_the_mass_that_can_do_it_is_found():
    """One mass on a spring that a negative damping of the track feeds: heavier absorbers calm it.

    Growth of the pair of masses by its matrix. With equal frequencies gain and loss balance at a
    mass ratio of (2 feed)^2, to first order.
    """
    feed = 0.12  # damping ratio below zero

    def growth(mu: float, case: int, design) -> float:
        c, d = design
        matrix = np.array([
            [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0],
            [-1.0 - c, c, 2.0 * feed - d, d], [c / mu, -c / mu, d / mu, -d / mu],
        ])  # fmt: skip
        return float(np.linalg.eigvals(matrix).real.max())

    one = oscillator(np.linspace(0.5, 1.8, 801))
    reference = criterion.references(one.largest(None), one.steady)

    def criteria(mu: float):
        own = Criterion(
            one._replace(inertia=mu), reference, np.ones(1, bool), ((1.0, 1.0),),
            lambda case, design: growth(mu, case, design),
        )  # fmt: skip
        return own, own

    needed, least = (2.0 * feed) ** 2, 0.029
    grid_c, grid_d = least * np.linspace(0.85, 1.0, 9), least * np.linspace(0.18, 0.38, 9)
    found = list(larger_mass.masses_tried(criteria, least, grid_c, grid_d, [0], []))
    assert [round(one.inertia / least, 3) for one in found] == [2.0, 4.0, 2.828]
    assert [one.is_enough for one in found] == [one.inertia > 1.2 * needed for one in found]


def test_references_are_never_below_the_line_as_configured():
    bare = np.array([[0.2, 0.1], [0.5, 0.9], [0.1, 0.0], [7.0, 7.0]])
    steady = np.array([True, True, True, False])
    np.testing.assert_array_equal(criterion.references(bare, steady), [0.2, 0.9, 0.2, 0.2])
    calm = np.array([[-1.0], [0.5], [0.3]])
    np.testing.assert_array_equal(criterion.references(calm, np.ones(3, bool)), [0.5, 0.5, 0.5])
    assert np.isnan(criterion.references(-np.abs(bare), steady)).all()


def test_robust_optimum_is_better_than_others_in_the_worst_case(settings, sample, tuned):
    assert list(tuned["status"]) == ["converged"] * 4
    assert tuned["worst_factor"][ROBUST] < tuned["worst_factor"][NOMINAL]
    assert tuned["worst_factor"][ROBUST] < tuned["worst_factor"][PAPER]
    assert tuned["nominal_factor"][NOMINAL] < tuned["nominal_factor"][ROBUST]
    assert tuned["self_excited_cases"][ROBUST] == 0.0
    assert tuned["worst_factor"][ROBUST] <= np.nanmin(tuned["map_worst_factor"]) * (1 + 1e-9)
    assert tuned["nominal_factor"][NOMINAL] <= np.nanmin(tuned["map_nominal_factor"]) * (1 + 1e-9)
    # Every case that counts is at most the worst, whatever its own shares of the rubber are.
    whole = tuned["factor"][ROBUST, tuned["counted"] & (tuned["varied"] != "all")]
    assert np.nanmax(whole) <= tuned["worst_factor"][ROBUST] * (1 + 1e-9)


def test_robust_optimum_is_that_of_a_brute_force_grid(settings, sample, tuned):
    whole = criterion.fleet(sample, 2.0)
    _, robust = robust_tuning._criteria(settings, sample, whole)
    robust = robust._replace(counted=tuned["counted"][whole.case])
    c, d = tuned["c_T"][ROBUST], tuned["d_T"][ROBUST]
    around = [
        robust.worst((c * a, d * b))
        for a in np.linspace(0.7, 1.4, 15)
        for b in np.linspace(0.5, 1.8, 15)
    ]
    assert min(around) >= tuned["worst_factor"][ROBUST] * (1.0 - 5e-3)


def test_without_ranges_the_robust_optimum_is_the_nominal_one(settings, sample):
    alone = {
        n: v[:1] if n == "case" or v.shape[:1] == sample["case"].shape else v
        for n, v in sample.items()
    }
    fixed = {"min": 1.0, "max": 1.0}
    study = settings["study"] | {"rubber": {"stiffness": fixed, "damping": fixed}}
    found = robust_tuning.compute({**settings, "study": study}, [alone])
    for name in ("c_T", "d_T"):
        assert found[name][ROBUST] == found[name][NOMINAL]
    assert found["worst_factor"][ROBUST] == found["nominal_factor"][NOMINAL]


def test_response_as_configured_is_that_of_the_attached_absorber(settings, sample, tuned):
    """The factor and the peaks from the same case by the response itself."""
    ports = stored_ports(sample)
    modes = criterion.fleet(sample, 2.0).modes.at(0)
    band, axis = settings["study"]["design_band"], sample["frequency"][0]
    inside = (axis >= band["min"]) & (axis <= band["max"])
    with_it = evolution_tendency(modes.response(2.0, 1.74e5, 300.0))[inside].max()
    bare = evolution_tendency(ports.without_absorbers[0])[inside].max()
    assert tuned["factor"][PAPER, 0] == pytest.approx(with_it / bare, rel=1e-12)
    assert tuned["nominal_factor"][PAPER] == pytest.approx(with_it / bare, rel=1e-12)


def changed(sample, **values):
    return {**sample, **values}


def test_a_case_that_no_absorber_calms_does_not_count(settings, sample, tuned):
    """A mode that no absorber reaches grows in one case."""
    row = 5
    value, forcing = sample["eigenvalue_real"].copy(), sample["mode_forcing_real"].copy()
    imag = sample["mode_forcing_imag"].copy()
    frequency = sample["eigenvalue_imag"][row, 0] / (2.0 * np.pi)
    mode = int(np.nanargmin(np.abs(frequency - 117.0)))
    value[row, :, mode] = 5.0
    forcing[row, :, mode], imag[row, :, mode] = 0.0, 0.0
    other = changed(
        sample, eigenvalue_real=value, mode_forcing_real=forcing, mode_forcing_imag=imag
    )
    found = robust_tuning.compute(settings, [other])

    others = np.arange(len(tuned["counted"])) != row
    assert tuned["counted"][row]
    assert not found["counted"][row]
    np.testing.assert_array_equal(found["counted"][others], tuned["counted"][others])
    assert found["status"][ROBUST] == "converged"
    assert (found["growth_rate"][1:, row] >= 5.0 - 1e-9).all()
    assert np.isnan(found["factor"][1:, row]).all()


def test_where_nothing_grows_there_is_no_optimum(settings, sample):
    flat = changed(
        sample,
        wear_by_wave_real=np.ones_like(sample["wear_by_wave_real"]),
        bare_wear_by_wave_real=np.ones_like(sample["wear_by_wave_real"]),
        wear_by_force_real=np.zeros_like(sample["wear_by_force_real"]),
        wear_by_force_imag=np.zeros_like(sample["wear_by_force_imag"]),
    )
    found = robust_tuning.compute(settings, [flat])
    assert list(found["status"][[NOMINAL, ROBUST]]) == ["nothing_grows"] * 2
    assert np.isnan(found["c_T"][[NOMINAL, ROBUST]]).all()
    assert np.isnan(found["factor"]).all()
    steady = found["growth_rate"][PAPER, :, FORCED] < 0.0
    np.testing.assert_array_equal(np.isfinite(found["stroke_amplitude"][PAPER]), steady)
    assert steady[0]


def test_without_steady_running_the_status_says_so(settings, sample):
    status = sample["status"].copy()
    status[0] = "wheel_lifted"
    found = robust_tuning.compute(settings, [changed(sample, status=status)])
    assert set(found["status"]) == {"no_equilibrium"}
    assert np.isnan(found["factor"]).all()


def test_a_case_without_equilibrium_is_left_out(settings, sample, tuned):
    status, broken = sample["status"].copy(), {}
    status[-1] = "not_converged"
    for name, values in sample.items():
        if name.endswith(("_real", "_imag")):
            broken[name] = values.copy()
            broken[name][-1] = np.nan
    found = robust_tuning.compute(settings, [changed(sample, status=status, **broken)])
    assert not found["counted"][-1]
    assert np.isnan(found["growth_rate"][1:, -1]).all()
    assert found["c_T"][NOMINAL] == tuned["c_T"][NOMINAL]
    assert found["worst_factor"][ROBUST] <= tuned["worst_factor"][ROBUST] * (1 + 1e-6)
