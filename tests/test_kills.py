"""A pipeline that is killed at random moments ends with the same bytes as an undisturbed one.

`pytest --slow tests/test_kills.py -s` shows each kill; about ten minutes.
"""

import contextlib
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tramdva.record.inventory import SET_ASIDE

KILLS = 24
SEED = 6
TARGETS = [
    *(
        f"results/{{line}}/{stage}.nc"
        for stage in (
            "hopf_points",
            "limit_cycles",
            "cycle_amplitudes",
            "frequency_response",
            "contact_geometry",
            "bogie_linearisation/none",
            *(f"wear/none/order_{order}" for order in (6, 26, 46)),
        )
    ),
    "paper_figures/{line}/fig07_frequency_response.pdf",
    "paper_figures/{line}/fig08_bogie.png",
    "paper_figures/{line}/table2_absorber_designs.csv",
]
COARSE = """
numerics:
  stability_map: {points: 61}
  limit_cycles: {mesh_intervals: 12, max_orbits: 25}
  cycle_amplitudes: {mesh_intervals: 12, points: 4}
  hopf_curves: {max_points: 100}
  critical_hopf_curve: {max_points: 100, check_points: 60}
  frequency_response: {points: 300}
  contact_geometry: {shift_step: 1.0e-4, yaw_nodes: 8}
  bogie: {cells_along: 6, strips: 6}
  bogie_simulation: {samples: 128, revolutions: 1}
  wear: {wear_cells_along: 8, wear_strips: 8}
  evolution_tendency: {orders: {first: 6, last: 60, step: 20}} # those of one job
"""
# Another state of the same folder: whatever of it survives a kill must not stay in the results.
OTHER = "numerics: {stability_map: {points: 51}, critical_hopf_curve: {check_points: 50}}\n"


# Removed where a run ended before it was killed: single files, and one of a batch.
LOST = [
    "stability_map.nc",
    "critical_hopf_curve.nc",
    "bogie_simulation/none/order_26.nc",
    "wear/none/order_26.nc",
]


class Kill:
    """A way to end a run: which processes get which signal."""

    def __init__(self, name: str, number: signal.Signals) -> None:
        self.name, self.number = name, number

    def __str__(self) -> str:
        return f"{self.number.name} to {self.name}"

    def strike(self, run: subprocess.Popen) -> bool:
        """Send the signal; False where there was nothing to kill."""
        with contextlib.suppress(ProcessLookupError):
            if self.name == "the group":
                os.killpg(run.pid, self.number)
            elif self.name == "snakemake":
                os.kill(run.pid, self.number)
            elif jobs := jobs_of(run.pid):
                os.kill(jobs[0][0], self.number)
            else:
                return False
            return True
        return False


WAYS = [
    Kill("the group", signal.SIGKILL),
    Kill("snakemake", signal.SIGKILL),  # its jobs go on
    Kill("a job", signal.SIGKILL),
    Kill("the group", signal.SIGTERM),
    Kill("a job", signal.SIGTERM),
    Kill("the group", signal.SIGINT),
]


def jobs_of(group: int) -> list[tuple[int, str]]:
    """Find the jobs in a process group: process and stage."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError, ValueError):
            words = (folder / "cmdline").read_bytes().decode().split("\0")
            if os.getpgid(int(folder.name)) == group and "python" in words[0]:
                scripts = [re.search(r"scripts/tmp\w+\.(\w+)\.py$", word) for word in words]
                found += [(int(folder.name), script[1]) for script in scripts if script]
    return found


def start(code: Path, folder: Path, *files: Path) -> subprocess.Popen:
    program = [sys.executable, "-m", "snakemake", "--snakefile", str(code / "Snakefile")]
    targets = [name.format(line="paper") for name in TARGETS]
    with (folder / "terminal.txt").open("a") as terminal:
        return subprocess.Popen(
            [*program, "-j1", "--directory", folder, *targets, "--configfile", *files],
            cwd=code,
            env=os.environ | {"PYTHONPATH": str(code / "src")},
            stdout=terminal,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )


def contents(folder: Path) -> dict[str, bytes]:
    """Files of the pipeline; what it set aside, made under the other values, is the user's."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for name in ("results", "paper_figures")
        for path in sorted((folder / name).rglob("*"))
        if path.is_file() and not path.name.endswith(SET_ASIDE)
    }


@pytest.mark.slow
def test_killed_runs_lose_nothing(frozen_code: Path, tmp_path: Path) -> None:
    chance = random.Random(SEED)
    coarse, other = tmp_path / "coarse.yaml", tmp_path / "other.yaml"
    coarse.write_text(COARSE)
    other.write_text(OTHER)
    undisturbed, killed = tmp_path / "undisturbed", tmp_path / "killed"
    undisturbed.mkdir()
    killed.mkdir()
    assert start(frozen_code, undisturbed, coarse).wait() == 0  # compiles
    first = contents(undisturbed)
    shutil.rmtree(undisturbed / "results")
    begin = time.monotonic()
    assert start(frozen_code, undisturbed, coarse).wait() == 0
    duration = time.monotonic() - begin
    assert contents(undisturbed) == first
    kills, stages, runs = 0, set(), 0
    while kills < KILLS:
        files = [coarse] if chance.random() < 0.7 else [coarse, other]
        run = start(frozen_code, killed, *files)
        runs += 1
        way, delay = WAYS[kills % len(WAYS)], chance.uniform(0.5, 0.6 * duration)
        with contextlib.suppress(subprocess.TimeoutExpired):
            run.wait(delay)
        running = [stage for _, stage in jobs_of(run.pid)]
        if run.poll() is None and way.strike(run):
            kills += 1
            stages |= set(running)
            print(f"{kills:2d} {way} after {delay:.1f} s during {running or 'no job'}", flush=True)
        elif run.poll() == 0:
            for name in LOST:
                (killed / "results/paper" / name).unlink(missing_ok=True)
        if way.number != signal.SIGKILL or way.name == "a job":
            run.wait(60 + duration)  # it ends by itself
    print(f"{kills} kills in {runs} runs during {sorted(stages)}; undisturbed {duration:.0f} s")

    last = start(frozen_code, killed, coarse)

    assert last.wait() == 0, (killed / "terminal.txt").read_text()
    assert contents(killed) == contents(undisturbed)
    assert not list((killed / ".snakemake").glob("locks/*.lock"))
    assert len(stages) >= 5
