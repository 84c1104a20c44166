"""What follows from a line's file, and what contradicts itself there."""

from pathlib import Path

import pytest

from tramdva.bogie.parameters import Bogie
from tramdva.configuration import following
from tramdva.configuration.reading import Configuration, ConfigurationError, load
from tramdva.configuration.uses import stages_read, used_values

ARTICULATED = "tram: {gauge_mm: 1000, axle_load_t: 8, speed_km_h: 18}\ntrack: {radius: 20}\n"


@pytest.fixture
def described(config_folder: Path):
    def of(text: str) -> Configuration:
        (config_folder / "lines/x.yaml").write_text(f"label: x\n{text}", encoding="utf-8")
        return load(config_folder, (), {"lines": ["x"]})

    return of


def mass_of(bogie: Bogie) -> float:
    """Mass in kg on four wheels, part by part of a drawing."""
    axle = bogie.axle
    beam = 2 * axle.middle_half_length * axle.middle.mass_per_length
    beam += 2 * (axle.half_length - axle.middle_half_length) * axle.outer.mass_per_length
    wheel = bogie.stub.mass + bogie.wheel.hub.mass + bogie.wheel.rim.mass
    return bogie.car_body.mass + bogie.frame.mass + 2 * beam + 4 * wheel


def test_speed_gauge_and_load_are_those_of_the_tram(described) -> None:
    line = described(ARTICULATED).lines["x"]

    assert line.track.speed == pytest.approx(5.0)
    assert mass_of(line.bogie) == pytest.approx(16_000.0)
    assert 2 * line.bogie.wheel.half_distance == pytest.approx(1.065)  # rails' edges and 65 mm
    assert pytest.approx(2.13) == 2 * line.wheelset.L


def test_what_is_inside_the_wheels_stays_there(described) -> None:
    """As far from the wheel as at the paper's; the beam keeps the shares of its sections."""
    paper, line = (described(text).lines["x"].bogie for text in ("", ARTICULATED))
    moved = line.wheel.half_distance - paper.wheel.half_distance

    for part in ("primary", "secondary", "stub", "absorber"):
        old, new = (getattr(bogie, part).lateral_position for bogie in (paper, line))
        assert new - old == pytest.approx(moved)
    assert line.axle.half_length < line.wheel.half_distance
    share = paper.axle.middle_half_length / paper.axle.half_length
    assert line.axle.middle_half_length / line.axle.half_length == pytest.approx(share, rel=1e-5)


def test_bands_are_left_to_the_bogie_unless_given(described) -> None:
    band = "study: {tendency_maps: {design_band: {min: 60, max: 80}}}\n"
    free, own = described(""), described(band)
    assert used_values(free, "x", "robust_tuning")["study"]["design_band"] is None
    assert used_values(free, "x", "evolution_tendency")["study"]["peaks"] is None
    own_band = used_values(own, "x", "robust_tuning")["study"]["design_band"]
    assert own_band == {"min": 60.0, "max": 80.0}
    # The file of the modes is read by what needs it, and by nothing else.
    for stage, when in (("tendency_design_chart", (True, False)), ("robust_tuning", (True, True))):
        reads = [stages_read(each, "x", stage, ["basic_model"]) for each in (free, own)]
        assert [bool(read) for read in reads] == list(when), stage


def test_rails_lean_as_the_tram_s_track_says(described) -> None:
    lines = [described(t).lines["x"] for t in ("tram: {rail_inclination_1_to: 40}\n", "")]
    leaning, upright = (line.contact_geometry.rail.inclination for line in lines)
    assert (leaning, upright) == (pytest.approx(0.025), 0.0)
    with pytest.raises(ConfigurationError, match="rail_inclination_1_to = 20 makes"):
        described(
            "tram: {rail_inclination_1_to: 20}\ncontact_geometry: {rail: {inclination: 0.025}}\n"
        )


