"""The example line: what differs reaches its stages, what does not is the paper's; its physics."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

from tramdva import results
from tramdva.configuration.reading import Configuration, load
from tramdva.configuration.uses import used_values
from tramdva.contact import profiles
from tramdva.contact.measured_profile import measured_profile
from tramdva.evolution.out_of_roundness import order_amplitudes, read_measurement

NAME = "worn-40m"
CHANGED = {  # what the line changes for each stage of the bogie
    "contact_geometry": {"contact_geometry", "bogie", "measured", "track", "study"},
    "bogie_simulation": {"out_of_roundness", "measured"},
    "wear": set(),
    "tendency_maps": {"track", "bogie", "contact_geometry", "forced_excitation", "study"},
    "fig09_curve_entry": {"label"},
}


@pytest.fixture(scope="module")
def loaded(root: Path) -> Configuration:
    return load(root / "config")


@pytest.fixture(scope="module")
def own(root: Path) -> dict:
    path = root / f"config/lines/{NAME}.yaml"
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def leaves(tree: dict, prefix: str = "") -> dict[str, object]:
    """Values of nested maps by dotted key."""
    found = {}
    for key, value in tree.items():
        path = f"{prefix}{key}"
        found |= leaves(value, f"{path}.") if isinstance(value, dict) else {path: value}
    return found


def test_only_what_differs_stands_in_the_file(loaded, own) -> None:
    paper = leaves(loaded.lines["paper"].model_dump(mode="json"))
    line = leaves(loaded.lines[NAME].model_dump(mode="json"))

    differing = {key for key in paper if line[key] != paper[key]}

    # A range and a direction are written whole.
    whole = re.compile(r"\.(min|max|direction\.[xyz])$")
    assert {key for key in leaves(own) if not whole.search(key)} <= differing
    assert differing <= set(leaves(own))


@pytest.mark.parametrize("stage", CHANGED)
def test_values_that_differ_reach_their_stages(loaded, stage: str) -> None:
    paper, line = (used_values(loaded, name, stage) for name in ("paper", NAME))

    assert {key for key in line if line[key] != paper[key]} == CHANGED[stage]


def test_every_stage_of_the_bogie_gets_the_hash_of_its_files_alone(loaded) -> None:
    files = loaded.measured[NAME]
    geometry = used_values(loaded, NAME, "contact_geometry")["measured"]
    simulation = used_values(loaded, NAME, "bogie_simulation")["measured"]

    assert geometry == {name: files[name].sha256 for name in ("wheel", "rail")}
    assert simulation == {"out_of_roundness": files["out_of_roundness"].sha256}
    assert used_values(loaded, "paper", "contact_geometry")["measured"] == {
        "wheel": "",
        "rail": "",
    }


def test_files_are_what_their_script_writes_and_say_so(root: Path, tmp_path: Path) -> None:
    sys.path.insert(0, str(root / "docs"))
    import synthetic_profiles

    synthetic_profiles.main(tmp_path)
    for path in tmp_path.iterdir():
        shipped = root / "config/profiles" / path.name
        assert shipped.read_text() == path.read_text()
        assert "synthetic" in path.read_text().splitlines()[0]


def test_worn_profiles_lost_material_where_they_say(root: Path) -> None:
    folder = root / "config/profiles"
    wheel = measured_profile(folder / "worn_wheel.csv", "wheel", 2e-6)
    new = profiles.tram_wheel(17e-3)
    tread = np.array([-0.015, -0.003, 0.03])
    hollow = new.depth_at(tread) - wheel.depth_at(tread)  # material goes upwards
    assert hollow[1] > max(hollow[0], hollow[2]) + 3e-5
    flank = np.interp(-12e-3, -wheel.depth[::-1], wheel.position[::-1])
    new_flank = np.interp(-12e-3, -new.depth[::-1], new.position[::-1])
    assert 0.4e-3 < new_flank - flank < 1.2e-3  # a thinner flange
    rail = measured_profile(folder / "worn_rail.csv", "rail", 2e-6)
    corner = rail.position < -20e-3
    assert (rail.depth[corner] > profiles.grooved_rail(corner_start=15e-3).depth_at(
        rail.position[corner]
    ) + 0.1e-3).all()  # fmt: skip


def test_wheel_out_of_round_has_its_polygon(root: Path) -> None:
    measured = read_measurement(str(root / "config/profiles/out_of_round.csv"))
    amplitude = np.abs(order_amplitudes(*measured, np.arange(1, 41)))

    assert amplitude[0] == pytest.approx(20e-6, rel=0.01)
    assert np.argmax(amplitude[9:]) + 10 == 19
    assert amplitude[18] == pytest.approx(1.5e-6 + 20e-6 * 19**-1.4, rel=0.03)


def read(folder: Path, line: str, stage: str) -> dict[str, np.ndarray]:
    return results.read(folder / f"results/{line}/{stage}.nc")


def test_all_stages_converge(quick_run: Path) -> None:
    assert set(read(quick_run, NAME, "curving_equilibrium")["status"]) == {"converged"}
    assert set(read(quick_run, NAME, "curve_entry")["status"]) == {"completed"}
    assert set(read(quick_run, NAME, "evolution_tendency")["status"].ravel()) == {"periodic"}
    maps = read(quick_run, NAME, "tendency_maps")
    assert {*maps["speed_status"].ravel(), *maps["radius_status"].ravel()} == {"converged"}


def test_wider_curve_means_less_angle_of_attack(quick_run: Path, loaded) -> None:
    paper, line = (read(quick_run, name, "curving_equilibrium") for name in ("paper", NAME))
    chord = [
        c.bogie.half_wheelbase / c.track.radius for c in map(loaded.lines.get, ("paper", NAME))
    ]

    front = [values["angle_of_attack"][0, 0] for values in (paper, line)]
    assert front[1] < front[0]
    # Beyond the chord the bogie turns by the play of its flanges, some mm on the wheelbase.
    assert all(0.0 < angle - least < 0.006 for angle, least in zip(front, chord, strict=True))


def test_heavier_vehicle_loads_its_wheels_by_its_weight(quick_run: Path, loaded) -> None:
    def mass(name: str) -> float:
        """Mass in kg of the bogie with its share of the car, without absorbers."""
        bogie = loaded.lines[name].bogie
        axle, wheel = bogie.axle, bogie.stub.mass + bogie.wheel.hub.mass + bogie.wheel.rim.mass
        outer = axle.half_length - axle.middle_half_length
        beam = axle.middle_half_length * axle.middle.mass_per_length
        beam += outer * axle.outer.mass_per_length
        return bogie.car_body.mass + bogie.frame.mass + 4 * wheel + 4 * beam

    weight = [
        read(quick_run, name, "curving_equilibrium")["straight_wheel_load"][:, :].sum(axis=1)
        for name in ("paper", NAME)
    ]
    np.testing.assert_allclose(
        weight[1][0] - weight[0][0], 9.81 * (mass(NAME) - mass("paper")), rtol=1e-6
    )
    # A translating absorber weighs on the wheels: four of 40 kg.
    np.testing.assert_allclose(weight[1][1] - weight[1][0], 9.81 * 160.0, rtol=1e-6)


def test_vibrates_by_itself_in_its_curve_and_its_absorber_ends_that(quick_run: Path) -> None:
    modes = read(quick_run, NAME, "bogie_modes")
    none, own_absorber = modes["operating_growth_rate"][:2]

    assert none > 1.0
    assert 50.0 < modes["operating_frequency"][0] < 62.0
    assert own_absorber < -5.0
    assert modes["critical_friction_decrease"][0] < 0.6 < modes["critical_friction_decrease"][1]


def test_basic_model_is_the_reduction_of_the_bogie(quick_run: Path, loaded) -> None:
    """Both vibrate by themselves at about the same frequency; one description of a tram."""
    basic, tuning = (read(quick_run, NAME, stage) for stage in ("basic_model", "absorber_tuning"))
    modes = read(quick_run, NAME, "bogie_modes")

    assert not basic["given"].any()
    assert str(basic["status"]) == "derived"
    assert basic["r_C"] == loaded.lines[NAME].track.radius + 0.75
    assert tuning["reference_growth_rate"] > 0.0
    assert tuning["reference_peak_frequency"] == pytest.approx(
        modes["operating_frequency"][0], rel=0.02
    )
