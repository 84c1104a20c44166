"""Read, merge and validate the configuration; give each stage exactly the values it uses.

A line is a file beside `lines/paper.yaml` that holds only what differs from it: maps merge,
lists and values replace. All problems of all files are reported at once, a line each.
"""

from __future__ import annotations

import difflib
import itertools
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from tramdva.configuration import following, grids, measured_files, messages, reference, yaml_files
from tramdva.configuration.everyday import Tram
from tramdva.configuration.line import Line
from tramdva.configuration.measured_files import MeasuredFile
from tramdva.configuration.run import LINE_NAME, Run

BASE_LINE = "paper"

_Model = TypeVar("_Model", bound=BaseModel)


class ConfigurationError(ValueError):
    """All problems of a configuration, a line each."""


@dataclass(frozen=True)
class Configuration:
    """A validated configuration: the run, its lines by name and the measured files of each.

    `own_run` is what `config.yaml` says by itself, without further files and overrides: what was
    made with its numerics is called full.
    """

    run: Run
    lines: Mapping[str, Line]
    measured: Mapping[str, Mapping[str, MeasuredFile]]
    # By line the keys that are derived from its bogie; the values that stand there in `lines` are
    # the paper's and reach no stage.
    derived: Mapping[str, tuple[str, ...]]
    own_run: Run


@dataclass(frozen=True)
class _Layer:
    """What one file (or the command line) says, and the name by which problems refer to it."""

    name: str
    content: Mapping[str, Any]


def load(
    folder: Path, files: Iterable[Path] = (), overrides: Mapping[str, Any] | None = None
) -> Configuration:
    """Read and validate a configuration.

    Parameters
    ----------
    folder : Path
        Holds `config.yaml` and `lines/`.
    files : iterable of Path
        Further files that are laid over `config.yaml`, the last one uppermost.
    overrides : mapping, optional
        Values from the command line, above all files.

    Returns
    -------
    Configuration
        The run and each of its lines.

    Raises
    ------
    ConfigurationError
        With a line for each problem: file, key, value and what is allowed.
    """
    problems: list[str] = []
    layers = []
    for path in (folder / "config.yaml", *files):
        layers += _read(path, folder, problems)
    if overrides:
        layers.append(_Layer("--config", overrides))
    run = None if problems else _validate(Run, layers, problems)
    lines, measured, derived = _load_lines(folder, layers, problems)
    if run is not None:
        problems += grids.problems(run.numerics, lines, derived)
    if problems or run is None:
        raise ConfigurationError("\n".join(dict.fromkeys(map(messages.harmless, problems))))
    own_run = _validate(Run, layers[:1], []) or run
    return Configuration(run, lines, measured, derived, own_run)


def load_or_exit(
    folder: Path, files: Iterable[Path] = (), overrides: Mapping[str, Any] | None = None
) -> Configuration:
    """Do as `load`, but end the program with the problems, a line each, instead of raising."""
    try:
        return load(folder, files, overrides)
    except ConfigurationError as error:
        raise SystemExit(str(error)) from None


def _read(path: Path, folder: Path, problems: list[str], hint: str = "") -> list[_Layer]:
    name = _shown(path, folder)
    content, wrong = yaml_files.read(path)
    problems += [f"{name}: {slip}{hint if slip == 'is empty' else ''}" for slip in wrong]
    return [] if content is None else [_Layer(name, content)]


def _shown(path: Path, folder: Path) -> str:
    for root in (folder.resolve().parent, Path.cwd()):
        if path.resolve().is_relative_to(root):
            return path.resolve().relative_to(root).as_posix()
    return str(path)


def _names(layers: Sequence[_Layer]) -> dict[str, int]:
    """Return the usable names of lines, and their positions, of a run that may be wrong."""
    names = _merged(layers).get("lines", [])
    listed = enumerate(names) if isinstance(names, list) else []
    return {
        name: position
        for position, name in listed
        if isinstance(name, str) and re.fullmatch(LINE_NAME, name)
    }


