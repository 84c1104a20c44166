"""Trams as they are in service, through what a run tells of them first.

    python benchmarks/real_trams.py [--count 30] [--first 0] [--table trams.csv]

draws trams (gauge, radius, speed, wheel, load, rubber, profiles; the same for the same number),
sends each through the stages `contact_geometry`, `basic_model` and `preflight` with the numerics of
`config/quick.yaml` and prints what came of it, shares of the outcomes and the five slowest. Each
tram has a result or a reason in words; the exit code is 1 where one ended in an error.
"""

from __future__ import annotations

import argparse
import csv
import os
import shutil
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

from tramdva.running.numba_cache import use_numba_cache

use_numba_cache()

import numpy as np
import yaml

from tramdva import results
from tramdva.configuration.reading import ConfigurationError, load
from tramdva.configuration.uses import used_values
from tramdva.report import preflight as glance
from tramdva.stages import basic_model, contact_geometry, preflight

ROOT = Path(__file__).resolve().parents[1]
SEED = 14
STRAIGHT = 5000.0  # m
LARGEST_ACCELERATION = 1.0  # m/s^2 across the track: passengers stand
WORN = {
    "wheel": {"measured": "profiles/worn_wheel.csv", "measured_noise": 2.0e-6},
    "rail": {"measured": "profiles/worn_rail.csv", "measured_noise": 2.0e-6},
}


class Outcome(NamedTuple):
    """What came of a tram.

    number : of the draw; words : what it is; verdict : in a word; reason : in words, or empty
    error : last line of a traceback, or empty; seconds : of all stages
    """

    number: int
    words: str
    verdict: str
    reason: str
    error: str
    seconds: float


