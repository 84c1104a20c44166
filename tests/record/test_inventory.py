"""Files in `results/` that this pipeline did not make here."""

import base64
import json
import os
import time
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from test_results import values_of

from tramdva import results
from tramdva.configuration.reading import load
from tramdva.configuration.uses import USES, used_values
from tramdva.record import inventory
from tramdva.running import stamps
from tramdva.running.code_hash import code_hash
from tramdva.variables.registry import STAGES

PATH = Path("results/paper/hopf_points.nc")
ASIDE = Path("results/paper/hopf_points.nc.set-aside")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def look(root: Path):
    """Look through the results with the paper's configuration."""
    configuration = load(root / "config")
    return lambda: inventory.set_aside_unusable(configuration, root / "workflow/scripts")


def write(root: Path, path: Path = PATH, stage: str = "hopf_points", **changes) -> None:
    """Write a result that fits the configuration and the code, but for the changes."""
    known = stage in USES
    cfg = used_values(load(root / "config"), "paper", stage) if known else {}
    code = code_hash(root / f"workflow/scripts/{stage}.py")
    made_with = {"parameters": cfg, "code": code} | changes
    results.save(path, STAGES[stage], values_of(stage), **made_with)


def record(path: Path) -> None:
    """Imitate Snakemake's record of a file."""
    name = base64.urlsafe_b64encode(str(path).encode()).decode()
    file = Path(".snakemake/metadata", name)
    file.parent.mkdir(parents=True)
    file.write_text(json.dumps({"endtime": path.stat().st_mtime}))


@pytest.mark.parametrize("stage", STAGES)
def test_fitting_file_stays(root: Path, look, capsys, stage: str) -> None:
    paths = [Path(f"results/paper/{stage}.nc"), Path(f"results/paper/{stage}/tuned/order_6.nc")]
    for path in paths:
        write(root, path, stage)
    look()

    assert all(path.exists() for path in paths)
    assert not capsys.readouterr().err


@pytest.mark.parametrize("share", [0.0, 0.5, 0.999])
def test_truncated_file_is_set_aside(root: Path, look, capsys, share: float) -> None:
    write(root)
    whole = PATH.read_bytes()
    PATH.write_bytes(whole[: int(share * len(whole))])
    look()

    assert not PATH.exists()
    assert ASIDE.exists()
    said = capsys.readouterr().err
    assert said.startswith(f"tramdva: {PATH}: is no complete netCDF file (")
    assert said.endswith(f"; it is now {ASIDE.name} and will be made again\n")


def test_foreign_file_is_set_aside(look, capsys) -> None:
    PATH.parent.mkdir(parents=True)
    with netCDF4.Dataset(PATH, "w") as dataset:
        dataset.title = "weather"
    look()

    assert ASIDE.exists()
    assert "is no result of tramdva" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"parameters": {"numerics": {"points": 7}}}, "made with other parameters;"),
        ({"code": "0" * 20}, "made with other code;"),
        ({"parameters": {}, "code": ""}, "made with other parameters and code;"),
    ],
)
def test_file_made_otherwise_is_set_aside(root: Path, look, capsys, changes, said: str) -> None:
    write(root, **changes)
    look()

    assert ASIDE.exists()
    assert said in capsys.readouterr().err


def test_file_of_other_packages_is_set_aside(root: Path, look, capsys, monkeypatch) -> None:
    with monkeypatch.context() as patched:
        patched.setattr(stamps, "package_versions", lambda: "numpy 0.1, scipy 0.1")
        write(root)
    look()

    assert ASIDE.exists()
    assert "made with other packages (numpy 0.1, scipy 0.1);" in capsys.readouterr().err


def test_file_whose_values_were_changed_is_set_aside(root: Path, look, capsys) -> None:
    write(root)
    with netCDF4.Dataset(PATH, "a") as dataset:
        dataset["frequency"][0] = 55.0
    look()

    assert ASIDE.exists()
    assert "its values are not those that were saved" in capsys.readouterr().err


def test_results_of_another_stage_are_set_aside(root: Path, look, capsys) -> None:
    write(root, stage="stability_map")
    look()

    assert ASIDE.exists()
    assert "holds the results of stability_map" in capsys.readouterr().err


def test_what_snakemake_recorded_is_left_to_it(root: Path, look) -> None:
    """After a change of the configuration: going back to it must not cost the results."""
    write(root, parameters={}, code="")
    record(PATH)
    look()

    assert PATH.exists()


def test_recorded_file_that_was_replaced_is_set_aside(root: Path, look) -> None:
    write(root)
    record(PATH)
    PATH.write_text("wheel")
    os.utime(PATH, (1, 1))
    look()

    assert ASIDE.exists()


def test_other_lines_are_left_alone(root: Path, look) -> None:
    other = Path("results/other/hopf_points.nc")
    other.parent.mkdir(parents=True)
    other.write_text("wheel")
    look()

    assert other.exists()


def test_file_that_cannot_be_moved(look, monkeypatch: pytest.MonkeyPatch) -> None:
    def replace(*arguments: object) -> None:
        raise OSError(30, "Read-only file system")

    PATH.parent.mkdir(parents=True)
    PATH.write_text("wheel")
    monkeypatch.setattr(Path, "replace", replace)

    with pytest.raises(SystemExit, match="it cannot be set aside: Read-only file system"):
        look()


def test_dates_in_the_future_are_taken_back_in_order(capsys) -> None:
    now = time.time()
    dates = {"results/a/x.nc": now - 50, "logs/a/x.log": now + 90, "results/a/y.nc": now + 100}
    for name, date in dates.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).touch()
        os.utime(name, (date, date))

    inventory.take_back_dates("results", "paper_figures", "logs")

    taken = [Path(name).stat().st_mtime for name in dates]
    assert taken == sorted(taken)
    assert now - 5 < taken[-1] < now
    np.testing.assert_allclose(np.diff(taken), [140, 10], atol=1e-3)
    assert "the clock was put back: files are taken back by 101 s" in capsys.readouterr().err


def test_dates_of_the_past_stay(capsys) -> None:
    PATH.parent.mkdir(parents=True)
    PATH.touch()
    os.utime(PATH, (5, 5))

    inventory.take_back_dates("results")

    assert PATH.stat().st_mtime == 5
    assert not capsys.readouterr().err
