"""What the paper says about the basic model, and what must hold of any result files.

By default the results of the quick pipeline are checked; `--results FOLDER` names those of a full
run, such as `results/paper`.
"""

import csv
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

PUBLISHED = Path(__file__).parent / "published/basic_model.csv"


def rows() -> list[dict[str, str]]:
    with PUBLISHED.open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def peak(response, design, low, high):
    """Frequency and height of the largest receptance of a design within a band."""
    k = list(response["design"]).index(design)
    inside = (response["frequency"] > low) & (response["frequency"] < high)
    amplitude = np.where(inside, response["receptance_amplitude"][k], 0.0)
    return response["frequency"][np.argmax(amplitude)], amplitude.max()


def measured(read) -> dict[str, float]:
    hopf, curves = read("hopf_points"), read("hopf_curves")
    critical, tuning = read("critical_hopf_curve"), read("absorber_tuning")
    response = read("frequency_response")
    bare = np.sort(hopf["c_A"][hopf["absorber"] == "none"])
    merging = (curves["special_kind"] == "critical") & (curves["special_d_T"] == 7500.0)
    largest = critical["special_kind"] == "largest_c_T"
    design = {name: k for k, name in enumerate(tuning["design"])}
    return {
        "first_hopf_point": bare[0],
        "second_hopf_point": bare[1],
        "merging_stiffness_at_7500": curves["special_c_T"][merging].max(),
        "damping_of_largest_stiffness": critical["special_d_T"][largest][0],
        "first_peak": peak(response, "none", 20, 90)[0],
        "second_peak": peak(response, "none", 90, 200)[0],
        "first_peak_with_absorber": peak(response, "paper", 20, 90)[0],
        "second_peak_with_absorber": peak(response, "paper", 90, 200)[0],
        "den_hartog_stiffness": tuning["c_T"][design["den_hartog"]],
        "den_hartog_damping_sqrt2": tuning["d_T"][design["den_hartog_sqrt2"]],
    }


@pytest.mark.parametrize("row", rows(), ids=lambda row: row["quantity"])
def test_number_of_the_paper(read, row):
    value = measured(read)[row["quantity"]]
    assert_allclose(value, float(row["value"]), rtol=0, atol=float(row["tolerance"]))


def test_statements_about_the_absorber_of_table_2(read):
    tuning, response = read("absorber_tuning"), read("frequency_response")
    paper = list(tuning["design"]).index("paper")
    # "no self-excitation expected", "below this curve", "reduces the amplitude significantly"
    assert tuning["growth_rate"][paper] < 0.0 < tuning["reference_growth_rate"]
    assert tuning["c_T"][paper] < tuning["critical_c_T"][paper]
    assert tuning["reduction"][paper] > 3.0
    # "the resonant peak associated with the resilient wheel decreases slightly"
    high = [peak(response, design, 90, 200)[1] for design in ("none", "paper")]
    assert 0.8 * high[0] < high[1] < high[0]


def test_statements_about_amplitudes(read):
    cycles, lines = read("limit_cycles"), read("cycle_amplitudes")
    size = {
        name: np.ptp([cycles["y_R_min"][here].min(), cycles["y_R_max"][here].max()])
        for name in ("none", "case_1", "case_2", "case_3")
        for here in [cycles["absorber"] == name]
    }
    # "marginally" smaller for the first two variants, "essentially" for the third
    assert size["none"] > size["case_1"] > size["case_2"] > size["case_3"]
    assert size["case_2"] > 0.9 * size["none"] > size["case_3"]
    # "the maxima increase at constant d_T for increasing c_T"; at the end "not significantly"
    for d_T in np.unique(lines["d_T"]):
        here = (lines["d_T"] == d_T) & (lines["axle"] == "critical")
        assert np.all(np.diff(lines["c_T"][here]) > 0)
        rises = np.diff(lines["y_R_deviation_max"][here])
        assert np.all(rises[:-2] > -2e-6)  # m; flat at the end
        assert abs(rises[-1]) < 0.01 * lines["y_R_deviation_max"][here].max()


def test_every_result_is_finite_or_has_a_status(read):
    for stage in ("hopf_points", "limit_cycles", "cycle_amplitudes", "absorber_tuning"):
        values = read(stage)
        fine = values["status"] == "converged"
        assert fine.any()
        for name in ("c_A", "period", "y_R_max", "y_R_deviation_max", "peak_receptance"):
            if name in values:
                assert np.isfinite(values[name][fine]).all(), f"{stage}: {name}"


def test_residuals_are_small(read):
    for stage, largest in (
        ("hopf_points", 1e-11),
        ("hopf_curves", 1e-10),
        ("critical_hopf_curve", 1e-10),
        ("limit_cycles", 1e-9),
    ):
        assert read(stage)["residual"].max() <= largest, stage


def test_stability_map_is_decided_the_same_in_both_ways(read):
    values = read("stability_map")
    assert values["absorber"][0] == "none"
    assert np.isnan(values["m_T"][0])
    assert values["routh_hurwitz_agrees"].all()
    assert values["absorber_routh_hurwitz_agrees"].all()


def test_limit_cycles_are_closed_and_between_their_hopf_points(read):
    values = read("limit_cycles")
    trivial = values["floquet_multiplier_real"][:, 0] + 1j * values["floquet_multiplier_imag"][:, 0]
    assert_allclose(trivial, 1.0, atol=1e-7)
    assert np.all(values["y_R_min"] < values["y_R_equilibrium"])
    assert np.all(values["y_R_equilibrium"] < values["y_R_max"])
    assert np.all(values["slip_min"] > 0.0)
    assert set(values["branch_ended"]) == {"hopf_point"}
    others = np.hypot(values["floquet_multiplier_real"], values["floquet_multiplier_imag"])[:, 1:]
    inside = np.nanmax(others, axis=1) < 1.0
    assert np.array_equal(inside, values["stable"])
    for name in np.unique(values["absorber"]):
        here = values["special_absorber"] == name
        ends = np.sort(values["special_c_A"][here & (values["special_kind"] == "hopf")])
        c_A = values["c_A"][values["absorber"] == name]
        assert ends[0] < c_A.min()
        assert c_A.max() < ends[1]
