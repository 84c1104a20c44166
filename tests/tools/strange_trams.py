"""Random trams through all stages: each must end with results, or with a status that says why.

    python tests/tools/strange_trams.py --basic 300 --bogie 50 [--table trams.csv]

draws parameter sets over the ranges of the schema ("wide") and around the paper's line ("near"),
sends each through the stages with coarse numerics in a process of its own and prints shares and
times. The exit code is 1 where a set crashed, ran out of time or holds unexplained NaN.
"""

from __future__ import annotations

import argparse
import copy
import csv
import importlib
import json
import os
import select
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

from tramdva import results
from tramdva.configuration import reference
from tramdva.configuration.line import Line
from tramdva.configuration.reading import Configuration, load
from tramdva.configuration.uses import used_values
from tramdva.running.numba_cache import use_numba_cache
from tramdva.stages import bogie_modes
from tramdva.variables.registry import STAGES

use_numba_cache()

import numpy as np
import snakefile_tables
import yaml

ROOT = Path(__file__).resolve().parents[2]
SEED = 20
BASIC = ("curve", "creep_force", "wheelset", "absorber", "forced_excitation")
BOGIE = (*BASIC, "track", "bogie", "contact_geometry")
NEAR = 1.5  # a near value lies within this factor of the paper's
NEAR_BOGIE = 1.25
COARSE: dict[str, Any] = {
    "stability_map": {"points": 15},
    "limit_cycles": {"mesh_intervals": 12, "max_orbits": 25, "equilibria": 30},
    "cycle_amplitudes": {"mesh_intervals": 12, "points": 3},
    "hopf_curves": {"max_points": 60},
    "critical_hopf_curve": {"max_points": 40, "check_points": 30},
    "absorber_tuning": {"frequency_points": 400},
    "frequency_response": {"points": 60},
    "contact_geometry": {"shift_step": 8.0e-5, "yaw_nodes": 12},
    "bogie": {
        "cells_along": 6,
        "strips": 6,
        "cutoff_frequency": 300,
        "elements_per_section": 2,
    },
    "bogie_modes": {"friction_points": 2, "map_points": 2},
    "curve_entry": {"interval": 2.0e-3, "every": 10, "tolerance": 5.0e-2},
}
SHORT_RIDE = {"entry": 0.5, "duration": 1.0}
LINE = "paper"


READS = snakefile_tables.read().stages
BASIC_JOBS = {
    name: READS[name]
    for name in (
        "stability_map",
        "hopf_points",
        "limit_cycles",
        "hopf_curves",
        "critical_hopf_curve",
        "cycle_amplitudes",
        "absorber_tuning",
        "frequency_response",
    )
}
BOGIE_JOBS = {
    name: READS[name]
    for name in (
        "hopf_curves",
        "critical_hopf_curve",
        "absorber_tuning",
        "contact_geometry",
        "curving_equilibrium",
        "bogie_modes",
        "curve_entry",
    )
}


class Outcome(NamedTuple):
    """How a stage ended: counts of its statuses, unexplained NaN, error, seconds."""

    stage: str
    statuses: dict[str, int]
    unexplained: list[str]
    error: str
    seconds: float


# Drawing ----------------------------------------------------------------------------------------


