"""Read the alignment of a track from LandXML: lines, curves and spirals, cant where it is given.

Lengths are attributes or follow from the points; where a file has both they have to agree, which
finds a file in other units than it says. The way that a curve turns is its attribute `rot`: files
differ in the order of their coordinates. `appliedCant` is in the unit of length or in millimetres
(inches), files differ; it is told by its size.
"""

from __future__ import annotations

import math

import numpy as np

from tramdva.route.alignment import Alignment, Stretch
from tramdva.route.safe_xml import Element, RouteFileError, kept_elements

UNITS = {"meter": 1.0, "foot": 0.3048, "USSurveyFoot": 1200.0 / 3937.0}
MOST_STRETCHES = 20_000
LONGEST = 1e6  # m
SHARPEST, WIDEST = 10.0, 1e7  # m, radius
TURNS = {"ccw": 1.0, "cw": -1.0}
AGREE = 0.01  # of a length, by which points and attributes may differ
ROUNDING = 0.05  # m, of coordinates
HIGHEST_CANT = 0.2  # m
SMALL_UNITS = {1.0: 1e-3, 0.3048: 0.0254}  # of a cant, by the unit of length


def read_landxml(data: bytes, origin: str, name: str | None = None) -> Alignment:
    """Alignment of a LandXML file.

    Parameters
    ----------
    data : of the file; origin : its name, for messages
    name : of the alignment, where there are several

    Raises
    ------
    RouteFileError
        With file, line, element and what is allowed.
    """
    found = kept_elements(data, origin, "LandXML", ("Units", "Alignment"))
    reader = _LandXML(origin, *_unit(origin, [e for e in found if e.name == "Units"]))
    chosen = _chosen(origin, [e for e in found if e.name == "Alignment"], name)
    return reader.alignment(chosen)


def _unit(origin: str, units: list[Element]) -> tuple[float, tuple[str, ...]]:
    """Metres per unit of length, and what was assumed."""
    given = [child for element in units for child in element.all("Metric", "Imperial")]
    if not given:
        return 1.0, ("the file names no units: metres assumed",)
    unit = given[0].attributes.get("linearUnit", "")
    if unit not in UNITS:
        raise RouteFileError(
            f"{origin}, line {given[0].line}: linearUnit = {unit[:40]!r}; "
            f"allowed: {', '.join(UNITS)}"
        )
    return UNITS[unit], ()


def _chosen(origin: str, alignments: list[Element], name: str | None) -> Element:
    names = [element.attributes.get("name", "") for element in alignments]
    listed = ", ".join(repr(each[:60]) for each in names[:20])
    if not alignments:
        raise RouteFileError(f"{origin}: has no <Alignment>")
    if name is None and len(alignments) > 1:
        raise RouteFileError(f"{origin}: has several alignments; name one of {listed}")
    if name is not None and names.count(name) != 1:
        how = "several" if name in names else "no"
        raise RouteFileError(f"{origin}: has {how} alignments named {name[:60]!r}; it has {listed}")
    return alignments[0 if name is None else names.index(name)]


def _side(start: tuple, end: tuple, centre: tuple) -> float:
    """Above zero where the centre lies left of the chord, with the easting as first coordinate."""
    cross = (end[0] - start[0]) * (centre[1] - start[1])
    cross -= (end[1] - start[1]) * (centre[0] - start[0])
    scale = math.dist(start, end) * math.dist(start, centre)
    return cross / scale if abs(cross) > 1e-6 * scale else 0.0


