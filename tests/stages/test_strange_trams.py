"""A few of the random trams of `strange_trams.py`, and its judgement."""

import time

import numpy as np
import pytest
import strange_trams
from strange_trams import BASIC, BASIC_JOBS, BOGIE, NEAR, Outcome, Tram

from tramdva.configuration.line import Line


@pytest.mark.parametrize("number", [77, 86])
def test_strange_tram_ends_with_results_or_a_status(number: int) -> None:
    """Once NaN without a status, branches without an end."""
    (tram,) = strange_trams.sample([number], BASIC, BASIC_JOBS, NEAR, 100.0)

    assert tram.verdict in ("converged", "with_status", "nothing_found"), tram
    assert [outcome.stage for outcome in tram.outcomes] == list(BASIC_JOBS)


@pytest.mark.parametrize("number", range(6))
def test_trams_fit_the_schema_and_differ(number: int) -> None:
    paper = strange_trams.yaml.safe_load(
        (strange_trams.ROOT / "config/lines/paper.yaml").read_text()
    )
    near = strange_trams.drawn(1, number, BOGIE, 1.25)
    wide = strange_trams.drawn(1, number, BOGIE, None)

    for tram in (near, wide):
        Line.model_validate(paper | tram)
        assert tram["wheelset"]["c_A"] != paper["wheelset"]["c_A"]
    assert 0.8 <= near["bogie"]["frame"]["mass"] / paper["bogie"]["frame"]["mass"] <= 1.25
    assert strange_trams.drawn(1, number, BOGIE, None) == wide


def test_process_without_end_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(strange_trams, "run_stages", lambda *_: time.sleep(60))
    outcomes, broken = strange_trams.apart({}, {"x": []}, 0.2)

    assert (outcomes, broken) == ([], "no end within 0.2 s")
    assert Tram("near", 0, outcomes, broken).verdict == "failed"


def test_nan_needs_a_reason() -> None:
    values = {
        "design": np.array(["none", "a", "b"]),
        "status": np.array(["converged", "converged", "self_excited"]),
        "m_T": np.array([np.nan, 1.0, 1.0]),
        "c_T": np.array([np.nan, np.nan, np.nan]),
        "d_T": np.array([np.nan, 1.0, np.nan]),
        "frequency": np.ones(2),
        "receptance_amplitude": np.array([[1, 1], [1, np.inf], [np.nan, 1]]),
        "receptance_phase": np.ones((3, 2)),
        "stroke_amplitude": np.ones((3, 2)),
        "y_R_equilibrium": np.ones(()),
        **{name: np.ones(3) for name in ("peak_receptance", "peak_frequency")},
    }

    found = strange_trams.unexplained("frequency_response", values)

    assert found == ["c_T (1 of 3)", "receptance_amplitude (1 of 6)"]


@pytest.mark.parametrize(
    ("statuses", "error", "verdict"),
    [
        ({"converged": 2}, "", "converged"),
        ({"converged": 2, "limit_reached": 1}, "", "with_status"),
        ({"nothing_found": 1}, "", "nothing_found"),
        ({}, "ValueError: x", "failed"),
    ],
)
def test_verdicts(statuses: dict[str, int], error: str, verdict: str) -> None:
    assert Tram("near", 0, [Outcome("x", statuses, [], error, 1.0)], "").verdict == verdict
