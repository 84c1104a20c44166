"""Who works in a folder, and which job may still put its result in place."""

import fcntl
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from tramdva import results
from tramdva.running import supervision

LOCK = Path(".snakemake/locks/0.output.lock")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in an empty folder; locks and variables end with the test."""
    monkeypatch.chdir(tmp_path)
    for name in ("RUN", "PROCESS"):
        variable = getattr(supervision, f"{name}_VARIABLE")
        monkeypatch.setenv(variable, "")
        monkeypatch.delenv(variable)
    monkeypatch.setattr(supervision, "_held", [])
    handler = signal.getsignal(signal.SIGTERM)
    yield tmp_path
    signal.signal(signal.SIGTERM, handler)


def leave_lock() -> None:
    LOCK.parent.mkdir(parents=True)
    LOCK.write_text("results/paper/stability_map.nc\n")


def enter_elsewhere() -> subprocess.Popen:
    """Another process that works in the folder until its input ends."""
    code = (
        "from tramdva.running import supervision as s; print(s.enter_folder(), flush=True); input()"
    )
    other = subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    other.stdout.readline()
    return other


def test_lock_of_a_killed_run_is_removed(capsys) -> None:
    with enter_elsewhere() as other:
        leave_lock()
        other.kill()

    assert supervision.enter_folder()
    assert not LOCK.exists()
    assert "a former run in this folder was killed; its lock is removed" in capsys.readouterr().err


def test_lock_of_a_living_run_stays(capsys) -> None:
    with enter_elsewhere() as other:
        leave_lock()
        (supervision.RUN).write_text("0a process 12 on tram")

        assert not supervision.enter_folder()
        assert LOCK.exists()
        other.communicate("")

    assert f"another run works in {Path.cwd()} (process 12 on tram)" in capsys.readouterr().err


def test_several_may_look_at_once() -> None:
    with enter_elsewhere() as first, enter_elsewhere() as second:
        assert not supervision.enter_folder()
        first.communicate("")
        second.communicate("")


def test_lock_of_another_machine_stays() -> None:
    leave_lock()
    supervision.ALIVE.write_text("another-machine")

    assert not supervision.enter_folder()
    assert LOCK.exists()


def test_file_system_without_locks(monkeypatch: pytest.MonkeyPatch) -> None:
    def flock(*arguments: object) -> None:
        raise OSError("not supported")

    leave_lock()
    monkeypatch.setattr(fcntl, "flock", flock)

    assert not supervision.enter_folder()
    assert LOCK.exists()


def test_job_on_another_machine_judges_nothing() -> None:
    leave_lock()

    assert not supervision.enter_folder(as_job=True)
    assert LOCK.exists()
    assert os.environ[supervision.PROCESS_VARIABLE] == str(os.getpid())


def test_folder_that_cannot_be_written(folder: Path) -> None:
    (folder / ".snakemake").write_text("a file")

    with pytest.raises(SystemExit, match=f"^{folder}: cannot be written: File exists; choose"):
        supervision.enter_folder()


def test_full_disk(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(supervision, "LEAST_FREE", 1e20)

    with pytest.raises(SystemExit, match=f"^{folder}: the disk is full$"):
        supervision.enter_folder()


def test_result_folder_that_cannot_be_written(folder: Path, monkeypatch) -> None:
    (folder / "results/paper").mkdir(parents=True)
    closed = Path("results/paper")
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != closed)

    with pytest.raises(SystemExit, match=f"^{folder}/results/paper: cannot be written$"):
        supervision.begin_run("results", "logs")


def save(path: Path, text: str) -> None:
    with results.atomically(path) as part:
        part.write_text(text)


def test_result_of_a_former_run_is_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    path = Path("results/x")
    supervision.FOLDER.mkdir()
    supervision.begin_run()
    former = os.environ[supervision.RUN_VARIABLE]
    save(path, "former")
    supervision.begin_run()
    save(path, "latest")

    monkeypatch.setenv(supervision.RUN_VARIABLE, former)
    with pytest.raises(supervision.SupersededError, match="another run has begun"):
        save(path, "late")

    assert path.read_text() == "latest"
    assert [file.name for file in path.parent.iterdir()] == ["x"]


JOB = """
import os, subprocess, sys
child = '''
import os, time
from tramdva.running import job
with job.logging_to("job.log"):
    open("started", "w").close()
    time.sleep(60)
'''
os.environ["TRAMDVA_SNAKEMAKE_PROCESS"] = str(os.getpid())
subprocess.run(["sh", "-c", '"$0" -c "$1"; true', sys.executable, child])
"""


def test_job_ends_with_its_run(folder: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", JOB]) as run:
        wait_for(lambda: Path("started").exists())
        run.kill()

    wait_for(lambda: "the run that started this job has ended" in Path("job.log").read_text())


def wait_for(condition, seconds: float = 20.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_job_whose_run_is_already_over_does_not_begin() -> None:
    over = subprocess.Popen(["true"])
    over.wait()
    ran = subprocess.run(
        [sys.executable, "-c", "from tramdva.running import supervision as s; s.end_with_run()"],
        env=os.environ | {supervision.PROCESS_VARIABLE: str(over.pid)},
        capture_output=True,
        text=True,
        check=False,
    )

    assert ran.returncode == 1
    assert ran.stderr == "the run that started this job has ended: so does the job\n"


def test_termination_cannot_wait_for_itself() -> None:
    """The handler takes a lock that the interrupted thread holds, as Snakemake's does."""
    lock, terminated = threading.Lock(), threading.Event()

    def handler(*arguments: object) -> None:
        with lock:
            terminated.set()

    signal.signal(signal.SIGTERM, handler)
    supervision.FOLDER.mkdir()
    supervision.begin_run()
    with lock:
        os.kill(os.getpid(), signal.SIGTERM)
        assert not terminated.wait(0.05)

    assert terminated.wait(10)
