"""Where nothing was computed a figure says why, in words; a missing equilibrium is a result."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from figure_scripts import STYLE, script, texts
from matplotlib.figure import Figure

from tramdva.report import figures
from tramdva.variables.arrays import without_numbers
from tramdva.variables.registry import STAGES

ABSORBERS = np.array(["none", "paper"])
WHEELS = np.array(["front_outer", "front_inner"])
LENGTHS = {"absorber": 2, "wheel": 2, "axis": 2, "motion": 6}
LEAVES = "a wheel leaves its profile or table"


def nothing(stage: str, lengths: dict | None = None, **given) -> dict[str, np.ndarray]:
    """A file of a stage without any number but those given."""
    description = STAGES[stage]
    names = {d for v in description.variables.values() for d in v.dimensions}
    values = without_numbers(description, dict.fromkeys(names, 4) | LENGTHS | (lengths or {}))
    return values | {"absorber": ABSORBERS} | given


def modes(**given) -> dict[str, np.ndarray]:
    return nothing(
        "bogie_modes",
        {"absorber": 3},
        absorber=np.array(["none", "paper", "tuned"]),
        status=np.array(["outside_profile"] * 3),
        map_status=np.array("outside_profile"),
        friction_decrease=np.linspace(0.0, 3.0, 4),
        shape_mode=np.array(
            ["first_bending", "second_bending", "third_bending", "resilient_wheel"]
        ),
        map_c_T=np.linspace(1e5, 2e5, 4),
        map_d_T=np.linspace(100.0, 200.0, 4),
        **given,
    )


def tendency(status: str, linearised: float = np.nan) -> dict[str, np.ndarray]:
    axis = np.linspace(2.0, 150.0, 40)
    return nothing(
        "evolution_tendency",
        {"order": 3, "frequency_axis": 40},
        wheel=WHEELS,
        peak=np.array(["first", "second", "third", "fourth"]),
        order=np.array([6.0, 26.0, 46.0]),
        frequency=np.array([12.7, 55.2, 97.6]),
        frequency_axis=axis,
        order_axis=axis / 2.12,
        level=np.zeros((2, 3)),
        status=np.array([[status] * 3, ["periodic"] * 3]),
        linearised_normalised=linearised * np.tile(np.linspace(-1.0, 1.0, 40), (2, 2, 1)),
    )


def curve_entry() -> dict[str, np.ndarray]:
    wheels = np.array(["front_outer", "front_inner", "rear_outer", "rear_inner"])
    return nothing("curve_entry", {"wheel": 4, "time": 9}, wheel=wheels, time=np.linspace(0, 9, 9))


def tendency_maps() -> dict[str, np.ndarray]:
    grid = {"map_c_T": np.linspace(1e5, 2e5, 4), "map_d_T": np.linspace(100.0, 200.0, 4)}
    status = np.full((2, 4), "outside_profile")
    return nothing("tendency_maps", wheel=WHEELS, speed_status=status, **grid)


CASES = {
    "fig09_curve_entry": (lambda draw: draw(curve_entry(), modes(), 3.0), LEAVES),
    "bogie_mode_shapes": (lambda draw: draw(modes(), 0.3), LEAVES),
    "bogie_stability": (lambda draw: draw(modes(), 0.7), LEAVES),
    "campbell_chart": (lambda draw: draw(modes(), 0.3, 4.0), LEAVES),
    "tendency_design_chart": (
        lambda draw: draw(tendency_maps(), {"min": 45.0, "max": 65.0}),
        LEAVES,
    ),
    "fig10_evolution_tendency": (
        lambda draw: draw(tendency("no_equilibrium")),
        "no absorber: no steady running was found",
    ),
    "worn_wheels": (
        lambda draw: draw(tendency("no_equilibrium"), [None, None]),
        "no order ran steadily\nno steady running was found",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_figure_says_why_it_is_empty(tmp_path: Path, name: str) -> None:
    draw, said = CASES[name]
    with figures.style(STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "No contour levels were found|All-NaN|invalid value")
        figure: Figure = draw(script(name).draw)
        figures.save(figure, tmp_path / "x.pdf", tmp_path / "x.png", "nothing")
        assert said in texts(figure)
    assert (tmp_path / "x.png").stat().st_size > 1000


def test_self_excitation_is_told_in_figure_10() -> None:
    with figures.style(STYLE):
        said = texts(script("fig10_evolution_tendency").draw(tendency("self_excited", 0.1)))
    assert "no absorber: vibrates by itself, no order was simulated" in said
    assert "line's absorber, simulated orders" in said


def test_every_status_has_words() -> None:
    for stage in ("bogie_simulation", "bogie_modes"):
        for name in STAGES[stage].variables["status"].meanings[1:]:
            assert name in figures.STATUS_WORDS, name
    assert figures.status_words(["converged", "wheel_lifted"], "converged") == ""
    assert figures.status_words(["wheel_lifted"] * 2, "converged") == "a wheel lifts off"
