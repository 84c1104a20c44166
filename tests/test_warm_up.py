import json
import subprocess
import sys
from pathlib import Path

from tramdva import provenance

PROGRAM = Path(__file__).parent / "stages_after_warm_up.py"


def test_after_the_warm_up_the_stages_compile_nothing():
    ended = subprocess.run(
        [sys.executable, PROGRAM], capture_output=True, text=True, timeout=600, check=False
    )
    assert ended.returncode == 0, ended.stderr
    kernels = json.loads(ended.stdout)
    assert kernels["after"] == kernels["before"]
    for name in (
        "wheelset._rhs",
        "bogie.running.all_wheel_forces",
        "bogie.integration.run",
        "bogie.running._sensitivity",
        "wear_history._passages",
    ):
        assert kernels["before"][f"tramdva.{name}"] > 0


def test_kernels_are_compiled_once(tmp_path, monkeypatch, capfd):
    """A stub in place of the kernels: it counts how often it was called."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    stub = tmp_path / "code/tramdva"
    stub.mkdir(parents=True)
    (stub / "__init__.py").touch()
    monkeypatch.setenv("PYTHONPATH", str(stub.parent))
    compiled = []
    for body in ("raise SystemExit(1)", "pass", "pass"):
        (stub / "warm_up.py").write_text(f"def compile_kernels():\n    {body}\n")
        provenance.compile_kernels_once()
        compiled.append("tramdva: compiling" in capfd.readouterr().out)
    assert compiled == [True, True, False]  # again after a failure, not after a success
