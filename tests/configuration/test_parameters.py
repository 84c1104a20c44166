"""The parameter sets and what is generated from them."""

import json
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from tramdva.configuration import reference
from tramdva.configuration.line import Line
from tramdva.configuration.run import Run
from tramdva.wheelset import parameters

ENTRIES = reference.entries(Line) | reference.entries(Run)


def test_every_number_has_unit_range_and_meaning() -> None:
    numbers = {path: e for path, e in ENTRIES.items() if "number" in e.kind}

    assert len(numbers) > 60
    for path, entry in numbers.items():
        assert entry.unit, path
        assert entry.meaning, path
        assert entry.low < entry.high, path


def test_every_physical_value_has_an_origin() -> None:
    sections = ("curve.", "creep_force.", "wheelset.", "absorber.", "forced_excitation.")
    for path, entry in ENTRIES.items():
        if path.startswith(sections):
            assert entry.origin, path


def test_slips_of_a_factor_of_thousand_are_refused(root: Path) -> None:
    """For every value of the paper's line that has a unit of force, mass or length."""
    line = yaml.safe_load((root / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    for section in ("curve", "creep_force", "wheelset", "absorber"):
        for name, value in line[section].items():
            entry = ENTRIES[f"{section}.{name}"]
            if entry.unit in ("-", "m/s", "s/m"):
                continue
            assert entry.low <= value <= entry.high, name
            for slip in (value * 1e3, value / 1e3):
                assert not entry.low <= slip <= entry.high, (name, slip)


def test_parameters_are_frozen(root: Path) -> None:
    curve = parameters.Curve(r_C=25, gamma=-0.04, outer_speed=4)

    with pytest.raises(ValidationError, match="frozen"):
        curve.r_C = 26.0


@given(st.floats(allow_nan=True, allow_infinity=True) | st.integers() | st.text() | st.booleans())
def test_a_number_is_in_range_or_refused(value: object) -> None:
    try:
        curve = parameters.Curve(r_C=value, gamma=-0.04, outer_speed=0.5)
    except ValidationError:
        return
    assert not isinstance(value, bool)
    assert 10 <= curve.r_C <= 2000


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (0.5, "0.5"),
        (-0.001, "-0.001"),
        (0.0003, "0.0003"),
        (1e-14, "1e-14"),
        (5001, "5001"),
        (10000, "10000"),
        (1e5, "1e5"),
        (1.2e7, "1.2e7"),
        (123456789, "123456789"),
        (1e10, "1e10"),
    ],
)
def test_numbers_are_written_short(value: float, text: str) -> None:
    assert reference.short(value) == text
    assert float(text) == value


def test_generated_files_are_current(root: Path) -> None:
    """Rewrite them by `python -m tramdva.configuration.reference config`."""
    readme = (root / "config/README.md").read_text(encoding="utf-8")

    assert json.loads((root / "config/schema.json").read_text()) == reference.json_schema()
    assert reference.with_table(readme) == readme


def test_generated_files_are_rewritten(root: Path, tmp_path: Path) -> None:
    readme = (root / "config/README.md").read_text(encoding="utf-8")
    (tmp_path / "README.md").write_text(readme.replace("Table 1", "Table 9"), encoding="utf-8")

    command = [sys.executable, "-m", "tramdva.configuration.reference", str(tmp_path)]
    subprocess.run(command, check=True)

    for name in ("README.md", "schema.json"):
        assert (tmp_path / name).read_bytes() == (root / "config" / name).read_bytes()


def test_schema_fits_the_files(root: Path) -> None:
    validator = jsonschema.Draft202012Validator(reference.json_schema())
    for path in [*root.glob("config/*.yaml"), *root.glob("config/lines/*.yaml")]:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
        assert not list(validator.iter_errors(content)), path
    assert list(validator.iter_errors({"wheelset": {"c_A": 5.2e4}}))
    assert list(validator.iter_errors({"wheelset": {"c_a": 5.2e7}}))
