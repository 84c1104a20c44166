import json
import subprocess
import sys
from pathlib import Path

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
