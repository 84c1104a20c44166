"""Alignments out of LandXML: known geometry, and files that lie, are broken or hostile."""

import math
import tracemalloc

import numpy as np
import pytest
from numpy.testing import assert_allclose
from route_files import landxml
from scipy.special import fresnel

from tramdva.route import safe_xml
from tramdva.route.alignment import plan, sections_of
from tramdva.route.landxml import read_landxml
from tramdva.route.safe_xml import RouteFileError

LINE = '<Line length="50"/>'
CURVE = '<Curve rot="ccw" radius="25" length="30"/>'
IN = '<Spiral length="12" radiusStart="INF" radiusEnd="25" rot="ccw" spiType="clothoid"/>'
HIGH = '<Cant><CantStation station="1" appliedCant="900"/></Cant>'
OUT = '<Spiral length="8" radiusStart="25" radiusEnd="INF" rot="ccw" spiType="clothoid"/>'


def read(data, **options):
    return read_landxml(data, "track.xml", **options)


def heading_at_end(alignment):
    """Direction of the last chord of a fine plan."""
    _, points = plan(alignment, 0.01)
    return math.atan2(*(points[-1] - points[-2])[::-1])


def test_a_circle_closes_on_itself():
    round_track = f'<Curve rot="ccw" radius="30" length="{2 * math.pi * 30}"/>'
    _, points = plan(read(landxml(round_track)), 0.5)
    assert_allclose(points[-1], [0.0, 0.0], atol=1e-9)
    assert_allclose(np.hypot(*(points - [0.0, 30.0]).T), 30.0, rtol=1e-12)  # to the left


def test_a_clothoid_turns_by_its_length_over_two_radii_and_ends_where_fresnel_says():
    alignment = read(landxml(IN))
    _, points = plan(alignment, 0.01)
    assert_allclose(heading_at_end(alignment), 12.0 / (2.0 * 25.0), atol=3e-4)
    scale = math.sqrt(math.pi * 12.0 * 25.0)
    sine, cosine = fresnel(12.0 / scale)
    assert_allclose(points[-1], [scale * cosine, scale * sine], atol=1e-9)


def test_a_curve_with_its_transitions_is_one_section():
    sections = sections_of(read(landxml(LINE + IN + CURVE + OUT + LINE)))
    assert [section.turn for section in sections] == ["straight", "left", "straight"]
    assert_allclose(sections[1][1:4], [25.0, 30.0, 10.0])
    whole = sum(s.length + 2.0 * s.transition for s in sections)
    assert_allclose(whole, 150.0)
    assert_allclose([s.start for s in sections] + [sections[-1].end], [0.0, 50.0, 100.0, 150.0])


def test_reverse_curves_meet_where_the_track_is_straight():
    between = '<Spiral length="30" radiusStart="25" radiusEnd="50" rot="cw"/>'
    ends = '<Curve rot="cw" radius="50" length="20"/>'
    egg = sections_of(read(landxml('<Curve rot="cw" radius="25" length="30"/>' + between + ends)))
    assert_allclose([s.length for s in egg], [45.0, 35.0])
    there = '<Spiral length="8" radiusStart="INF" radiusEnd="50" rot="cw"/>'
    turned = sections_of(read(landxml(CURVE + OUT + there + ends)))
    assert [s.turn for s in turned] == ["left", "right"]
    assert_allclose([s.transition for s in turned], [4.0, 4.0])


def test_two_clothoids_without_an_arc_are_a_curve():
    (section,) = sections_of(read(landxml(IN + OUT)))
    assert section.turn == "left"
    assert_allclose(section.length + 2.0 * section.transition, 20.0)


@pytest.mark.parametrize("swap", [False, True])
@pytest.mark.parametrize("angle", [1.0, 4.0])
def test_lengths_and_radii_follow_from_points_in_either_order_of_coordinates(swap, angle):
    """Start, centre and end of a left arc from the origin to the east, as northing, easting."""
    end = 30.0 * math.sin(angle), 30.0 * (1.0 - math.cos(angle))
    known = '<Curve rot="ccw"><Start>0 0</Start><Center>30 0</Center><End>30 30</End></Curve>'
    points = [("Start", (0.0, 0.0)), ("Center", (0.0, 30.0)), ("End", end)]
    text = "".join(
        f"<{name}>{' '.join(map(str, p if swap else p[::-1]))}</{name}>" for name, p in points
    )
    if swap:
        known = '<Curve rot="ccw"><Start>0 0</Start><Center>0 30</Center><End>30 30</End></Curve>'
    first, *_, last = read(landxml(known * 3 + f'<Curve rot="ccw">{text}</Curve>')).stretches
    assert_allclose(first, [0.5 * math.pi * 30.0, 1.0 / 30.0, 1.0 / 30.0])
    assert_allclose(last, [30.0 * angle, 1.0 / 30.0, 1.0 / 30.0])


def test_feet_are_metres():
    straight = read(landxml('<Line length="1000"/>', "Imperial", "foot"))
    assert_allclose(straight.length, 304.8)
    survey = read(landxml('<Line length="3937"/>', "Imperial", "USSurveyFoot"))
    assert_allclose(survey.length, 1200.0)


