"""What is recorded of a run: files, jobs, inputs, values, times; and the sources behind them.

Snakemake keeps a record of every file that a job made. A file is current when Snakemake would not
make it again, when nobody touched it since, and when its inputs still have the bytes that the job
read.
"""

from __future__ import annotations

import ast
import csv
import functools
import hashlib
import json
import subprocess
import sys
from base64 import urlsafe_b64encode
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tramdva import results

RECORDS = Path(".snakemake/metadata")
CURRENT = "ok"
SAME_DATE = 1e-3  # s; archives and file systems round dates
# What belongs to the sources where no git can tell.
SOURCES = (
    ".ci",
    ".github",
    ".gitignore",
    ".pre-commit-config.yaml",
    ".snakemake-workflow-catalog.yml",
    "CHANGELOG.md",
    "CITATION.cff",
    "LICENSE",
    "README.md",
    "Snakefile",
    "benchmarks",
    "config",
    "docs",
    "paper_figures",
    "profiles",
    "pyproject.toml",
    "requirements.lock",
    "run.py",
    "src",
    "tests",
    "workflow",
)
MADE_OF_SOURCES = {"__pycache__", "_build", "results"}


class IncompleteRunError(Exception):
    """Why there is nothing sound to describe, a line for each reason."""


@dataclass(frozen=True)
class Made:
    """A file of the run and what is recorded of its making.

    path, rule : the file and the rule that makes it
    log : log files of the job
    status : what Snakemake says of the file; `ok` where it is current
    record : Snakemake's record of the job, empty where there is none
    """

    path: str
    rule: str
    log: tuple[str, ...]
    status: str
    record: Mapping[str, Any]

    @property
    def inputs(self) -> tuple[str, ...]:
        """Files that the job read."""
        return tuple(self.record["input"])

    @property
    def values(self) -> list[Any]:
        """Parameters of the job: the hash of its code and what it used of the configuration."""
        return [_plain(text) for text in self.record["params"]]


def files_of_run(arguments: Sequence[str]) -> list[Made]:
    """List the files of the run in the current folder, all of them current.

    Parameters
    ----------
    arguments : sequence of str
        Arguments for snakemake, such as `--config lines=[dresden]`.

    Raises
    ------
    IncompleteRunError
        Where files are missing, stale or not made by the pipeline.
    """
    made = [_made(row) for row in _summary(arguments)]
    if missing := [file.path for file in made if not Path(file.path).is_file()]:
        raise IncompleteRunError(
            f"{len(missing)} of {len(made)} files of this run are missing, such as {missing[0]}; "
            "make them first: python3 run.py"
        )
    if faults := [f"{file.path}: {fault}" for file in made if (fault := _fault(file))]:
        raise IncompleteRunError("\n".join(faults))
    return made


def _summary(arguments: Sequence[str]) -> Iterator[dict[str, str]]:
    """Ask Snakemake which files it would make, how, and which of them are out of date."""
    program = [sys.executable, "-m", "snakemake", "--detailed-summary", *arguments]
    ended = subprocess.run(program, capture_output=True, text=True)
    if ended.returncode:
        raise IncompleteRunError(ended.stderr.strip())
    told = [line for line in ended.stderr.splitlines() if line.startswith("tramdva: ")]
    print(*told, sep="\n", end="\n" if told else "", file=sys.stderr)
    head = ended.stdout.index("output_file\t")
    return csv.DictReader(ended.stdout[head:].splitlines(), delimiter="\t")


def _made(row: Mapping[str, str]) -> Made:
    path = row["output_file"]
    logs = tuple(name for name in row["log-file(s)"].split(",") if name)
    return Made(path, row["rule"], logs, row["status"], _record(path))


def record_of(path: str) -> Path:
    """Return where Snakemake keeps its record of a file."""
    return RECORDS / urlsafe_b64encode(path.encode()).decode()


def _record(path: str) -> dict[str, Any]:
    try:
        return json.loads(record_of(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _fault(file: Made) -> str:
    """Say what speaks against a file, nothing where it is current."""
    if file.status != CURRENT:
        return f"is out of date ({file.status}); run the pipeline again"
    if not file.record:
        return "there is no record of its making; remove it and run the pipeline again"
    if abs(file.record["endtime"] - Path(file.path).stat().st_mtime) > SAME_DATE:
        return "was changed after the pipeline had made it; remove it and run the pipeline again"
    if file.path.endswith(".nc") and (fault := _tampered(file.path)):
        return fault
    for path, checksum in file.record["input_checksums"].items():
        if checksum != f"sha256:{sha256(path)}":
            return f"was made from another {path}; remove it and run the pipeline again"
    return ""


def _tampered(path: str) -> str:
    """Say that a result file does not hold what was saved; nothing where it does."""
    try:
        results.verify(path)
    except ValueError as error:
        return str(error).removeprefix(f"{path}: ")
    return ""


def _plain(text: str) -> Any:
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return text


def sha256(path: str) -> str:
    """Return the checksum of a file, which is read once as long as it does not change."""
    file = Path(path).resolve()
    return _digest(file, file.stat().st_mtime_ns, file.stat().st_size)


@functools.cache
def _digest(path: Path, date: int, size: int) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def sources(lines: Iterable[str] = ()) -> list[str]:
    """List the source files of the checkout, without what is made from them.

    Where git can tell, these are the files it knows, and what belongs to the lines of the run.

    Parameters
    ----------
    lines : iterable of str
        Files that a run read and that git need not know, such as a new line.
    """
    if commit() is not None:
        listed = {*_git("ls-files", "-z").split("\0"), *lines}
        return sorted(name for name in listed if name and Path(name).is_file())
    found = [path for name in SOURCES for path in (Path(name), *Path(name).rglob("*"))]
    figures = set(Path("paper_figures").glob("*/*"))
    return sorted(
        path.as_posix()
        for path in found
        if path.is_file() and path not in figures and not MADE_OF_SOURCES & set(path.parts)
    )


def commit() -> str | None:
    """Return the git commit of the checkout; nothing where the folder is none."""
    top = _git("rev-parse", "--show-toplevel").strip()
    if not top or Path(top) != Path.cwd().resolve():
        return None
    return _git("rev-parse", "--verify", "--quiet", "HEAD").strip() or None


def changes() -> list[str]:
    """List the source files that differ from the commit."""
    status = _git("status", "--porcelain", "-z", "--no-renames", "--untracked-files=all")
    return sorted(entry[3:] for entry in status.split("\0") if entry)


def _git(*arguments: str) -> str:
    """Return what git prints, nothing where git or the repository is missing."""
    try:
        ended = subprocess.run(["git", *arguments], capture_output=True, text=True)
    except OSError:
        return ""
    return ended.stdout if ended.returncode == 0 else ""
