"""Figures of ordinary and of strange results: each is drawn and says what happened."""

import csv
import io
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
import snakefile_tables
from figure_scripts import STYLE, script, texts
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from tramdva import results
from tramdva.report import figures
from tramdva.variables.registry import STAGES

CFG = {
    "label": "A $ line",
    "absorber": {"c_T": 4.3e6, "d_T": 6850.0},
    "absorber_variants": [{"name": "case_1", "label": "①"}, {"name": "soft", "label": "s$ft"}],
}
KINDS = {"real": float, "flag": "U20", "truth": bool, "text": "U20"}


def empty(stage: str, **lengths: int) -> dict[str, np.ndarray]:
    """All variables of a stage with the given lengths of dimensions, others 0."""
    return {
        name: np.zeros([lengths.get(d, 0) for d in variable.dimensions], KINDS[variable.kind])
        for name, variable in STAGES[stage].variables.items()
    }


def stability_map(kind: str = "oscillatory") -> dict[str, np.ndarray]:
    n, absorbers = 7, ["none", "case_1", "soft"]
    values = empty("stability_map", absorber=3, c_R=n, c_A=n, d_T=n, c_T=n)
    axis = np.linspace(1e5, 2.5e8, n)
    c_R, c_A = np.meshgrid(axis, axis, indexing="ij")
    growth = np.stack([shift - np.hypot(c_R - 1e8, c_A - 1e8) / 1e8 for shift in (1.0, 0.7, 0.4)])
    if kind == "stable":
        growth -= 10.0
    signs = np.where(growth > 0.0, kind, "stable").astype("U20")
    values |= {
        "absorber": np.array(absorbers),
        "absorber_c_T": np.array([np.nan, 4e7, 1e7]),
        "absorber_d_T": np.array([np.nan, 7500.0, 7500.0]),
        "c_R": axis,
        "c_A": axis,
        "d_T": np.linspace(0.0, 2e4, n),
        "c_T": np.linspace(1e5, 6e7, n),
        "growth_rate": growth,
        "hurwitz_h5": -growth,
        "coefficient_a6": -growth if kind == "monotone" else np.ones_like(growth),
        "instability": signs,
        "absorber_growth_rate": growth[0],
        "absorber_hurwitz_h5": -growth[0],
        "absorber_coefficient_a6": np.ones((n, n)),
        "absorber_instability": np.where(growth[0] > 0.0, "oscillatory", "stable"),
        "baseline_c_A": np.array(5.2e7),
        "baseline_c_R": np.array(4.9e7),
    }
    return values


def equilibria(stable: bool) -> dict[str, np.ndarray]:
    return {
        "equilibrium_absorber": np.repeat(["none", "case_1", "soft"], 2),
        "equilibrium_c_A": np.tile([2e7, 3e8], 3),
        "equilibrium_y_R": np.full(6, 1.4995),
        "mean_equilibrium_y_R": np.array(1.4995),
        "equilibrium_stable": np.full(6, stable),
    }


def limit_cycles() -> dict[str, np.ndarray]:
    """Two branches of one absorber; the second is subcritical with a fold."""
    first, second = np.linspace(5e7, 9e7, 5), np.array([1.2e8, 1.1e8, 1.0e8, 1.3e8, 1.5e8])
    c_A = np.concatenate([first, second])
    size = np.tile([1e-4, 2e-4, 3e-4, 3e-4, 3e-4], 2)
    values = empty("limit_cycles", cycle=10, multiplier=6)
    values |= equilibria(stable=False) | {
        "absorber": np.full(10, "none"),
        "cycle_branch": np.repeat([0, 1], 5),
        "c_A": c_A,
        "y_R_equilibrium": np.full(10, 1.4995),
        "y_R_max": 1.4995 + size,
        "y_R_min": 1.4995 - size,
        "stable": np.array([True] * 5 + [False] * 3 + [True] * 2),
        "status": np.full(10, "converged"),
        "special_kind": np.array(["hopf", "hopf", "fold"]),
        "special_absorber": np.full(3, "none"),
        "special_c_A": np.array([5e7, 1.2e8, 1e8]),
        "branch_absorber": np.full(2, "none"),
        "branch_c_A": np.array([5e7, 1.2e8]),
        "branch_ended": np.array(["window", "no_convergence"]),
    }
    return values


