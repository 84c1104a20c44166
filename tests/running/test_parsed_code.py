"""What is read out of code: the same on all versions of Python, and never out of date."""

import ast
import hashlib
import json
import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from tramdva.running import parsed_code
from tramdva.running.code_hash import code_hash
from tramdva.running.parsed_code import parsed, written_tree

# Every kind of syntax whose tree differs between versions of Python, or whose text might.
SAMPLE = """
from __future__ import annotations
import tramdva.force as force

class Wheel(Part, metaclass=Meta):
    radius: float = 0.3
    name: str

    @property
    def mass(self, /, a, b=1, *rest, c, d=None, **others) -> float:
        return

    async def roll(self):
        async with self as s, t:
            await s
        async for x in y:
            yield x
        return [None, 1, 1.0, 1j, -0.0, 1e999, True, ..., b"\\xff", "\\u00e9\\U0001fae8", u"u"]

f"{a!r:>{width}}" "b" f"{{}}{c=}" f"{d:{e}.{g}}" f"{h:}" f""
lambda *a, **k: {**a, "b": [*c, *d], **e}
x[1:2, ::3, ...] = (y := z) if not a < b <= c else {d for e in f if g for h in i}
match p:
    case [1, *_, Q(r=2) | {"s": None, **t}] if u: pass
    case _: pass
try: raise V from w
except* (X, Y) as z: del a, b[c]
else: assert d, e
finally: global_ = 1
with (open(a) as b, c): nonlocal_ = 2
while a: break
else: continue_ = a @ b // c ** ~d
"""
# Made with Python 3.11.7, 3.12.1 and 3.13.0.
SAMPLE_HASH = "79c2d040b4c1f8ec92bb40015612cbbd1100d40622c87df95dc8d108f66f6fae"


def written(code: str) -> str:
    return written_tree(ast.parse(textwrap.dedent(code)))


def test_text_of_a_tree_is_the_same_on_all_versions_of_python() -> None:
    assert hashlib.sha256(written(SAMPLE).encode()).hexdigest() == SAMPLE_HASH


# Hashes the code that scripts reach.
HASHES = """
import json, sys
from tramdva.running.code_hash import code_hash
print(json.dumps({path: code_hash(path) for path in sys.argv[1:]}))
"""


def test_other_interpreters_on_path_hash_all_scripts_alike(root: Path, tmp_path: Path) -> None:
    """Of the supported versions; how many there are depends on the machine."""
    scripts = sorted([*root.glob("workflow/scripts/*.py"), *root.glob("paper_figures/*.py")])
    hashes = {str(path): code_hash(path) for path in scripts}
    environment = {
        "PYTHONPATH": str(root / "src"),
        "PYTHONDONTWRITEBYTECODE": "1",
        "NUMBA_CACHE_DIR": str(tmp_path),
    }
    for name in (f"python3.{minor}" for minor in (11, 12, 13) if minor != sys.version_info.minor):
        if shutil.which(name) is None or subprocess.run([name, "-V"], check=False).returncode:
            continue  # a shim of a version manager is no interpreter
        ended = subprocess.run(
            [name, "-c", HASHES, *hashes],
            env=os.environ | environment, capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert not ended.returncode, ended.stderr
        assert json.loads(ended.stdout) == hashes


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("x = 1", "x = True"),
        ("x = 1", "x = 1.0"),
        ("x = 1", "x = '1'"),
        ("x = 0.0", "x = -0.0"),
        ("x = None", "x = 'None'"),
        ("x = ''", "x = b''"),
        ("x = ''", "x = f''"),
        ("x = ()", "x = []"),
        ("x = {}", "x = set()"),
        ("return_ = 1\ndef f(): return", "return_ = 1\ndef f(): return None"),
        ("x: int", "x: int = None"),
        ("f'{x}'", "f'{x!s}'"),
        ("f'{x:}'", "f'{x}'"),
        ("f'{x:{y}}'", "f'{x:{y} }'"),
        ("f'{x}' ' '", "f'{x}'"),
        ("x[1:]", "x[:1]"),
        ("x[:]", "x[None:]"),
        ("def f(a, *, b): pass", "def f(*, a, b): pass"),
        ("def f(*, a, b=None): pass", "def f(*, a=None, b): pass"),
        ("def f(a, /): pass", "def f(a): pass"),
        ("{**a, None: b}", "{None: b, **a}"),
        ("{**a}", "{None: a}"),
        ("if a:\n b\nelse:\n c", "if a:\n b\n c"),
        ("try:\n a\nexcept:\n b", "try:\n a\nexcept b:\n b"),
        ("a < b < c", "a < (b < c)"),
        ("a + b * c", "(a + b) * c"),
        ("import a.b", "import a as b"),
    ],
)
def test_different_code_has_different_trees(one: str, other: str) -> None:
    assert written(one) != written(other)


def test_every_single_change_of_a_tree_shows(root: Path) -> None:
    """Each constant, name and operator of the sample, and each child of a list, in turn."""
    before = written_tree(ast.parse(SAMPLE))
    count = len(list(ast.walk(ast.parse(SAMPLE))))
    for number in range(count):
        for field in list(ast.walk(ast.parse(SAMPLE)))[number]._fields:
            tree = ast.parse(SAMPLE)
            node = list(ast.walk(tree))[number]
            value = getattr(node, field)
            if isinstance(node, ast.JoinedStr) and not value:
                continue
            if value is not None and value != []:
                setattr(node, field, value[1:] if isinstance(value, list) else ast.Pass())
                assert written_tree(tree) != before, ast.dump(node)


