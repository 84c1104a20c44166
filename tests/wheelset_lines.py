"""The paper's line as plain values, for tests of the basic model."""

import csv
from pathlib import Path

import yaml

from tramdva.wheelset import WheelsetParameters, wheelset_parameters

ROOT = Path(__file__).resolve().parents[1]
REFERENCE = Path(__file__).parent / "reference"


def paper(**changes: float) -> WheelsetParameters:
    """Parameters of the line `paper` without absorber values, in SI units."""
    sections = yaml.safe_load((ROOT / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    sections["absorber"] = {"m_T": sections["absorber"]["m_T"]}
    return wheelset_parameters(sections, **changes)


def reference(name: str) -> list[dict[str, str]]:
    """Rows of a reference table, its comments left out."""
    with (REFERENCE / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))
