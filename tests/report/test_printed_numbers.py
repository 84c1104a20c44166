"""What is printed is read: figure scripts and the report choose and reckon nothing."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DRAWING = [
    *sorted((ROOT / "paper_figures").glob("*.py")),
    *sorted((ROOT / "src/tramdva/report").glob("*.py")),
]
# Names of functions and methods that make a new number out of many, or choose one of them.
RECKONING = {
    "argmax", "argmin", "argsort", "average", "gradient", "interp", "mean", "median", "nanargmax",
    "nanargmin", "nanmean", "nanmedian", "nanpercentile", "nanquantile", "nanstd", "percentile",
    "polyfit", "quantile", "std", "trapezoid", "unravel_index", "var",
}  # fmt: skip
# Where a thing is drawn, or in which order numbers of the file are told; no number comes of it.
PLACED = {
    ("bogie_mode_shapes", "argsort"): "the two largest shares of the strain energy come first",
    ("fig02_stability_map", "argmax"): "a mark stands where its boundary ends",
    ("fig03_bifurcation_diagram", "argmin"): "curves and special points are joined to neighbours",
    ("preflight_chart", "interp"): "contacts are marked on the profile that is drawn",
    ("route_chart", "argsort"): "sections with large shares come first",
    ("sheet_verdicts", "argmin"): "the speed of the maps that is nearest to the line's, and told",
}


def reckoning(path: Path) -> set[str]:
    """Names of the functions of `RECKONING` that a file calls."""
    calls = (node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    names = {
        getattr(node.func, "attr", getattr(node.func, "id", ""))
        for node in calls
        if isinstance(node, ast.Call)
    }
    return names & RECKONING


@pytest.mark.parametrize("path", DRAWING, ids=lambda path: path.stem)
def test_drawing_reckons_nothing(path: Path) -> None:
    assert {name for name in reckoning(path) if (path.stem, name) not in PLACED} == set()


def test_exceptions_are_needed() -> None:
    assert {(path.stem, name) for path in DRAWING for name in reckoning(path)} == set(PLACED)