@pytest.mark.parametrize(("given", "metres"), [("0.06", 0.06), ("60", 0.06)])
def test_cant_in_metres_and_in_millimetres(given, metres):
    stations = "".join(
        f'<CantStation station="{100 + place}" appliedCant="{value}"/>'
        for place, value in ((50, 0), (62, given), (92, given), (100, 0))
    )
    alignment = read(landxml(LINE + IN + CURVE + OUT + LINE, cant=f"<Cant>{stations}</Cant>"))
    assert_allclose([s.cant for s in sections_of(alignment)], [0.0, metres, 0.0])


def test_one_of_several_alignments_is_chosen_by_its_name():
    data = landxml(LINE).replace(
        b"<Alignments>",
        b'<Alignments><Alignment name="side"><CoordGeom><Line length="7"/></CoordGeom></Alignment>',
    )
    assert_allclose(read(data, name="side").length, 7.0)
    with pytest.raises(RouteFileError, match="several alignments; name one of 'side', 'main'"):
        read(data)
    with pytest.raises(RouteFileError, match="no alignments named 'x'; it has 'side', 'main'"):
        read(data, name="x")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (landxml('<Line length="-5"/>'), "line 5: <Line>: is -5 m long; allowed: above 0"),
        (landxml('<Line length="nan"/>'), "length = 'nan' is no number"),
        (landxml('<Line length="1e9"/>'), "is 1e\\+09 m long"),
        (landxml("<Line/>"), "has no length"),
        (landxml(CURVE.replace("25", "inf")), "<Curve>: radius is INF; a curve has a number"),
        (landxml(CURVE.replace("25", "3")), "radius is 3 m; allowed: 10 to 1e\\+07 m"),
        (landxml(CURVE.replace("ccw", "left")), "rot = 'left'; allowed: cw, ccw"),
        (landxml(IN.replace("INF", "25")), "are equal"),
        (landxml("<IrregularLine/>"), "<IrregularLine>: is not read; Line, Curve and Spiral are"),
        (landxml(LINE, "Metric", "kilometer"), "linearUnit = 'kilometer'; allowed: meter, foot"),
        (
            landxml('<Line length="164"><Start>0 0</Start><End>50 0</End></Line>'),
            "its points are 50.000 m apart, by its length it would be 164.000 m",
        ),
        (landxml(""), "has no <CoordGeom>"),
        (landxml(LINE)[:-30], "is no whole XML"),
        (b"", "is no whole XML"),
        (b"\xff\xfe\x00", "is no whole XML|encoding"),
        (b"<kml/>", "the file is <kml>; a file of <LandXML> is needed"),
        (landxml(LINE, cant=HIGH), "appliedCant is up to 900; allowed: 0.2 m"),
    ],
)  # fmt: skip
def test_what_cannot_be_told_one_line_says(data, words):
    with pytest.raises(RouteFileError, match=words) as raised:
        read(data)
    assert str(raised.value).startswith("track.xml")
    assert "\n" not in str(raised.value)


LAUGHS = "".join(
    f'<!ENTITY l{k} "{10 * f"&l{k - 1};"}">' if k else '<!ENTITY l0 "ha">' for k in range(10)
)


@pytest.mark.parametrize(
    "document_type",
    [
        f"<!DOCTYPE LandXML [{LAUGHS}]>",
        '<!DOCTYPE LandXML [<!ENTITY x SYSTEM "file:///etc/hostname">]>',
        '<!DOCTYPE LandXML SYSTEM "http://localhost/x.dtd">',
        '<!DOCTYPE LandXML [<!ENTITY % x SYSTEM "file:///etc/hostname"> %x;]>',
        "<!DOCTYPE LandXML>",
    ],
)
def test_no_document_type_and_so_no_entity_is_read(document_type):
    data = landxml(LINE).replace(b"\n<LandXML", document_type.encode() + b"\n<LandXML", 1)
    data = data.replace(b'length="50"', b'length="&l9;"')
    tracemalloc.start()
    with pytest.raises(RouteFileError, match="has a document type"):
        read(data)
    assert tracemalloc.get_traced_memory()[1] < 3e6
    tracemalloc.stop()


def test_numbers_and_depth_of_elements_are_limited(monkeypatch):
    monkeypatch.setattr(safe_xml, "MOST_ELEMENTS", 1000)
    with pytest.raises(RouteFileError, match="more than 1000 elements"):
        read(landxml(LINE + 2000 * "<P/>"))
    with pytest.raises(RouteFileError, match="more than 60 deep"):
        read(landxml(100 * "<Feature>" + 100 * "</Feature>"))
    monkeypatch.setattr(safe_xml, "LARGEST", 1000)
    with pytest.raises(RouteFileError, match="larger than 1000 bytes"):
        read(landxml(LINE + 1000 * " "))
    monkeypatch.setattr(safe_xml, "LARGEST", 10**8)
    with pytest.raises(RouteFileError, match="holds more than 10000 letters"):
        read(landxml(f"<Line><Start>{10_001 * '1'}</Start></Line>"))


def test_a_survey_around_the_alignment_passes_by_and_takes_no_memory():
    """Half a million points of a surface in the same file."""
    data = landxml(LINE).replace(
        b"<Alignments>", b"<Surfaces>" + 500_000 * b"<P>1 2 3</P>" + b"</Surfaces><Alignments>"
    )
    tracemalloc.start()
    assert read(data).length == 50.0
    assert tracemalloc.get_traced_memory()[1] < 20e6
    tracemalloc.stop()
