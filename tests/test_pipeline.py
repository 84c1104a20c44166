"""The whole pipeline with coarse numerics: complete, repeatable, reported."""

import csv
import json
import re
from pathlib import Path

import pytest

from tramdva import results
from tramdva.config import load_or_exit
from tramdva.config import stage as values_of
from tramdva.registry import STAGES

FIGURES = [
    "fig02_stability_map",
    "fig03_bifurcation_diagram",
    "fig04_hopf_curves",
    "fig05_critical_hopf_curve",
    "fig06_cycle_amplitudes",
    "fig07_frequency_response",
]
QUICK = ("--configfile", "config/quick.yaml")


@pytest.mark.parametrize("stage", STAGES)
def test_results_are_complete(quick_run: Path, root: Path, stage: str) -> None:
    path = quick_run / f"results/paper/{stage}.nc"
    dataset = results.load(path)

    assert set(dataset.variables) == set(STAGES[stage].variables)
    assert re.fullmatch("[0-9a-f]{20}", dataset.attrs["code_hash"])
    configuration = load_or_exit(root / "config", [root / "config/quick.yaml"], {})
    used = json.loads(json.dumps(values_of(configuration, "paper", stage)))
    assert results.read_parameters(path) == used


@pytest.mark.parametrize("figure", FIGURES)
def test_figures_are_drawn(quick_run: Path, figure: str) -> None:
    folder = quick_run / "paper_figures/paper"

    assert (folder / f"{figure}.png").read_bytes().startswith(b"\x89PNG")
    assert (folder / f"{figure}.pdf").read_bytes().startswith(b"%PDF")


def test_table_of_designs(quick_run: Path) -> None:
    with (quick_run / "paper_figures/paper/table2_absorber_designs.csv").open() as file:
        rows = list(csv.DictReader(file))

    assert len(rows) >= 4
    assert {"design", "stiffness c_T (MN/m)", "status"} <= set(rows[0])


def test_nothing_is_left_over(quick_run: Path) -> None:
    assert not list(quick_run.rglob("*.part"))


def test_second_run_does_nothing(quick_run: Path, snakemake) -> None:
    ended = snakemake(quick_run, "-n", *QUICK)

    assert ended.returncode == 0
    assert "Nothing to be done" in ended.stdout + ended.stderr


@pytest.mark.parametrize("rule", ["stability_map", "fig07_frequency_response"])
def test_rewriting_gives_the_same_bytes(quick_run: Path, snakemake, rule: str) -> None:
    files = [p for p in quick_run.glob(f"*/paper/{rule}.*") if "logs" not in p.parts]
    before = {path: path.read_bytes() for path in files}

    ended = snakemake(quick_run, *QUICK, "--forcerun", rule, "--until", rule)

    assert ended.returncode == 0, ended.stderr
    assert before
    assert {path: path.read_bytes() for path in files} == before


def test_report_is_self_contained(quick_run: Path, tmp_path: Path, snakemake) -> None:
    path = tmp_path / "report.html"
    ended = snakemake(quick_run, *QUICK, "--report", str(path))

    assert ended.returncode == 0, ended.stderr
    text = path.read_text(encoding="utf-8")
    for words in ("Figure 2", "Figure 7", "Table 2", "Stability", "Forced vibrations"):
        assert words in text, words