def drawn(number: int) -> dict[str, Any]:
    """Draw what a line's file says of a tram.

    Notes
    -----
    One in six runs straight on. No tram is faster in its curve than passengers bear.
    """
    random = np.random.default_rng([SEED, number])
    gauge = int(random.choice([1000, 1435]))
    is_straight = number % 6 == 5
    radius = STRAIGHT if is_straight else float(np.exp(random.uniform(np.log(15), np.log(60))))
    fastest = min(50.0, 3.6 * np.sqrt(LARGEST_ACCELERATION * radius))
    wheel, load = float(random.uniform(0.25, 0.37)), float(random.uniform(4.0, 10.0))
    stiffness = float(np.exp(random.uniform(np.log(0.5), np.log(8.0))))
    paper = yaml.safe_load((ROOT / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    layer = paper["bogie"]["wheel"]["layer"]
    worn = bool(random.random() < 0.5)
    return {
        "label": f"tram {number}",
        "tram": {
            "gauge_mm": gauge,
            "speed_km_h": round(float(random.uniform(5.0, fastest)), 1),
            "axle_load_t": round(load, 2),
        },
        "track": {"radius": round(radius, 1)},
        "bogie": {
            "wheel": {
                "radius": round(wheel, 3),
                "layer": {
                    name: stiffness * value
                    for name, value in layer.items()
                    if name.endswith("stiffness")
                },
            },
            "stub": {"height": round(wheel, 3)},
        },
        **({"contact_geometry": WORN} if worn else {}),
    }


def described(line: dict[str, Any]) -> str:
    """Say what a tram is."""
    tram, radius, wheel = line["tram"], line["track"]["radius"], line["bogie"]["wheel"]
    where = "straight" if radius == STRAIGHT else f"R {radius:.1f} m"
    stiffness = wheel["layer"]["radial_stiffness"] / 4.0e8
    profiles = "worn" if "contact_geometry" in line else "new"
    return (
        f"{tram['gauge_mm']} mm, {where}, {tram['speed_km_h']} km/h, wheel {wheel['radius']} m, "
        f"{tram['axle_load_t']} t, rubber x {stiffness:.1f}, {profiles}"
    )


def outcome(number: int, folder: Path, numerics: Path | None = None) -> Outcome:
    """Send a tram through the stages.

    Parameters
    ----------
    number : of the draw; folder : copy of the configuration, which receives the line
    numerics : file with the numerics, else `quick.yaml`
    """
    line, name = drawn(number), f"tram-{number}"
    (folder / f"lines/{name}.yaml").write_text(yaml.safe_dump(line), encoding="utf-8")
    start = time.perf_counter()
    verdict, reason, error = "refused", "", ""
    try:
        values, basic = _stages(name, folder, numerics or folder / "quick.yaml")
        verdict, reason = _verdict(values, basic)
    except ConfigurationError as refused:
        reason = str(refused)
    except Exception as wrong:
        traceback.print_exc()
        verdict, error = "error", f"{type(wrong).__name__}: {wrong}"
    seconds = time.perf_counter() - start
    return Outcome(number, described(line), verdict, reason, error, seconds)


def _stages(name: str, folder: Path, numerics: Path) -> tuple[dict, dict]:
    configuration = load(folder, [numerics], {"lines": [name]})

    def file_of(measured: str) -> Path:
        return folder / measured

    found: dict[str, dict[str, np.ndarray]] = {}
    for stage, reads in (
        (contact_geometry, ()),
        (basic_model, ("contact_geometry",)),
        (preflight, ("contact_geometry", "basic_model")),
    ):
        rule = stage.VARIABLES.name
        cfg = used_values(configuration, name, rule)
        files = {other: found[other] for other in reads}
        asked = {} if stage is basic_model else {"file_of": file_of}
        path = folder / f"{rule}.nc"
        values = stage.compute(cfg, **files, **asked)
        results.save(path, stage.VARIABLES, values, parameters=cfg, code="")
        found[rule] = results.read(path)
    return found["preflight"], found["basic_model"]


def _verdict(values: dict[str, np.ndarray], basic: dict[str, np.ndarray]) -> tuple[str, str]:
    """Verdict in a word and what is to be said of it."""
    status = str(values["status"][0])
    if status != "converged":
        rows = dict(row for _, rows in glance.sections(values) for row in rows)
        return status, rows["steady running without absorbers"]
    words = [f"basic model: {basic['reason']}"] if str(basic["reason"]) else []
    rate, frequency = values["growth_rate"][0, 0], values["growth_frequency"][0, 0]
    if np.isnan(rate):
        return "no_oscillation", "; ".join(words)
    mode = str(values["growth_mode"][0, 0])
    words.insert(0, f"{mode} {frequency:.1f} Hz {rate:+.2f} 1/s")
    if str(values["critical_mode"]):
        words.insert(1, f"critical {values['critical_frequency']:.1f} Hz")
    return "self_excited" if rate > 0.0 else "stable", "; ".join(words)


def outcomes(numbers: range) -> Iterator[Outcome]:
    """Send trams through the stages, one after the other."""
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copytree(ROOT / "config", Path(folder) / "config")
        for number in numbers:
            yield outcome(number, copy)


def main(arguments: list[str]) -> int:
    """Run the sample and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--table", type=Path, help="CSV file with a row per tram")
    options = parser.parse_args(arguments)
    found = []
    for one in outcomes(range(options.first, options.first + options.count)):
        found.append(one)
        said = one.error or one.reason
        print(
            f"{one.number:3d} {one.verdict} {one.seconds:.1f} s | {one.words} | {said}", flush=True
        )
    if options.table:
        with options.table.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([Outcome._fields, *found])
    counts = Counter(one.verdict for one in found)
    print("\nshares:", ", ".join(f"{k} {n} ({n / len(found):.0%})" for k, n in counts.items()))
    slowest = sorted(found, key=lambda one: -one.seconds)[:5]
    print("slowest:", ", ".join(f"tram {one.number} {one.seconds:.1f} s" for one in slowest))
    return 1 if counts["error"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
