"""The design sheet: every quantity, units, and lines where nothing grows or nothing runs."""

import re
from pathlib import Path

import numpy as np
import pytest
from figure_scripts import STYLE, script, texts
from matplotlib.backends.backend_agg import FigureCanvasAgg

from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.evolution.growing_orders import growing_orders
from tramdva.report import design_sheet, design_sheet_page, figures
from tramdva.report.design_sheet import NOMINAL, PAPER, ROBUST
from tramdva.robustness.spread import QUANTILES
from tramdva.robustness.spread import spread as spread_of
from tramdva.variables.registry import STAGES
from tramdva.variables.shared import CASE_STATUS

ROOT = Path(__file__).resolve().parents[2]
KINDS = {"real": float, "flag": "U20", "truth": bool, "text": "U30"}
DESIGN = script("design_sheet")


@pytest.fixture
def cfg() -> dict:
    return used_values(load(ROOT / "config"), "paper", "design_sheet")


def tuning() -> dict[str, np.ndarray]:
    """Numbers of a robust tuning with 30 sampled cases."""
    ranges = list(design_sheet.RANGES)
    ends = [f"{name}_{end}" for name in ranges[:9] for end in ("min", "max")]
    varied = ["none", *ends, *["all"] * 30]
    cases = len(varied)
    lengths = {"case": cases, "range": 11, "wheel": 2, "friction": 2, "design": 4, "axis": 2,
               "end": 2, "map_c_T": 5, "map_d_T": 5, "rubber_end": 4, "peak": 2,
               "outcome": len(CASE_STATUS), "quantile": len(QUANTILES)}  # fmt: skip
    values = {
        name: np.zeros([lengths[d] for d in variable.dimensions], KINDS[variable.kind])
        for name, variable in STAGES["robust_tuning"].variables.items()
    }
    spread = np.linspace(0.02, 0.9, cases)
    missing = np.array([np.nan, 1.0, 1.0, 1.0])
    values |= {
        "varied": np.array(varied),
        "range": np.array(ranges),
        "wheel": np.array(["front_outer", "front_inner"]),
        "case_status": np.array(["converged"] * cases, dtype="U20"),
        "counted": np.ones(cases, bool),
        "status": np.array(["converged"] * 4, dtype="U20"),
        "I_T": 2.0 * missing,
        "c_T": np.array([np.nan, 1.74e5, 2.7e5, 2.6e5]),
        "d_T": np.array([np.nan, 300.0, 115.0, 394.0]),
        "tuned_frequency": 46.9 * missing,
        "damping_ratio": 0.25 * missing,
        "added_mass": 40.0 * missing,
        "added_weight": 392.4 * missing,
        "unsprung_mass": np.array(1000.0),
        "tolerance": np.array(
            [np.full((2, 2), np.nan)] * 3 + [np.array([[2.3e5, 3e5], [197.0, np.nan]])]
        ),
        "map_c_T": np.linspace(2e4, 5e5, 5),
        "map_d_T": np.linspace(20.0, 1500.0, 5),
        "map_worst_factor": np.add.outer(np.linspace(0.5, 2, 5), np.linspace(0.1, 1, 5)),
        "nominal_factor": np.array([np.nan, 0.29, 0.19, 0.27]),
        "worst_factor": np.array([np.nan, 1.1, 3.7, 0.71]),
        "self_excited_cases": np.array([np.nan, 1.0, 34.0, 0.0]),
        "factor": np.outer([1.0, 0.6, 0.7, 0.5], spread),
        "rubber_end": np.array(["stiffness_min", "stiffness_max", "damping_min", "damping_max"]),
        "rubber_factor": np.full((4, 4), 0.28),
        "peak": np.array(["second_bending", "resilient_wheel"]),
        "peak_frequency": np.full((cases, 2, 2), 55.3),
        "peak_factor": np.full((4, cases, 2, 2), 0.25) * spread[:, None, None],
        "growth_rate": np.tile(np.where(np.arange(cases) % 2, 1.0, -1.0)[:, None], (4, 1, 2)),
        "stroke_amplitude": np.outer([0.0, 1.0, 2.0, 1.0], 1e-3 * spread),
        "torque_amplitude": np.outer([0.0, 1.0, 2.0, 1.0], 100 * spread),
        "dissipated_power": np.outer([0.0, 1.0, 2.0, 1.0], 10 * spread),
        "carrier_amplitude": np.outer([3.0, 1.0, 1.0, 1.0], 1e-3 * spread),
        "load_frequency": np.full((4, cases), 55.0),
        "load_order": np.full((4, cases), 25.9),
    }
    values["growth_rate"][1:] = -5.0
    return values | spread_of(values, CASE_STATUS)


def without(values: dict, status: str) -> dict:
    """The same line where a search found no design."""
    for name in ("c_T", "d_T", "nominal_factor", "worst_factor", "tuned_frequency"):
        values[name][[NOMINAL, ROBUST]] = np.nan
    values["status"][[NOMINAL, ROBUST]] = status
    for name in ("factor", "peak_factor", "stroke_amplitude", "torque_amplitude", "growth_rate"):
        values[name][[NOMINAL, ROBUST]] = np.nan
    if status != "self_excited":
        for name in ("factor", "peak_factor", "map_worst_factor", "peak_frequency"):
            values[name][:] = np.nan
    if status == "nothing_grows":
        values["growth_rate"][0] = -1.0
    if status == "no_equilibrium":
        values["case_status"][:] = "not_converged"
        values["growth_rate"][:] = np.nan
    return values | spread_of(values, CASE_STATUS)


