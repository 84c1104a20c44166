"""The folder of compiled code: one per state of the sources."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tramdva.running.numba_cache import use_numba_cache


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
    hertz = package / "contact/hertz.py"
    hertz.write_text(hertz.read_text() + "# a comment\n")

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


PROGRAM = """
import sys
from pathlib import Path
from tramdva.running.numba_cache import use_numba_cache
use_numba_cache(Path(sys.argv[1]) / "tramdva")
sys.path.insert(0, sys.argv[1])
del sys.modules["tramdva"], sys.modules["tramdva.running"]
from tramdva.contact.area import area
area(1.0)
print(sum(area.stats.cache_hits.values()))
"""
AREA = "from numba import njit\n@njit(cache=True)\ndef area(w):\n    return 3.0 * w * w\n"


def copy_of_area(package: Path, folder: Path) -> Path:
    """Write another copy of the package in which Numba can compile something."""
    copy = shutil.copytree(package, folder / "tramdva")
    (copy / "contact/hertz.py").unlink()
    (copy / "wear.py").unlink()
    (copy / "contact/area.py").write_text(AREA)
    return folder


def test_copies_of_the_same_sources_compile_once(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    first, second = (copy_of_area(package, tmp_path / name) for name in ("first", "second"))

    def hits(folder: Path) -> int:
        program = [sys.executable, "-c", PROGRAM, str(folder)]
        return int(subprocess.run(program, capture_output=True, text=True, check=True).stdout)

    assert [hits(folder) for folder in (first, second, first)] == [0, 1, 1]
    # A comment is no other code, but Numba knows functions by their lines: it compiles anew.
    (second / "tramdva/contact/area.py").write_text(f"# comment\n{AREA}")
    assert [hits(folder) for folder in (second, second, first)] == [0, 1, 1]


def test_links_into_the_cache_are_removed_with_it(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    old = use_numba_cache(package)
    assert any(path.is_symlink() for path in old.iterdir())
    os.utime(old, (1e9, 1e9))
    (package / "contact/kalker.py").write_text("c = 2\n")

    use_numba_cache(package)

    assert not old.exists()
