"""Compiled kernels in a folder that belongs to exactly these sources."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import time
from contextlib import suppress
from importlib import metadata
from pathlib import Path

from tramdva.running.cache_folders import cache_roots
from tramdva.running.code_hash import PACKAGE, reached_from, read_module

UNUSED_AFTER = 30 * 86400  # seconds after which a folder of compiled code is removed


def use_numba_cache(package: Path = PACKAGE) -> Path:
    """Let Numba keep compiled code in a folder that belongs to exactly these sources.

    Numba does not notice that a function in another file changed; a folder named by the hash of
    all modules with compiled functions, and of what they import, does. It is below NUMBA_CACHE_DIR
    or else in the cache of the user or, where that cannot be written, in the working directory.
    NUMBA_CACHE_DIR is set for this process and those that it starts; call this before Numba is
    imported. Copies of the same sources share what was compiled. Folders that were unused for long
    are removed.
    """
    folder = _numba_cache_folder(package)
    os.environ["NUMBA_CACHE_DIR"] = str(folder)
    with suppress(OSError):  # where there are no links, each copy compiles for itself
        _share_between_copies(folder, package)
    return folder


def compile_kernels_once(package: Path = PACKAGE) -> None:
    """Compile all kernels where the folder of `use_numba_cache` does not hold them yet.

    A kernel that was just compiled and the same kernel out of the cache can differ in the last
    bit: each is optimised with other functions in sight. So all jobs take theirs from the cache.
    """
    # Numba keeps what it compiled by its own version, that of Python, and the place and the content
    # of the sources.
    folder = Path(os.environ["NUMBA_CACHE_DIR"])
    kept_by = f"{_content_hash(package)} {sys.version_info[:2]} {metadata.version('numba')}"
    if not all(copy.is_symlink() for copy in _folders_of_copy(folder, package).values()):
        kept_by += f" {package}"
    done = folder / f"complete-{hashlib.sha256(kept_by.encode()).hexdigest()[:20]}"
    if done.is_file():
        return
    print("tramdva: compiling, once for this version of the code (a minute)", flush=True)
    program = "from tramdva.stages.warm_up import compile_kernels; compile_kernels()"
    if subprocess.run([sys.executable, "-c", program], check=False).returncode == 0:
        with suppress(OSError):
            done.touch()


def _numba_cache_folder(package: Path) -> Path:
    name = f"sources-{_compiled_code_hash(package)}"
    for root in cache_roots():
        folder = root if root.name == name else root / name
        try:
            folder.mkdir(parents=True, exist_ok=True)
            os.utime(folder)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            _remove_unused(folder)
            return folder
    return folder


def _share_between_copies(folder: Path, package: Path) -> None:
    """Lead the folders that Numba names by the place of the sources to one for their content."""
    content = f"content-{_content_hash(package)}"
    for name, copy in _folders_of_copy(folder, package).items():
        (folder / content / name).mkdir(parents=True, exist_ok=True)
        target = Path(content, name)
        if copy.is_dir() and (not copy.is_symlink() or copy.readlink() == target):
            continue
        link = folder / f"{copy.name}.{os.getpid()}"
        link.symlink_to(target, target_is_directory=True)
        link.replace(copy)


def _folders_of_copy(folder: Path, package: Path) -> dict[str, Path]:
    """Where Numba (`get_suitable_cache_subpath`) keeps the functions of folders of the package."""
    places = {path.absolute().parent for path in _compiled_files(package)}
    return {
        os.path.relpath(place, package): folder
        / f"{place.name}_{hashlib.sha1(str(place).encode()).hexdigest()}"
        for place in places
    }


def _content_hash(package: Path) -> str:
    """Hash the bytes of the modules that compile functions."""
    digest = hashlib.sha256()
    for path in _compiled_files(package):
        digest.update(os.path.relpath(path, package).encode() + path.read_bytes())
    return digest.hexdigest()[:20]


def _compiled_code_hash(package: Path) -> str:
    """Hash the modules that compile functions and everything that they import."""
    modules = {}
    for path in _compiled_files(package):
        own = read_module(path)
        found = (own, *reached_from(own, package).values())
        modules |= {os.path.relpath(module.path, package): module for module in found}
    digest = hashlib.sha256()
    for place, module in sorted(modules.items()):
        digest.update((place + module.code.digest).encode())
    return digest.hexdigest()[:20]


def _compiled_files(package: Path) -> list[Path]:
    """Name the modules that compile functions."""
    return [path for path in sorted(package.rglob("*.py")) if read_module(path).code.compiles]


def _remove_unused(current: Path) -> None:
    for folder in current.parent.glob("sources-*"):
        try:
            if folder != current and folder.stat().st_mtime < time.time() - UNUSED_AFTER:
                for file in sorted(folder.rglob("*"), reverse=True):
                    file.rmdir() if _is_folder(file) else file.unlink()
                folder.rmdir()
        except OSError:
            continue


def _is_folder(file: Path) -> bool:
    """Tell whether a file is a folder and no link to one."""
    return file.is_dir() and not file.is_symlink()