def drawn(seed: int, number: int, sections: tuple[str, ...], near: float | None) -> dict[str, Any]:
    """Draw the sections of a tram that the schema allows.

    Parameters
    ----------
    seed, number : int
        They determine the set.
    sections : tuple of str
        The sections that are drawn; the others are the paper's.
    near : float or None
        Largest factor between a value and the paper's; None draws over the whole ranges.

    Returns
    -------
    dict
        Sections of a line's file.

    Notes
    -----
    Where values do not fit together, they alone are drawn again.
    """
    random = np.random.default_rng([seed, number])
    paper = yaml.safe_load((ROOT / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    table = {
        path: entry
        for path, entry in reference.entries(Line).items()
        if path.split(".")[0] in sections and entry.low is not None and "[" not in path
    }
    tram = {name: copy.deepcopy(paper[name]) for name in sections}
    due = table
    for _ in range(1000):
        for path, entry in due.items():
            _put(tram, path, _value(random, entry, _get(paper, path), near))
        slips = _slips(paper | tram)
        if not slips:
            return tram
        due = {p: e for p, e in table.items() if any(p.startswith(slip) for slip in slips)}
    raise RuntimeError(f"tram {number}: no parameters that fit together: {slips}")


def _slips(line: Mapping[str, Any]) -> list[str]:
    """Return the sections whose values do not fit together; '' is the line itself."""
    try:
        Line.model_validate(line)
    except ValueError as error:
        return [".".join(map(str, slip["loc"])) for slip in error.errors()]
    return []


def _value(
    random: np.random.Generator, entry: reference.Entry, paper: float, near: float | None
) -> float:
    if near is not None:
        value = paper * near ** random.uniform(-1.0, 1.0)
        return float(np.clip(value, entry.low, entry.high))
    if entry.low > 0.0 and entry.high > 20.0 * entry.low:
        return float(np.exp(random.uniform(np.log(entry.low), np.log(entry.high))))
    if entry.low == 0.0 and entry.high > 1e3:
        decades = entry.high * 10.0 ** random.uniform(-8.0, 0.0)
        return float(decades if random.random() < 0.9 else 0.0)
    return float(random.uniform(entry.low, entry.high))


def _get(tree: Any, path: str) -> Any:
    for key in path.split("."):
        tree = tree[key]
    return tree


def _put(tree: Any, path: str, value: float) -> None:
    *parents, last = path.split(".")
    _get(tree, ".".join(parents))[last] = value


# Running ----------------------------------------------------------------------------------------


def run_stages(
    tram: Mapping[str, Any], jobs: Mapping[str, Sequence[str]], folder: Path
) -> Iterator[Outcome]:
    """Send a tram through stages; each result is saved and read again."""
    configuration = _configured(tram, folder)
    found: dict[str, dict[str, np.ndarray]] = {}
    for name, reads in jobs.items():
        start = time.perf_counter()
        if missing := [other for other in reads if other not in found and other != "basic_model"]:
            yield Outcome(name, {}, [], f"not run: no {', '.join(missing)}", 0.0)
            continue
        try:
            found[name] = _stage(configuration, name, reads, found, folder)
        except Exception as error:
            traceback.print_exc()
            reason = f"{type(error).__name__}: {' '.join(str(error).split())}"
            yield Outcome(name, {}, [], reason, time.perf_counter() - start)
        else:
            seconds = time.perf_counter() - start
            yield Outcome(name, statuses(found[name]), unexplained(name, found[name]), "", seconds)


def _configured(tram: Mapping[str, Any], folder: Path) -> Configuration:
    (folder / "lines").mkdir(parents=True)
    (folder / "config.yaml").write_bytes((ROOT / "config/config.yaml").read_bytes())
    # In the place of the paper's line, whose basic model and bogie may be those of two trams.
    line = yaml.safe_load((ROOT / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    line |= {"label": "strange"} | dict(tram)
    line["study"]["curve_entry"] |= SHORT_RIDE
    (folder / f"lines/{LINE}.yaml").write_text(yaml.safe_dump(line))
    return load(folder, (), {"lines": [LINE], "numerics": COARSE})


def _stage(
    configuration: Configuration,
    name: str,
    reads: Sequence[str],
    found: Mapping[str, Mapping[str, np.ndarray]],
    folder: Path,
) -> dict[str, np.ndarray]:
    stage = importlib.import_module(f"tramdva.stages.{name}")
    cfg = used_values(configuration, LINE, name)
    values = stage.compute(cfg, **{other: found[other] for other in reads if other in found})
    path = folder / f"{name}.nc"
    results.save(path, stage.VARIABLES, values, parameters=cfg, code="")
    return results.read(path)


def apart(
    tram: Mapping[str, Any], jobs: Mapping[str, Sequence[str]], limit: float
) -> tuple[list[Outcome], str]:
    """Run the stages in a process of its own, which ends after a time limit.

    Returns
    -------
    outcomes : list of Outcome
        Of the stages that ended.
    broken : str
        Why the process ended early; empty where it did not.
    """
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        _report(tram, jobs, reading, writing)
    os.close(writing)
    text, late = _received(reading, time.monotonic() + limit)
    if late:
        os.kill(child, signal.SIGKILL)
    _, status = os.waitpid(child, 0)
    outcomes = [Outcome(*json.loads(line)) for line in text.splitlines()]
    if late:
        return outcomes, f"no end within {limit:g} s"
    return outcomes, f"ended with {status}" if status else ""


def _report(
    tram: Mapping[str, Any], jobs: Mapping[str, Sequence[str]], reading: int, writing: int
) -> None:
    code = 1
    try:
        os.close(reading)
        quiet = os.open(os.devnull, os.O_WRONLY)
        if not os.environ.get("STRANGE_TRAMS_SHOW"):
            os.dup2(quiet, 2)
        with tempfile.TemporaryDirectory() as folder, os.fdopen(writing, "w") as pipe:
            for outcome in run_stages(tram, jobs, Path(folder) / "config"):
                print(json.dumps(outcome), file=pipe, flush=True)
        code = 0
    finally:
        os._exit(code)


def _received(reading: int, deadline: float) -> tuple[str, bool]:
    parts, late = [], False
    while not late:
        ready, _, _ = select.select([reading], [], [], max(0.0, deadline - time.monotonic()))
        late = not ready
        if ready and not (part := os.read(reading, 65536)):
            break
        parts += [part] if ready else []
    os.close(reading)
    return b"".join(parts).decode(), late


# Judging ----------------------------------------------------------------------------------------

GOOD = {"converged", "completed", "nothing_found", "without_status"}
# NaN with a meaning: the value does not exist there, which the other variable says.
ABSENT_WITHOUT_ABSORBER = ("m_T", "c_T", "d_T", "absorber_c_T", "absorber_d_T")
# No critical curve at this damping; no self-excitation up to the largest friction decrease.
ABSENT_BY_NATURE = ("critical_c_T", "critical_friction_decrease")
APART = ("absorber", "contact")  # dimensions of what a wheel and rail that do not touch lack


def statuses(values: Mapping[str, np.ndarray]) -> dict[str, int]:
    """Count the statuses of a file."""
    if "status" not in values:
        return {"without_status": 1}
    counts = Counter(map(str, values["status"].ravel()))
    return dict(counts) or {"nothing_found": 1}


def unexplained(stage: str, values: Mapping[str, np.ndarray]) -> list[str]:
    """Name the variables with NaN or infinity that no status, flag or name explains."""
    found = []
    for name, variable in STAGES[stage].variables.items():
        if variable.kind != "real" or name in ABSENT_BY_NATURE:
            continue
        wrong = ~np.isfinite(values[name]) & ~_explained(stage, name, values)
        if wrong.any():
            found.append(f"{name} ({int(wrong.sum())} of {wrong.size})")
    return found


def _explained(stage: str, name: str, values: Mapping[str, np.ndarray]) -> np.ndarray:
    """Where a value may be missing: what stands along the same dimensions says so."""
    variables, shape = STAGES[stage].variables, values[name].shape
    dimensions = variables[name].dimensions
    explained = np.zeros(shape, dtype=bool)
    if name.startswith("floquet_multiplier"):  # the bare wheelset has four of the six
        explained[:, 4:] = (values["absorber"] == "none")[:, None]
    if dimensions == APART:
        explained |= np.isnan(values["normal_force"])
    if name == "map_growth_rate":
        explained |= str(values["map_status"]) not in GOOD
    for other, variable in variables.items():
        along = len(variable.dimensions)
        if along and variable.kind != "real" and variable.dimensions == dimensions[:along]:
            reason = _reason(name, other, values[other])
            explained |= reason.reshape(shape[:along] + (1,) * (len(shape) - along))
    return explained


def _reason(name: str, other: str, flags: np.ndarray) -> np.ndarray:
    if other == "status":
        return ~np.isin(flags, list(GOOD))
    if other == "instability" and not name.startswith("absorber_"):
        return flags == "no_equilibrium"
    if other == "absorber_instability" and name.startswith("absorber_"):
        return flags == "no_equilibrium"
    if other in ("absorber", "design") and name in ABSENT_WITHOUT_ABSORBER:
        return flags == "none"
    if other.endswith("mode_name"):
        return flags == ""
    if other == "shape_mode":  # a mode that is not there keeps its bare word as name
        return np.isin(flags, bogie_modes.SHAPES)
    return np.zeros(flags.shape, dtype=bool)


# Telling ----------------------------------------------------------------------------------------


class Tram(NamedTuple):
    """One set: how it was drawn, its number, how its stages ended."""

    draw: str
    number: int
    outcomes: list[Outcome]
    broken: str

    @property
    def verdict(self) -> str:
        """One word for the whole set."""
        if self.broken or any(outcome.error for outcome in self.outcomes):
            return "failed"
        if any(outcome.unexplained for outcome in self.outcomes):
            return "silent_nan"
        found = {status for outcome in self.outcomes for status in outcome.statuses}
        if not found <= GOOD:
            return "with_status"
        return "converged" if found & {"converged", "completed"} else "nothing_found"


def sample(
    numbers: Iterable[int],
    sections: tuple[str, ...],
    jobs: Mapping[str, Sequence[str]],
    near: float,
    limit: float,
    seed: int = SEED,
) -> Iterator[Tram]:
    """Yield sets over the whole ranges (odd numbers) and near the paper's line (even ones)."""
    for number in numbers:
        factor = None if number % 2 else near
        tram = drawn(seed, number, sections, factor)
        outcomes, broken = apart(tram, jobs, limit)
        yield Tram("wide" if factor is None else "near", number, outcomes, broken)


def main(arguments: list[str]) -> int:
    """Run the sample and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--basic", type=int, default=300, help="sets for the basic model")
    parser.add_argument("--bogie", type=int, default=50, help="sets for the bogie")
    parser.add_argument("--first", type=int, default=0, help="number of the first set")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--limit", type=float, default=300.0, help="seconds per set")
    parser.add_argument("--table", type=Path, help="CSV file with a row per set and stage")
    options = parser.parse_args(arguments)
    bad = 0
    for title, count, sections, jobs, near in (
        ("basic model", options.basic, BASIC, BASIC_JOBS, NEAR),
        ("bogie", options.bogie, BOGIE, BOGIE_JOBS, NEAR_BOGIE),
    ):
        if not count:
            continue
        trams = []
        numbers = range(options.first, options.first + count)
        for tram in sample(numbers, sections, jobs, near, options.limit, options.seed):
            trams.append(tram)
            _tell(tram)
            _tabulate(options.table, title, tram)
        _summarise(title, trams)
        bad += sum(tram.verdict in ("failed", "silent_nan") for tram in trams)
    return 1 if bad else 0


def _tell(tram: Tram) -> None:
    reasons = [f"{o.stage}: {o.error or '; '.join(o.unexplained)}" for o in tram.outcomes]
    reasons = [reason for reason in reasons if not reason.endswith(": ")]
    seconds = sum(outcome.seconds for outcome in tram.outcomes)
    reasons += [tram.broken] if tram.broken else []
    print(f"{tram.number:4d} {tram.draw} {tram.verdict} {seconds:.1f} s", *reasons, flush=True)


def _tabulate(path: Path | None, title: str, tram: Tram) -> None:
    if path is None:
        return
    with path.open("a", encoding="utf-8") as file:
        for outcome in tram.outcomes:
            row = [title, tram.draw, tram.number, tram.verdict, *outcome, tram.broken]
            csv.writer(file).writerow(row)


def _summarise(title: str, trams: list[Tram]) -> None:
    print(f"\n{title}: {len(trams)} sets")
    for draw in ("near", "wide"):
        chosen = [tram for tram in trams if tram.draw == draw]
        if not chosen:
            continue
        counts = Counter(tram.verdict for tram in chosen)
        shares = ", ".join(f"{name} {n} ({n / len(chosen):.0%})" for name, n in counts.items())
        print(f"  {draw}: {len(chosen)} sets: {shares}")
    for stage in dict.fromkeys(o.stage for tram in trams for o in tram.outcomes):
        ended = [o for tram in trams for o in tram.outcomes if o.stage == stage]
        total: Counter[str] = Counter()
        for outcome in ended:
            total.update(outcome.statuses)
        seconds = [outcome.seconds for outcome in ended]
        shares = ", ".join(f"{k} {v / total.total():.1%}" for k, v in total.most_common())
        print(f"  {stage}: {np.median(seconds):.2f} s (at most {max(seconds):.1f} s); {shares}")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