def hopf_points() -> dict[str, np.ndarray]:
    values = empty("hopf_points", hopf_point=3)
    return values | {
        "absorber": np.array(["none", "none", "case_1"]),
        "c_A": np.array([5e7, 1.2e8, 6e7]),
        "status": np.array(["converged", "converged", "not_converged"]),
    }


def no_limit_cycles(stable: bool) -> dict[str, np.ndarray]:
    return empty("limit_cycles", multiplier=6) | equilibria(stable)


def hopf_curves(dampings: int = 2) -> dict[str, np.ndarray]:
    n = 5
    values = empty("hopf_curves", curve_point=n * dampings)
    number = np.repeat(np.arange(dampings), n)
    c_A = np.tile(np.linspace(5e7, 2e8, n), dampings)
    return values | {
        "curve": number.astype(float),
        "d_T": 2500.0 * (1 + number),
        "c_A": c_A,
        "c_T": 1e7 * (1 + number) + ((c_A - 1e8) / 2e4) ** 2,
    }


def critical_curve() -> dict[str, np.ndarray]:
    """A curve that leaves c_T > 0 on its lower branch and returns at small dampings."""
    d_T = np.array([100, 300, 2e3, 1e4, 3e4, 6e4, 9e4, 1.1e5, 1.1e5, 2e3, 1e3, 300, 100])
    c_T = np.array([6, 7, 11, 19, 27, 30, 25, 12, 0.5, 0.5, 2, 5.5, 7]) * 1e6
    n = len(d_T)
    values = empty("critical_hopf_curve", critical_point=n, special_point=1)
    safe = np.ones(n, bool)
    safe[[0, -1]] = False
    return values | {
        "piece": np.array([0] * 9 + [1] * 4),
        "branch": np.array(["upper"] * 8 + ["lower"] * 5),
        "d_T": d_T,
        "c_T": c_T,
        "c_A": np.linspace(7e7, 1.4e8, n),
        "stabilises_all_c_A": safe,
        "special_kind": np.array(["largest_c_T"]),
        "special_d_T": np.array([6e4]),
        "special_c_T": np.array([3e7]),
        "special_c_A": np.array([1e8]),
    }


def never_safe() -> dict[str, np.ndarray]:
    curve = critical_curve()
    return curve | {"stabilises_all_c_A": np.zeros(len(curve["d_T"]), bool)}


def cycle_amplitudes(dampings: int = 2, status: str = "converged") -> dict[str, np.ndarray]:
    n = 4
    values = empty("cycle_amplitudes", cycle=2 * n * dampings)
    size = np.tile([0.4e-3, 0.6e-3, 0.7e-3, 0.75e-3], 2 * dampings)
    return values | {
        "axle": np.repeat(["critical", "baseline"], n * dampings),
        "d_T": np.tile(np.repeat(2500.0 * (1 + np.arange(dampings)), n), 2),
        "c_T": np.tile(np.geomspace(1.5e7, 2e8, n), 2 * dampings),
        "y_R_deviation_max": size if status == "converged" else size * np.nan,
        "a_R_max": 5e4 * size if status == "converged" else size * np.nan,
        "stable": np.ones(2 * n * dampings, bool),
        "status": np.full(2 * n * dampings, status),
    }


def absorber_tuning() -> dict[str, np.ndarray]:
    values = empty("absorber_tuning", design=3)
    values |= {name: np.array([1.0, 2.0, np.nan]) for name in values if values[name].size == 3}
    return values | {
        "design": np.array(["paper", "den_hartog", "h_infinity"]),
        "peak_frequency": np.array([45.0, 44.0, np.nan]),
        "peak_receptance": np.array([3e-7, 2e-7, np.nan]),
        "reduction": np.array([5.0, 7.5, np.nan]),
        "status": np.array(["converged", "self_excited", "self_excited"]),
        "reference_peak_frequency": np.array(48.0),
        "reference_peak_receptance": np.array(1.5e-6),
        "reference_growth_rate": np.array(0.2),
    }


