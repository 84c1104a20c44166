"""Files of routes for tests: alignments as LandXML, and runs over them as GPX."""

from datetime import UTC, datetime, timedelta

import numpy as np

from tramdva.route.alignment import Alignment, Stretch, plan

NAMESPACE = "http://www.landxml.org/schema/LandXML-1.2"
LATITUDE, LONGITUDE = 51.05, 13.74
# Radii of the Earth there, by WGS 84: along the meridian and across it.
MERIDIAN, ACROSS = 6374.1e3, 6391.1e3


def landxml(geometry: str, unit: str = "Metric", linear: str = "meter", cant: str = "") -> bytes:
    """LandXML with one alignment that starts at station 100."""
    units = f'<Units><{unit} linearUnit="{linear}"/></Units>'
    inside = f'<Alignment name="main" staStart="100"><CoordGeom>{geometry}</CoordGeom>{cant}'
    return (
        f'<?xml version="1.0"?>\n<LandXML xmlns="{NAMESPACE}">\n{units}\n'
        f"<Alignments>\n{inside}\n</Alignment></Alignments></LandXML>"
    ).encode()


def of_pieces(*pieces: tuple[float, float]) -> Alignment:
    """Alignment of arcs and straight pieces: length and radius (left above 0, 0 straight)."""
    stretches = [Stretch(a, *2 * (1.0 / b if b else 0.0,)) for a, b in pieces]
    return Alignment("", tuple(stretches), np.zeros((0, 2)), ())


def gpx(
    alignment: Alignment,
    speeds: list[float],
    noise: float = 0.0,
    seed: int = 0,
    backwards: bool = False,
) -> bytes:
    """A run per speed (m/s), a place a second; noise in m (independent, each coordinate)."""
    random = np.random.default_rng(seed)
    place, points = plan(alignment, 0.2)
    text = ['<gpx xmlns="http://www.topografix.com/GPX/1/1"><trk>']
    for day, speed in enumerate(speeds):
        at = np.arange(0.0, alignment.length, speed)
        at = alignment.length - at if backwards else at
        track = np.column_stack([np.interp(at, place, points[:, k]) for k in range(2)])
        track += noise * random.standard_normal(track.shape)
        east = LONGITUDE + np.degrees(track[:, 0] / ACROSS / np.cos(np.radians(LATITUDE)))
        north = LATITUDE + np.degrees(track[:, 1] / MERIDIAN)
        begin = datetime(2026, 5, 4, tzinfo=UTC) + timedelta(days=day)
        text.append("<trkseg>")
        for second, (lon, lat) in enumerate(zip(east, north, strict=True)):
            time = (begin + timedelta(seconds=second)).isoformat()
            text.append(f'<trkpt lat="{lat:.9f}" lon="{lon:.9f}"><time>{time}</time></trkpt>')
        text.append("</trkseg>")
    return "\n".join([*text, "</trk></gpx>"]).encode()