def _load_lines(
    folder: Path, run_layers: Sequence[_Layer], problems: list[str]
) -> tuple[dict[str, Line], dict[str, dict[str, MeasuredFile]], dict[str, tuple[str, ...]]]:
    base_problems: list[str] = []
    base = _read(folder / "lines" / f"{BASE_LINE}.yaml", folder, base_problems)
    problems += base_problems
    there = sorted(path.stem for path in (folder / "lines").glob("*.yaml"))
    lines, measured, derived = {}, {}, {}
    for name, position in _names(run_layers).items():
        if name not in there:
            where = _origin(("lines", position), run_layers).name
            problems.append(f"{where}: lines[{position}] = {name}: {_no_such_line(name, there)}")
            continue
        layers = base
        if name != BASE_LINE:
            path = folder / "lines" / f"{name}.yaml"
            own = _read(path, folder, problems, ": it must hold what differs, at least its label")
            if own and "label" not in own[0].content:
                meaning = reference.entries(Line)["label"].meaning
                problems.append(f"{own[0].name}: label: missing: must be {meaning}")
            layers = _followed(base[0], own[0], problems) if base and own else []
        if layers and (line := _validate(Line, layers, problems)):
            lines[name] = line
            measured[name] = _measured(line, folder, layers, problems)
            own_content = layers[-1].content if name != BASE_LINE else None
            derived[name] = () if own_content is None else following.derived(own_content)
            slips = following.contradictions(own_content or {}, line)
            problems += [f"{layers[-1].name}: {slip}" for slip in slips]
    return lines, measured, derived


def _followed(base: _Layer, own: _Layer, problems: list[str]) -> list[_Layer]:
    """Layers of a line: the paper's, what follows from its file, the file; none where it is wrong.

    The section `tram` of the file is among what follows.
    """
    content = dict(own.content)
    known: dict[str, Any] = dict.fromkeys(Tram.model_fields)
    said = content.pop("tram", None)
    if said is not None and not isinstance(said, Mapping):
        problems.append(f"{own.name}: tram: must be a map of keys")
        return []
    slips = len(problems)
    tram = _validate(Tram, [_Layer(own.name, known | dict(said or {}))], problems, "tram.")
    if tram is None:
        return [base, _Layer(own.name, content)]
    found = following.Description(content, base.content, tram)
    problems += [f"{own.name}: {slip}" for slip in found.problems]
    if len(problems) > slips:
        return []
    return [base, _Layer(own.name, found.follows), _Layer(own.name, content)]


def _measured(
    line: Line, folder: Path, layers: Sequence[_Layer], problems: list[str]
) -> dict[str, MeasuredFile]:
    measured = {}
    for what, name in measured_files.names(line).items():
        key = measured_files.KEYS[what]
        try:
            measured[what] = measured_files.found(folder, name)
        except measured_files.UnusableFileError as error:
            where = _origin(key, layers).name
            problems.append(f"{where}: {'.'.join(key)} = {name}: {error}")
    return measured


def _no_such_line(name: str, there: Sequence[str]) -> str:
    close = difflib.get_close_matches(name, there, 1)
    hint = f"did you mean {close[0]}?" if close else f"there are: {', '.join(there)}"
    return f"there is no config/lines/{name}.yaml; {hint}"


def _merged(layers: Iterable[_Layer]) -> dict[str, Any]:
    merged: dict[str, Any] = {}
    for layer in layers:
        merged = _merge(merged, layer.content)
    return merged


def _merge(below: Any, above: Any) -> Any:
    if not (isinstance(below, Mapping) and isinstance(above, Mapping)):
        return above
    return {**below, **{key: _merge(below.get(key), value) for key, value in above.items()}}


def _validate(
    model: type[_Model], layers: Sequence[_Layer], problems: list[str], prefix: str = ""
) -> _Model | None:
    try:
        return model.model_validate(_merged(layers))
    except ValidationError as error:
        for slip in error.errors(include_url=False):
            if slip["type"] == "too_short" and slip["input"]:
                continue  # only because its items, reported themselves, did not count
            where = _origin(slip["loc"], layers, missing=slip["type"] == "missing").name
            words = f"{prefix}{messages.in_words(slip, model)}"
            words = words.replace("did you mean ", f"did you mean {prefix}")
            problems.append(f"{where}: {words}")
        return None


def _origin(path: Sequence[str | int], layers: Sequence[_Layer], missing: bool = False) -> _Layer:
    """Find the layer that is to blame for a path: it holds the largest part of it.

    Of several, it is the uppermost; but what is missing should stand in the lowest. A list comes
    whole from one layer.
    """
    names = list(itertools.takewhile(lambda key: isinstance(key, str), path))
    lowest = missing and len(names) == len(path)
    return max(layers if lowest else layers[::-1], key=lambda layer: _depth(layer.content, names))


def _depth(tree: Any, path: Sequence[str]) -> int:
    for depth, key in enumerate(path):
        if not isinstance(tree, Mapping) or key not in tree:
            return depth
        tree = tree[key]
    return len(path)
