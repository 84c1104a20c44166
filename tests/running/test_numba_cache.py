"""The folder of compiled code: one per state of the sources."""

import os
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
