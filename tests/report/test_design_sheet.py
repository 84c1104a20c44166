"""The design sheet: every quantity, units, and lines where nothing grows or nothing runs."""

import re
from pathlib import Path

import numpy as np
import pytest
from figure_scripts import STYLE, script, texts
from matplotlib.backends.backend_agg import FigureCanvasAgg
from sheet_values import content, curving, growth, maps, modes, remedies, tuning, without

from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.report import design_sheet, design_sheet_page, figures, sheet_numbers
from tramdva.report.sheet_verdicts import PAPER, ROBUST

ROOT = Path(__file__).resolve().parents[2]
DESIGN = script("design_sheet")


@pytest.fixture
def cfg() -> dict:
    return used_values(load(ROOT / "config"), "paper", "design_sheet")


def page_of(cfg, values, found: design_sheet.Sheet) -> str:
    with figures.style(STYLE):
        picture = DESIGN.svg(DESIGN.pictures(values, cfg))
    return design_sheet_page.page(found, picture)


def test_sheet_tells_every_quantity(cfg):
    found = content(cfg, tuning())
    said = page_of(cfg, tuning(), found)
    for words in (
        "self-excitation from B = 0.680 s/m on", "it vibrates by itself", "B = 0.676 s/m",
        "growth rate 0.300 1/s at 54.7 Hz", "no onset of self-excitation up to B = 3 s/m",
        "no absorber 50 %", "robust optimum 0 %", "Recommended: the robust optimum",
        "inertia of one I_T (kg m²)", "stiffness c_T (N m/rad)", "tolerance band", "damping d_T",
        "tuned frequency (Hz)", "stroke (mrad)", "at 250 mm radius (mm)", "dissipated power",
        "torque on the mounting (N m)", "weight on one mounting (N)",
        "added unsprung mass per axle (kg)", "second bending, front outer", "second bending",
        "orders that grow", "rubber of the absorber, stiffness (%)", "curve radius (m)",
        "49 converged", "self-excited in 34 of 49", "197 to open",
    ):  # fmt: skip
        assert words in said, words
    assert not re.findall(r"(?:src|href)=\"(?!data:)", said)


def cell(table: design_sheet.Table, row: str, column: int) -> str:
    (found,) = [cells for cells in table.rows if cells[0].strip().startswith(row)]
    return found[column]


def test_numbers_of_the_absorber_are_those_of_the_file(cfg):
    found, values = content(cfg, tuning()).absorber, tuning()
    assert cell(found, "added unsprung mass", ROBUST) == "80.0 (8 %)"
    assert cell(found, "weight on one", ROBUST) == "392"
    worst = 1e3 * values["stroke_amplitude"][PAPER].max()
    assert cell(found, "stroke", PAPER) == f"0.0200, {sheet_numbers.number(worst)}"
    assert cell(found, "at 250 mm", PAPER) == f"0.00500, {sheet_numbers.number(0.25 * worst)}"
    assert cell(found, "growth left in the worst case", ROBUST) == "71 %"


def test_translating_absorbers_have_other_units(cfg):
    cfg["bogie"]["absorber"]["motion"] = "translation"
    found = content(cfg, tuning())
    said = "\n".join(row[0] for row in found.absorber.rows)
    for words in ("mass of one I_T (kg)", "c_T (N/m)", "d_T (N s/m)", "stroke (mm)", "force on"):
        assert words in said, words
    assert "radius (mm)" not in said
    assert any("Translating absorbers press on the wheels" in line for line in found.notes)


@pytest.mark.parametrize(
    ("status", "said"),
    [
        ("nothing_grows", "No absorber is needed: between 45 and 65 Hz no order grows"),
        ("no_equilibrium", "No recommendation: the line as configured has no steady running"),
        ("self_excited", "No recommendation: with every absorber of this mass (2.00 kg m²) some"),
    ],
)
def test_sheet_says_why_there_is_no_recommendation(cfg, tmp_path, status: str, said: str):
    values = without(tuning(), status)
    calm = modes(growth=-2.0)
    found = content(cfg, values, np.nan, modes=calm, maps=maps(-1.0))
    assert any(line.startswith(said) for line in found.verdicts)
    assert any("does not vibrate by itself, whatever B is" in line for line in found.verdicts)
    assert found.orders.rows[1][1:] == ["none", "none", "–", "none"]
    assert said in page_of(cfg, values, found).replace("&#x27;", "'")
    with figures.style(STYLE):
        drawn = texts(DESIGN.first_page(found)) + texts(DESIGN.second_page(found, values, cfg))
    assert "nan" not in drawn.replace("tenant", "")


