"""Sentences about kilometres: each state has its own, and none claims what was not computed."""

import numpy as np
import pytest
import sheet_values

from tramdva.report.sheet_kilometres import ROUTE, kilometre_rows, kilometres


@pytest.mark.parametrize("status", ROUTE)
def test_every_state_has_its_sentence(status):
    first, *rest = kilometres(sheet_values.growth(status), sheet_values.remedies())
    assert first.startswith(ROUTE[status].split("{")[0])
    assert ("nan" in " ".join([first, *rest])) is False
    assert ("4 200 km" in first) == (status == "reached")


def test_what_has_no_answer_names_the_condition():
    first, *_ = kilometres(sheet_values.growth("no_steady_answer"), sheet_values.remedies())
    assert "self excited: 25 m left" in first


def test_laws_that_disagree_decide_nothing():
    words = " ".join(kilometres(sheet_values.growth(), sheet_values.remedies()))
    assert "do not decide between absorbers" in words
    agreed = sheet_values.growth() | {
        "laws_agree": np.array(True), "longest_absorber": np.array(["paper", "paper"])
    }  # fmt: skip
    words = " ".join(kilometres(agreed, sheet_values.remedies()))
    assert "name the line's absorber as the best (4 200 to 5 400 km" in words


def test_only_measures_that_help_are_told():
    words = " ".join(kilometres(sheet_values.growth(), sheet_values.remedies()))
    assert "lubricated flanges in old town (+50 %)" in words
    assert "harder" not in words


def test_table_has_a_row_for_each_absorber_and_the_life():
    rows = kilometre_rows(sheet_values.growth())
    assert [row[0] for row in rows] == [
        "absorber", "no absorber", "line's absorber", "life of the wheels, no absorber"
    ]  # fmt: skip
    assert rows[1][1:] == ["4 200 km", "5 400 km"]