def test_format_does_not_show() -> None:
    assert written("x = 'a' \"b\" # c\nif(x):\n  y = 0x10") == written("x='ab'\nif x: y = 16")


def edit_unseen(path: Path, old: str, new: str) -> None:
    """Edit a file so that neither its size nor the date of its content tells."""
    before = path.stat()
    path.write_text(path.read_text().replace(old, new))
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    after = path.stat()
    assert (after.st_size, after.st_mtime_ns) == (before.st_size, before.st_mtime_ns)


def test_edit_that_dates_do_not_tell_counts(tmp_path: Path) -> None:
    path = tmp_path / "a.py"
    path.write_text("import tramdva.force\nx = 1\n")
    before = parsed(path)
    edit_unseen(path, "x = 1", "x = 2")

    assert parsed(path).digest != before.digest


@pytest.fixture
def another_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Begin anew with what was stored, and count what is parsed."""
    parses = []
    parse = parsed_code._parse
    monkeypatch.setattr(parsed_code, "_parse", lambda *of: parses.append(of) or parse(*of))
    monkeypatch.setattr(parsed_code.atexit, "register", lambda *arguments: None)

    def begin(*roots: Path) -> list:
        monkeypatch.setattr(parsed_code, "_known", {})
        monkeypatch.setattr(parsed_code, "_new", set())
        parsed_code.use_store(roots or [tmp_path / "cache"])
        parses.clear()
        return parses

    return begin


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "wheel.py"
    path.write_text("from tramdva import a\n@njit\ndef f(): return 11\n")
    return path


def test_next_process_parses_nothing(tmp_path: Path, file: Path, another_process) -> None:
    parses = another_process()
    first = parsed(file)
    assert len(parses) == 1
    assert (first.imports, first.compiles) == (("tramdva.a",), True)
    parsed_code.store([tmp_path / "cache"])

    parses = another_process()
    assert parsed(file) == first
    assert parsed(shutil.copy(file, tmp_path / "other.py")) == first
    assert not parses


def test_next_process_sees_what_dates_do_not_tell(
    tmp_path: Path, file: Path, another_process
) -> None:
    another_process()
    first = parsed(file)
    parsed_code.store([tmp_path / "cache"])
    edit_unseen(file, "return 11", "return 12")
    another_process()

    assert parsed(file).digest != first.digest


@pytest.mark.parametrize("damaged", [b"", b"{", b"[]", b'{"a": 1}', b'{"a": []}', b"\xff\x00"])
def test_damaged_store_is_made_anew(
    tmp_path: Path, file: Path, another_process, damaged: bytes
) -> None:
    (tmp_path / "cache").mkdir()
    store = tmp_path / "cache" / parsed_code.STORE
    store.write_bytes(damaged)
    another_process()
    first = parsed(file)
    parsed_code.store([tmp_path / "cache"])

    parses = another_process()
    assert parsed(file) == first
    assert not parses
    assert [path.name for path in store.parent.iterdir()] == [store.name]


def test_processes_at_the_same_time_keep_both_what_they_found(
    tmp_path: Path, file: Path, another_process, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = tmp_path / "b.py"
    other.write_text("x = 1\n")
    another_process()
    parsed(file)
    mine = parsed_code._known, parsed_code._new
    another_process()
    parsed(other)
    parsed_code.store([tmp_path / "cache"])
    for name, value in zip(("_known", "_new"), mine, strict=True):
        monkeypatch.setattr(parsed_code, name, value)
    parsed_code.store([tmp_path / "cache"])

    parses = another_process()
    parsed(file), parsed(other)
    assert not parses


def test_store_forgets_what_was_not_used_for_longest(
    tmp_path: Path, another_process, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parsed_code, "MOST_STORED", 2)
    files = [tmp_path / f"{number}.py" for number in range(3)]
    for number, path in enumerate(files):
        path.write_text(f"x = {number}\n")
    another_process()
    parsed(files[0]), parsed(files[1])
    parsed_code.store([tmp_path / "cache"])
    another_process()
    parsed(files[0]), parsed(files[2])
    parsed_code.store([tmp_path / "cache"])

    parses = another_process()
    parsed(files[0]), parsed(files[2])
    assert not parses
    parsed(files[1])
    assert len(parses) == 1


def test_folder_that_cannot_be_written_is_passed_over(
    tmp_path: Path, file: Path, another_process
) -> None:
    (tmp_path / "no folder").write_text("")
    roots = [tmp_path / "no folder", tmp_path / "second"]
    another_process(*roots)
    parsed(file)
    parsed_code.store(roots)
    assert not another_process(*roots)
    parsed(file)

    assert (tmp_path / "second" / parsed_code.STORE).is_file()
    parsed_code.store([tmp_path / "no folder"])  # without a word


def test_store_is_of_this_version_of_the_parser(another_process, monkeypatch) -> None:
    before = parsed_code._key(b"")
    monkeypatch.setattr(parsed_code.sys, "version_info", (3, 99, 0))
    parsed_code._parser.cache_clear()
    after = parsed_code._key(b"")
    parsed_code._parser.cache_clear()

    assert before != after
