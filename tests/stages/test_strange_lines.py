"""Lines whose physics differs from the paper's: every stage ends with results or with a status."""

import importlib
from pathlib import Path

import numpy as np
import pytest
import strange_trams
import yaml

from tramdva import results
from tramdva.configuration.reading import load_or_exit
from tramdva.configuration.uses import used_values

LINES = {
    "quiet": "creep_force: {B: 0.3}",
    "lively": "wheelset: {d_A: 500, d_R: 500}",
    "subcritical": "creep_force: {a: 6.5e-3, b: 6.5e-3}",
    "light_absorber": "absorber: {m_T: 1.0, c_T: 1.0e+5, d_T: 100}",
    "soft_wheel": "wheelset: {c_R: 5.0e+6}",
}
COARSE = """
numerics:
  cycle_amplitudes: {points: 5}
  critical_hopf_curve: {max_points: 80, check_points: 60}
  hopf_curves: {max_points: 120}
  limit_cycles: {max_orbits: 60}
"""


@pytest.fixture(scope="module", params=LINES)
def line(request, tmp_path_factory, root) -> dict[str, dict[str, np.ndarray]]:
    """Results of all stages of a line, saved and read again."""
    folder = tmp_path_factory.mktemp(request.param)
    (folder / "lines").mkdir()
    (folder / "config.yaml").write_text((root / "config/config.yaml").read_text(encoding="utf-8"))
    # In the place of the paper's line, whose basic model and bogie may be those of two trams.
    paper = yaml.safe_load((root / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    for section, values in yaml.safe_load(LINES[request.param]).items():
        paper[section] |= values
    (folder / "lines/paper.yaml").write_text(yaml.safe_dump(paper))
    (folder / "coarse.yaml").write_text(COARSE)
    files = [root / "config/quick.yaml", folder / "coarse.yaml"]
    configuration = load_or_exit(folder, files, {"lines": ["paper"]})
    return run_stages(configuration, folder) | {"line": {"name": np.array(request.param)}}


def run_stages(configuration, folder: Path) -> dict[str, dict[str, np.ndarray]]:
    name = configuration.run.lines[0]
    found: dict[str, dict[str, np.ndarray]] = {}
    for stage, reads in strange_trams.BASIC_JOBS.items():
        cfg = used_values(configuration, name, stage)
        module = importlib.import_module(f"tramdva.stages.{stage}")
        values = module.compute(
            cfg, **{other: found[other] for other in reads if other != "basic_model"}
        )
        path = folder / f"{stage}.nc"
        results.save(path, module.VARIABLES, values, parameters=cfg, code="")
        found[stage] = results.read(path)
    return found


def test_numbers_are_finite_or_have_a_status(line):
    for name, quantity in (
        ("hopf_points", "frequency"),
        ("limit_cycles", "period"),
        ("cycle_amplitudes", "a_R_max"),
        ("absorber_tuning", "peak_receptance"),
    ):
        values = line[name]
        fine = values["status"] == "converged"
        assert np.isfinite(values[quantity][fine]).all(), name


def test_both_ways_to_stability_agree(line):
    values = line["stability_map"]
    assert values["routh_hurwitz_agrees"].mean() > 0.999  # grid points on a boundary may differ
    assert values["absorber_routh_hurwitz_agrees"].mean() > 0.999


def test_what_is_known_of_each_line(line):
    name = str(line["line"]["name"])
    hopf, cycles = line["hopf_points"], line["limit_cycles"]
    if name == "quiet":
        assert hopf["c_A"].size == cycles["c_A"].size == line["hopf_curves"]["c_A"].size == 0
        assert line["critical_hopf_curve"]["d_T"].size == 0
    elif name == "lively":
        assert "none" not in hopf["absorber"]
        assert not cycles["equilibrium_stable"][cycles["equilibrium_absorber"] == "none"].any()
        assert line["absorber_tuning"]["reference_growth_rate"] > 0.0
    elif name == "subcritical":
        assert (hopf["first_lyapunov_coefficient"] > 0.0).all()
        assert (cycles["special_kind"] == "fold").sum() >= 2
        assert not cycles["stable"].all()
    elif name == "light_absorber":
        assert not line["critical_hopf_curve"]["stabilises_all_c_A"].any()
        assert "self_excited" in line["absorber_tuning"]["status"]
    else:
        bare = np.sort(hopf["c_A"][hopf["absorber"] == "none"])
        assert bare[-1] < 3e7  # everything happens at softer axles
