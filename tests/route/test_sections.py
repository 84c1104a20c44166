"""Tables of sections: what is read, and the one line that says what is wrong."""

import re

import pytest

from tramdva.route.sections import RouteError, read_sections

HEAD = "name,length_m,radius_m,turn,speed_km_h\n"


def table(tmp_path, text: str):
    path = tmp_path / "route.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_what_a_table_does_not_say_has_its_usual_value(tmp_path):
    found = read_sections(
        table(tmp_path, f"# by hand\n{HEAD}first,100,,straight,40\nbend,39.3,25,left,14.4\n")
    )
    assert [one.radius_m for one in found] == [None, 25.0]
    assert found[1].speed_scatter_percent == 5.0
    assert found[1].passages_per_lap == 1.0


def test_semicolons_a_mark_and_empty_fields(tmp_path):
    path = table(
        tmp_path, "\ufeffname;length_m;turn;radius_m;speed_km_h;cant_mm\na;9;right;30;9;\n"
    )
    (found,) = read_sections(path)
    assert (found.turn, found.cant_mm) == ("right", 0.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("name,length\nx,1\n", "line 1: there is no column 'length'"),
        ("name,turn,speed_km_h\nx,left,9\n", "line 1: column length_m is missing"),
        (f"{HEAD}x,ten,25,left,14\n", "line 2: length_m = 'ten' is no number"),
        (f"{HEAD}x,1_0,25,left,14\n", "line 2: length_m = '1_0' is no number"),
        (f"{HEAD}x,nan,25,left,14\n", "line 2: length_m = 'nan' is no number"),
        (f"{HEAD}x,-5,25,left,14\n", "length_m: -5.0 must be between 0.1 and 1e+06"),
        (f"{HEAD}x,5,3,left,14\n", "radius_m: 3.0 must be between 10 and 100000"),
        (f"{HEAD}x,5,25,links,14\n", "turn: 'links' must be left, right or straight"),
        (f"{HEAD}x,5,,left,14\n", "a curve has turn left or right and a radius_m"),
        (f"{HEAD}x,5,25,left\n", "line 2: 4 fields; the head names 5 columns"),
        (HEAD, "0 sections"),
    ],
)
def test_one_line_says_what_is_wrong(tmp_path, text, words):
    path = table(tmp_path, text)
    with pytest.raises(RouteError, match=re.escape(words)) as error:
        read_sections(path)
    assert "\n" not in str(error.value)
    assert str(path) in str(error.value)
