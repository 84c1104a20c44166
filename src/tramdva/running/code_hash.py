"""What the code of a stage is: the hash of everything that can change its results."""

from __future__ import annotations

import functools
import hashlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from tramdva.running.cache_folders import cache_roots
from tramdva.running.parsed_code import ParsedCode, parsed, use_store
from tramdva.running.stamps import computing_versions

PACKAGE = Path(__file__).parents[1]
# Modules that cannot change a result.
WITHOUT_EFFECT = frozenset({"tramdva.running.job", "tramdva.running.supervision"})


def code_hash(script: str | Path, *data: str | Path, package: Path = PACKAGE) -> str:
    """Hash the code that a script reaches.

    Counted are the syntax trees, without docstrings, of the script and of each module of tramdva
    that it imports, directly or through others, and the versions of the packages that compute.
    Comments, formatting, dates and the version of Python do not matter.

    Parameters
    ----------
    script : path
        A script.
    *data : path
        Files whose bytes count as well, such as a style sheet.
    package : Path, optional
        Folder of the package.

    Returns
    -------
    str
        20 hexadecimal digits.
    """
    own = read_module(script)
    digest = hashlib.sha256((own.code.digest + computing_versions()).encode())
    for name, module in sorted(reached_from(own, package).items()):
        digest.update((name + module.code.digest).encode())
    for path in data:
        digest.update(Path(path).read_bytes())
    return digest.hexdigest()[:20]


def reached_modules(script: Path, package: Path = PACKAGE) -> set[str]:
    """Name all modules of tramdva that a script imports, directly or through others."""
    return set(reached_from(read_module(script), package))


class Module(NamedTuple):
    """A file of code and what it says."""

    path: str
    code: ParsedCode


def reached_from(own: Module, package: Path) -> dict[str, Module]:
    """Return all modules that a file imports, directly or through others."""
    met: dict[str, Module | None] = {}  # all names, which need not be modules
    reached: dict[str, Module] = {}
    waiting = list(_imported(own, package, met))
    while waiting:
        name = waiting.pop()
        if name not in reached and name not in WITHOUT_EFFECT:
            reached[name] = met[name]
            waiting += _imported(met[name], package, met)
    return reached


def _imported(own: Module, package: Path, met: dict[str, Module | None]) -> Iterator[str]:
    for name in own.code.imports:
        parts = name.split(".")
        modules = [".".join(parts[:end]) for end in range(1, len(parts) + 1)]
        for module in modules:
            if module not in met:
                path = _file(module, package)
                met[module] = read_module(path) if path else None
        found = [module for module in modules if met[module]]
        if len(found) < min(2, len(parts)):
            raise ValueError(f"{own.path}: there is no module {name}")
        yield from found


def _file(module: str, package: Path) -> str:
    """Find the file of a module; nothing where there is none."""
    place = os.path.join(package, *module.split(".")[1:])  # noqa: PTH118 - a thousand times a start
    candidates = (f"{place}/__init__.py", f"{place}.py")
    return next(filter(os.path.isfile, candidates), "")


def read_module(path: str | Path) -> Module:
    """Read a file of code."""
    _use_store()
    return Module(os.fspath(path), parsed(path))


@functools.cache
def _use_store() -> None:
    """Parse nothing that another process has parsed."""
    use_store(list(cache_roots()))
