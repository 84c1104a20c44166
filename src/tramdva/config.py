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

from tramdva import measured_files, schema, slips, strict_yaml
from tramdva.bogie_parameters import BareBogie, BogieAbsorber
from tramdva.measured_files import MeasuredFile
from tramdva.parameters import LINE_NAME, Line, Run

BASE_LINE = "paper"

_FORCE = ("curve", "creep_force")
_WHEELSET = ("wheelset",)
_WHEELSET_OF_ANY_C_A = tuple(
    f"wheelset.{name}" for name in ("m_A", "m_R", "d_A", "c_R", "d_R", "L")
)
_VARIANTS = (
    "absorber.m_T",
    "absorber_variants.name",
    "absorber_variants.c_T",
    "absorber_variants.d_T",
)
_BOGIE = (
    "track",
    "bogie",
    "contact_geometry",
    "creep_force.mu_0",
    "creep_force.A",
    "creep_force.B",
    "numerics.bogie",
)
# Without self-excitation, for wheels out of round.
_ROUGH_BOGIE = (
    "track",
    *(f"bogie.{name}" for name in BareBogie.model_fields),
    "contact_geometry",
    "creep_force.mu_0",
    "creep_force.A",
    "forced_excitation.B",
    "numerics.bogie",
)
_ABSORBER_TO_TUNE = tuple(
    f"bogie.absorber.{name}" for name in BogieAbsorber.model_fields if name not in ("c_T", "d_T")
)
_FIGURE = ("label",)
_FIGURE_WITH_ABSORBER = (*_FIGURE, "absorber.c_T", "absorber.d_T")
_FIGURE_OF_VARIANTS = ("label", "absorber_variants.name", "absorber_variants.label")

