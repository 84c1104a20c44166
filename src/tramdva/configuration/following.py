"""What follows from a line's file without standing in it, and what contradicts itself there.

The paper's line gives everything. Another line gives what differs; of the rest some values follow
from what it gives, so that the tram computed is the tram described:

* gauge, speed and axle load, in people's units (section `tram`), become positions, speed and mass
  of the car;
* the route is the line's own curve to either side between straight track;
* the ranges of the maps over speed and radius are the paper's shares of the line's own values;
* the basic model of figures 2 to 7 is derived from the bogie (stage `basic_model`), value by value,
  where the file does not give the value;
* the band for which absorbers are designed, and the bands of the peaks, are those of the modes that
  are found (the same stage), where the file does not give them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

from tramdva.configuration.everyday import Tram
from tramdva.configuration.line import Line

# Values of the basic model that are derived from the bogie where a line does not give them.
BASIC_MODEL = (
    *(f"curve.{name}" for name in ("r_C", "gamma", "outer_speed")),
    *(f"creep_force.{name}" for name in ("F_N", "a", "b", "c_22")),
    *(f"wheelset.{name}" for name in ("m_A", "m_R", "c_A", "d_A", "c_R", "d_R")),
    *(f"absorber.{name}" for name in ("m_T", "c_T", "d_T")),
)
# Bands of frequencies that are put about the modes of the bogie where a line does not give them.
BANDS = ("study.tendency_maps.design_band", "study.evolution_tendency.peaks")
# Distances from the track centre that keep their distance from the wheel when the gauge differs.
BESIDE_THE_WHEEL = (
    "bogie.axle.half_length",
    "bogie.stub.lateral_position",
    "bogie.primary.lateral_position",
    "bogie.secondary.lateral_position",
    "bogie.absorber.lateral_position",
)
WHEEL_CENTRES = 0.065  # m, by which the wheels' centres are further apart than the rails' edges
# The maps of the paper's line over its own speed and radius: 2.5 to 6.5 m/s, 20 to 100 m.
SPEED_SHARES, RADIUS_SHARES = (0.625, 1.625), (0.8, 4.0)
SMALLEST_RADIUS, LARGEST_RADIUS, SLOWEST, FASTEST = 10.0, 5000.0, 0.5, 30.0
# Of a kilometre of a route that nobody told, in m: straight track, and the own curve to each side.
STRAIGHT, CURVE = 920.0, 40.0
INERTIAS = ("roll_inertia", "pitch_inertia", "yaw_inertia")
# How far both descriptions of a tram may differ: shares of the bogie's value.
SAME, SAME_LOAD = 0.02, 0.25


def derived(own: Mapping[str, Any]) -> tuple[str, ...]:
    """Keys that a line's file leaves to its bogie: of the basic model, and bands."""
    return tuple(key for key in (*BASIC_MODEL, *BANDS) if value_at(own, key) is None)


def value_at(tree: Any, path: str) -> Any:
    """Value at a dotted path, or None."""
    for key in path.split("."):
        if not isinstance(tree, Mapping) or key not in tree:
            return None
        tree = tree[key]
    return tree


def number_at(tree: Any, path: str) -> float | None:
    """Number at a dotted path; None where there is none, which the validation tells."""
    value = value_at(tree, path)
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if is_number and abs(value) < 1e12 else None


