"""Look through `results/` before a run.

What this pipeline did not make here is set aside, and dates in the future are taken back.
"""

from __future__ import annotations

import json
import os
import time
from base64 import urlsafe_b64encode
from collections.abc import Iterator
from pathlib import Path

from tramdva.configuration.reading import Configuration
from tramdva.configuration.uses import USES, used_values
from tramdva.running import supervision
from tramdva.running.code_hash import code_hash
from tramdva.running.stamps import package_versions

SET_ASIDE = ".set-aside"
SECOND = 1_000_000_000  # in ns


def take_back_dates(*folders: str) -> None:
    """Let no file be newer than the clock; which of two is newer stays as it is.

    Where the clock was put back, a file made now would be older than what was once made from its
    predecessor, which would pass for current.

    Parameters
    ----------
    *folders : str
        Where the files of the pipeline are.
    """
    files = (file for name in folders for file in _files(name))
    dates = sorted((file.stat().st_mtime_ns, file.path) for file in files)
    ahead = (dates[-1][0] if dates else 0) - time.time_ns()
    if ahead <= 0:
        return
    supervision.say(f"the clock was put back: files are taken back by {ahead / SECOND + 1:.0f} s")
    for date, path in dates:  # the oldest first: an interruption does not change the order
        earlier = date - ahead - SECOND
        os.utime(path, ns=(earlier, earlier))


def set_aside_unusable(configuration: Configuration, scripts: Path) -> None:
    """Rename result files that are truncated, foreign or made from other values.

    Snakemake takes every file under the right name for the result. Files that it recorded and
    that nobody touched since are left to it; of others, the stamps must be those of this
    configuration and code.

    Parameters
    ----------
    configuration : Configuration
        The run and its lines.
    scripts : Path
        Folder of the scripts of the stages.
    """
    for line in configuration.lines:
        files = (file for file in _files(f"results/{line}") if file.name.endswith(".nc"))
        foreign = sorted(Path(file.path) for file in files if not _recorded(file))
        for path in foreign:
            if fault := _fault(path, configuration, line, scripts):
                _set_aside(path, fault)


def _files(folder: str) -> Iterator[os.DirEntry[str]]:
    """Yield all files below a folder; links to folders are not followed."""
    try:
        entries = list(os.scandir(folder))
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        return
    for entry in entries:
        if entry.is_dir(follow_symlinks=False):
            yield from _files(entry.path)
        elif entry.is_file():
            yield entry


def _set_aside(path: Path, fault: str) -> None:
    aside = path.with_name(path.name + SET_ASIDE)
    try:
        path.replace(aside)
    except OSError as error:
        raise SystemExit(f"{fault}; it cannot be set aside: {error.strerror}") from None
    supervision.say(f"{fault}; it is now {aside.name} and will be made again")


def _recorded(file: os.DirEntry[str]) -> bool:
    """Tell whether Snakemake made exactly this file, by the date in its record."""
    record = f"{supervision.FOLDER}/metadata/{urlsafe_b64encode(file.path.encode()).decode()}"
    try:
        with open(record, "rb") as opened:  # noqa: PTH123 - hundreds before each run
            return json.load(opened)["endtime"] == file.stat().st_mtime
    except (OSError, ValueError, KeyError):
        return False


def _fault(path: Path, configuration: Configuration, line: str, scripts: Path) -> str:
    """Say in a line what speaks against a file; nothing where it can stay."""
    from tramdva import results  # half a second that a start without such files does not need

    try:
        results.verify(path)
        stamps = results.read_stamps(path)
    except ValueError as error:
        return str(error)
    name = stamps["stage"]
    if name not in path.with_suffix("").parts:
        return f"{path}: holds the results of {name}"
    if other := list(_differing(path, stamps, configuration, line, scripts)):
        return f"{path}: comes from elsewhere, made with other {' and '.join(other)}"
    return ""


def _differing(
    path: Path, stamps: dict[str, str], configuration: Configuration, line: str, scripts: Path
) -> Iterator[str]:
    name = stamps["stage"]
    values = name if name in USES else f"{name}_{path.stem}"  # those of an absorber
    if values in USES:
        expected = json.dumps(used_values(configuration, line, values))
        if json.loads(stamps["parameters"]) != json.loads(expected):
            yield "parameters"
    if stamps["packages"] != package_versions():
        yield f"packages ({stamps['packages']})"
    elif stamps["code_hash"] != code_hash(scripts / f"{name}.py"):
        yield "code"