# What each stage and each figure uses. `study.<x>` and `numerics.<x>` come without the <x>.
STAGES: dict[str, tuple[str, ...]] = {
    "stability_map": (
        *_FORCE,
        *_WHEELSET,
        *_VARIANTS,
        "study.stability_map",
        "numerics.stability_map",
    ),
    "hopf_points": (*_FORCE, *_WHEELSET_OF_ANY_C_A, *_VARIANTS, "numerics.hopf_points"),
    "limit_cycles": (
        *_FORCE,
        *_WHEELSET_OF_ANY_C_A,
        *_VARIANTS,
        "study.limit_cycles",
        "numerics.limit_cycles",
    ),
    "hopf_curves": (
        *_FORCE,
        *_WHEELSET_OF_ANY_C_A,
        "absorber.m_T",
        "study.hopf_curves",
        "numerics.hopf_curves",
    ),
    "critical_hopf_curve": (
        *_FORCE,
        *_WHEELSET_OF_ANY_C_A,
        "absorber.m_T",
        "study.critical_hopf_curve",
        "numerics.critical_hopf_curve",
    ),
    "cycle_amplitudes": (
        *_FORCE,
        *_WHEELSET,
        "absorber.m_T",
        "study.cycle_amplitudes",
        "numerics.cycle_amplitudes",
    ),
    "absorber_tuning": (
        *_FORCE,
        *_WHEELSET,
        "absorber",
        "forced_excitation.B",
        "study.frequency_response.frequency",
        "numerics.absorber_tuning",
    ),
    "frequency_response": (
        *_FORCE,
        *_WHEELSET,
        "forced_excitation.B",
        "study.frequency_response",
        "numerics.frequency_response",
    ),
    "contact_geometry": (
        "contact_geometry",
        "bogie.wheel.radius",
        "bogie.wheel.half_distance",
        "bogie.half_wheelbase",
        "track.radius",
        "measured.wheel",
        "measured.rail",
        "numerics.contact_geometry",
    ),
    "curving_equilibrium": (*_BOGIE, "study.bogie_modes.frequency"),
    "bogie_modes": (*_BOGIE, "study.bogie_modes", "numerics.bogie_modes"),
    "curve_entry": (*_BOGIE, "study.curve_entry", "numerics.curve_entry"),
    "bogie_linearisation_none": _ROUGH_BOGIE,
    "bogie_linearisation_paper": (*_ROUGH_BOGIE, "bogie.absorber"),
    "bogie_linearisation_tuned": (*_ROUGH_BOGIE, *_ABSORBER_TO_TUNE),
    "bogie_simulation": (
        "out_of_roundness",
        "measured.out_of_roundness",
        "numerics.bogie_simulation",
    ),
    "wear": ("wear", "numerics.wear"),
    "evolution_tendency": (
        "wear",
        "out_of_roundness.wheels",
        "study.evolution_tendency",
        "numerics.wear",
        "numerics.evolution_tendency",
    ),
    "tendency_maps": (
        *_ROUGH_BOGIE,
        "bogie.absorber",
        "wear",
        "out_of_roundness.wheels",
        "study.evolution_tendency",
        "study.tendency_maps",
        "numerics.wear",
        "numerics.tendency_maps",
    ),
    "wheelset_designs": (
        *_FORCE,
        *_WHEELSET,
        "absorber",
        "forced_excitation.B",
        "study.stability_map.c_A",
        "study.stability_map.c_R",
        "study.frequency_response.frequency",
        "study.wheelset_designs",
        "numerics.wheelset_designs",
    ),
    "bogie_designs": (
        *_BOGIE,
        "forced_excitation.B",
        "wear",
        "out_of_roundness.wheels",
        "study.evolution_tendency.frequency",
        "study.tendency_maps.design_band",
        "study.bogie_designs",
        "numerics.wear",
        "numerics.bogie_designs",
    ),
    "robustness_sample": (
        *_ROUGH_BOGIE,
        *_ABSORBER_TO_TUNE,
        "creep_force.B",
        "wear",
        "out_of_roundness.wheels",
        "study.bogie_modes.frequency",
        "study.evolution_tendency.peaks",
        "study.tendency_maps.design_band",
        "study.design_sheet.conditions",
        "study.design_sheet.rubber",
        "numerics.wear",
        "numerics.robustness_sample",
    ),
    "robust_tuning": (
        "bogie.absorber",
        "bogie.wheel.radius",
        "study.bogie_modes.frequency",
        "study.evolution_tendency.peaks",
        "study.tendency_maps.design_band",
        "study.tendency_maps.c_T",
        "study.tendency_maps.d_T",
        "study.design_sheet",
        "numerics.robust_tuning",
    ),
    "fig02_stability_map": (*_FIGURE_OF_VARIANTS, *_FIGURE_WITH_ABSORBER),
    "fig03_bifurcation_diagram": _FIGURE_OF_VARIANTS,
    "fig04_hopf_curves": _FIGURE,
    "fig05_critical_hopf_curve": _FIGURE_WITH_ABSORBER,
    "fig06_cycle_amplitudes": _FIGURE,
    "fig07_frequency_response": _FIGURE,
    "fig08_bogie": (*_FIGURE, "bogie"),
    "fig09_curve_entry": (*_FIGURE, "study.curve_entry.entry"),
    "bogie_mode_shapes": (*_FIGURE, "bogie.wheel.radius"),
    "bogie_stability": (*_FIGURE, "creep_force.B", "bogie.absorber.motion"),
    "campbell_chart": (*_FIGURE, "track.speed", "bogie.wheel.radius"),
    "fig10_evolution_tendency": _FIGURE,
    "worn_wheels": (*_FIGURE, "study.tendency_maps.design_band"),
    "order_speed_chart": (*_FIGURE, "bogie.wheel.radius"),
    "tendency_design_chart": (
        *_FIGURE,
        "study.tendency_maps.design_band",
        "bogie.absorber.motion",
    ),
    "explorer": (
        *_FIGURE,
        "creep_force.B",
        "forced_excitation.B",
        "bogie.absorber.motion",
        "study.tendency_maps.design_band",
    ),
    "design_sheet": (
        *_FIGURE,
        "creep_force.mu_0",
        "creep_force.B",
        "forced_excitation.B",
        "track",
        "bogie.absorber",
        "bogie.car_body.mass",
        "bogie.wheel.radius",
        "study.bogie_modes.B_max",
        "study.bogie_modes.frequency",
        "study.tendency_maps.design_band",
        "study.design_sheet",
    ),
}


