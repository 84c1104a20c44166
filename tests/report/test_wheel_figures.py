"""Figures and tables of wheel wear, on results of few numbers."""

import csv

import numpy as np
import pytest
from figure_scripts import STYLE, script, texts

from tramdva import results
from tramdva.report import figures
from tramdva.variables.registry import STAGES

BAND = {"min": 45.0, "max": 65.0}
CODE = "0" * 20
PEAKS = ["first_bending", "second_bending", "third_bending", "resilient_wheel"]


def filled(stage: str, given: dict, **lengths: int) -> dict[str, np.ndarray]:
    """Variables of a stage: those given, the others ones or the first of their texts."""
    values = {}
    for name, variable in STAGES[stage].variables.items():
        shape = tuple(lengths[dimension] for dimension in variable.dimensions)
        if name in given:
            values[name] = np.broadcast_to(given[name], shape)
        elif variable.kind == "real":
            values[name] = np.ones(shape)
        elif variable.kind == "flag":
            values[name] = np.full(shape, variable.meanings[0])
        else:
            values[name] = np.full(shape, False if variable.kind == "truth" else "x")
    return values


def evolution_tendency(absorbers=("none", "paper"), wheels=("front_outer", "front_inner")):
    axis, order = np.linspace(2.0, 150.0, 75), np.arange(1.0, 69.0)
    top = np.array([15.0, 55.0, 73.0, 117.0])
    curve = sum(
        h * np.exp(-(((axis - f) / 2.5) ** 2)) for h, f in zip((0.1, 1, 0.6, 0.9), top, strict=True)
    )
    speed = 2.122
    at_orders = np.interp(order * speed, axis, curve)
    factor = np.where(np.array(absorbers) == "none", 1.0, 0.3)[:, None, None]
    return filled(
        "evolution_tendency",
        {
            "absorber": np.array(absorbers),
            "wheel": np.array(wheels),
            "order": order,
            "frequency": order * speed,
            "frequency_axis": axis,
            "order_axis": axis / speed,
            "linearised_normalised": factor * curve,
            "linearised_evolution_tendency": 0.04 * factor * curve,
            "evolution_tendency": 0.04 * factor * at_orders,
            "evolution_tendency_normalised": factor * at_orders,
            "level_after": 3.0 * factor * at_orders,
            "peak": np.array(PEAKS),
            "peak_frequency": np.where(factor < 1.0, np.nan, top),
            "peak_tendency": 0.04 * factor * np.array([0.1, 1.0, 0.6, 0.9]),
            "peak_tendency_normalised": factor * np.array([0.1, 1.0, 0.6, 0.9]),
            "largest_tendency": 0.04,
            "fastest_order": 26.0,
            "peak_factor": factor * np.ones(4),
            "peak_order_factor": factor * np.array([np.nan, 1.0, 1.0, 1.0]),
        },
        absorber=len(absorbers), wheel=len(wheels), order=68, frequency_axis=75, peak=4,
    )  # fmt: skip


def worn(order: int, absorber: str = "none"):
    angle = 2.0 * np.pi * np.arange(128) / 128
    wave = np.cos(order * angle)
    return filled(
        "wear",
        {"order": order, "absorber": absorber, "frequency": 55.2, "angle": angle,
         "radius_deviation": 1e-6 * wave, "wear_depth": 1e-8 * (3.0 - wave),
         "mean_wear_depth": 3e-8, "largest_radius_deviation": 1e-6,
         "wear_depth_variation": 1e-8, "wheel": np.array(["front_outer", "front_inner"])},
        wheel=2, angle=128, region=5,
    )  # fmt: skip


def tendency_maps(absorbers=("none", "paper"), **changed):
    speed, frequency = np.linspace(2.5, 6.5, 9), np.linspace(2.0, 150.0, 60)
    wave = 0.02 * np.sin(frequency / 20.0)
    return filled(
        "tendency_maps",
        {"absorber": np.array(absorbers), "wheel": np.array(["front_outer", "front_inner"]),
         "speed": speed, "radius": np.geomspace(20.0, 100.0, 5), "frequency": frequency,
         "speed_tendency": wave, "radius_tendency": wave, "map_d_T": np.linspace(20, 1500, 6),
         "map_c_T": np.linspace(2e4, 5e5, 7), "map_factor": np.linspace(0.2, 0.9, 7),
         "map_worst_factor": np.linspace(0.3, 0.9, 7), "best_c_T": 2e4, "best_d_T": 20.0,
         "best_factor": 0.2, "compromise_c_T": 2e4, "compromise_d_T": 20.0,
         "compromise_factor": 0.3, "largest_speed_tendency": 0.02,
         "c_T": np.where(np.array(absorbers) == "none", np.nan, 1.74e5),
         "d_T": np.where(np.array(absorbers) == "none", np.nan, 300.0), **changed},
        absorber=len(absorbers), wheel=2, speed=9, radius=5, frequency=60, map_d_T=6, map_c_T=7,
        order=68,
    )  # fmt: skip


