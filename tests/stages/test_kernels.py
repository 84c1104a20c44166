"""Compiled kernels compute what their Python says; coverage sees them in the interpreted run."""

import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

PROGRAM = Path(__file__).parents[1] / "tools/interpreted_kernels.py"


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], dict[str, Any]]:
    """Results of the kernels compiled and interpreted, by name."""
    folder = tmp_path_factory.mktemp("kernels")
    results = []
    for how in ("compiled", "interpreted"):
        subprocess.run(
            [sys.executable, PROGRAM, how, folder],
            env=os.environ | {"NUMBA_DISABLE_JIT": str(int(how == "interpreted"))},
            check=True,
        )
        results.append(pickle.loads((folder / how).read_bytes()))
    return tuple(results)


def assert_same(compiled: Any, interpreted: Any, where: str) -> None:
    """Compare to rounding, which compiled sums may order differently."""
    if isinstance(compiled, dict):
        assert compiled.keys() == interpreted.keys()
        for name in compiled:
            assert_same(compiled[name], interpreted[name], f"{where}, {name}")
        return
    one, other = np.asarray(compiled), np.asarray(interpreted)
    assert one.shape == other.shape, where
    if one.dtype.kind not in "fc":
        assert (one == other).all(), where
        return
    scale = np.nanmax(np.abs(one), initial=0.0)
    assert_allclose(other, one, rtol=1e-7, atol=1e-9 * scale, err_msg=where)


def test_compiled_and_interpreted_agree(both: tuple[dict[str, Any], dict[str, Any]]) -> None:
    assert_same(*both, "kernels")


def test_interpreted_kernels_obey_the_known_laws(
    both: tuple[dict[str, Any], dict[str, Any]],
) -> None:
    found = both[1]

    assert found["friction 0.0"] == pytest.approx(0.35, rel=1e-14)
    assert found["creep_force 0.0"][0] == 0.0
    assert found["creep_force 0.0"][1] == pytest.approx(5.35e6 / 3.9, rel=1e-12)  # C_22 / V_0
    assert found["pressure"] == pytest.approx(1.5 * 35e3 / (np.pi * 5e-3 * 3e-3), rel=1e-12)
    assert found["polach (0.0, 0.0, 0.0)"] == pytest.approx((0.0, 0.0, 0.0))
    assert found["polach (0.001, 0.0, 0.0)"][0] < 0.0  # against the creepage
    assert found["saturated (0.0, 0.0, 0.0)"] == pytest.approx((0.0, 0.0, 0.0))
    assert found["saturated (0.001, 0.0, 0.0)"][0] < 0.0
    assert found["half_space (0.001, 0.0, 0.0)"][0] < 0.0
    for method in ("chart", "smoothed", "constant"):
        assert (found[f"wear {method}"]["wear_depth"] >= 0.0).all()
