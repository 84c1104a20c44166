"""Threads and compiled code are settled before anything imports NumPy or Numba."""

import fcntl
import os
import shutil
import subprocess
import sys
from pathlib import Path

for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

from tramdva.running.numba_cache import use_numba_cache

use_numba_cache()

import pytest
from browser import MISSING

ROOT = Path(__file__).resolve().parents[1]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--results", help="folder of full results to check, such as results/paper")
    parser.addoption("--quick-run", help="folder of a quick run of this code, which saves one")
    parser.addoption("--slow", action="store_true", help="run the tests marked slow as well")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if not config.getoption("--slow"):
        for item in items:
            if item.get_closest_marker("slow"):
                item.add_marker(pytest.mark.skip(reason="takes minutes: --slow"))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    passed = terminalreporter.stats.get("passed", [])
    if refused := sum("refuses" in report.keywords for report in passed):
        terminalreporter.write_line(f"{refused} wrong configurations and measured files refused")
    skipped = terminalreporter.stats.get("skipped", [])
    if blind := [report for report in skipped if MISSING in str(report.longrepr)]:
        terminalreporter.write_line(f"{len(blind)} tests in a browser were skipped: {MISSING}")


@pytest.fixture(scope="session")
def root() -> Path:
    """Folder of the checkout; no test writes into it."""
    return ROOT


@pytest.fixture
def config_folder(tmp_path: Path) -> Path:
    """Copy of the configuration that a test may change."""
    return shutil.copytree(ROOT / "config", tmp_path / "config")


def copy_code(source: Path, target: Path) -> Path:
    """Copy what a run of the pipeline needs."""
    for name in ("src", "workflow", "paper_figures", "profiles", "config"):
        ignored = shutil.ignore_patterns("__pycache__", "*.pdf", "*.png")
        shutil.copytree(source / name, target / name, ignore=ignored)
    shutil.copy(source / "Snakefile", target)
    return target


@pytest.fixture(scope="session")
def frozen_code(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy of the code, so that edits during the tests do not disturb them."""
    return copy_code(ROOT, tmp_path_factory.mktemp("frozen") / "code")


@pytest.fixture
def code(frozen_code: Path, tmp_path: Path) -> Path:
    """Copy of the code that a test may edit."""
    return copy_code(frozen_code, tmp_path / "code")


@pytest.fixture(scope="session")
def snakemake(frozen_code: Path):
    """Start snakemake with a copy of the code and return how it ended."""

    def start(
        folder: Path, *arguments: str, code: Path = frozen_code, snakefile: str = "Snakefile"
    ) -> subprocess.CompletedProcess:
        program = [sys.executable, "-m", "snakemake", "--snakefile", str(code / snakefile)]
        return subprocess.run(
            [*program, "--directory", str(folder), *arguments],
            cwd=code,
            env=os.environ | {"PYTHONPATH": str(code / "src")},
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )

    return start


@pytest.fixture(scope="session")
def quick_run(
    request: pytest.FixtureRequest, snakemake, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """Folder in which the whole pipeline ran with coarse numerics."""
    folder = tmp_path_factory.mktemp("quick")
    if given := request.config.getoption("--quick-run"):
        return shutil.copytree(given, folder, dirs_exist_ok=True)
    if not hasattr(request.config, "workerinput"):
        run_quickly(snakemake, folder)
        return folder
    # Processes of pytest-xdist share a run: the first makes it on all cores, the others wait.
    shared = tmp_path_factory.getbasetemp().parent / "quick"
    with shared.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (made := shared.with_suffix(".made")).exists():
            run_quickly(snakemake, shared)
            made.touch()
    return shutil.copytree(shared, folder, dirs_exist_ok=True)


def run_quickly(snakemake, folder: Path) -> None:
    """Run the whole pipeline with coarse numerics."""
    ended = snakemake(folder, "--configfile", "config/quick.yaml")
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.fixture(scope="session")
def read(request: pytest.FixtureRequest):
    """Read the file of a stage of the run that `--results` names, or of the quick run."""
    from tramdva import results

    given = request.config.getoption("--results")
    folder = Path(given) if given else request.getfixturevalue("quick_run") / "results/paper"
    return lambda stage: results.read(folder / f"{stage}.nc")