def frequency_response() -> dict[str, np.ndarray]:
    frequency = np.linspace(1.0, 300.0, 100)
    peak = np.exp(-(((frequency - 48.0) / 10.0) ** 2)) + 0.01
    amplitude = np.stack([1.5e-6 * peak, 3e-7 * peak, 2e-7 * peak, peak * np.nan])
    return empty("frequency_response", design=4, frequency=100) | {
        "design": np.array(["none", "paper", "den_hartog", "h_infinity"]),
        "frequency": frequency,
        "receptance_amplitude": amplitude,
        "receptance_phase": np.zeros_like(amplitude),
        "peak_frequency": np.array([48.0]),
        "peak_receptance": np.array([1.515e-6]),
        "y_R_equilibrium": np.array(1.5),
        "status": np.full(4, "converged"),
    }


@pytest.fixture
def draw() -> Callable[..., Figure]:
    """Draw a figure without writing it."""

    def drawn(name: str, *data: dict) -> Figure:
        with figures.style(STYLE):
            figure = script(name).draw(*data)
            figure.draw_without_rendering()
        return figure

    return drawn


def lines(axes: Axes, **look: object) -> list:
    """Lines of axes with data and this look."""
    return [
        line
        for line in axes.lines
        if len(line.get_xdata()) and all(getattr(line, f"get_{k}")() == v for k, v in look.items())
    ]


FILES = {
    "stability_map": stability_map,
    "hopf_points": hopf_points,
    "limit_cycles": limit_cycles,
    "hopf_curves": hopf_curves,
    "critical_hopf_curve": critical_curve,
    "cycle_amplitudes": cycle_amplitudes,
    "absorber_tuning": absorber_tuning,
    "frequency_response": frequency_response,
}
OF_THE_WHEELSET = [
    name
    for name, reads in snakefile_tables.read().figures.items()
    if name.startswith("fig") and reads and set(reads) <= set(FILES)
]


def write(name: str, folder: Path) -> tuple[bytes, bytes]:
    """Run a script as the pipeline does and return its PDF and PNG."""
    inputs = {}
    for stage in snakefile_tables.read().figures[name]:
        inputs[stage] = str(folder / f"{stage}.nc")
        results.save(inputs[stage], STAGES[stage], FILES[stage](), parameters={}, code="")
    paths = {kind: folder / f"{name}.{kind}" for kind in ("pdf", "png")}
    script(name).main(**{k: str(p) for k, p in paths.items()}, code="", cfg=CFG, **inputs)
    return paths["pdf"].read_bytes(), paths["png"].read_bytes()


@pytest.mark.parametrize("name", OF_THE_WHEELSET)
def test_files(name: str, tmp_path: Path) -> None:
    before = dict(mpl.rcParams)
    pdf, png = write(name, tmp_path)
    image = Image.open(io.BytesIO(png))
    width = image.width / image.info["dpi"][0] * 25.4

    assert pdf.startswith(b"%PDF")
    assert b"CreationDate" not in pdf
    assert b"/FontType 42" in pdf or b"/Subtype /Type0" in pdf or b"CIDFontType2" in pdf
    assert image.format == "PNG"
    assert any(abs(width - column) < 0.5 for column in (84, 174))
    assert image.info["Title"].endswith(CFG["label"])
    assert len(png) < 300_000
    assert dict(mpl.rcParams) == before


def test_same_results_give_same_files(tmp_path: Path) -> None:
    first, second = (write("fig04_hopf_curves", tmp_path / str(n)) for n in range(2))

    assert first == second


