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
    imported. Folders that were unused for long are removed.
    """
    folder = _numba_cache_folder(package)
    os.environ["NUMBA_CACHE_DIR"] = str(folder)
    return folder


def compile_kernels_once(package: Path = PACKAGE) -> None:
    """Compile all kernels where the folder of `use_numba_cache` does not hold them yet.

    A kernel that was just compiled and the same kernel out of the cache can differ in the last
    bit: each is optimised with other functions in sight. So all jobs take theirs from the cache.
    """
    # Numba keeps what it compiled by its own version, that of Python, and the place and the date
    # of the sources.
    places = "".join(f"{path} {path.stat().st_mtime_ns};" for path in _compiled_files(package))
    places += f"{sys.version_info[:2]} {metadata.version('numba')}"
    name = f"complete-{hashlib.sha256(places.encode()).hexdigest()[:20]}"
    done = Path(os.environ["NUMBA_CACHE_DIR"]) / name
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
                    file.rmdir() if file.is_dir() else file.unlink()
                folder.rmdir()
        except OSError:
            continue
