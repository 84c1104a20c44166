"""The paper's line as plain values, for tests of the basic model."""

import csv
from pathlib import Path

import yaml

from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "tests/reference"


def paper(**changes: float) -> WheelsetParameters:
    """Parameters of the line `paper` without absorber values, in SI units."""
    sections = yaml.safe_load((ROOT / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    sections["absorber"] = {"m_T": sections["absorber"]["m_T"]}
    return wheelset_parameters(sections, **changes)


def reference(name: str) -> list[dict[str, str]]:
    """Rows of a reference table, its comments left out."""
    with (REFERENCE / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def sections(p: WheelsetParameters) -> dict[str, dict[str, float]]:
    """Sections of a line's configuration from its parameter vector; the patch is the paper's."""
    wheelset = ("m_A", "m_R", "c_A", "d_A", "c_R", "d_R", "L")
    creep_force = ("F_N", "mu_0", "A", "B", "k_A", "k_S")
    patch = {"a": 4.2e-3, "b": 4.2e-3, "G": 8.2e10, "c_22": 3.7}
    return {
        "curve": {"r_C": p.r_C, "gamma": p.gamma, "outer_speed": p.Omega * p.r_C},
        "creep_force": {**{name: getattr(p, name) for name in creep_force}, **patch},
        "wheelset": {name: getattr(p, name) for name in wheelset},
        "absorber": {"m_T": p.m_T},
    }
