"""The line at a glance, and trams as they are in service."""

import importlib.util
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

from tramdva.configuration.reading import load
from tramdva.report import preflight as glance


@pytest.fixture(scope="module")
def trams(root: Path):
    """The script that draws trams as they are in service."""
    path = root / "benchmarks/real_trams.py"
    spec = importlib.util.spec_from_file_location("real_trams", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def coarse(root: Path, tmp_path_factory) -> Path:
    """Copy of the configuration with very coarse numerics."""
    folder = shutil.copytree(root / "config", tmp_path_factory.mktemp("trams") / "config")
    numerics = yaml.safe_load((folder / "quick.yaml").read_text(encoding="utf-8"))
    numerics["numerics"]["contact_geometry"] = {"shift_step": 8.0e-5, "yaw_nodes": 12}
    numerics["numerics"]["bogie"] = {"cells_along": 6, "strips": 6, "cutoff_frequency": 300}
    (folder / "coarse.yaml").write_text(yaml.safe_dump(numerics), encoding="utf-8")
    return folder


def test_trams_are_those_of_their_numbers_and_differ(trams) -> None:
    assert trams.drawn(3) == trams.drawn(3)
    drawn = [trams.drawn(number) for number in range(30)]
    assert {line["tram"]["gauge_mm"] for line in drawn} == {1000, 1435}
    assert {"contact_geometry" in line for line in drawn} == {True, False}
    assert sum(line["track"]["radius"] == trams.STRAIGHT for line in drawn) == 5


@pytest.mark.parametrize("number", [3, 5])
def test_tram_in_service_has_a_result_or_a_reason(trams, coarse: Path, number: int) -> None:
    found = trams.outcome(number, coarse, coarse / "coarse.yaml")

    assert found.error == ""
    assert found.verdict in ("stable", "self_excited") or found.reason
    assert found.words.startswith(("1000 mm", "1435 mm"))


def test_load_on_the_wheels_is_that_of_the_file(trams, coarse: Path) -> None:
    """Equilibrium of the vehicle against the weighbridge's number."""
    line = trams.drawn(3)
    (coarse / "lines/tram-3.yaml").write_text(yaml.safe_dump(line), encoding="utf-8")
    values, basic = trams._stages("tram-3", coarse, coarse / "coarse.yaml")

    mass = 1e3 * line["tram"]["axle_load_t"]
    np.testing.assert_allclose(values["axle_mass"], mass, rtol=2e-3)
    assert values["axle_mass"].sum() == pytest.approx(2.0 * mass, rel=1e-6)
    assert values["speed"] == pytest.approx(line["tram"]["speed_km_h"] / 3.6)
    # The inner wheel of a curve slides at about its angle of attack.
    slip = np.nanmax(values["slip_velocity"][0, 1])
    assert slip == pytest.approx(values["speed"] * values["angle_of_attack"][0, 0], rel=0.15)
    assert basic["r_C"] == pytest.approx(line["track"]["radius"] + 0.75)
    assert basic["gamma"] == -values["angle_of_attack"][0, 0]
    assert 0.8 * basic["critical_frequency"] < basic["band_min"] < basic["critical_frequency"]
    words = glance.text("tram-3", values)
    assert f"{line['tram']['axle_load_t']:.2f} t" in words
    assert "nan" not in words


def lost(**changes) -> dict[str, np.ndarray]:
    """What the file holds where a wheel leaves its table."""
    nothing = np.full((2, 4), np.nan)
    values = {
        "speed": np.array(4.0),
        "radius": np.array(15.0),
        "absorber": np.array(["none", "paper"]),
        "wheel": np.array(["front_outer", "front_inner", "rear_outer", "rear_inner"]),
        "status": np.array(["outside_profile"] * 2),
        "needed_yaw": np.array([0.081, np.nan]),
        "table_yaw": np.array(0.062),
        "axle_mass": np.array([8000.0, 8000.0]),
        "wheel_load": nothing,
        "part": np.array(["a", "b"]),
        "part_jobs": np.array([1.0, 3.0]),
        "part_seconds": np.array([5.0, 300.0]),
        "part_reason": np.array(["a wheel leaves its profile", ""]),
    }
    return values | changes


def test_missing_equilibrium_is_told_with_the_angle_that_was_needed() -> None:
    words = glance.text("sharp", lost())

    assert "81.0 mrad of yaw against the rail are needed, the tables reach 62.0 mrad" in words
    assert "a: no result: a wheel leaves its profile" in words
    assert "b: 3 files, about 5 min" in words
    assert "nan" not in words.lower()


def test_plan_counts_files_and_grows_with_them(root: Path) -> None:
    full, quick = (
        load(root / "config", [root / "config" / name for name in names])
        for names in ((), ("quick.yaml",))
    )
    from tramdva.configuration.plan import plan

    rows = [plan(c.run, c.lines["paper"]) for c in (full, quick)]
    orders = [next(row for row in part if "wear" in row["stages"]) for part in rows]
    assert [part["jobs"] for part in orders] == [2 + 2 * 68 + 2 * 68 + 1, 2 + 2 * 3 + 2 * 3 + 1]
    total = [sum(part["seconds"] for part in row) for row in rows]
    assert total[1] < 0.2 * total[0]