def drawn_texts(figure) -> str:
    figure.draw_without_rendering()
    return texts(figure)


@pytest.fixture
def style():
    with figures.style(STYLE):
        yield


@pytest.mark.parametrize("absorbers", [("none",), ("none", "paper"), ("none", "paper", "tuned")])
def test_tendency_names_its_peaks_and_absorbers(style, absorbers):
    figure = script("fig10_evolution_tendency").draw(evolution_tendency(absorbers))
    said = drawn_texts(figure)
    for words in ("\n55\n", "\n73\n", "\n117\n", "front outer wheel", "no absorber, linearised"):
        assert words in said
    assert ("line's absorber" in said) == ("paper" in absorbers)
    panel = figure.axes[0]
    curves = [line for line in panel.lines if len(line.get_xdata()) == 75]
    assert len(curves) == len(absorbers)
    assert 0.8 < max(curves[0].get_ydata()) <= 1.0


def test_detail_shows_the_lowest_frequencies_on_their_own_scale(style):
    figure = script("fig10_evolution_tendency").draw(evolution_tendency())
    whole, detail = figure.axes[:2]
    assert detail.get_xlim()[1] < 0.4 * whole.get_xlim()[1]
    assert detail.get_ylim()[1] < 0.3 * whole.get_ylim()[1]


def test_wheels_are_shown_with_the_order_of_the_band_of_design(style, tmp_path):
    tendency = tmp_path / "evolution_tendency.nc"
    results.save(
        tendency, STAGES["evolution_tendency"], evolution_tendency(), parameters={}, code=CODE
    )
    paths = []
    for absorber in ("paper", "none"):  # in any order: the files say whose they are
        for order in (26, 27):
            path = tmp_path / absorber / f"order_{order}.nc"
            results.save(path, STAGES["wear"], worn(order, absorber), parameters={}, code=CODE)
            paths.append(str(path))
    names = {"pdf": str(tmp_path / "x.pdf"), "png": str(tmp_path / "x.png")}
    script("worn_wheels").main(
        **names, code=CODE, cfg={"label": "A $line"},
        evolution_tendency=str(tendency), wear=paths,
    )  # fmt: skip
    assert (tmp_path / "x.png").read_bytes().startswith(b"\x89PNG")
    figure = script("worn_wheels").draw(evolution_tendency(), [worn(26), worn(26)])
    assert "front inner wheel, order 26, 55.2 Hz" in drawn_texts(figure)


def test_chart_over_speed_tells_where_no_equilibrium_was_found(style):
    status = np.full((2, 9), "converged", dtype="U20")
    status[1] = "wheel_lifted"
    maps = tendency_maps(speed_status=status)
    cfg = {"bogie": {"wheel": {"radius": 0.3}}}
    said = drawn_texts(script("order_speed_chart").draw(maps, cfg))
    assert said.count("no equilibrium found") == 2
    assert "radius (m)" in said
    assert "front inner" in said


def test_design_chart_marks_the_best_absorber(style):
    figure = script("tendency_design_chart").draw(tendency_maps(), BAND)
    said = drawn_texts(figure)
    assert "least: 0.20" in said
    assert "least: 0.30" in said
    assert "line's absorber" in said
    assert "peak in 45 to 65 Hz" in said


def test_table_of_effects_leaves_empty_what_there_is_not(tmp_path):
    path = tmp_path / "evolution_tendency.nc"
    results.save(path, STAGES["evolution_tendency"], evolution_tendency(), parameters={}, code=CODE)
    table, page = tmp_path / "t.csv", tmp_path / "t.html"
    script("table_absorber_effect").main(
        table=str(table), page=str(page), code=CODE, line="paper", evolution_tendency=str(path)
    )
    rows = list(csv.DictReader(table.open(encoding="utf-8")))
    assert len(rows) == 2 * 4 * 2
    second = [
        row
        for row in rows
        if row["peak"] == "second bending" and row["absorber"] == "line's absorber"
    ]
    assert [row["factor"] for row in second] == ["0.30", "0.30"]
    assert {row["frequency (Hz)"] for row in second} == {""}
    assert [row["paper: factor"] for row in second] == ["about 1/3", "about 1/2"]
    assert "nan" not in page.read_text(encoding="utf-8")
