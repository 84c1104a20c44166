"""The hash of a stage's code: it follows what can change results and nothing else."""

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tramdva.running.code_hash import WITHOUT_EFFECT, code_hash, reached_modules
from tramdva.running.numba_cache import use_numba_cache

SOURCES = {
    "__init__.py": '"""Nomenclature."""\n',
    "results.py": (
        "import importlib\nfrom tramdva.variables import kinds\n"
        "def read():\n    return importlib.import_module('tramdva.variables.registry')\n"
    ),
    "variables/__init__.py": '"""Variables."""\n',
    "variables/kinds.py": "KINDS = 1\n",
    "variables/registry.py": "from tramdva.variables import force, wear\nSTAGES = [force, wear]\n",
    "variables/wear.py": "from tramdva.variables import kinds\nVARIABLES = 1\n",
    "variables/force.py": "VARIABLES = 2\n",
    "running/__init__.py": '"""Running."""\n',
    "running/job.py": "import logging\n",
    "force.py": '"""Force."""\n\n\ndef force(w):\n    """Return it."""\n    return 2 * w  # N\n',
    "wear.py": (
        "import tramdva.contact.hertz as hertz\nfrom tramdva import force\n"
        "from tramdva.variables.wear import VARIABLES\n"
    ),
    "alone.py": "x = 1\n",
    "contact/__init__.py": '"""Contact."""\n',
    "contact/hertz.py": (
        "@njit(cache=True)\ndef late():\n    from tramdva.contact.kalker import c\n    return c\n"
    ),
    "contact/kalker.py": "c = 1\n",
    "contact/fastsim.py": "c = 1\n",
}


@pytest.fixture
def package(tmp_path: Path) -> Path:
    for name, text in SOURCES.items():
        path = tmp_path / "tramdva" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (tmp_path / "wear.py").write_text(
        "from tramdva import results, wear\nfrom tramdva.running import job\n"
    )
    return tmp_path / "tramdva"


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


def test_compiled_code_has_a_folder_per_state_of_the_sources(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    first = use_numba_cache(package)
    (package / "contact/kalker.py").write_text("c = 2\n")
    second = use_numba_cache(package)

    assert first.parent == second.parent == tmp_path / "cache"
    assert first != second
    assert second.is_dir()


def test_sources_without_compiled_functions_leave_the_compiled_code_as_it_is(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    first = use_numba_cache(package)
    (package / "alone.py").write_text("x = 2\n")
    (package / "contact/hertz.py").write_text(SOURCES["contact/hertz.py"] + "# a comment\n")

    assert use_numba_cache(package) == first


def test_folder_of_a_parent_process_is_kept(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    first = use_numba_cache(package)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(first))

    assert use_numba_cache(package) == first


def test_folder_where_the_home_cannot_be_written(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("NUMBA_CACHE_DIR")
    (tmp_path / "home").write_text("a file where a folder should be")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home"))
    monkeypatch.chdir(tmp_path)

    assert use_numba_cache(package).parent == tmp_path / ".snakemake/tramdva"


def test_unused_folders_are_removed(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    old, recent, other = (tmp_path / "cache" / name for name in ("sources-a", "sources-b", "c"))
    for folder in (old, recent, other):
        folder.mkdir(parents=True)
        (folder / "f.nbi").touch()
    month_ago = time.time() - 31 * 86400
    for folder in (old, other):
        os.utime(folder, (month_ago, month_ago))

    use_numba_cache(package)

    assert [folder.exists() for folder in (old, recent, other)] == [False, True, True]
