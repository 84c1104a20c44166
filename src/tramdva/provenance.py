"""What the code of a stage is: the hash of everything that can change its results."""

from __future__ import annotations

import functools
import hashlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

from tramdva.parsed_code import RESULT_TABLE, ParsedCode, parsed, use_store

PACKAGE = Path(__file__).parent
WITHOUT_EFFECT = frozenset(
    {"tramdva.job", "tramdva.supervision"}
)  # modules that cannot change a result
UNUSED_AFTER = 30 * 86400  # seconds after which a folder of compiled code is removed


def code_hash(script: str | Path, *data: str | Path, package: Path = PACKAGE) -> str:
    """Hash the code that a script reaches.

    Counted are the syntax trees, without docstrings, of the script and of each module of tramdva
    that it imports, directly or through others. Comments, formatting, dates and the version of
    Python do not matter.

    Parameters
    ----------
    script : path
        A script; its stem is the name of its stage.
    *data : path
        Files whose bytes count as well, such as a style sheet.
    package : Path, optional
        Folder of the package.

    Returns
    -------
    str
        20 hexadecimal digits.
    """
    script = Path(script)
    own = _read(script)
    digest = hashlib.sha256(_tree_hash(own))
    for name, module in sorted(_reached(own, package).items()):
        stage = script.stem if name.endswith(RESULT_TABLE) else ""
        digest.update(name.encode() + _tree_hash(module, stage))
    for path in data:
        digest.update(Path(path).read_bytes())
    return digest.hexdigest()[:20]


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
    program = "from tramdva.warm_up import compile_kernels; compile_kernels()"
    if subprocess.run([sys.executable, "-c", program], check=False).returncode == 0:
        with suppress(OSError):
            done.touch()


def _numba_cache_folder(package: Path) -> Path:
    name = f"sources-{_compiled_code_hash(package)}"
    for root in _cache_roots():
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
        own = _read(path)
        found = (own, *_reached(own, package).values())
        modules |= {os.path.relpath(module.path, package): module for module in found}
    digest = hashlib.sha256()
    for place, module in sorted(modules.items()):
        digest.update(place.encode() + _tree_hash(module))
    return digest.hexdigest()[:20]


def _compiled_files(package: Path) -> list[Path]:
    """Name the modules that compile functions."""
    return [path for path in sorted(package.rglob("*.py")) if _read(path).code.compiles]


def _cache_roots() -> Iterator[Path]:
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        path = Path(given)
        yield path.parent if path.name.startswith("sources-") else path
    home = os.environ.get("XDG_CACHE_HOME") or Path("~").expanduser() / ".cache"
    yield Path(home) / "tramdva"
    yield Path.cwd() / ".snakemake" / "tramdva"


def _remove_unused(current: Path) -> None:
    for folder in current.parent.glob("sources-*"):
        try:
            if folder != current and folder.stat().st_mtime < time.time() - UNUSED_AFTER:
                for file in sorted(folder.rglob("*"), reverse=True):
                    file.rmdir() if file.is_dir() else file.unlink()
                folder.rmdir()
        except OSError:
            continue


def reached_modules(script: Path, package: Path = PACKAGE) -> set[str]:
    """Name all modules of tramdva that a script imports, directly or through others."""
    return set(_reached(_read(script), package))


class _Module(NamedTuple):
    """A file of code and what it says."""

    path: str
    code: ParsedCode


def _reached(own: _Module, package: Path) -> dict[str, _Module]:
    """Return all modules that a file imports, directly or through others."""
    met: dict[str, _Module | None] = {}  # all names, which need not be modules
    reached: dict[str, _Module] = {}
    waiting = list(_imported(own, package, met))
    while waiting:
        name = waiting.pop()
        if name not in reached and name not in WITHOUT_EFFECT:
            reached[name] = met[name]
            waiting += _imported(met[name], package, met)
    return reached


def _imported(own: _Module, package: Path, met: dict[str, _Module | None]) -> Iterator[str]:
    for name in own.code.imports:
        parts = name.split(".")
        modules = [".".join(parts[:end]) for end in range(1, len(parts) + 1)]
        for module in modules:
            if module not in met:
                path = _file(module, package)
                met[module] = _read(path) if path else None
        found = [module for module in modules if met[module]]
        if len(found) < min(2, len(parts)):
            raise ValueError(f"{own.path}: there is no module {name}")
        yield from found


def _file(module: str, package: Path) -> str:
    """Find the file of a module; nothing where there is none."""
    place = os.path.join(package, *module.split(".")[1:])  # noqa: PTH118 - a thousand times a start
    candidates = (f"{place}/__init__.py", f"{place}.py")
    return next(filter(os.path.isfile, candidates), "")


def _tree_hash(module: _Module, stage: str = "") -> bytes:
    """Hash a file; of a table of result variables, with a stage, only the entry of this stage."""
    entries = module.code.entries
    counted = [entries.get(stage, "")] if stage else entries.values()
    return "".join([module.code.rest, *counted]).encode()


def _read(path: str | Path) -> _Module:
    _use_store()
    return _Module(os.fspath(path), parsed(path))


@functools.cache
def _use_store() -> None:
    """Parse nothing that another process has parsed."""
    use_store(list(_cache_roots()))
