"""One number everywhere: pages that tell the same quantity of a line tell the same number.

Growth without absorbers, and what the line's own leave of it in the band of design, are printed by
figure 10 and its table (`evolution_tendency`), the explorer (`bogie_designs`) and the design sheet
(`robust_tuning`). The first two are compared at the frequencies that both have; the sheet has its
own, so that its maxima may differ by what lies between two points.
"""

from pathlib import Path

import numpy as np
import pytest

from tramdva import results
from tramdva.configuration.reading import load
from tramdva.report import figures, sheet_verdicts
from tramdva.report.design_names import NAMED, STEPS

LINES = ("paper", "worn-40m")
# The masses of translating absorbers are part of what the sheet calls "without".
BARE_ON_THE_SHEET = ("paper",)
PAPER = list(NAMED).index("paper")
# The weight of translating absorbers is in the wheel loads of figure 10 and of the modes, not in
# those of any absorber (explorer and sheet), as the sheet says.
WEIGHT = {"paper": 1e-3, "worn-40m": 0.06}  # of the largest value
BETWEEN_POINTS = 0.05  # of a maximum; the peaks are a few points of the quick run wide


@pytest.fixture(scope="module")
def files(quick_run: Path):
    return lambda line, stage: results.read(quick_run / f"results/{line}/{stage}.nc")


def band_of(root: Path, line: str) -> tuple[float, float]:
    band = load(root / "config", (), {"lines": [line]}).lines[line].study.tendency_maps.design_band
    return band.min, band.max


def own_place(designs: dict[str, np.ndarray]) -> tuple[int, int]:
    """Row and column of the line's absorber among the explorer's stops."""
    return tuple(int(np.flatnonzero(designs[k] == designs[f"own_{k}"])[0]) for k in ("d_T", "c_T"))


@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize("absorber", ["none", "paper"])
def test_figure_10_and_the_explorer_agree(files, line: str, absorber: str) -> None:
    evolution, designs = files(line, "evolution_tendency"), files(line, "bogie_designs")
    assert designs["wheel"].tolist() == evolution["wheel"].tolist()
    row = list(evolution["absorber"]).index(absorber)
    own = designs["tendency"][own_place(designs)]
    explorer = designs["none_tendency"] if absorber == "none" else own
    both = np.isin(evolution["frequency_axis"].round(6), designs["frequency"].round(6))
    assert both.sum() == designs["frequency"].size
    figure = evolution["linearised_evolution_tendency"][row][:, both]
    scale = np.abs(figure).max(axis=1, keepdims=True)
    weight = 1e-3 if absorber == "none" else WEIGHT[line]
    np.testing.assert_allclose(explorer / scale, figure / scale, atol=weight)


@pytest.mark.parametrize("line", BARE_ON_THE_SHEET)
def test_the_sheet_agrees_with_figure_10(files, root: Path, line: str) -> None:
    evolution, tuning = files(line, "evolution_tendency"), files(line, "robust_tuning")
    low, high = band_of(root, line)
    near = (evolution["frequency_axis"] >= low) & (evolution["frequency_axis"] <= high)
    largest = evolution["linearised_evolution_tendency"][..., near].max(axis=(1, 2))
    none, own = (list(evolution["absorber"]).index(name) for name in ("none", "paper"))
    assert tuning["reference"][0] == pytest.approx(largest[none], rel=BETWEEN_POINTS)
    left = largest[own] / largest[none]
    assert tuning["nominal_factor"][PAPER] == pytest.approx(left, rel=BETWEEN_POINTS)
    assert tuning["factor"][PAPER, 0] == pytest.approx(tuning["nominal_factor"][PAPER])


@pytest.mark.parametrize("line", LINES)
def test_self_excitation_is_the_same_on_every_page(files, line: str) -> None:
    modes, designs, tuning = (
        files(line, stage) for stage in ("bogie_modes", "bogie_designs", "robust_tuning")
    )
    none, own = (list(modes["absorber"]).index(name) for name in ("none", "paper"))
    growth = modes["operating_growth_rate"]
    assert designs["none_growth_rate"] == pytest.approx(growth[none], abs=1e-3)
    assert designs["growth_rate"][own_place(designs)] == pytest.approx(growth[own], abs=1e-3)
    told = tuning["growth_rate"][PAPER, 0, 1]
    assert told == pytest.approx(growth[own], rel=WEIGHT[line])


@pytest.mark.parametrize("line", LINES)
def test_the_line_s_absorber_is_the_same_everywhere(files, line: str) -> None:
    tuning, designs, modes = (
        files(line, stage) for stage in ("robust_tuning", "bogie_designs", "bogie_modes")
    )
    assert tuning["design"].tolist() == list(NAMED)
    row = list(modes["absorber"]).index("paper")
    for name in ("c_T", "d_T"):
        assert tuning[name][PAPER] == designs[f"own_{name}"] == modes[name][row]


def test_named_designs_are_one_list() -> None:
    assert tuple(figures.design_name(name) for name in NAMED) == sheet_verdicts.NAMES
    assert not set(NAMED) & set(STEPS)
    assert figures.design_name("tuned").startswith("step: ")
