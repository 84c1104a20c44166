"""Threads and compiled code are settled before anything imports NumPy or Numba."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

from tramdva.provenance import numba_cache_folder

os.environ["NUMBA_CACHE_DIR"] = str(numba_cache_folder())

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def root() -> Path:
    """Folder of the checkout; no test writes into it."""
    return ROOT


@pytest.fixture
def config_folder(tmp_path: Path) -> Path:
    """Copy of the configuration that a test may change."""
    return shutil.copytree(ROOT / "config", tmp_path / "config")


@pytest.fixture(scope="session")
def snakemake():
    """Start snakemake, in a folder other than the checkout, and return how it ended."""

    def start(
        folder: Path, *arguments: str, snakefile: Path = ROOT / "Snakefile"
    ) -> subprocess.CompletedProcess:
        program = [sys.executable, "-m", "snakemake", "--snakefile", str(snakefile)]
        return subprocess.run(
            [*program, "--directory", str(folder), *arguments],
            cwd=snakefile.parent,
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )

    return start