def test_self_excitation_without_growing_orders_is_told(cfg):
    values = without(tuning(), "nothing_grows")
    values["growth_rate"][0, 0] = 1.0
    found = content(cfg, values)
    assert found.verdicts[-1].startswith("No tuning: between 45 and 65 Hz no order grows")
    assert "self-excitation" in found.verdicts[-1]


def test_bogie_without_steady_running_is_told(cfg):
    found = content(cfg, tuning(), modes=modes("wheel_lifted"))
    assert any("no steady running was found (wheel lifted)" in line for line in found.verdicts)


def test_orders_that_grow_are_those_of_the_tendency(cfg):
    rows = content(cfg, tuning()).orders.rows
    per_order = 4.0 / (2.0 * np.pi * 0.3)
    inside = [n for n in range(1, 70) if abs(n * per_order - 55.0) < 4.0 * np.sqrt(np.log(10.0))]
    assert rows[2][1] == f"{inside[0]} to {inside[-1]}"
    assert rows[2][3] == f"26 ({26 * per_order:.0f} Hz)"
    assert rows[2][0] == "14.4"
    assert rows[1][4] == rows[1][2]  # the same tendency with absorbers
    assert rows[2][4] == "–"  # no steady running with them


@pytest.mark.parametrize(
    ("orders", "words"), [([], "none"), ([4], "4"), ([1, 2, 3, 7, 9, 10], "1 to 3, 7, 9 to 10")]
)
def test_ranges_of_whole_numbers(orders, words):
    assert sheet_numbers.in_ranges(orders) == words


@pytest.mark.parametrize(
    ("value", "words"),
    [(0.0, "0"), (1.74e5, "1.74·10⁵"), (9.996, "10.0"), (-17.3, "−17.3"), (np.nan, "–"),
     (392.4, "392"), (-2e-5, "−2.00·10⁻⁵"), (0.0780, "0.0780"), (1234.0, "1234")],
)  # fmt: skip
def test_numbers_in_words(value, words):
    assert sheet_numbers.number(value) == words


@pytest.mark.parametrize(
    ("share", "words"),
    [(0.27, "27 %"), (0.004, "0.4 %"), (0.0, "0 %"), (np.nan, "–"), (1.5, "150 %")],
)
def test_shares_in_per_cent(share, words):
    assert sheet_numbers.percent(share) == words


def test_letters_of_a_label_mean_nothing(cfg):
    cfg["label"] = "<b>A $x$ & B</b>"
    found = content(cfg, tuning())
    said = page_of(cfg, tuning(), found)
    assert "&lt;b&gt;A $x$ &amp; B" in said
    assert "<b>A" not in said
    with figures.style(STYLE):
        DESIGN.first_page(found).draw_without_rendering()


def test_same_results_give_the_same_files(cfg, tmp_path, monkeypatch):
    files = {"tuning": tuning(), "modes": modes(), "maps": maps(), "curving": curving(),
             "map": {"baseline_critical_B": np.array(0.68)},
             "growth": growth(), "remedies": remedies()}  # fmt: skip
    monkeypatch.setattr(DESIGN.results, "read", files.__getitem__)
    made = []
    for folder in ("a", "b"):
        pdf, html = tmp_path / folder / "x.pdf", tmp_path / folder / "x.html"
        DESIGN.main(
            pdf=str(pdf), html=str(html), code="", cfg=cfg, stability_map="map",
            bogie_modes="modes", tendency_maps="maps", robust_tuning="tuning",
            curving_equilibrium="curving", polygon_growth="growth", route_remedies="remedies",
        )  # fmt: skip
        made.append((pdf.read_bytes(), html.read_bytes()))
    assert made[0] == made[1]
    assert len(re.findall(rb"/Type /Page\b", made[0][0])) == 3


def test_texts_stay_on_the_pages(cfg):
    values = tuning()
    found = content(cfg, values)
    with figures.style(STYLE):
        for page in DESIGN.pages(found, values, cfg):
            page.draw_without_rendering()
            renderer = FigureCanvasAgg(page).get_renderer()
            for text in page.texts:
                box = text.get_window_extent(renderer).transformed(page.transFigure.inverted())
                assert box.x0 > 0.05, text.get_text()
                assert box.x1 < 0.95, text.get_text()
                assert box.y0 > 0.02, text.get_text()
