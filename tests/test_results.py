"""Result files: validated, stamped, atomic, bit-identical."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

import netCDF4
import numpy as np
import pytest

from tramdva import results
from tramdva.variables.kinds import Stage, real
from tramdva.variables.registry import STAGES

PACKAGES = ("numpy", "scipy", "numba", "llvmlite", "netCDF4")
LENGTHS = {"absorber": 3, "design": 4, "frequency": 7, "multiplier": 6}


def values_of(stage: str, length: int = 5) -> dict[str, np.ndarray]:
    """Values that fit the registry, of the given length along all other dimensions."""
    random = np.random.default_rng(1)
    values = {}
    for name, variable in STAGES[stage].variables.items():
        shape = tuple(LENGTHS.get(d, length) if length else 0 for d in variable.dimensions)
        if variable.kind == "text":
            count = int(np.prod(shape))
            values[name] = np.array([f"①{i}" for i in range(count)], dtype=str).reshape(shape)
        elif variable.kind == "real":
            values[name] = random.random(shape)
        elif variable.kind == "truth":
            values[name] = random.random(shape) < 0.5
        else:
            values[name] = random.integers(0, len(variable.meanings), shape)
    return values


def save(path: Path, values: dict, stage: str = "hopf_points") -> None:
    results.save(path, STAGES[stage], values, parameters={"b": 1.0, "a": [2]}, code="abc")


@pytest.mark.parametrize("length", [0, 1, 5])
@pytest.mark.parametrize("stage", STAGES)
def test_what_is_saved_is_read(tmp_path: Path, stage: str, length: int) -> None:
    values = values_of(stage, length)
    save(tmp_path / "x.nc", values, stage)

    read = results.read(tmp_path / "x.nc")

    assert list(read) == list(STAGES[stage].variables)
    for name, variable in STAGES[stage].variables.items():
        expected = values[name]
        if variable.kind == "flag":
            expected = np.array(variable.meanings)[expected]
        np.testing.assert_array_equal(read[name], expected)
        assert read[name].dtype.kind == {"real": "f", "truth": "b"}.get(variable.kind, "U")


@pytest.mark.parametrize("stage", STAGES)
def test_dataset_follows_the_registry(tmp_path: Path, stage: str) -> None:
    save(tmp_path / "x.nc", values_of(stage), stage)

    dataset = results.load(tmp_path / "x.nc")

    assert dataset.attrs == {
        "title": STAGES[stage].title,
        "stage": stage,
        "tramdva_version": version("tramdva"),
        "packages": ", ".join(f"{name} {version(name)}" for name in PACKAGES),
        "content_hash": dataset.attrs["content_hash"],
        "code_hash": "abc",
        "parameters": '{"a": [2], "b": 1.0}',
    }
    assert set(dataset.variables) == set(STAGES[stage].variables)
    for name, variable in STAGES[stage].variables.items():
        stored = dataset[name]
        assert stored.dims == variable.dimensions
        assert stored.attrs["units"] == variable.unit
        assert stored.attrs["long_name"] == variable.long_name
        if variable.meanings:
            assert stored.dtype == np.int8
            assert stored.attrs["flag_meanings"].split() == list(variable.meanings)
            assert stored.attrs["flag_values"].tolist() == list(range(len(variable.meanings)))


@pytest.mark.parametrize("name", ["frequency", "residual", "absorber", "parameters"])
def test_changed_values_are_found(tmp_path: Path, name: str) -> None:
    save(tmp_path / "x.nc", values_of("hopf_points"))
    results.verify(tmp_path / "x.nc")
    with netCDF4.Dataset(tmp_path / "x.nc", "a") as dataset:
        if name == "parameters":
            dataset.parameters = '{"a": [3], "b": 1.0}'
        else:
            dataset.set_auto_chartostring(False)
            values = dataset[name][...]
            values[0] = values[-1]  # as many bytes as before, and allowed
            dataset[name][...] = values

    for way in (results.verify, results.read):
        with pytest.raises(ValueError, match=r"x\.nc: its values are not those that were saved"):
            way(tmp_path / "x.nc")


@pytest.mark.parametrize("stage", STAGES)
def test_rewriting_gives_the_same_bytes(tmp_path: Path, stage: str) -> None:
    for name in ("a.nc", "b.nc"):
        save(tmp_path / name, values_of(stage), stage)
        time.sleep(0.01)

    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


def test_another_process_writes_the_same_bytes(tmp_path: Path) -> None:
    code = (
        "import sys; sys.path.insert(0, sys.argv[1]); import test_results as t; "
        "t.save(t.Path(sys.argv[2]), t.values_of('hopf_points'))"
    )
    for seed in ("1", "2"):
        subprocess.run(
            [sys.executable, "-c", code, Path(__file__).parent, tmp_path / seed],
            env=os.environ | {"PYTHONHASHSEED": seed, "TZ": f"UTC{seed}"},
            check=True,
        )

    assert (tmp_path / "1").read_bytes() == (tmp_path / "2").read_bytes()


def test_flags_by_meaning_or_number(tmp_path: Path) -> None:
    values = values_of("hopf_points", 2)
    save(tmp_path / "a.nc", values | {"status": ["converged", "not_converged"]})
    save(tmp_path / "b.nc", values | {"status": [0, 1]})

    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"speed": [1.0]}, "hopf_points: unknown variable speed"),
        ({"c_A": None}, "hopf_points: missing variable c_A"),
        ({"c_A": [1.0]}, r"frequency|c_A: has length 1 along hopf_point, others have 5"),
        ({"c_A": np.ones((5, 1))}, r"c_A: has shape \(5, 1\), must have dimensions"),
        ({"c_A": 1.0}, r"c_A: has shape \(\), must have dimensions \(hopf_point\)"),
        ({"c_A": np.ones(5) * 1j}, "c_A: must be real numbers, not complex128"),
        ({"c_A": ["a"] * 5}, "c_A: must be real numbers, not <U1"),
        ({"c_A": [None] * 5}, "c_A: must be real numbers, not object"),
        ({"c_A": np.ma.masked_array(np.ones(5), [1, 0, 0, 0, 0])}, "c_A: is a masked array"),
        ({"absorber": np.ones(5)}, "absorber: must be texts, not float64"),
        ({"status": [9] * 5}, "status: must be between 0 and"),
        ({"status": [-1] * 5}, "status: must be between 0 and"),
        ({"status": [0.5] * 5}, "status: must be flags, not float64"),
        ({"status": ["fine"] * 5}, "status: fine is none of converged, not_converged"),
    ],
)
def test_wrong_values_are_refused(tmp_path: Path, change: dict, problem: str) -> None:
    values = {k: v for k, v in (values_of("hopf_points") | change).items() if v is not None}

    with pytest.raises(ValueError, match=problem):
        save(tmp_path / "x.nc", values)
    assert not list(tmp_path.iterdir())


def test_file_of_an_unknown_stage_is_refused(tmp_path: Path) -> None:
    stage = Stage("hopf_point", "One Hopf point", {"c_A": real("", "N/m", "stiffness")})
    results.save(tmp_path / "x.nc", stage, {"c_A": 1.0}, parameters={}, code="")

    with pytest.raises(ValueError, match="is no result of tramdva"):
        results.read(tmp_path / "x.nc")


def test_nan_among_parameters_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="not JSON compliant"):
        results.save(
            tmp_path / "x.nc",
            STAGES["hopf_points"],
            values_of("hopf_points"),
            parameters={"a": float("nan")},
            code="",
        )


@pytest.mark.parametrize("share", [0.0, 0.001, 0.3, 0.9, 0.9999])
def test_truncated_file_is_refused(tmp_path: Path, share: float) -> None:
    path = tmp_path / "x.nc"
    save(path, values_of("hopf_points"))
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole))])

    for load in (results.read, results.load, results.read_parameters):
        with pytest.raises(ValueError, match=f"{path}: is no complete netCDF file"):
            load(path)


def test_last_byte_counts(tmp_path: Path) -> None:
    path = tmp_path / "x.nc"
    save(path, values_of("hopf_points"))
    path.write_bytes(path.read_bytes()[:-1])

    with pytest.raises(ValueError, match="is no complete netCDF file"):
        results.read(path)


def test_foreign_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "x.nc"
    with netCDF4.Dataset(path, "w") as dataset:
        dataset.title = "weather"
    with pytest.raises(ValueError, match="is no result of tramdva"):
        results.read(path)
    path.write_text("wheel")
    with pytest.raises(ValueError, match="is no complete netCDF file"):
        results.load(path)
    with pytest.raises(ValueError, match="there is no such file"):
        results.load(tmp_path / "y.nc")


def test_file_of_another_version_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "x.nc"
    save(path, values_of("hopf_points"))
    with netCDF4.Dataset(path, "a") as dataset:
        dataset.renameVariable("frequency", "f")

    with pytest.raises(ValueError, match="lacks frequency: made by another version"):
        results.read(path)


def test_parameters_are_read_back(tmp_path: Path) -> None:
    save(tmp_path / "x.nc", values_of("hopf_points"))

    assert results.read_parameters(tmp_path / "x.nc") == json.loads('{"a": [2], "b": 1.0}')


def test_loaded_file_can_be_rewritten(tmp_path: Path) -> None:
    path = tmp_path / "x.nc"
    save(path, values_of("hopf_points"))
    dataset, arrays = results.load(path), results.read(path)
    save(path, values_of("hopf_points", 2))

    assert dataset.sizes["hopf_point"] == len(arrays["c_A"]) == 5
    assert len(results.read(path)["c_A"]) == 2


def test_xarray_is_imported_only_where_it_is_needed() -> None:
    code = "import sys, tramdva.results; print('xarray' in sys.modules, 'pandas' in sys.modules)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert ran.stdout.split() == ["False", "False"]


WRITER = """
import sys; sys.path.insert(0, sys.argv[1])
import numpy as np
from pathlib import Path
from test_results import save, values_of
small, large = values_of("hopf_points", 3), values_of("hopf_points", 20000)
print("ready", flush=True)
while True:
    save(Path(sys.argv[2]), small)
    save(Path(sys.argv[2]), large)
