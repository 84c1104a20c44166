"""What the code of a stage is: the hash of everything that can change its results."""

from __future__ import annotations

import ast
import functools
import hashlib
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

PACKAGE = Path(__file__).parents[1]
# Modules that cannot change a result.
WITHOUT_EFFECT = frozenset({"tramdva.running.job", "tramdva.running.supervision"})


def code_hash(script: str | Path, *data: str | Path, package: Path = PACKAGE) -> str:
    """Hash the code that a script reaches.

    Counted are the syntax trees, without docstrings, of the script and of each module of tramdva
    that it imports, directly or through others. Comments, formatting and dates do not matter.

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
    script = Path(script)
    digest = hashlib.sha256(tree_hash(script))
    for name in sorted(reached_modules(script, package)):
        digest.update(name.encode() + tree_hash(module_file(name, package)))
    for path in data:
        digest.update(Path(path).read_bytes())
    return digest.hexdigest()[:20]


def reached_modules(script: Path, package: Path = PACKAGE) -> set[str]:
    """Name all modules of tramdva that a script imports, directly or through others."""
    reached: set[str] = set()
    waiting = list(_imported(script, package))
    while waiting:
        name = waiting.pop()
        if name not in reached and name not in WITHOUT_EFFECT:
            reached.add(name)
            waiting += _imported(module_file(name, package), package)
    return reached


def _imported(path: Path, package: Path) -> Iterator[str]:
    for name in _absolute_imports(path):
        parts = name.split(".")
        modules = [".".join(parts[:end]) for end in range(1, len(parts) + 1)]
        files = [module for module in modules if module_file(module, package).is_file()]
        if len(files) < min(2, len(parts)):
            raise ValueError(f"{path}: there is no module {name}")
        yield from files


def module_file(module: str, package: Path) -> Path:
    """Return the file of a module of the package by its full name."""
    path = package.joinpath(*module.split(".")[1:])
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _absolute_imports(path: Path) -> tuple[str, ...]:
    return _parsed_now(path).imports


def tree_hash(path: Path) -> bytes:
    """Hash the syntax tree of a file without its docstrings."""
    return _parsed_now(path).digest


class _Parsed(NamedTuple):
    """Modules of tramdva that a file imports; hash of its syntax tree."""

    imports: tuple[str, ...]
    digest: bytes


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
    own = tuple(name for name in imports if name.split(".")[0] == "tramdva")
    return _Parsed(own, hashlib.sha256(ast.dump(tree).encode()).digest())


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