class Description:
    """A line's file over the paper's line, with what follows from it.

    own : what the file says, without its section `tram`; below : the paper's line
    follows : values that follow, as nested maps; problems : of the section `tram`, a line each
    """

    def __init__(self, own: Mapping[str, Any], below: Mapping[str, Any], tram: Tram):
        self.own, self.below, self.tram = own, below, tram
        self.follows: dict[str, Any] = {}
        self.problems: list[str] = []
        self._gauge()
        self._speed()
        self._load()
        self._rails()
        self._ranges()
        self._route()

    def _number(self, path: str) -> float | None:
        """Value of the line at a path: its own, else what follows, else the paper's."""
        found = (number_at(tree, path) for tree in (self.own, self.follows, self.below))
        return next((number for number in found if number is not None), None)

    def _follow(self, path: str, value: float) -> None:
        *parents, last = path.split(".")
        if value_at(self.own, path) is None:
            tree = self.follows
            for key in parents:
                tree = tree.setdefault(key, {})
            tree[last] = value

    def _refuse(self, key: str, path: str, value: float) -> bool:
        """Tell whether the file gives another value than one that follows from a key of `tram`."""
        given = number_at(self.own, path)
        differs = given is not None and abs(given - value) > 0.005 * abs(value)
        if differs:
            shown = f"{getattr(self.tram, key):g}"
            self.problems.append(
                f"tram.{key} = {shown} makes {path} = {value:.6g}, but {path} = {given:g} is given"
            )
        return differs

    def _gauge(self) -> None:
        centre = "bogie.wheel.half_distance"
        old = number_at(self.below, centre)
        if self.tram.gauge_mm is not None:
            half = 0.5 * (1e-3 * self.tram.gauge_mm + WHEEL_CENTRES)
            if self._refuse("gauge_mm", centre, half):
                return
            self._follow(centre, half)
        half = self._number(centre)
        if half is None or old is None or half == old:
            return
        for path in BESIDE_THE_WHEEL:
            if (position := number_at(self.below, path)) is not None:
                self._follow(path, round(position + half - old, 6))
        axle = BESIDE_THE_WHEEL[0]
        long, old_long = self._number(axle), number_at(self.below, axle)
        middle = number_at(self.below, "bogie.axle.middle_half_length")
        if None not in (long, old_long, middle):
            self._follow("bogie.axle.middle_half_length", round(middle * long / old_long, 6))
        self._follow("wheelset.L", 2.0 * half)

    def _speed(self) -> None:
        if self.tram.speed_km_h is not None:
            speed = self.tram.speed_km_h / 3.6
            if not self._refuse("speed_km_h", "track.speed", speed):
                self._follow("track.speed", speed)

    def _load(self) -> None:
        wanted, before = self.tram.bogie_mass, number_at(self.below, "bogie.car_body.mass")
        rest = bogie_mass(self._number)
        if wanted is None or rest is None or before is None:
            return
        key = "axle_load_t" if self.tram.axle_load_t is not None else "wheel_load_t"
        if wanted - rest < 1.0:
            self.problems.append(
                f"tram.{key} = {getattr(self.tram, key):g}: of {1e-3 * wanted:.3g} t on its wheels "
                f"the bogie alone has {1e-3 * rest:.3g} t: nothing is left for the car"
            )
        elif not self._refuse(key, "bogie.car_body.mass", wanted - rest):
            self._follow("bogie.car_body.mass", wanted - rest)
            for name in INERTIAS:
                if (inertia := number_at(self.below, f"bogie.car_body.{name}")) is not None:
                    self._follow(f"bogie.car_body.{name}", inertia * (wanted - rest) / before)

    def _rails(self) -> None:
        if self.tram.rail_inclination_1_to is not None:
            path, angle = "contact_geometry.rail.inclination", 1.0 / self.tram.rail_inclination_1_to
            if not self._refuse("rail_inclination_1_to", path, angle):
                self._follow(path, round(angle, 9))

    def _route(self) -> None:
        """Route of a line that tells none: its own curve to either side, and straight track."""
        route = self.own.get("route")
        if isinstance(route, Mapping) and (route.get("sections") or route.get("file")):
            return
        radius, speed = self._number("track.radius"), self._number("track.speed")
        half, cant = self._number("bogie.wheel.half_distance"), self._number("track.cant")
        if None in (radius, speed, half, cant):
            return
        common = {"speed_km_h": round(3.6 * speed, 6)}
        curve = {"radius_m": radius, "cant_mm": round(2e3 * half * cant, 6), **common}
        self.follows.setdefault("route", {})["sections"] = [
            {"name": "straight", "length_m": STRAIGHT, "turn": "straight", **common},
            {"name": "own curve left", "length_m": CURVE, "turn": "left", **curve},
            {"name": "own curve right", "length_m": CURVE, "turn": "right", **curve},
        ]

    def _ranges(self) -> None:
        """Ranges of the maps where the line runs otherwise than the paper's."""
        for name, shares, low, high in (
            ("speed", SPEED_SHARES, SLOWEST, FASTEST),
            ("radius", RADIUS_SHARES, SMALLEST_RADIUS, LARGEST_RADIUS),
        ):
            value = self._number(f"track.{name}")
            if value is None or value == number_at(self.below, f"track.{name}"):
                continue
            for end, share in zip(("min", "max"), shares, strict=True):
                path = f"study.tendency_maps.{name}.{end}"
                self._follow(path, round(min(max(share * value, low), high), 6))


def bogie_mass(number: Callable[[str], float | None]) -> float | None:
    """Mass in kg of a bogie without its car body and absorbers; `number` gives a path's value."""
    half, middle = number("bogie.axle.half_length"), number("bogie.axle.middle_half_length")
    per_length = [number(f"bogie.axle.{part}.mass_per_length") for part in ("middle", "outer")]
    wheel = [number(f"bogie.{part}.mass") for part in ("stub", "wheel.hub", "wheel.rim")]
    frame = number("bogie.frame.mass")
    if None in (half, middle, frame, *per_length, *wheel):
        return None
    axle = 2.0 * (middle * per_length[0] + (half - middle) * per_length[1])
    return frame + 2.0 * axle + 4.0 * sum(wheel)


def contradictions(own: Mapping[str, Any], line: Line) -> Iterator[str]:
    """Say where the basic model that a file gives is not that of the line's bogie and track.

    own : what the file says; line : with all its values
    """
    values = line.model_dump(mode="json")
    radius, half = line.track.radius, line.bogie.wheel.half_distance
    speed, car = line.track.speed, line.bogie.car_body.mass
    whole = car + (bogie_mass(partial(number_at, values)) or 0.0)
    outer, load = radius + half, 0.25 * line.track.gravity * whole
    for path, value, unit, share, why in (
        ("curve.r_C", outer, "m", SAME, f"track.radius = {radius:g} m"),
        ("curve.outer_speed", speed * outer / radius, "m/s", SAME, f"track.speed = {speed:g} m/s"),
        ("creep_force.F_N", load, "N", SAME_LOAD, f"bogie.car_body.mass = {car:.5g} kg"),
        ("wheelset.L", 2.0 * half, "m", SAME, f"bogie.wheel.half_distance = {half:g} m"),
    ):
        given = number_at(own, path)
        if given is not None and abs(given - value) > share * abs(value):
            yield (
                f"{path} = {given:g} {unit}, but {why} makes it {value:.4g} {unit}: "
                f"give one of them, or both alike"
            )
