"""Measured files and positions that a line can hold but that cannot be meant."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from tramdva.configuration.measured_files import check_or_exit
from tramdva.configuration.reading import ConfigurationError, load
from tramdva.contact.profile_checks import noise_of

pytestmark = pytest.mark.refuses


def points(path: Path) -> np.ndarray:
    return np.loadtxt(path, delimiter=",")


def write(path: Path, values: np.ndarray) -> None:
    np.savetxt(path, values, "%.9f", ",")


def said(folder: Path, line: str = "worn-40m") -> str:
    """What is said of the measured files of a line before a run; nothing where they are good."""
    found = load(folder, (), {"lines": [line]})
    try:
        check_or_exit(found.measured, found.lines)
    except SystemExit as error:
        return str(error)
    return ""


def test_shipped_files_are_good(config_folder: Path) -> None:
    assert said(config_folder) == ""


@pytest.mark.parametrize("unit", [1e-3, 1e-6], ids=["mm", "m"])
def test_out_of_roundness_in_another_unit(config_folder: Path, unit: float) -> None:
    path = config_folder / "profiles/out_of_round.csv"
    write(path, points(path) * [1.0, unit])

    words = said(config_folder)

    assert words.startswith(f"{path}: the deviation varies by")
    assert "at least 1 um are needed (deviation in um, not in mm or m)" in words
    assert "\n" not in words


@pytest.mark.parametrize("name", ["out_of_round", "worn_wheel", "worn_rail"])
def test_byte_order_mark_is_no_content(config_folder: Path, name: str) -> None:
    path = config_folder / f"profiles/{name}.csv"
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().partition(b"\n")[2].partition(b"\n")[2])

    assert said(config_folder) == ""


def test_rail_given_as_wheel_and_wheel_given_as_rail(config_folder: Path) -> None:
    wheel, rail = (config_folder / f"profiles/worn_{kind}.csv" for kind in ("wheel", "rail"))
    kept = wheel.read_bytes()
    shutil.copy(rail, wheel)
    assert "the flange has a play of -" in said(config_folder)
    rail.write_bytes(kept)
    words = said(config_folder).splitlines()
    assert words == [line for line in words if line.startswith(f"{rail}: the highest point is at")]
    assert "(a wheel, or a shifted profile?)" in words[0]


@pytest.mark.parametrize("shift", [5.0, -5.0, 20.0, -20.0])
@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("wheel", "the flange has a play of"),
        ("rail", "y = 0 must be the top of the rail, up to 3 mm beside it"),
    ],
)
def test_shifted_profiles(config_folder: Path, kind: str, shift: float, words: str) -> None:
    path = config_folder / f"profiles/worn_{kind}.csv"
    write(path, points(path) + np.array([shift, 0.0]))

    told = said(config_folder)

    assert words in told or "must reach 8 mm beyond y = 0" in told
    assert path.name in told
    assert "\n" not in told


def test_measured_wheel_on_a_rail_of_the_parameters(config_folder: Path) -> None:
    (config_folder / "lines/mine.yaml").write_text(
        "label: Mine\ncontact_geometry: {wheel: {measured: profiles/worn_wheel.csv}}\n"
    )
    assert said(config_folder, "mine") == ""
    path = config_folder / "profiles/worn_wheel.csv"
    write(path, points(path) + np.array([6.0, 0.0]))
    assert "worn_wheel.csv on the rail of the parameters: the flange has a play of -" in said(
        config_folder, "mine"
    )


@pytest.mark.parametrize("noise", [0.02, 0.1])
@pytest.mark.parametrize("kind", ["wheel", "rail"])
def test_noise_of_a_profile_is_found_and_bounded(
    config_folder: Path, kind: str, noise: float
) -> None:
    path = config_folder / f"profiles/worn_{kind}.csv"
    values = points(path)
    values[:, 1] += np.random.default_rng(5).normal(0.0, noise, len(values))
    # Noise of the depth alone: all of it counts on the tread, part of it on the flank.
    assert 0.75 * noise < noise_of(values) < 1.05 * noise
    write(path, values)

    assert f"worn_{kind}.csv: the points scatter by" in said(config_folder)
    assert "at most 10 um are allowed with measured_noise = 2e-06 m" in said(config_folder)


def test_noise_that_was_told_is_smoothed(config_folder: Path) -> None:
    path, line = config_folder / "profiles/worn_wheel.csv", config_folder / "lines/worn-40m.yaml"
    values = points(path)
    values[:, 1] += np.random.default_rng(5).normal(0.0, 0.02, len(values))
    write(path, values)
    text = line.read_text()
    line.write_text(text.replace("measured_noise: 2.0e-6", "measured_noise: 2.0e-5", 1))

    assert said(config_folder) == ""


WRONG = {
    "band above": (
        "study: {tendency_maps: {design_band: {min: 160, max: 180}}}",
        "study: tendency_maps.design_band = 160 to 180 Hz must lie within "
        "evolution_tendency.frequency = 2 to 150 Hz: nothing is computed beyond",
    ),
    "band between the frequencies": (
        "study: {tendency_maps: {design_band: {min: 55.1, max: 55.2}}}",
        "study.tendency_maps.design_band = 55.1 to 55.2 Hz must be at least 1.5 Hz wide: 297 "
        "numerics.tendency_maps.frequency_points lie 0.5 Hz apart",
    ),
    "full gauge": (
        "bogie: {wheel: {half_distance: 1.0}}",
        "bogie.wheel.half_distance = 1.0: must be between 0.4 and 0.9 m "
        "(distance of a wheel's centre from the track centre, half of that of both wheels)",
    ),
    "metre gauge, springs of the other": (
        "bogie: {wheel: {half_distance: 0.53}, axle: {half_length: 0.5}, "
        "absorber: {lateral_position: 0.4}, secondary: {lateral_position: 0.55}}",
        "bogie: secondary.lateral_position = 0.55 m must be at most 0.48 m, between the wheels: "
        "wheel.half_distance = 0.53 m",
    ),
    "primary springs outside": (
        "bogie: {primary: {lateral_position: 0.75}}",
        "bogie: primary.lateral_position = 0.75 m must be at most 0.7 m, between the wheels: "
        "wheel.half_distance = 0.75 m",
    ),
    "stubs outside": (
        "bogie: {stub: {lateral_position: 0.9}}",
        "bogie: stub.lateral_position = 0.9 m must be at most 0.8 m, within the outer face of the "
        "wheel: wheel.half_distance = 0.75 m",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_values_that_cannot_be_meant(config_folder: Path, case: str) -> None:
    text, words = WRONG[case]
    (config_folder / "lines/mine.yaml").write_text(f"label: Mine\n{text}\n")
    with pytest.raises(ConfigurationError) as caught:
        load(config_folder, (), {"lines": ["mine"]})
    lines = str(caught.value).splitlines()
    assert any(line.endswith(f"config/lines/mine.yaml: {words}") for line in lines), lines
