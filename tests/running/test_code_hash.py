"""The hash of a stage's code: it follows what can change results and nothing else."""

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tramdva.running import code_hash as hashing
from tramdva.running.code_hash import WITHOUT_EFFECT, code_hash, reached_modules


def hash_after(package: Path, name: str, text: str) -> str:
    (package / name).write_text(text)
    return code_hash(package.parent / "wear.py", package=package)


@pytest.mark.parametrize(
    "name",
    [
        "../wear.py",
        "__init__.py",
        "results.py",
        "variables/kinds.py",
        "variables/wear.py",
        "force.py",
        "wear.py",
        "contact/__init__.py",
        "contact/hertz.py",
        "contact/kalker.py",
    ],
)
def test_edit_of_reached_code_counts(package: Path, name: str) -> None:
    before = code_hash(package.parent / "wear.py", package=package)
    text = (package / name).read_text()

    assert hash_after(package, name, f"{text}edited = 1\n") != before


@pytest.mark.parametrize("name", ["alone.py", "contact/fastsim.py", "running/job.py"])
def test_edit_of_other_code_does_not_count(package: Path, name: str) -> None:
    before = code_hash(package.parent / "wear.py", package=package)
    text = (package / name).read_text()

    assert hash_after(package, name, f"{text}edited = 1\n") == before


@pytest.mark.parametrize(
    "text",
    [
        "def force(w):\n    return 2 * w\n",
        '"""Other words."""\n# comment\ndef force(w):\n\n    """Others."""\n    return (2 * w)\n',
        "def force( w ):\n    return 2*w",
    ],
)
def test_comments_docstrings_and_format_do_not_count(package: Path, text: str) -> None:
    before = code_hash(package.parent / "wear.py", package=package)

    assert hash_after(package, "force.py", text) == before


@pytest.mark.parametrize("name", ["variables/force.py", "variables/registry.py"])
def test_variables_of_other_stages_do_not_count(package: Path, name: str) -> None:
    before = code_hash(package.parent / "wear.py", package=package)

    assert hash_after(package, name, "VARIABLES, STAGES = 3, [4]\n") == before


def test_dates_and_place_do_not_count(package: Path, tmp_path: Path) -> None:
    before = code_hash(package.parent / "wear.py", package=package)
    moved = shutil.copytree(package, tmp_path / "moved" / "tramdva")
    shutil.copy(package.parent / "wear.py", tmp_path / "moved")
    os.utime(package / "force.py", (0, 0))

    assert code_hash(package.parent / "wear.py", package=package) == before
    assert code_hash(tmp_path / "moved/wear.py", package=moved) == before


def test_data_count(package: Path, tmp_path: Path) -> None:
    script, style = package.parent / "wear.py", tmp_path / "x.mplstyle"
    style.write_text("lines.linewidth: 1\n")
    before = code_hash(script, style, package=package)
    style.write_text("lines.linewidth: 2\n")

    assert code_hash(script, style, package=package) != before


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("from . import force\n", "line 1: relative imports are not followed"),
        ("from tramdva import springs\n", "there is no module tramdva.springs"),
        ("import tramdva.springs\n", "there is no module tramdva.springs"),
    ],
)
def test_imports_that_cannot_be_followed(package: Path, text: str, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        hash_after(package, "wear.py", text)


# Runs a script without its main part and reports the modules that Python then has loaded.
LOADED = """
import json, runpy, sys
import matplotlib; matplotlib.use("agg")
loaded = {}
for script in sys.argv[1:]:
    for name in [name for name in sys.modules if name.partition(".")[0] == "tramdva"]:
        del sys.modules[name]
    runpy.run_path(script)
    loaded[script] = [name for name in sys.modules if name.partition(".")[0] == "tramdva"]
print(json.dumps(loaded))
"""


def test_reached_modules_are_those_that_python_loads(root: Path) -> None:
    scripts = sorted(
        map(str, [*root.glob("workflow/scripts/*.py"), *root.glob("paper_figures/*.py")])
    )
    ran = subprocess.run(
        [sys.executable, "-c", LOADED, *scripts], capture_output=True, text=True, check=True
    )

    for script, loaded in json.loads(ran.stdout).items():
        reached = reached_modules(Path(script))
        assert reached == set(loaded) - WITHOUT_EFFECT, script


def test_all_scripts_are_hashed_in_two_seconds(root: Path) -> None:
    scripts = [*root.glob("workflow/scripts/*.py"), *root.glob("paper_figures/*.py")]
    start = time.process_time()
    hashes = {code_hash(script) for script in scripts}

    assert time.process_time() - start < 2.0  # each start of snakemake waits for it
    assert len(hashes) == len(scripts)


def test_another_version_of_what_computes_counts(package: Path, monkeypatch) -> None:
    before = code_hash(package.parent / "wear.py", package=package)
    monkeypatch.setattr(hashing, "computing_versions", lambda: "numpy 0.1")

    assert code_hash(package.parent / "wear.py", package=package) != before