def test_stability_map(draw) -> None:
    figure = draw("fig02", CFG, stability_map())
    words = texts(figure)

    assert "①  $c_T$ = 40 MN/m, $d_T$ = 7.5 kN s/m" in words
    assert r"s\$ft" in words
    assert "oscillation grows" in words
    assert "diverges" not in words
    wheelset, absorber = figure.axes[:2]
    assert lines(wheelset, marker="o")[0].get_xydata().tolist() == [[49.0, 52.0]]
    assert lines(absorber, marker="*")[0].get_xydata().tolist() == [[6.85, 4.3]]
    assert wheelset.get_xlim() == (0.0, 250.0)


@pytest.mark.parametrize(("kind", "said"), [("monotone", "diverges"), ("stable", "stable")])
def test_stability_map_of_other_kinds(draw, kind: str, said: str) -> None:
    words = texts(draw("fig02", CFG, stability_map(kind)))

    assert said in words


def test_stability_map_without_equilibrium(draw) -> None:
    maps = stability_map()
    for name in ("growth_rate", "hurwitz_h5", "coefficient_a6"):
        maps[name][..., :2] = np.nan
    maps["instability"][..., :2] = "no_equilibrium"

    assert "no equilibrium" in texts(draw("fig02", CFG, maps))


def test_bifurcation_diagram(draw) -> None:
    figure = draw("fig03", CFG, hopf_points(), limit_cycles())
    diagram, ranges = figure.axes[:2]
    words = texts(figure)

    assert "50.0  H" in words
    assert "fold of cycles" in words
    assert "branches cut off: no convergence" in words
    assert "no Hopf point: never stable" in words
    assert [label.get_text() for label in ranges.get_yticklabels()] == [
        "no absorber",
        "①",
        r"s\$ft",
    ]
    cycles = [line for line in lines(diagram, markersize=3.0) if line.get_linestyle() == "-"]
    assert len(cycles) == 4  # largest and smallest positions of both branches
    assert len(lines(diagram, markersize=3.0, linestyle="--")) == 2
    assert len(lines(diagram, marker="x")) == 2
    for line in cycles:  # the branches are not joined
        assert np.all(np.abs(np.diff(line.get_xdata())) < 25.0)


@pytest.mark.parametrize("stable", [True, False])
def test_bifurcation_diagram_without_hopf_points(draw, stable: bool) -> None:
    figure = draw("fig03", CFG, empty("hopf_points"), no_limit_cycles(stable))

    said = "does not vibrate by itself" if stable else "neither begins nor ends"
    assert said in texts(figure)


@pytest.mark.parametrize("dampings", [1, 9])
def test_hopf_curves(draw, dampings: int) -> None:
    figure = draw("fig04", hopf_curves(dampings), critical_curve())
    words = texts(figure)

    assert words.count("kN s/m") == dampings
    assert "only locally critical" in words
    assert len(lines(figure.axes[0])) >= dampings + 2


def test_hopf_curves_without_critical_points(draw) -> None:
    words = texts(draw("fig04", hopf_curves(), empty("critical_hopf_curve")))

    assert "kN s/m" in words
    assert "critical" not in words


def test_no_hopf_curves(draw) -> None:
    words = texts(draw("fig04", empty("hopf_curves"), empty("critical_hopf_curve")))

    assert "no Hopf point with any of these absorbers" in words


def test_critical_curve(draw) -> None:
    figure = draw("fig05", CFG, critical_curve())
    axes = figure.axes[0]
    words = texts(figure)

    assert "no self-excitation" in words
    assert "largest $c_T$ = 30.0 MN/m at $d_T$ = 60.0 kN s/m" in words
    assert lines(axes, marker="^")[0].get_xydata().tolist() == [[60.0, 30.0]]
    assert lines(axes, marker="*")
    assert len(axes.child_axes) == 1  # the lower branch at small dampings
    for line in lines(axes, linestyle="-"):  # not joined where c_T would be negative
        assert np.all(np.abs(np.diff(line.get_xdata())) < 50.0)
    (safe,) = axes.patches[:1]
    assert safe.contains_point(axes.transData.transform((60.0, 0.2)))
    assert not safe.contains_point(axes.transData.transform((0.5, 1.0)))