class _LandXML:
    """What the elements of one file say, in metres."""

    def __init__(self, origin: str, unit: float, notes: tuple[str, ...]) -> None:
        self.origin, self.unit, self.notes = origin, unit, list(notes)
        self.order = -1.0  # of coordinates: 1 where the first is the easting

    def error(self, element: Element, words: str) -> RouteFileError:
        return RouteFileError(f"{self.origin}, line {element.line}: <{element.name}>: {words}")

    def alignment(self, element: Element) -> Alignment:
        geometry = element.first("CoordGeom")
        if geometry is None or not geometry.children:
            raise self.error(element, "has no <CoordGeom> with lines, curves or spirals")
        if len(geometry.children) > MOST_STRETCHES:
            raise self.error(geometry, f"has more than {MOST_STRETCHES} elements")
        self.find_order(geometry.all("Curve"))
        stretches = tuple(
            self.stretch(child) for child in geometry.children if child.name != "Feature"
        )
        if sum(stretch.length for stretch in stretches) > LONGEST:
            raise self.error(geometry, f"is longer than {LONGEST / 1000:g} km")
        cant = self.cant(element)
        name = element.attributes.get("name", "")
        return Alignment(name, stretches, cant, tuple(dict.fromkeys(self.notes)))

    def stretch(self, element: Element) -> Stretch:
        if element.name == "Line":
            return Stretch(self.length(element, self.chord(element)), 0.0, 0.0)
        if element.name == "Curve":
            return self.curve(element)
        if element.name == "Spiral":
            return self.spiral(element)
        raise self.error(element, "is not read; Line, Curve and Spiral are")

    def curve(self, element: Element) -> Stretch:
        turn, centre = self.turn(element), self.point(element, "Center")
        start, end = self.point(element, "Start"), self.point(element, "End")
        if "radius" not in element.attributes and (centre is None or start is None):
            raise self.error(element, "has neither a radius nor points Start and Center")
        if "radius" not in element.attributes:
            radius = math.dist(start, centre)
            self.check_radius(element, "radius", radius)
        elif (radius := self.radius(element, "radius")) is None:
            raise self.error(element, "radius is INF; a curve has a number")
        elif start is not None and centre is not None:
            self.check_agrees(element, radius, math.dist(start, centre), "radius")
        if "length" in element.attributes:
            return self.arc(element, self.length(element, None), radius, turn, start, end)
        if start is None or end is None:
            raise self.error(element, "has neither a length nor points Start and End")
        angle = 2.0 * math.asin(min(1.0, 0.5 * math.dist(start, end) / radius))
        if self.is_long_way(start, end, centre, turn):
            angle = 2.0 * math.pi - angle
        return Stretch(self.checked(element, angle * radius), turn / radius, turn / radius)

    def is_long_way(self, start, end, centre, turn) -> bool:
        """Whether an arc is more than half a circle: its centre lies on the outer side."""
        return centre is not None and self.order * _side(start, end, centre) * turn < 0.0

    def find_order(self, curves: list[Element]) -> None:
        """Tell the order of coordinates by how most curves turn; else it is northing, easting."""
        votes = 0.0
        for curve in curves:
            points = [self.point(curve, name) for name in ("Start", "End", "Center")]
            if all(points) and curve.attributes.get("rot") in TURNS:
                votes += np.sign(_side(*points) * self.turn(curve))
        self.order = 1.0 if votes > 0.0 else -1.0

    def arc(self, element, length, radius, turn, start, end) -> Stretch:
        if start is not None and end is not None:
            chord = 2.0 * radius * abs(math.sin(0.5 * length / radius))
            self.check_agrees(element, chord, math.dist(start, end), "length and radius")
        return Stretch(length, turn / radius, turn / radius)

    def spiral(self, element: Element) -> Stretch:
        turn, kind = self.turn(element), element.attributes.get("spiType", "clothoid")
        if kind != "clothoid":
            self.notes.append(f"spirals of the type {kind[:40]!r} count as clothoids")
        ends = [
            0.0 if radius is None else turn / radius
            for radius in (self.radius(element, "radiusStart"), self.radius(element, "radiusEnd"))
        ]
        if ends[0] == ends[1]:
            raise self.error(element, "radiusStart and radiusEnd are equal; a spiral changes them")
        chord, length = self.chord(element), self.length(element, None)
        if chord is not None and chord > length * (1.0 + AGREE) + ROUNDING:
            raise self.error(
                element, f"is {length:.3f} m long, but its points are {chord:.3f} m apart"
            )
        return Stretch(length, *ends)

    def turn(self, element: Element) -> float:
        given = element.attributes.get("rot", "")
        if given not in TURNS:
            raise self.error(element, f"rot = {given[:40]!r}; allowed: cw, ccw")
        return TURNS[given]

    def radius(self, element: Element, name: str) -> float | None:
        """Radius in m; None where the track is straight."""
        given = element.attributes.get(name)
        if given is None:
            raise self.error(element, f"{name} is missing; a number or INF is needed")
        if given.strip().upper() == "INF":
            return None
        value = self.unit * self.number(element, name, given)
        if value == 0.0 and element.name == "Spiral":  # as some programs write INF
            return None
        self.check_radius(element, name, value)
        return value

    def check_radius(self, element: Element, name: str, value: float) -> None:
        if not SHARPEST <= value <= WIDEST:
            raise self.error(
                element, f"{name} is {value:g} m; allowed: {SHARPEST:g} to {WIDEST:g} m"
            )

    def length(self, element: Element, chord: float | None) -> float:
        """Length by the attribute, or by the points of a line."""
        given = element.attributes.get("length")
        if given is None and chord is None:
            raise self.error(element, "has no length")
        if given is None:
            return self.checked(element, chord)
        value = self.checked(element, self.unit * self.number(element, "length", given))
        if chord is not None:
            self.check_agrees(element, value, chord, "length")
        return value

    def checked(self, element: Element, length: float) -> float:
        if not 0.0 < length <= LONGEST:
            raise self.error(
                element, f"is {length:g} m long; allowed: above 0, up to {LONGEST:g} m"
            )
        return length

    def check_agrees(self, element: Element, told: float, points: float, what: str) -> None:
        if abs(told - points) > AGREE * max(told, points) + ROUNDING:
            raise self.error(
                element,
                f"its points are {points:.3f} m apart, by its {what} it would be {told:.3f} m",
            )

    def number(self, element: Element, name: str, given: str) -> float:
        try:
            value = math.nan if "_" in given else float(given)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise self.error(element, f"{name} = {given[:40]!r} is no number")
        return value

    def point(self, element: Element, name: str) -> tuple[float, float] | None:
        """Northing and easting in m; None where they are not given as numbers."""
        child = element.first(name)
        if child is None or not child.words():
            return None
        fields = child.words().split()
        if len(fields) < 2:
            raise self.error(child, f"{child.words()[:40]!r} is no pair of coordinates")
        return tuple(self.unit * self.number(child, "coordinate", f) for f in fields[:2])

    def chord(self, element: Element) -> float | None:
        """Distance of the ends; None where they are not given."""
        start, end = self.point(element, "Start"), self.point(element, "End")
        return None if start is None or end is None else math.dist(start, end)

    def cant(self, element: Element) -> np.ndarray:
        """Places from the start and cant (k, 2), m."""
        first = self.number(element, "staStart", element.attributes.get("staStart", "0"))
        table = []
        for cant in element.all("Cant"):
            for station in cant.all("CantStation"):
                values = [
                    self.number(station, name, station.attributes.get(name, ""))
                    for name in ("station", "appliedCant")
                ]
                table.append((self.unit * (values[0] - first), abs(values[1])))
        if not table:
            return np.zeros((0, 2))
        places, cants = np.array(sorted(table)).T
        largest = cants.max()
        metres = self.unit * largest <= HIGHEST_CANT
        small = SMALL_UNITS[min(SMALL_UNITS, key=lambda unit: abs(unit - self.unit))]
        if not metres and small * largest > HIGHEST_CANT:
            raise self.error(
                element.first("Cant"),
                f"appliedCant is up to {largest:g}; allowed: {HIGHEST_CANT:g} m",
            )
        if not metres:
            self.notes.append("cant counts as in " + ("mm" if small == 1e-3 else "inches"))
        return np.column_stack([places, (self.unit if metres else small) * cants])
