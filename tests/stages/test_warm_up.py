import json
import os
import subprocess
import sys
from pathlib import Path

from tramdva.running import numba_cache

PROGRAM = Path(__file__).parents[1] / "tools/stages_after_warm_up.py"


def test_after_the_warm_up_the_stages_compile_nothing():
    ended = subprocess.run(
        [sys.executable, PROGRAM], capture_output=True, text=True, timeout=600, check=False
    )
    assert ended.returncode == 0, ended.stderr
    kernels = json.loads(ended.stdout)
    assert kernels["after"] == kernels["before"]
    for name in (
        "wheelset.model._rhs",
        "bogie.wheel_forces.all_wheel_forces",
        "bogie.integration._run",
        "bogie.wheel_forces._sensitivity",
        "wear.passages._passages",
        "wear.gradient._gradient",
    ):
        assert kernels["before"][f"tramdva.{name}"] > 0


def test_kernels_are_compiled_once(tmp_path, monkeypatch, capfd):
    """A stub in place of the kernels: it counts how often it was called."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    stub = tmp_path / "code/tramdva"
    stub.mkdir(parents=True)
    (stub / "stages").mkdir()
    for folder in (stub, stub / "stages"):
        (folder / "__init__.py").touch()
    monkeypatch.setenv("PYTHONPATH", str(stub.parent))
    kernel = stub / "kernel.py"
    kernel.write_text("@njit\ndef f(): pass\n")
    numba_cache.use_numba_cache(stub)

    def compiles(body: str = "pass") -> bool:
        (stub / "stages/warm_up.py").write_text(f"def compile_kernels():\n    {body}\n")
        numba_cache.compile_kernels_once(stub)
        return "tramdva: compiling" in capfd.readouterr().out

    assert compiles("raise SystemExit(1)")
    assert compiles()  # again after a failure
    assert not compiles()
    os.utime(kernel, (1, 1))
    assert not compiles()
    kernel.write_text("# a comment\n@njit\ndef f(): pass\n")  # then Numba takes nothing from it
    numba_cache.use_numba_cache(stub)
    assert compiles()
    assert not compiles()
    # Other versions of Python and Numba find nothing in it, either.
    monkeypatch.setattr(numba_cache.metadata, "version", lambda name: "99.0")
    assert compiles()
    assert not compiles()
    monkeypatch.setattr(numba_cache.sys, "version_info", (3, 99, 0))
    assert compiles()