_Model = TypeVar("_Model", bound=BaseModel)


class ConfigurationError(ValueError):
    """All problems of a configuration, a line each."""


@dataclass(frozen=True)
class Configuration:
    """A validated configuration: the run, its lines by name and the measured files of each."""

    run: Run
    lines: Mapping[str, Line]
    measured: Mapping[str, Mapping[str, MeasuredFile]]


@dataclass(frozen=True)
class _Layer:
    """What one file (or the command line) says, and the name by which problems refer to it."""

    name: str
    content: Mapping[str, Any]


def stage(config: Configuration, line: str, name: str) -> dict[str, Any]:
    """Return exactly the values that a stage or figure of a line uses.

    Parameters
    ----------
    config : Configuration
        The whole configuration.
    line : str
        Name of the line.
    name : str
        Name of the stage or figure, a key of `STAGES`.

    Returns
    -------
    dict
        Plain nested maps, lists, numbers and texts in SI units; the entries of `study` and
        `numerics` are those of this stage; `measured` holds the hashes of measured files.
    """
    everything = config.lines[line].model_dump(mode="json")
    measured = config.measured[line]
    everything["measured"] = {
        what: measured[what].sha256 if what in measured else "" for what in measured_files.KEYS
    }
    everything["numerics"] = config.run.numerics.model_dump(mode="json")
    values = _select(everything, [tuple(path.split(".")) for path in STAGES[name]])
    for section in ("study", "numerics"):
        if section in values:
            values[section] = {k: v for part in values[section].values() for k, v in part.items()}
    return values


def _select(tree: Any, paths: Sequence[tuple[str, ...]]) -> Any:
    if () in paths:
        return tree
    if isinstance(tree, list):
        return [_select(item, paths) for item in tree]
    heads = {path[0] for path in paths}
    return {
        key: _select(value, [path[1:] for path in paths if path[0] == key])
        for key, value in tree.items()
        if key in heads
    }


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
    lines, measured = _load_lines(folder, layers, problems)
    if problems or run is None:
        raise ConfigurationError("\n".join(dict.fromkeys(map(slips.harmless, problems))))
    return Configuration(run, lines, measured)


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
    content, wrong = strict_yaml.read(path)
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
) -> tuple[dict[str, Line], dict[str, dict[str, MeasuredFile]]]:
    base_problems: list[str] = []
    base = _read(folder / "lines" / f"{BASE_LINE}.yaml", folder, base_problems)
    problems += base_problems
    there = sorted(path.stem for path in (folder / "lines").glob("*.yaml"))
    lines, measured = {}, {}
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
                meaning = schema.entries(Line)["label"].meaning
                problems.append(f"{own[0].name}: label: missing: must be {meaning}")
            layers = [*base, *own] if base and own else []
        if layers and (line := _validate(Line, layers, problems)):
            lines[name] = line
            measured[name] = _measured(line, folder, layers, problems)
    return lines, measured


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


def _validate(model: type[_Model], layers: Sequence[_Layer], problems: list[str]) -> _Model | None:
    try:
        return model.model_validate(_merged(layers))
    except ValidationError as error:
        for slip in error.errors(include_url=False):
            if slip["type"] == "too_short" and slip["input"]:
                continue  # only because its items, reported themselves, did not count
            where = _origin(slip["loc"], layers, missing=slip["type"] == "missing").name
            problems.append(f"{where}: {slips.in_words(slip, model)}")
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
