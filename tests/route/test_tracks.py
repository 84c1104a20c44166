"""Runs out of GPX files and odometers, and the speeds that they had in sections."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from route_files import gpx, of_pieces

from tramdva.route.alignment import sections_of
from tramdva.route.measured_track import measured_track
from tramdva.route.passes import on_alignment, speeds_of
from tramdva.route.safe_xml import RouteFileError
from tramdva.route.tracks import read_gpx, read_odometer

TRACK = of_pieces((150.0, 0.0), (40.0, 25.0), (120.0, 0.0), (50.0, -60.0), (140.0, 0.0))


def table(*rows, head="distance_m,speed_km_h"):
    return "\n".join([head, *(",".join(map(str, row)) for row in rows)]).encode()


def test_speeds_of_an_odometer_count_by_distance_over_all_runs():
    """18 and 36 km/h on halves of the curve in one run, 27 in another: by hand."""
    uneven = [(0, 18), (170, 18), (170.001, 36), (500, 36)]
    even = [(0, 27), (500, 27)]
    runs = read_odometer(table(*uneven, *even), "log.csv")
    runs, _ = on_alignment(runs, TRACK)
    curve = speeds_of(runs, sections_of(TRACK))[1]
    assert curve.runs == 2
    assert_allclose(3.6 * curve.mean, 27.0, rtol=1e-4)
    assert_allclose(3.6 * curve.scatter, np.sqrt((9.0**2 + 9.0**2 + 0.0 + 0.0) / 4.0), rtol=1e-4)
    assert_allclose(curve.between, 0.0, atol=1e-3)


def test_a_stop_wears_nothing_and_counts_nothing():
    rows = [(t, min(10.0 * t, 200.0)) for t in range(60)]
    rows += [(60 + t, 200.0 + 10.0 * t) for t in range(31)]
    (run,) = read_odometer(table(*rows, head="time_s,distance_m"), "log.csv")
    for speed in speeds_of([run], sections_of(TRACK)):
        assert_allclose(speed.mean, 10.0, rtol=1e-9)
        assert_allclose(speed.scatter, 0.0, atol=1e-6)


@pytest.mark.parametrize("backwards", [False, True])
def test_gpx_is_matched_by_distance_and_turned_the_way_that_fits(backwards):
    speeds = [4.5, 5.0, 5.5]
    runs = read_gpx(gpx(TRACK, speeds, noise=0.1, backwards=backwards), "log.gpx")
    matched, notes = on_alignment(runs, TRACK)
    assert len(matched) == 3
    assert "3 runs matched by distance" in notes[0]
    before, behind = np.diff(matched[0].points, axis=0)[[25, 47]]  # the first curve: to the left
    assert before[0] * behind[1] - before[1] * behind[0] > 0.0
    for speed in speeds_of(matched, sections_of(TRACK)):
        assert_allclose(speed.mean, 5.0, rtol=0.02)
        assert_allclose(speed.between, np.std(speeds), rtol=0.1)
        assert_allclose(speed.scatter, np.std(speeds), rtol=0.15)


def test_noise_of_places_is_no_scatter_of_speeds():
    """Twelve runs at one speed whose places err by 1 m: what is left is a part of what is read."""
    calm = read_gpx(gpx(TRACK, 12 * [5.0], noise=1.0, seed=3), "log.gpx")
    matched, _ = on_alignment(calm, TRACK)
    as_read = np.std(np.concatenate([run.speed for run in matched]))
    assert as_read > 0.25
    for speed in speeds_of(matched, sections_of(TRACK)):
        assert speed.scatter < 0.6 * as_read


def test_the_receivers_own_speed_counts_where_it_is_told():
    data = gpx(TRACK, [5.0], noise=2.0).replace(b"</time>", b"</time><speed>5.25</speed>")
    (run,) = read_gpx(data, "log.gpx")
    assert_allclose(run.speed, 5.25)
    assert not run.noise.any()


def test_a_gap_of_a_minute_divides_a_run():
    for left_out, runs in (((100, 165), 2), ((120, 190), 1)):  # what is behind may be too short
        lines = gpx(TRACK, [2.5]).decode().split("\n")
        del lines[slice(*left_out)]
        assert len(read_gpx("\n".join(lines).encode(), "log.gpx")) == runs


def test_a_run_over_another_track_is_left_out():
    runs = read_gpx(gpx(of_pieces((300.0, 0.0)), [5.0]), "log.gpx")
    matched, notes = on_alignment(runs, TRACK)
    assert not matched
    assert "is left out" in notes[0]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (table((0, 10)), "1 rows; at least two"),
        (table((0, 10), (10, "x")), "line 3: speed_km_h = 'x' is no number"),
        (table((0, 10), (10, "nan")), "is no number"),
        (table((0, 10), (10, 900)), "line 3: the speed is 455 km/h; allowed: 0 to 150"),
        (table((0, -10), (10, -10)), "the speed is -10 km/h"),
        (table((0, 10), (100, 10), (90, 10)), "line 4: the distance falls by 10 m"),
        (table((0, 0), (0, 5), head="time_s,distance_m"), "line 3: time_s does not rise"),
        (table((0, 0), head="place,speed"), "the columns distance_m, speed_km_h or time_s"),
        (table((0, 1, 2), (0, 2)), "line 2: 3 fields; the head names 2 columns"),
        (b"", "is empty"),
        (b"\xff\xff", "line 1: is not UTF-8"),
    ],
)
def test_what_a_table_cannot_tell_one_line_says(data, words):
    with pytest.raises(RouteFileError, match=words):
        read_odometer(data, "log.csv")


POINT = '<trkpt lat="51.0{:04d}" lon="13.7"><time>2026-05-04T12:{:02d}:{:02d}Z</time></trkpt>'


def seconds(change=lambda number, text: text):
    points = [change(k, POINT.format(k, k // 60, k % 60)) for k in range(40)]
    return f"<gpx><trk><trkseg>{''.join(points)}</trkseg></trk></gpx>".encode()


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"<gpx/>", "has no track segment of 20 points"),
        (seconds(lambda k, text: text.replace("51.0", "91.0")), "lat must be within 85"),
        (seconds(lambda k, text: text.replace("13.7", "inf")), "lon = 'inf' is no number"),
        (seconds(lambda k, text: text.replace("2026", "noon")), "is no time as"),
        (seconds(lambda k, text: f'<trkpt lat="1" lon="{k}"/>'), "has no <time>"),
        (seconds(lambda k, text: text.replace("51.", "5.") if k == 20 else text), "km/h apart"),
        (seconds(lambda k, text: text.replace("12:00:30", "11:00:30")), "track segment go back"),
        (b'<!DOCTYPE gpx [<!ENTITY x "y">]><gpx>&x;</gpx>', "has a document type"),
    ],
)  # fmt: skip
def test_what_gpx_cannot_tell_one_line_says(data, words):
    with pytest.raises(RouteFileError, match=words) as raised:
        read_gpx(data, "log.gpx")
    assert "\n" not in str(raised.value)


def test_a_track_without_noise_gives_its_radii_back():
    found = measured_track(read_gpx(gpx(TRACK, [5.0]), "log.gpx"), "log.gpx")
    curves = [stretch for stretch in found.alignment.stretches if stretch.start]
    assert_allclose([1.0 / curve.start for curve in curves], [25.0, -60.0], rtol=2e-3)
    assert_allclose([curve.length for curve in curves], [40.0, 50.0], rtol=5e-3)


def test_radii_lie_within_what_is_stated():
    """Eight logs of three runs with 0.5 m: errors over their standard deviations are about 1."""
    scores = []
    for seed in range(8):
        data = gpx(TRACK, [4.5, 5.0, 5.5], noise=0.5, seed=seed)
        found = measured_track(read_gpx(data, "log.gpx"), "log.gpx")
        assert_allclose(found.noise, 0.5, rtol=0.25)
        curves = [
            (stretch.start, share)
            for stretch, share in zip(found.alignment.stretches, found.uncertainty, strict=True)
            if stretch.start
        ]
        assert len(curves) == 2
        for (curvature, share), true in zip(curves, (1.0 / 25.0, -1.0 / 60.0), strict=True):
            scores.append((curvature - true) / (share * abs(true)))
            assert share < 0.1
    assert 0.4 < np.sqrt(np.mean(np.square(scores))) < 2.0
    assert np.abs(scores).max() < 4.0