def modes(status: str = "converged", growth: float = 0.3) -> dict[str, np.ndarray]:
    return {
        "absorber": np.array(["none", "paper", "tuned"]),
        "status": np.array([status] * 3),
        "operating_growth_rate": np.array([growth, -17.0, -18.0]),
        "operating_frequency": np.array([54.7, 34.9, 35.0]),
        "critical_friction_decrease": np.array([0.676 if growth > 0 else np.nan, np.nan, np.nan]),
    }


def maps(sign: float = 1.0) -> dict[str, np.ndarray]:
    frequency, speed = np.linspace(2.0, 150.0, 297), np.array([3.0, 4.0])
    bump = 1e-3 * np.exp(-(((frequency - 55.0) / 4.0) ** 2)) - 1e-4
    values = {
        "absorber": np.array(["none", "paper"]),
        "frequency": frequency,
        "speed": speed,
        "speed_status": np.array([["converged", "converged"], ["converged", "wheel_lifted"]]),
        "speed_tendency": np.tile(bump if sign > 0 else -np.abs(bump), (2, 2, 2, 1)),
    }
    return values | growing_orders(values, wheel_radius=0.3)


def content(cfg, values, critical: float = 0.68, **others) -> design_sheet.Sheet:
    return design_sheet.sheet(
        cfg,
        values,
        {"baseline_critical_B": np.array(critical)},
        others.get("modes", modes()),
        others.get("maps", maps()),
    )


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
    assert cell(found, "stroke", PAPER) == f"0.0200, {design_sheet.number(worst)}"
    assert cell(found, "at 250 mm", PAPER) == f"0.00500, {design_sheet.number(0.25 * worst)}"
    assert cell(found, "growth left in the worst case", ROBUST) == "71 %"


def test_translating_absorbers_have_other_units(cfg):
    cfg["bogie"]["absorber"]["motion"] = "translation"
    found = content(cfg, tuning())
    said = "\n".join(row[0] for row in found.absorber.rows)
    for words in ("mass of one I_T (kg)", "c_T (N/m)", "d_T (N s/m)", "stroke (mm)", "force on"):
        assert words in said, words
    assert "radius (mm)" not in said
    assert any("weight of the translating absorbers" in line for line in found.notes)


@pytest.mark.parametrize(
    ("status", "said"),
    [
        ("nothing_grows", "No absorber is needed: between 45 and 65 Hz no order grows"),
        ("no_equilibrium", "No recommendation: the line as configured has no steady running"),
        ("self_excited", "No recommendation: with every absorber some condition vibrates"),
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
    assert "no steady running was found (wheel lifted)" in found.verdicts[1]


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
    assert design_sheet.in_ranges(orders) == words


@pytest.mark.parametrize(
    ("value", "words"),
    [(0.0, "0"), (1.74e5, "1.74·10⁵"), (9.996, "10.0"), (-17.3, "−17.3"), (np.nan, "–"),
     (392.4, "392"), (-2e-5, "−2.00·10⁻⁵"), (0.0780, "0.0780"), (1234.0, "1234")],
)  # fmt: skip
def test_numbers_in_words(value, words):
    assert design_sheet.number(value) == words


@pytest.mark.parametrize(
    ("share", "words"),
    [(0.27, "27 %"), (0.004, "0.4 %"), (0.0, "0 %"), (np.nan, "–"), (1.5, "150 %")],
)
def test_shares_in_per_cent(share, words):
    assert design_sheet.percent(share) == words


def test_letters_of_a_label_mean_nothing(cfg):
    cfg["label"] = "<b>A $x$ & B</b>"
    found = content(cfg, tuning())
    said = page_of(cfg, tuning(), found)
    assert "&lt;b&gt;A $x$ &amp; B" in said
    assert "<b>A" not in said
    with figures.style(STYLE):
        DESIGN.first_page(found).draw_without_rendering()


def test_same_results_give_the_same_files(cfg, tmp_path, monkeypatch):
    files = {"tuning": tuning(), "modes": modes(), "maps": maps(),
             "map": {"baseline_critical_B": np.array(0.68)}}  # fmt: skip
    monkeypatch.setattr(DESIGN.results, "read", files.__getitem__)
    made = []
    for folder in ("a", "b"):
        pdf, html = tmp_path / folder / "x.pdf", tmp_path / folder / "x.html"
        DESIGN.main(
            pdf=str(pdf), html=str(html), code="", cfg=cfg, stability_map="map",
            bogie_modes="modes", tendency_maps="maps", robust_tuning="tuning",
        )  # fmt: skip
        made.append((pdf.read_bytes(), html.read_bytes()))
    assert made[0] == made[1]
    assert len(re.findall(rb"/Type /Page\b", made[0][0])) == 2


def test_texts_stay_on_the_pages(cfg):
    values = tuning()
    found = content(cfg, values)
    with figures.style(STYLE):
        for page in (DESIGN.first_page(found), DESIGN.second_page(found, values, cfg)):
            page.draw_without_rendering()
            renderer = FigureCanvasAgg(page).get_renderer()
            for text in page.texts:
                box = text.get_window_extent(renderer).transformed(page.transFigure.inverted())
                assert box.x0 > 0.05, text.get_text()
                assert box.x1 < 0.95, text.get_text()
                assert box.y0 > 0.02, text.get_text()
