"""What the code of a stage is: the hash of everything that can change its results."""

from __future__ import annotations

import ast
import functools
import hashlib
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

PACKAGE = Path(__file__).parent
RESULT_TABLE = "_variables"  # end of the names of modules of which only the stage's entry counts
WITHOUT_EFFECT = frozenset(
    {"tramdva.job", "tramdva.supervision"}
)  # modules that cannot change a result
COMPILED = re.compile(rb"^ *@.*jit\b", re.MULTILINE)  # decorators of Numba
UNUSED_AFTER = 30 * 86400  # seconds after which a folder of compiled code is removed


def code_hash(script: str | Path, *data: str | Path, package: Path = PACKAGE) -> str:
    """Hash the code that a script reaches.

    Counted are the syntax trees, without docstrings, of the script and of each module of tramdva
    that it imports, directly or through others. Comments, formatting and dates do not matter.

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
    digest = hashlib.sha256(_tree_hash(script))
    for name in sorted(reached_modules(script, package)):
        stage = script.stem if name.endswith(RESULT_TABLE) else ""
        digest.update(name.encode() + _tree_hash(_file(name, package), stage))
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
    # Numba keeps what it compiled by the place and the date of the sources.
    places = "".join(f"{path} {path.stat().st_mtime_ns};" for path in _compiled_files(package))
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
    files = set(_compiled_files(package))
    for path in tuple(files):
        files |= {_file(name, package) for name in reached_modules(path, package)}
    digest = hashlib.sha256()
    for path in sorted(files):
        digest.update(str(path.relative_to(package)).encode() + _tree_hash(path))
    return digest.hexdigest()[:20]


def _compiled_files(package: Path) -> list[Path]:
    """Name the modules that compile functions."""
    return [path for path in sorted(package.rglob("*.py")) if COMPILED.search(path.read_bytes())]


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
    reached: set[str] = set()
    waiting = list(_imported(script, package))
    while waiting:
        name = waiting.pop()
        if name not in reached and name not in WITHOUT_EFFECT:
            reached.add(name)
            waiting += _imported(_file(name, package), package)
    return reached


def _imported(path: Path, package: Path) -> Iterator[str]:
    for name in _absolute_imports(path):
        parts = name.split(".")
        modules = [".".join(parts[:end]) for end in range(1, len(parts) + 1)]
        files = [module for module in modules if _file(module, package).is_file()]
        if len(files) < min(2, len(parts)):
            raise ValueError(f"{path}: there is no module {name}")
        yield from files


def _file(module: str, package: Path) -> Path:
    path = package.joinpath(*module.split(".")[1:])
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _absolute_imports(path: Path) -> tuple[str, ...]:
    return _parsed_now(path).imports


def _tree_hash(path: Path, stage: str = "") -> bytes:
    """Hash a file; of a table of result variables, with a stage, only the entry of this stage."""
    parsed = _parsed_now(path)
    entries = [parsed.entries.get(stage, b"")] if stage else parsed.entries.values()
    return b"".join([parsed.rest, *entries])


class _Parsed(NamedTuple):
    """Modules of tramdva that a file imports; hashes of its syntax tree.

    entries : of a table of result variables, by stage; rest : of everything else
    """

    imports: tuple[str, ...]
    rest: bytes
    entries: dict[str, bytes]


def _parsed_now(path: Path) -> _Parsed:
    status = path.stat()
    return _parsed(path, status.st_mtime_ns, status.st_size)


@functools.cache
def _parsed(path: Path, mtime_ns: int, size: int) -> _Parsed:
    tree = ast.parse(path.read_bytes(), filename=str(path))
    imports: list[str] = []
    _drop_docstring(tree)
    for node in _statements(tree):
        _drop_docstring(node)
        if isinstance(node, ast.Import):
            imports += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            if node.level:
                raise ValueError(f"{path}: line {node.lineno}: relative imports are not followed")
            imports += [f"{node.module}.{alias.name}" for alias in node.names]
    entries = _taken_entries(tree) if path.stem.endswith(RESULT_TABLE) else {}
    own = tuple(name for name in imports if name.split(".")[0] == "tramdva")
    return _Parsed(own, _digest(tree), {key: _digest(value) for key, value in entries.items()})


def _digest(tree: ast.AST) -> bytes:
    return hashlib.sha256(ast.dump(tree).encode()).digest()


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield all statements below a node; expressions, which are far more, are passed over."""
    for block in ("body", "orelse", "handlers", "finalbody", "cases"):
        for statement in getattr(node, block, ()):
            yield statement
            yield from _statements(statement)


def _drop_docstring(node: ast.AST) -> None:
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    if isinstance(node, documented) and ast.get_docstring(node, clean=False) is not None:
        node.body = node.body[1:]


def _taken_entries(tree: ast.Module) -> dict[str, ast.expr]:
    """Take the entries out of the table STAGES of result variables."""
    taken: dict[str, ast.expr] = {}
    for node in tree.body:
        if isinstance(node, ast.AnnAssign) and getattr(node.target, "id", "") == "STAGES":
            table = node.value
            taken |= {key.value: value for key, value in zip(table.keys, table.values, strict=True)}
            table.keys, table.values = [], []
    return taken