"""


def test_kill_at_any_moment_leaves_a_whole_file(tmp_path: Path) -> None:
    path = tmp_path / "x.nc"
    random = np.random.default_rng(1)
    lengths = set()
    for _ in range(12):
        with subprocess.Popen(
            [sys.executable, "-c", WRITER, Path(__file__).parent, path], stdout=subprocess.PIPE
        ) as writer:
            writer.stdout.readline()
            time.sleep(0.01 + random.random() * 0.15)
            writer.send_signal(signal.SIGKILL)
        if path.exists():
            lengths.add(len(results.read(path)["c_A"]))

    assert lengths <= {3, 20000}
    assert lengths
    save(path, values_of("hopf_points"))
    assert [file.name for file in tmp_path.iterdir()] == ["x.nc"]


def test_first_write_that_is_killed_leaves_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def killed(descriptor: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", killed)
    with pytest.raises(KeyboardInterrupt):
        save(tmp_path / "x.nc", values_of("hopf_points"))

    assert not list(tmp_path.iterdir())


LIMITED = """
import resource, signal, sys; sys.path.insert(0, sys.argv[1])
from pathlib import Path
from test_results import save, values_of
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))
try:
    save(Path(sys.argv[2]), values_of("hopf_points", 20000))
except OSError as error:
    print(error)
"""


def test_full_disk_leaves_the_old_file(tmp_path: Path) -> None:
    """A limit on the size of files fails a write in its middle, as a full disk does."""
    path = tmp_path / "x.nc"
    save(path, values_of("hopf_points"))
    before = path.read_bytes()
    ran = subprocess.run(
        [sys.executable, "-c", LIMITED, Path(__file__).parent, path],
        capture_output=True,
        text=True,
        check=True,
    )

    assert ran.stdout.startswith(f"{path}: cannot be written, disk full?")
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["x.nc"]


def test_folder_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "results").write_text("a file")

    with pytest.raises(OSError, match="results"):
        save(tmp_path / "results/x.nc", values_of("hopf_points"))


def test_large_file_is_compressed(tmp_path: Path) -> None:
    values = values_of("hopf_points", 100_000) | {"c_A": np.zeros(100_000)}
    save(tmp_path / "x.nc", values)
    shutil.copy(tmp_path / "x.nc", tmp_path / "y.nc")

    assert (tmp_path / "x.nc").stat().st_size < 0.95 * sum(v.nbytes for v in values.values())
