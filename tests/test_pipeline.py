"""The whole pipeline with coarse numerics: complete, repeatable, reported."""

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
import snakefile_tables
from browser import Watched, chromium

from tramdva import results
from tramdva.configuration.reading import load_or_exit
from tramdva.configuration.uses import used_values as values_of
from tramdva.variables.registry import STAGES

DRAWN = [name for name, kinds in snakefile_tables.read().kinds.items() if "png" in kinds]
# Files of the stages that have one per absorber, or per absorber and order.
PER_JOB = {
    "bogie_linearisation": "{absorber}.nc",
    "bogie_simulation": "{absorber}/order_{order}.nc",
    "wear": "{absorber}/order_{order}.nc",
    "robustness_sample": "part_{part}.nc",
}
QUICK = ("--configfile", "config/quick.yaml")


def files_of(stage: str, root: Path) -> dict[str, str]:
    """Files of a stage, and the name under which the configuration knows their values."""
    if stage not in PER_JOB:
        return {f"{stage}.nc": stage}
    numerics = load_or_exit(root / "config", [root / "config/quick.yaml"], {}).run.numerics
    if stage == "robustness_sample":
        parts = range(numerics.robustness_sample.parts)
        return {f"{stage}/{PER_JOB[stage].format(part=part)}": stage for part in parts}
    return {
        f"{stage}/{PER_JOB[stage].format(absorber=absorber, order=order)}": (
            f"{stage}_{absorber}" if stage == "bogie_linearisation" else stage
        )
        for absorber in ("none", "paper")
        for order in numerics.evolution_tendency.orders.listed()
    }


@pytest.mark.parametrize("stage", STAGES)
def test_results_are_complete(quick_run: Path, root: Path, stage: str) -> None:
    configuration = load_or_exit(root / "config", [root / "config/quick.yaml"], {})
    for name, values in files_of(stage, root).items():
        path = quick_run / "results/paper" / name
        dataset = results.load(path)

        assert set(dataset.variables) == set(STAGES[stage].variables)
        assert re.fullmatch("[0-9a-f]{20}", dataset.attrs["code_hash"])
        used = json.loads(json.dumps(values_of(configuration, "paper", values)))
        assert results.read_parameters(path) == used


def test_all_orders_ran_steadily(quick_run: Path) -> None:
    found = results.read(quick_run / "results/paper/evolution_tendency.nc")

    assert set(found["status"].ravel()) == {"periodic"}
    assert (found["harmonic_distortion"] < 0.2).all()
    linear = found["order_linearised_real"] + 1j * found["order_linearised_imag"]
    simulated = found["wear_response_amplitude"] * np.exp(1j * found["wear_response_phase"])
    # The inner wheel slides just below a step of the chart, which order 26 crosses: on the coarse
    # grid of the quick run by 18 %, on the full one by 3 %. All others are linear.
    deviation = np.sort(np.abs(np.abs(simulated / linear) - 1.0), axis=None)
    assert deviation[-1] < 0.25
    assert deviation[-2] < 0.02
    assert np.abs(np.degrees(np.angle(simulated / linear))).max() < 5.0


@pytest.mark.parametrize("figure", DRAWN)
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
    for words in ("Figure 2", "Figure 7", "Table 2", "Stability", "Forced vibrations", "Explorer"):
        assert words in text, words
    with chromium() as browser:
        watched = Watched(browser)
        watched.tab.goto(path.as_uri())
        for words in ("Results", "Explorer"):
            watched.tab.get_by_text(words, exact=True).first.click()
        watched.tab.locator("td a").first.click()
        watched.tab.locator("iframe").content_frame.locator("body[data-ready]").wait_for()
        inside = watched.tab.frames[-1]
        assert inside.url.startswith("data:text/html")
        assert inside.locator(".line").text_content() == "Tram line of the paper"
        before = inside.locator("#bogie td.now").all_text_contents()
        inside.locator("#bogie .d_T").focus()
        watched.tab.keyboard.press("ArrowRight")
        assert inside.locator("#bogie td.now").all_text_contents() != before
        assert not [url for url in watched.asked if not url.startswith(("file:", "data:", "blob:"))]