def test_critical_curve_that_is_nowhere_safe(draw) -> None:
    figure = draw("fig05", CFG, never_safe())

    assert "no self-excitation" not in texts(figure)
    assert "only locally critical" in texts(figure)


def test_upper_branch_alone(draw) -> None:
    curve = critical_curve()
    upper = curve["branch"] == "upper"
    curve |= {name: curve[name][upper] for name in curve if curve[name].shape == upper.shape}
    figure = draw("fig05", CFG, curve)

    assert not figure.axes[0].child_axes
    assert figure.axes[0].patches[0].contains_point(figure.axes[0].transData.transform((50.0, 0.5)))


def test_no_critical_curve(draw) -> None:
    assert "no critical Hopf point" in texts(draw("fig05", CFG, empty("critical_hopf_curve")))


@pytest.mark.parametrize("dampings", [1, 3])
def test_cycle_amplitudes(draw, dampings: int) -> None:
    figure = draw("fig06", critical_curve(), cycle_amplitudes(dampings))
    (onset,) = lines(figure.axes[0], color=figures.ONSET)

    assert texts(figure).count("kN s/m") == dampings
    assert onset.get_ydata().tolist() == pytest.approx([0.4] * dampings)
    assert figure.axes[0].get_ylabel().endswith("(mm)")
    assert len(lines(figure.axes[1])) == 2 * dampings + 1


@pytest.mark.parametrize(
    ("critical", "cycles", "said"),
    [
        (critical_curve, lambda: empty("cycle_amplitudes"), "does not vibrate by itself"),
        (critical_curve, lambda: cycle_amplitudes(1, "not_converged"), "could be computed"),
        (
            lambda: empty("critical_hopf_curve"),
            lambda: empty("cycle_amplitudes"),
            "no critical Hopf point",
        ),
    ],
)
def test_no_cycle_amplitudes(draw, critical, cycles, said: str) -> None:
    figure = draw("fig06", critical(), cycles())

    assert texts(figure).count(said) == 2


def test_unstable_cycles_are_dotted(draw) -> None:
    cycles = cycle_amplitudes(1)
    cycles["stable"][:2] = False
    figure = draw("fig06", critical_curve(), cycles)

    assert "unstable" in texts(figure)


def test_frequency_response(draw) -> None:
    figure = draw("fig07", frequency_response(), absorber_tuning())
    words = texts(figure)

    assert "no absorber: 48.0 Hz" in words
    assert "Den Hartog: 44.0 Hz, 7.5× lower, self-excited" in words
    assert "lowest peak (H∞): there is none" in words
    assert "5.0× lower" in words
    assert figure.axes[0].get_yscale() == "log"
    assert len(lines(figure.axes[0])) == 2


def test_table_of_designs(tmp_path: Path) -> None:
    tuning = str(tmp_path / "absorber_tuning.nc")
    results.save(tuning, STAGES["absorber_tuning"], absorber_tuning(), parameters={}, code="")
    paths = {"table": tmp_path / "table.csv", "page": tmp_path / "table.html"}
    script("table2").main(**{k: str(p) for k, p in paths.items()}, code="", absorber_tuning=tuning)
    rows = list(csv.DictReader(paths["table"].open(encoding="utf-8")))

    assert [row["design"] for row in rows][:2] == ["no absorber", "line's absorber"]
    assert rows[0]["peak frequency (Hz)"] == "48.00"
    assert rows[1]["peak receptance (mm/kN)"] == "0.3000"
    assert rows[2]["status"] == "self excited"
    assert rows[3]["peak frequency (Hz)"] == ""
    assert paths["page"].read_text(encoding="utf-8").count("<tr>") == 5


def test_pieces() -> None:
    truth = np.array([True, True, False, True])

    assert [list(range(4))[piece] for piece in figures.pieces(truth)] == [[0, 1, 2], [2, 3], [3]]
    assert not list(figures.pieces(truth[:0]))
