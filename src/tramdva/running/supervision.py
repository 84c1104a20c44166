"""One run at a time in a folder: stale locks, orphaned jobs, results of runs that are over.

Snakemake locks a folder, but its lock stays where it is killed, and its jobs go on without it.
Each `snakemake` process of a pipeline therefore holds a shared `flock` on a file as long as it
lives: who gets this exclusively knows that nobody else works in the folder, so that Snakemake's
lock is stale. A job ends when the process that started it has ended, and it cannot put its
result in place when another run has begun in the folder since.
"""

from __future__ import annotations

import fcntl
import os
import select
import shutil
import signal
import socket
import sys
import threading
import uuid
from pathlib import Path
from typing import IO

FOLDER = Path(".snakemake")
ALIVE = FOLDER / "tramdva-alive"  # locked by living processes; names the machine of the first
RUN = FOLDER / "tramdva-run"  # names the latest run
RESOLUTION = FOLDER / "tramdva-resolution"  # of the results in the folder
RUN_VARIABLE = "TRAMDVA_RUN"
PROCESS_VARIABLE = "TRAMDVA_SNAKEMAKE_PROCESS"
LEAST_FREE = 200_000  # bytes, for locks, logs and records

_held: list[IO[str]] = []  # open as long as this process lives


class SupersededError(RuntimeError):
    """Another run has begun in the folder."""


def enter_folder(*, as_job: bool = False) -> bool:
    """Take part in the work on the current folder; remove the lock of a run that was killed.

    Parameters
    ----------
    as_job : bool
        Whether this process was started by a run, on a machine of a cluster for example.

    Returns
    -------
    bool
        Whether no other process works here.

    Raises
    ------
    SystemExit
        Where the folder cannot be written or the disk is full.
    """
    os.environ[PROCESS_VARIABLE] = str(os.getpid())
    if as_job:
        return False
    if shutil.disk_usage(".").free < LEAST_FREE:
        raise SystemExit(f"{Path.cwd()}: the disk is full")
    try:
        FOLDER.mkdir(exist_ok=True)
        alive = ALIVE.open("a+", encoding="utf-8")
    except OSError as error:
        raise SystemExit(
            f"{Path.cwd()}: cannot be written: {error.strerror}; "
            "choose another folder with --directory"
        ) from None
    _held.append(alive)
    alone = _is_alone(alive)
    try:
        fcntl.flock(alive, fcntl.LOCK_SH)
    except OSError:
        return False
    return alone


def _is_alone(alive: IO[str]) -> bool:
    try:
        fcntl.flock(alive, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        if _locks():
            say(f"another run works in {Path.cwd()} ({_latest_run()}); wait for its end or stop it")
        return False
    except OSError:
        return False  # a file system without locks
    if not _locks():
        alive.truncate(0)
        alive.write(socket.gethostname())
        alive.flush()
        return True
    alive.seek(0)
    if alive.read() != socket.gethostname():
        return False  # on some clusters a lock counts on its own machine only
    for lock in _locks():
        lock.unlink()
    say("a former run in this folder was killed; its lock is removed and its work is taken up")
    return True


def _locks() -> list[Path]:
    return list((FOLDER / "locks").glob("*.lock"))


def _latest_run() -> str:
    try:
        return RUN.read_text(encoding="utf-8").partition(" ")[2]
    except OSError:
        return "it has just begun"


def say(text: str) -> None:
    """Tell the user something about the folder."""
    print(f"tramdva: {text}", file=sys.stderr)


def begin_run(*folders: str) -> None:
    """Make this the run whose jobs may put results in place.

    Parameters
    ----------
    *folders : str
        Where the files of the pipeline are.

    Raises
    ------
    SystemExit
        Where one of the folders cannot be written.
    """
    for folder in (path for name in folders for path in (Path(name), *Path(name).glob("*/"))):
        if folder.is_dir() and not os.access(folder, os.W_OK):
            raise SystemExit(f"{folder.absolute()}: cannot be written")
    token = uuid.uuid4().hex
    os.environ[RUN_VARIABLE] = token
    RUN.write_text(f"{token} process {os.getpid()} on {socket.gethostname()}", encoding="utf-8")
    _terminate_without_deadlock()


def keep_apart(resolution: str) -> None:
    """Refuse coarse results in a folder of full ones, which they would replace.

    Parameters
    ----------
    resolution : str
        ``full`` or ``coarse``.

    Raises
    ------
    SystemExit
        Where the folder holds full results and those of this run are coarse.
    """
    try:
        there = RESOLUTION.read_text(encoding="utf-8")
    except OSError:
        there = resolution
    if there == "full" and resolution == "coarse":
        raise SystemExit(
            f"{Path.cwd()}: holds full results, which coarse ones would replace: "
            "python3 run.py quick makes them in a folder of their own (or --directory <folder>); "
            f"to replace them nevertheless, remove {RESOLUTION}"
        )
    RESOLUTION.write_text(resolution, encoding="utf-8")


def _terminate_without_deadlock() -> None:
    """Let the handler of SIGTERM run in a thread of its own.

    Snakemake's takes a lock that the interrupted main thread may hold, for instance while it
    selects jobs: then it would wait for ever, and with it the run.
    """
    handler = signal.getsignal(signal.SIGTERM)
    if callable(handler):
        signal.signal(
            signal.SIGTERM,
            lambda *arguments: threading.Thread(target=handler, args=arguments).start(),
        )


def end_with_run() -> None:
    """Let this job end when the process that started it is no longer there."""
    process = os.environ.get(PROCESS_VARIABLE)
    if process is None:
        return
    try:
        descriptor = os.pidfd_open(int(process))
    except ProcessLookupError:
        _end()
    except (AttributeError, OSError):
        return  # not on this system; a late result is refused all the same
    else:
        threading.Thread(target=_wait_and_end, args=(descriptor,), daemon=True).start()


def _wait_and_end(descriptor: int) -> None:
    select.select([descriptor], [], [])
    _end()


def _end() -> None:
    print("the run that started this job has ended: so does the job", file=sys.stderr, flush=True)
    os._exit(1)


def put_in_place(part: Path, path: Path) -> None:
    """Give a finished file its name, unless another run has begun since this job started."""
    own = os.environ.get(RUN_VARIABLE)
    if own is not None and RUN.is_file():
        latest = RUN.read_text(encoding="utf-8").partition(" ")[0]
        if latest != own:
            raise SupersededError(f"{path}: another run has begun in this folder; result dropped")
    part.replace(path)