def test_a_load_on_a_wheel_is_a_quarter_of_the_bogie(described) -> None:
    wheel, axle = (
        described(f"tram: {{{key}: {load}}}").lines["x"].bogie.car_body
        for key, load in (("wheel_load_t", 4), ("axle_load_t", 8))
    )
    assert wheel == axle


def test_maps_cover_the_line_s_own_speed_and_radius(described) -> None:
    maps = described("track: {radius: 60, speed: 10}").lines["x"].study.tendency_maps

    assert maps.radius.min < 60 < maps.radius.max
    assert maps.speed.min < 10 < maps.speed.max


def test_given_ranges_stay(described) -> None:
    text = "track: {radius: 60}\nstudy: {tendency_maps: {radius: {min: 50, max: 70}}}"
    radius = described(text).lines["x"].study.tendency_maps.radius

    assert (radius.min, radius.max) == (50, 70)


def test_basic_model_is_the_bogie_s_but_for_what_the_file_gives(described) -> None:
    cfg = used_values(described("wheelset: {c_A: 6.0e+7}"), "x", "stability_map")

    assert cfg["wheelset"]["c_A"] == 6.0e7
    left = {key: cfg["wheelset"][key] for key in ("m_A", "m_R", "d_A", "c_R", "d_R")}
    assert left == dict.fromkeys(left)
    assert cfg["curve"] == dict.fromkeys(("r_C", "gamma", "outer_speed"))
    assert cfg["creep_force"]["mu_0"] == 0.35


def test_the_paper_s_line_gives_everything(root: Path) -> None:
    configuration = load(root / "config")

    assert configuration.derived["paper"] == ()
    for stage in ("stability_map", "absorber_tuning", "wheelset_designs"):
        cfg = used_values(configuration, "paper", stage)
        values = [v for section in cfg.values() if isinstance(section, dict) for v in section]
        assert None not in values


@pytest.mark.refuses
@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("curve: {r_C: 20}", ("curve.r_C = 20 m", "track.radius = 25 m", "25.75 m")),
        ("curve: {outer_speed: 3.3}", ("curve.outer_speed = 3.3 m/s", "4.12 m/s")),
        ("creep_force: {F_N: 60000}", ("creep_force.F_N = 60000 N", "11000 kg", "N:")),
        ("tram: {speed_km_h: 18}\ntrack: {speed: 4}", ("tram.speed_km_h = 18", "track.speed = 4")),
        (
            "tram: {gauge_mm: 1000}\nbogie: {wheel: {half_distance: 0.75}}",
            ("tram.gauge_mm = 1000", "bogie.wheel.half_distance = 0.75"),
        ),
        (
            "tram: {wheel_load_t: 1}\nbogie: {frame: {mass: 3000}}",
            ("tram.wheel_load_t = 1", "nothing is left for the car"),
        ),
        ("tram: {axle_load_t: 8, wheel_load_t: 4}", ("axle_load_t and wheel_load_t",)),
        ("tram: {speed_km_h: 180}", ("tram.speed_km_h = 180", "between 1.8 and 108 km/h")),
        ("tram: 8", ("tram: must be a map",)),
        ("bogie: {primary: {lateral_position: 0.8}}", ("0.8 m", "0.75 m")),
        ("bogie: {stub: {lateral_position: 0.9}}", ("0.9 m", "0.75 m")),
        ("track: {radius: 12}", ("0.0724", "0.065")),
    ],
)
def test_contradictions_are_told_with_both_numbers(described, text: str, numbers) -> None:
    with pytest.raises(ConfigurationError) as refused:
        described(text)

    (line,) = str(refused.value).splitlines()
    assert line.startswith("config/lines/x.yaml: ")
    for number in numbers:
        assert number in line


def test_mass_of_the_bogie_is_that_of_its_parts(root: Path) -> None:
    line = load(root / "config").lines["paper"]
    values = line.model_dump(mode="json")

    mass = following.bogie_mass(lambda path: following.number_at(values, path))
    assert mass == pytest.approx(mass_of(line.bogie) - line.bogie.car_body.mass)
