"""One number everywhere: pages that tell the same quantity of a line tell the same number.

Growth without absorbers, and what the line's own leave of it in the band of design, are printed by
figure 10 and its table (`evolution_tendency`), the explorer (`bogie_designs`) and the design sheet
(`robust_tuning`). Curves are compared at the frequencies that both have. Maxima in the band are
looked for by each stage at frequencies of its own, finer near the modes.
"""

from pathlib import Path

import numpy as np
import pytest
from lines_by_stages import WrittenLine

from tramdva import results
from tramdva.report import figures, sheet_verdicts
from tramdva.report.design_names import NAMED, STEPS

LINES = ("paper", "worn-40m")
PAPER = list(NAMED).index("paper")
# Wheels carry translating absorbers on all pages: what differs are equilibria, to 1e-9 m/s^2.
SAME = 1e-3  # of the largest value
BETWEEN_POINTS = 0.03  # of a maximum: with absorbers its place is between frequencies
RUBBER = {"radial_stiffness": 1.2e9, "axial_stiffness": 2.4e8, "tilting_stiffness": 9.0e6}
WORN = {
    "wheel": {"measured": "profiles/worn_wheel.csv", "measured_noise": 2.0e-6},
    "rail": {"measured": "profiles/worn_rail.csv", "measured_noise": 2.0e-6},
}
LATERALLY = {
    "motion": "translation", "direction": {"x": 0, "y": 0.4, "z": 1},
    "I_T": 30, "c_T": 3.4e+6, "d_T": 2200,
}  # fmt: skip
# Trams as they are in service: gauge, curve, speed, load, rubber, absorber and profiles differ.
WRITTEN = {
    "metre gauge": {
        "tram": {"gauge_mm": 1000, "speed_km_h": 15, "axle_load_t": 6},
        "track": {"radius": 30},
        "bogie": {"wheel": {"layer": RUBBER}},
    },
    "translating": {
        "tram": {"speed_km_h": 18, "axle_load_t": 8},
        "track": {"radius": 40},
        "bogie": {"absorber": LATERALLY},
    },
    "worn": {
        "tram": {"speed_km_h": 24, "axle_load_t": 7},
        "track": {"radius": 60},
        "contact_geometry": WORN,
    },
}


@pytest.fixture(scope="module")
def files(quick_run: Path):
    return lambda line, stage: results.read(quick_run / f"results/{line}/{stage}.nc")


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
    np.testing.assert_allclose(explorer / scale, figure / scale, atol=SAME)


def agree(evolution, designs, tuning) -> None:
    """Compare growth in the band of design, and what is left of it, on three pages."""
    none, own = (list(evolution["absorber"]).index(name) for name in ("none", "paper"))
    largest = evolution["band_tendency"].max(axis=1)
    assert tuning["reference"][0] == pytest.approx(largest[none], rel=BETWEEN_POINTS)
    assert designs["none_band_tendency"].max() == pytest.approx(largest[none], rel=BETWEEN_POINTS)
    left = evolution["band_growth_left"][own]
    assert left == pytest.approx(largest[own] / largest[none])
    assert tuning["nominal_factor"][PAPER] == pytest.approx(left, rel=BETWEEN_POINTS)
    assert tuning["factor"][PAPER, 0] == pytest.approx(tuning["nominal_factor"][PAPER])
    assert designs["worst_band_factor"][own_place(designs)] == pytest.approx(
        left, rel=BETWEEN_POINTS
    )


@pytest.mark.parametrize("line", LINES)
def test_all_pages_tell_the_same_growth(files, line: str) -> None:
    stages = ("evolution_tendency", "bogie_designs", "robust_tuning")
    agree(*(files(line, stage) for stage in stages))


@pytest.mark.parametrize("words", WRITTEN)
def test_all_pages_tell_the_same_of_other_trams(tmp_path: Path, words: str) -> None:
    line = WrittenLine(tmp_path, WRITTEN[words])
    linearised, designs, tuning = line.linearisations(), line.explorer(), line.sheet()
    evolution = line.figure_10(linearised) | {"absorber": np.array(["none", "paper"])}
    assert designs["none_quiet_self_excitation"] == "stable"
    agree(evolution, designs, tuning)
    told = tuning["growth_rate"][:, 0, 1]
    assert told[0] == pytest.approx(designs["none_growth_rate"], abs=1e-3)
    assert told[PAPER] == pytest.approx(designs["growth_rate"][own_place(designs)], abs=1e-3)


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
    assert told == pytest.approx(growth[own], abs=1e-3)


@pytest.mark.parametrize("line", LINES)
def test_the_line_s_absorber_is_the_same_everywhere(files, line: str) -> None:
    tuning, designs, modes = (
        files(line, stage) for stage in ("robust_tuning", "bogie_designs", "bogie_modes")
    )
    assert tuning["design"].tolist() == [name for name in NAMED if name != "route"]
    row = list(modes["absorber"]).index("paper")
    for name in ("c_T", "d_T"):
        assert tuning[name][PAPER] == designs[f"own_{name}"] == modes[name][row]


def test_named_designs_are_one_list() -> None:
    of_the_line = [name for name in NAMED if name != "route"]  # the other is for a whole route
    assert tuple(figures.design_name(name) for name in of_the_line) == sheet_verdicts.NAMES
    assert not set(NAMED) & set(STEPS)
    assert figures.design_name("tuned").startswith("step: ")
