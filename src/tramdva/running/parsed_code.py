"""What a file of Python code says, independent of its format and of the version of Python.

Parsing all files takes half a second, which each start of the pipeline would pay. What was
found is therefore kept in a file below the folder of caches, by the hash of the content that it
was found in. No date decides whether it is current, so that no edit can be missed: reading and
hashing all files takes some milliseconds.
"""

from __future__ import annotations

import ast
import atexit
import functools
import hashlib
import json
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

COMPILED = re.compile(rb"^ *@.*jit\b", re.MULTILINE)  # decorators of Numba
STORE = "parsed-code.json"
MOST_STORED = 2000  # files, some 15 versions of the code

_known: dict[str, ParsedCode] = {}  # by the hash of the content; those used last come last
_new: set[str] = set()


class ParsedCode(NamedTuple):
    """What a file of code says.

    imports : modules of tramdva that it imports
    compiles : whether it holds functions that Numba compiles
    digest : hash of the syntax tree without docstrings
    """

    imports: tuple[str, ...]
    compiles: bool
    digest: str


def parsed(path: str | Path) -> ParsedCode:
    """Read a file of code and tell what it says.

    Raises
    ------
    SyntaxError
        Where it is no Python.
    ValueError
        Where it has relative imports.
    """
    path = os.fspath(path)
    with open(path, "rb") as file:  # noqa: PTH123 - called a thousand times before each run
        content = file.read()
    key = _key(content)
    found = _known.pop(key, None)
    if found is None:
        found = _parse(content, path)
        _new.add(key)
    _known[key] = found
    return found


def written_tree(tree: ast.AST) -> str:
    """Write a syntax tree, the same for the same code on all versions of Python.

    `ast.dump` differs: Python 3.12 knows type parameters, 3.13 leaves out what is empty, and 3.12
    has empty texts beside the values of an f-string.
    """
    words: list[str] = []
    _write(tree, words.append)
    return "".join(words)


def use_store(roots: Sequence[Path]) -> None:
    """Take what other processes found in the same code; keep at the end what this one found.

    Parameters
    ----------
    roots : sequence of Path
        Folders where caches may be; the first that can be used is.
    """
    for root in roots:
        if stored := _stored(root):
            _known.update(stored)
            break
    atexit.register(store, [root.absolute() for root in roots])


def store(roots: Sequence[Path]) -> None:
    """Keep what this process found; where no folder can be written, nothing is kept."""
    for root in roots if _new else ():
        part = root / f"{STORE}.{os.getpid()}"
        try:
            root.mkdir(parents=True, exist_ok=True)
            others = {key: value for key, value in _stored(root).items() if key not in _known}
            latest = list((others | _known).items())[-MOST_STORED:]
            part.write_text(json.dumps(dict(latest)), encoding="utf-8")
            part.replace(root / STORE)
        except OSError:
            with suppress(OSError):
                part.unlink()
            continue
        _new.clear()
        return


def _stored(root: Path) -> dict[str, ParsedCode]:
    """Read what was kept; nothing where the file is missing or damaged."""
    try:
        stored = json.loads((root / STORE).read_bytes())
        return {key: ParsedCode(tuple(found[0]), *found[1:]) for key, found in stored.items()}
    except (OSError, ValueError, TypeError, AttributeError, LookupError):
        return {}


def _key(content: bytes) -> str:
    digest = _parser().copy()
    digest.update(content)
    return digest.hexdigest()


@functools.cache
def _parser() -> Any:
    """Hash what decides, beside the content, what is found: this file and the version of Python."""
    return hashlib.sha256(f"{sys.version_info[:3]}".encode() + Path(__file__).read_bytes())


def _parse(content: bytes, path: str) -> ParsedCode:
    tree = ast.parse(content, filename=path)
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
    return ParsedCode(
        tuple(name for name in imports if name.split(".")[0] == "tramdva"),
        COMPILED.search(content) is not None,
        hashlib.sha256(written_tree(tree).encode()).hexdigest(),
    )


def _write(value: Any, put: Callable[[str], None]) -> None:
    if isinstance(value, ast.AST):
        put(f"{type(value).__name__}(")
        for name in value._fields:
            field = getattr(value, name, None)
            if isinstance(value, ast.JoinedStr):
                field = [piece for piece in field if not _is_empty_text(piece)]
            # Each field is either optional or a list: what is left out is never ambiguous.
            if field is not None and field != []:
                put(f"{name}=")
                _write(field, put)
                put(",")
        put(")")
    elif isinstance(value, list):
        put("[")
        for item in value:
            _write(item, put)
            put(",")
        put("]")
    else:
        put(ascii(value))  # what repr() escapes depends on the version of Unicode


def _is_empty_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and node.value == ""


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield all statements below a node; expressions, which are far more, are passed over.

    So is what checkers of types alone read: it never runs.
    """
    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
        return
    for block in ("body", "orelse", "handlers", "finalbody", "cases"):
        for statement in getattr(node, block, ()):
            yield statement
            yield from _statements(statement)


def _drop_docstring(node: ast.AST) -> None:
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    if isinstance(node, documented) and ast.get_docstring(node, clean=False) is not None:
        node.body = node.body[1:]
