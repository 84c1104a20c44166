"""Say in one line what is wrong with a value of the configuration and what is allowed."""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import BaseModel

from tramdva.configuration import reference
from tramdva.configuration.line import Line
from tramdva.configuration.run import Run

WIDTH = 60  # letters of a value that are shown
LONGEST = 800  # letters of a line


def in_words(slip: Mapping[str, Any], model: type[BaseModel]) -> str:
    """Word one problem that pydantic found.

    Parameters
    ----------
    slip : mapping
        An item of `ValidationError.errors()`.
    model : type
        The parameter set that was validated.

    Returns
    -------
    str
        `key = value: what is allowed`.
    """
    table = reference.entries(model)
    path = dotted(slip["loc"])
    entry = table.get(dotted(slip["loc"], indices=False))
    kind = slip["type"]
    if kind == "extra_forbidden":
        other, place = (Run, "config.yaml") if model is Line else (Line, "lines/<line>.yaml")
        if path in other.model_fields:
            return f"{path}: unknown key; it belongs in config/{place}"
        return f"{path}: unknown key; {_hint(slip['loc'], table)}"
    if kind == "missing":
        return f"{path}: missing: {_allowed(entry)}"
    if kind == "value_error" and (entry is None or entry.kind in ("section", "list")):
        reason = str(slip["ctx"]["error"])
        return f"{path}: {reason}" if path else reason
    if kind == "value_error" and entry.kind == "text":
        return f"{path} = {shown(slip['input'])}: {slip['ctx']['error']}"
    if kind == "too_short" and entry is not None and entry.kind == "list":
        return f"{path}: must not be empty ({entry.meaning})"
    if kind == "too_long" and entry is not None and entry.kind == "list":
        return f"{path}: must have at most {slip['ctx']['max_length']} entries"
    return f"{path} = {shown(slip['input'])}: {_allowed(entry)}"


def dotted(location: Sequence[str | int], indices: bool = True) -> str:
    """Write the place of a value as in `absorber_variants[0].c_T`."""
    text = ""
    for key in location:
        if isinstance(key, int):
            text += f"[{key}]" if indices else "[]"
        else:
            text += f".{key}" if text else key
    return text


def shown(value: Any) -> str:
    """Write a value on one line, about as in the file."""
    if isinstance(value, float | int) and not isinstance(value, bool):
        text = (
            repr(value) if isinstance(value, float) or abs(value) < 10**WIDTH else "a huge number"
        )
    else:
        text = json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= WIDTH else f"{text[: WIDTH - 3]}..."


def harmless(line: str) -> str:
    """Write letters that would move the cursor or hide text as their codes; cut long lines."""
    letters = (
        letter if letter.isprintable() else letter.encode("unicode_escape").decode()
        for letter in line[: LONGEST + 1]
    )
    text = "".join(letters)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."


def _allowed(entry: reference.Entry | None) -> str:
    if entry is None:
        return "is not allowed"
    if entry.kind == "text" or not entry.meaning:
        return f"must be {entry.allowed}"
    return f"must be {entry.allowed} ({entry.meaning})"


def _hint(location: Sequence[str | int], table: Mapping[str, reference.Entry]) -> str:
    parent, key = dotted(location[:-1], indices=False), str(location[-1])
    prefix = f"{parent}." if parent else ""
    siblings = [
        path.removeprefix(prefix)
        for path in table
        if path.startswith(prefix) and not set(path.removeprefix(prefix)) & set(".[")
    ]
    elsewhere = [path for path in table if path.endswith(f".{key}")]
    close = {name.lower(): name for name in siblings}
    matches = difflib.get_close_matches(key.lower(), close, 1)
    if matches:
        return f"did you mean {prefix}{close[matches[0]]}?"
    if elsewhere:
        return f"did you mean {' or '.join(elsewhere[:3])}?"
    return f"known here: {', '.join(siblings)}"
