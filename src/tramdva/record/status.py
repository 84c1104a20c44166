"""What is missing, stale, changed or coarse: `python3 run.py status`, and before a report.

    python -m tramdva.record.status [ARGUMENTS OF SNAKEMAKE]
    python -m tramdva.record.status --report FILE [ARGUMENTS OF SNAKEMAKE]

The second writes a report, unless a figure in it would stand beside values that it is not of.
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from tramdva.configuration.reading import load_or_exit
from tramdva.record import origin, run_record
from tramdva.record.run_record import IncompleteRunError, Made

STATES = ("current", "stale", "kept", "missing")
SHOWN = 10  # files of a kind that are named


class Found(NamedTuple):
    """A file of the run: where it should be, its line, its state and what is said of it.

    state : ``current``, ``missing``, ``stale`` (of other values, code or inputs, or changed), or
        ``kept`` (not made here)
    """

    path: str
    line: str
    state: str
    words: str
    coarse: bool


def look(arguments: Sequence[str]) -> list[Found]:
    """Find the state of every file of a run.

    Parameters
    ----------
    arguments : sequence of str
        For snakemake, such as `--config lines=[dresden]` or `--directory quick`.

    Raises
    ------
    IncompleteRunError
        Where the configuration is wrong.
    """
    rows = list(run_record._summary(arguments))
    here = Path.cwd()
    os.chdir(directory(arguments))
    try:
        return [_found(run_record._made(row)) for row in rows]
    finally:
        os.chdir(here)


def directory(arguments: Sequence[str]) -> str:
    """Return the folder that arguments of snakemake name as the working directory."""
    for place, argument in enumerate(arguments):
        name, given, value = argument.partition("=")
        if name in ("--directory", "-d"):
            return value if given else arguments[place + 1]
    return "."


def _found(file: Made) -> Found:
    line = file.path.split("/")[1]
    if not Path(file.path).is_file():
        return Found(file.path, line, "missing", "is missing", False)
    if not file.record:
        return Found(file.path, line, "kept", "comes with the repository", _is_coarse(file.path))
    fault = run_record._fault(file)
    return Found(file.path, line, "stale" if fault else "current", fault, _is_coarse(file.path))


def _is_coarse(path: str) -> bool:
    return path.endswith(".png") and "COARSE" in origin.of_picture(Path(path), origin.WORDS)


def told(found: Sequence[Found], outdated: Sequence[str] = ()) -> Iterator[str]:
    """Say it in lines: a count for each line of trams, then the files that are not current."""
    for line in dict.fromkeys(file.line for file in found):
        of_line = [file for file in found if file.line == line]
        count = Counter(file.state for file in of_line)
        words = ", ".join(f"{count[s]} {s}" for s in STATES if count[s])
        coarse = " (pictures of coarse numerics)" if any(f.coarse for f in of_line) else ""
        yield f"{line}: {words}{coarse}"
    for state in ("stale", "missing"):
        files = [file for file in found if file.state == state]
        yield from (f"  {file.path}: {file.words}" for file in files[:SHOWN])
        if len(files) > SHOWN:
            yield f"  and {len(files) - SHOWN} more {state}"
    if outdated:
        yield (
            f"{len(outdated)} pictures of the repository are not of its code and configuration, "
            f"such as {outdated[0]}; a full run draws them anew"
        )


def kept_pictures() -> list[str]:
    """Name the pictures that git knows and that are not of the code and configuration here."""
    listed = run_record._git("ls-files", "paper_figures/*/*.png").split()
    if not listed:
        return []
    lines = sorted({name.split("/")[1] for name in listed})
    configuration = load_or_exit(Path("config"), (), {"lines": lines})
    old = set(origin.outdated(configuration, Path("paper_figures"), Path()))
    return [name for name in listed if name in old]


def report(file: str, arguments: Sequence[str]) -> None:
    """Become the program that writes the report, or end with what is stale."""
    found = look(arguments)
    if stale := [one for one in found if one.state == "stale"]:
        lines = [f"tramdva: no report: {one.path}: {one.words}" for one in stale[:SHOWN]]
        more = f"tramdva: and {len(stale) - SHOWN} more" if len(stale) > SHOWN else ""
        sys.exit("\n".join(filter(None, [*lines, more])))
    for line in told(found):
        print(f"tramdva: {line}", flush=True)
    os.execv(sys.executable, [sys.executable, "-m", "snakemake", "--report", file, *arguments])


def main(arguments: Sequence[str]) -> None:
    """Print the state of a run, or write its report."""
    try:
        if arguments[:1] == ["--report"]:
            report(arguments[1], arguments[2:])
        found = look(arguments)
    except IncompleteRunError as error:
        sys.exit("\n".join(f"tramdva: {line}" for line in str(error).splitlines()))
    print(*told(found, kept_pictures()), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
