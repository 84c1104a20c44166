"""Run a job: its output into a log file, one line to the terminal where it fails."""

from __future__ import annotations

import csv
import logging
import os
import sys
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from tramdva.running import supervision


@contextmanager
def logging_to(path: str | Path) -> Iterator[None]:
    """Send all output of the block to a log file.

    An exception is written to the log with its traceback and to the terminal as one line; it
    ends the program with exit code 1.

    Parameters
    ----------
    path : path
        The log file.
    """
    terminal = os.dup(2)
    with _opened(Path(path)) as log:
        sys.stdout.flush()
        sys.stderr.flush()
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
        logging.basicConfig(
            level=logging.INFO, stream=log, format="%(name)s: %(message)s", force=True
        )
        logging.captureWarnings(True)
        supervision.end_with_run()
        try:
            yield
        except Exception as error:
            reason = " ".join(str(error).split()) or "no reason given"
            os.write(terminal, f"{type(error).__name__}: {reason} (see {path})\n".encode())
            with suppress(OSError):  # the disk may be full
                traceback.print_exc(file=log)
            raise SystemExit(1) from None
        finally:
            sys.stdout.flush()
            sys.stderr.flush()


def stop_polling(workflow: object) -> None:
    """Let Snakemake's scheduler wait for its jobs instead of looking every second.

    With its limit of jobs per second each look of the scheduler at jobs that are ready starts a
    timer whose end is the next look, and each costs more the more jobs there are. Where jobs run
    on this machine the number of cores limits them. The attribute is none of Snakemake's promises:
    where it is missing, nothing happens.

    Parameters
    ----------
    workflow : Snakemake's object of the run
    """
    scheduler = getattr(workflow, "scheduler", None)
    is_local = getattr(workflow, "local_exec", False)
    if is_local and hasattr(scheduler, "job_rate_limiter"):
        scheduler.job_rate_limiter = None


def configuration_file(name: str, scriptdir: str) -> Path:
    """Find a file that a line names, in the folder of the run's configuration.

    It is no input of its rule, whose path would differ where results are moved or the code lies
    elsewhere: the hash of its content is among the parameters.

    Parameters
    ----------
    name : str
        Relative to the folder.
    scriptdir : str
        Folder of the scripts, `workflow/scripts`.

    Returns
    -------
    Path
        In `config` of the working directory if there is a configuration, else beside the code.
    """
    own = Path("config")
    code = Path(scriptdir).resolve().parents[1]
    folder = own if (own / "config.yaml").is_file() else code / "config"
    return folder / name


def _opened(path: Path) -> IO[str]:
    try:
        return path.open("w", buffering=1, encoding="utf-8")
    except OSError as error:
        raise SystemExit(f"{path}: cannot be written: {error.strerror}") from None


def summary(lines: Sequence[str], folder: Path = Path("logs")) -> str:
    """Tell where the results are and how long each job of each line took."""
    rows = [
        f"  {seconds:7.1f} s  {line}/{stage}"
        for line in lines
        for stage, seconds in _durations(folder / line)
    ]
    return "\n".join(["tramdva: results/ and paper_figures/ are complete.", *rows])


def _durations(folder: Path) -> Iterator[tuple[str, float]]:
    """Time of each job; of the many jobs of one stage their sum."""
    for path in sorted(folder.glob("*.tsv"), key=_age):
        yield path.stem, _seconds(path)
    for stage in sorted(path for path in folder.glob("*") if path.is_dir()):
        jobs = [_seconds(path) for path in stage.rglob("*.tsv")]
        if jobs:
            yield f"{stage.name}, {len(jobs)} jobs", sum(jobs)


def _age(path: Path) -> int:
    return path.stat().st_mtime_ns


def _seconds(path: Path) -> float:
    with path.open(encoding="utf-8") as table:
        return sum(float(row["s"]) for row in csv.DictReader(table, delimiter="\t"))
