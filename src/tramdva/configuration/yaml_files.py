"""Read YAML files that people write: safely, and with every slip named.

Beyond `yaml.safe_load`: keys that are given twice, keys that are no text, aliases, deep nesting
and very large files are refused. Only decimal notation is a number, so that 1.2e6 is one, and
neither 1:30 nor 0700 stands for a number that nobody meant; dates are texts.

`python -m tramdva.configuration.yaml_files FILE...` says what is wrong with files.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import yaml

GREATEST_SIZE = 100_000  # bytes
GREATEST_DEPTH = 30  # of maps and lists within each other
RESERVED = "__"  # keys that begin so, as __use_yte__, let Snakemake run code from a file


class _Loader(yaml.SafeLoader):
    yaml_implicit_resolvers: dict[str, list] = {}  # noqa: RUF012 -- those below, not PyYAML's

    def __init__(self, stream: str) -> None:
        super().__init__(stream)
        self.slips: list[str] = []
        self.depth = 0

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node:
        mark = self.peek_event().start_mark
        if self.check_event(yaml.AliasEvent):
            raise yaml.composer.ComposerError(None, None, "aliases are not supported", mark)
        if self.depth > GREATEST_DEPTH:
            raise yaml.composer.ComposerError(None, None, "is nested too deeply", mark)
        self.depth += 1
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict:
        seen = set()
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            line = key_node.start_mark.line + 1
            if not isinstance(key, str):
                self.slips.append(f"line {line}: the key {key_node.value!r} must be a text")
            elif key in seen:
                self.slips.append(f"line {line}: the key {key} is given twice")
            elif key.startswith(RESERVED):
                self.slips.append(f"line {line}: the key {key} is not allowed")
            seen.add(str(key))
        return super().construct_mapping(node, deep)


_NOTATIONS = (
    ("null", r"~|null|Null|NULL|", "~nN"),
    (
        "bool",
        r"yes|Yes|YES|no|No|NO|true|True|TRUE|false|False|FALSE|on|On|ON|off|Off|OFF",
        "yYnNtTfFoO",
    ),
    ("int", r"[-+]?(0|[1-9][0-9]{0,999})", "-+0123456789"),
    ("float", r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?", "-+.0123456789"),
    ("float", r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)", "-+."),
    ("merge", r"<<", "<"),
)
for _tag, _pattern, _first in _NOTATIONS:
    _Loader.add_implicit_resolver(
        f"tag:yaml.org,2002:{_tag}",
        re.compile(f"(?:{_pattern})$"),
        [*_first, *([""] if _tag == "null" else [])],
    )


def read(path: Path) -> tuple[dict[str, Any] | None, list[str]]:
    """Read a YAML file whose top level is a map.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    content : dict or None
        What the file holds; None where it cannot be used.
    slips : list of str
        What is wrong with it, a line each.
    """
    try:
        text = _text(path)
        loader = _Loader(text)
        content = loader.get_single_data()
    except OSError as error:
        return None, [f"cannot be read: {(error.strerror or str(error)).lower()}"]
    except yaml.YAMLError as error:
        return None, [_where_and_what(error)]
    except ValueError as error:
        return None, [str(error).splitlines()[0]]
    if content is None:
        return None, ["is empty"]
    if not isinstance(content, dict):
        return None, [f"must be a map of keys (key: value), not {_kind(content)}"]
    return (None if loader.slips else content), loader.slips


def _text(path: Path) -> str:
    with path.open("rb") as file:
        raw = file.read(GREATEST_SIZE + 1)
    if len(raw) > GREATEST_SIZE:
        raise ValueError(f"is larger than {GREATEST_SIZE} bytes")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise ValueError(f"line {line}: is not UTF-8 text") from None


def _where_and_what(error: yaml.YAMLError) -> str:
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    what = getattr(error, "problem", None) or getattr(error, "reason", None) or "is not YAML"
    where = f"line {mark.line + 1}: " if mark else ""
    if "'\\t'" in what:
        what = "indent with spaces, not tabs"
    elif "constructor for the tag" in what:
        what = "tags (!...) are not supported"
    elif "expected a single document" in (getattr(error, "context", None) or ""):
        what = "must hold one document only"
    return f"{where}{what}"


def _kind(content: Any) -> str:
    return "a list" if isinstance(content, list) else "a single value"


def main(files: Sequence[str]) -> int:
    """Print what is wrong with files; return 1 where something is."""
    slips = [f"{name}: {slip}" for name in files for slip in read(Path(name))[1]]
    print("\n".join(slips), end="\n" if slips else "", file=sys.stderr)
    return 1 if slips else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
