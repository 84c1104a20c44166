"""The command that makes the table of a route."""

import csv
from pathlib import Path

import pytest
from matplotlib.image import imread
from route_files import gpx, landxml, of_pieces

from tramdva.importing import route

GEOMETRY = (
    '<Line length="150"/><Curve rot="ccw" radius="25" length="40"/><Line length="120"/>'
    '<Curve rot="cw" radius="60" length="50"/><Line length="140"/>'
)
TRACK = of_pieces((150.0, 0.0), (40.0, 25.0), (120.0, 0.0), (50.0, -60.0), (140.0, 0.0))


@pytest.fixture
def files(tmp_path: Path) -> Path:
    """A folder with an alignment and a log."""
    (tmp_path / "track.xml").write_bytes(landxml(GEOMETRY))
    (tmp_path / "log.gpx").write_bytes(gpx(TRACK, [4.5, 5.0, 5.5], noise=0.2))
    (tmp_path / "log.csv").write_text("distance_m,speed_km_h\n0,18\n500,18\n")
    return tmp_path


def rows(path: Path) -> list[dict[str, str]]:
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


@pytest.mark.parametrize("log", ["log.gpx", "log.csv"])
def test_a_table_and_a_picture(files, capsys, log):
    out = files / "routes/mine.csv"
    done = route.main([str(files / "track.xml"), "--speeds", str(files / log), "--out", str(out)])
    assert done == 0
    table = rows(out)
    assert [row["turn"] for row in table] == ["straight", "left", "straight", "right", "straight"]
    assert [row["radius_m"] for row in table] == ["", "25.000", "", "60.000", ""]
    assert [float(row["speed_km_h"]) for row in table] == pytest.approx(5 * [18.0], rel=0.02)
    picture = imread(out.with_suffix(".png"))
    assert picture.min() < picture.max()
    said = capsys.readouterr().out
    assert "500 m in 5 sections, 2 of them curves (1 left, 1 right)" in said
    assert not list(out.parent.glob(".*"))


def test_the_same_files_make_the_same_bytes(files):
    made = []
    for name in ("a.csv", "b.csv"):
        out = files / name
        route.main(
            [str(files / "track.xml"), "--speeds", str(files / "log.gpx"), "--out", str(out)]
        )
        made.append((out.read_bytes(), out.with_suffix(".png").read_bytes()))
    assert made[0] == made[1]


def test_without_a_log_speeds_are_assumed_and_marked_so(files):
    out = files / "mine.csv"
    assert route.main([str(files / "track.xml"), "--out", str(out)]) == 0
    assert "# ASSUME: no log of speeds; 0.65 m/s^2" in out.read_text()
    acceleration = [
        (float(row["speed_km_h"]) / 3.6) ** 2 / float(row["radius_m"])
        for row in rows(out)
        if row["radius_m"]
    ]
    assert acceleration == pytest.approx(2 * [0.65], rel=1e-3)


def test_a_gpx_track_is_its_own_alignment_with_its_uncertainty(files):
    out = files / "mine.csv"
    assert route.main([str(files / "log.gpx"), "--out", str(out)]) == 0
    assert "# radius of section 2: +-" in out.read_text()
    assert [float(row["radius_m"]) for row in rows(out) if row["radius_m"]] == pytest.approx(
        [25.0, 60.0], rel=0.05
    )


def test_a_bad_file_leaves_a_line_and_no_table(files, capsys):
    out = files / "mine.csv"
    out.write_text("as before")
    (files / "track.xml").write_bytes(landxml('<Line length="-1"/>'))
    for name in ("track.xml", "missing.xml"):
        assert route.main([str(files / name), "--out", str(out)]) == 1
        error = capsys.readouterr().err
        assert error.startswith(f"tramdva: {files / name}")
        assert error.count("\n") == 1
    assert out.read_text() == "as before"


def test_names_out_of_a_file_stay_in_their_line(files):
    data = landxml(GEOMETRY).replace(b'name="main"', b'name="a&#10;name,length_m&#133;"')
    (files / "track.xml").write_bytes(data)
    out = files / "mine.csv"
    assert route.main([str(files / "track.xml"), "--out", str(out)]) == 0
    assert len(rows(out)) == 5
    assert "\x85" not in out.read_text()


def test_the_table_has_to_be_a_csv(files):
    with pytest.raises(SystemExit):
        route.main([str(files / "track.xml"), "--out", "mine.txt"])
