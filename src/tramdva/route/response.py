"""Wear responses of the vehicle in a class of running conditions.

One equilibrium, linearisation and wear at each of a few speeds; between them the response at a
frequency is linear in the speed. The frequency of an order follows the wheel's own rate of turning
exactly.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from tramdva.bogie.curving import Equilibrium, System, equilibrium, near, resting_start
from tramdva.bogie.names import WHEELS
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.revolutions import hindrance
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.bogie.tram import BogieLine, run_through, systems, transferred
from tramdva.contact import patch
from tramdva.evolution.tendency import Wearing, WearSensitivity, wear_sensitivity
from tramdva.route.classes import RunningClass
from tramdva.route.own_response import OwnResponse, own_response, spins
from tramdva.route.speeds import SpeedPoints, intervals, narrowest, speed_points

SURFACES = ("tread", "flange")
FLANGE_ANGLE = 0.35  # rad, contact angles beyond which a contact wears the flange or its root
Designs = Mapping[str, BogieAbsorber | None]  # by name; `none` is the vehicle without absorbers


class Running(NamedTuple):
    """The vehicle without absorbers in steady running on a track."""

    line: BogieLine
    system: System
    equilibrium: Equilibrium


class Node(NamedTuple):
    """The vehicle in a class at one speed.

    bogie : RoughBogie of each design that has an equilibrium
    status : of each design: that of its equilibrium, or ``self_excited``
    wear : of each law, by design (empty without an equilibrium)
    flange : (4, zones), contacts of the flange
    spin : (4,) rad/s
    """

    bogie: dict[str, RoughBogie]
    status: dict[str, str]
    wear: dict[str, list[WearSensitivity]]
    flange: np.ndarray
    spin: np.ndarray


class ClassRun(NamedTuple):
    """The vehicle in a class at its speeds."""

    running: RunningClass
    points: SpeedPoints
    nodes: list[Node]

    @property
    def speed(self) -> np.ndarray:
        """Speeds (p,) of the points in m/s."""
        return self.running.speed * self.points.share

    def spin(self) -> np.ndarray:
        """Rates of turning (p, 4) in rad/s of the wheels at the points."""
        at = self.running.speed * self.points.share[self.points.node]
        per_metre = np.array([node.spin for node in self.nodes]) / at[:, None]
        return self.speed[:, None] * (self.points.between() @ per_metre)

    def status(self, design: str) -> list[str]:
        """Status of a design at the points: the first hindrance of the speeds beside it."""
        near_by = self.points.between() > 0.0
        of_node = [node.status[design] for node in self.nodes]
        hindered = [
            [of_node[k] for k in np.flatnonzero(row) if of_node[k] != "converged"]
            for row in near_by
        ]
        return [found[0] if found else "converged" for found in hindered]


def on_track(line: BogieLine, running: RunningClass, speed: float) -> BogieLine:
    """Line in the conditions of a class at a speed in m/s; the radius counts in curves only."""
    width = 2.0 * line.bogie.wheel.half_distance
    update = {"speed": speed, "cant": running.cant / width, "transition_length": 0.0}
    if running.curvature > 0.0:
        update["radius"] = 1.0 / running.curvature
    mu_0, ratio, decrease = line.friction
    if np.isfinite(running.friction):
        mu_0 = running.friction
    return line._replace(
        track=line.track.model_copy(update=update), friction=(mu_0, ratio, decrease)
    )


def _share(running: RunningClass) -> float:
    return 1.0 if running.curvature > 0.0 else 0.0


def steady(line: BogieLine, running: RunningClass) -> Running:
    """Steady running of the vehicle without absorbers at the mean speed of a class."""
    own = on_track(line, running, running.speed)
    if running.curvature > 0.0:
        run = run_through(own)
        return Running(own, run.curve, run.equilibrium)
    (straight,) = systems(own, None, (0.0,))
    return Running(own, straight, equilibrium(straight, resting_start(straight)))


def at_speed(known: Running, running: RunningClass, speed: float) -> Running:
    """Steady running at another speed (m/s), from a known one nearby."""
    own = on_track(known.line, running, speed)
    (system,) = systems(own, None, (_share(running),))
    start = transferred(known.system, known.equilibrium, system)
    return Running(own, system, near(system, start))


def with_absorbers(known: Running, running: RunningClass, design: BogieAbsorber) -> Running:
    """Steady running with absorbers, from that without."""
    (system,) = systems(known.line, design, (_share(running),))
    start = transferred(known.system, known.equilibrium, system)
    return known._replace(system=system, equilibrium=near(system, start))


def _node(run: Running, running: RunningClass, designs: Designs, laws: Sequence[Wearing]) -> Node:
    """Bogies with every design, and the wear of each law.

    An absorber that only turns does not load the wheels: its wear is that of the bare vehicle.
    """
    bogies, status, wear = {}, {}, {}
    for name in sorted(designs, key=lambda name: designs[name] is not None):
        design = designs[name]
        own = run if design is None else with_absorbers(run, running, design)
        status[name] = own.equilibrium.status
        if status[name] != "converged":
            continue
        bogies[name] = rough_bogie(own.system, own.equilibrium)
        status[name] = hindrance(bogies[name], converged=True) or "converged"
        if design is None or design.motion == "translation" or "none" not in wear:
            law_of_contact = run.system.contacts.law
            wear[name] = [wear_sensitivity(bogies[name], law_of_contact, law) for law in laws]
        else:
            wear[name] = wear["none"]
    angle = np.abs(run.equilibrium.results[..., patch.CONTACT_ANGLE])
    touching = run.equilibrium.results[..., patch.STATUS] == patch.CONTACT
    spin = spins(run.system, run.equilibrium.state)
    return Node(bogies, status, wear, touching & (angle > FLANGE_ANGLE), spin)


class Middle(NamedTuple):
    """The vehicle in a class at its mean speed.

    width : of the narrowest mode with any design, from `speeds.narrowest`
    """

    running: RunningClass
    known: Running
    node: Node
    width: float


def at_mean_speed(
    line: BogieLine, running: RunningClass, designs: Designs, laws: Sequence[Wearing]
) -> Middle:
    """Compute the vehicle in a class at its mean speed.

    Parameters
    ----------
    line : BogieLine, as configured
    running : RunningClass
    designs : absorbers by name, ``none`` among them
    laws : of wear; their wheels are all four
    """
    known = steady(line, running)
    node = _node(known, running, designs, laws)
    width = min((narrowest(bogie.eigenvalue) for bogie in node.bogie.values()), default=1.0)
    return Middle(running, known, node, width)


def over_speeds(
    middle: Middle, points: SpeedPoints, designs: Designs, laws: Sequence[Wearing]
) -> ClassRun:
    """Compute the vehicle in a class at the speeds over its scatter, from the mean outwards."""
    running, count = middle.running, points.node.size
    nodes = {count // 2: middle.node}
    for way in (range(count // 2 + 1, count), range(count // 2 - 1, -1, -1)):
        known = middle.known
        for k in way:
            speed = running.speed * float(points.share[points.node[k]])
            found = at_speed(known, running, speed)
            nodes[k] = _node(found, running, designs, laws)
            known = found if found.equilibrium.status == "converged" else known
    return ClassRun(running, points, [nodes[k] for k in sorted(nodes)])


def run_classes(
    line: BogieLine,
    classes: Sequence[RunningClass],
    designs: Designs,
    laws: Sequence[Wearing],
    most_points: int,
) -> list[ClassRun]:
    """Compute the vehicle in all classes, each at the same number of speeds.

    Parameters
    ----------
    line, designs, laws : as in `at_mean_speed`
    classes : of the route
    most_points : of speed
    """
    middles = [at_mean_speed(line, one, designs, laws) for one in classes]
    steps = max(intervals(one.running.scatter, one.width, most_points) for one in middles)
    return [
        over_speeds(one, speed_points(one.running.scatter, steps), designs, laws) for one in middles
    ]


def mean_depth(run: ClassRun, law: int) -> np.ndarray:
    """Wear depth (2, 4, p) in m per revolution of `SURFACES` of each wheel, no absorber."""
    depth = np.full((len(run.nodes), len(SURFACES), len(WHEELS)), np.nan)
    for k, node in enumerate(run.nodes):
        if "none" in node.wear:
            wear = node.wear["none"][law]
            share = wear.area / np.where(wear.width > 0.0, wear.width, 1.0)[:, None]
            lubricated = run.running.flange_wear_share
            depth[k, 0] = np.where(node.flange, 0.0, share).sum(axis=1)
            depth[k, 1] = lubricated * np.where(node.flange, share, 0.0).sum(axis=1)
    return np.einsum("pk,ksw->swp", run.points.between(), depth)


def own_wear(
    run: ClassRun, design: str, orders: np.ndarray, flange_ratio: Sequence[float]
) -> np.ndarray:
    """Wear response (laws, 4, orders, p) per revolution of the wheels to their own waves.

    Parameters
    ----------
    run : ClassRun
    design : name of the absorber
    orders : (o,) waves around the wheel
    flange_ratio : of each law, by which flange contacts wear more than the law says

    Returns
    -------
    Complex, NaN at points beside a speed without a steady answer.
    """
    between, spin = run.points.between(), run.spin()
    laws = len(flange_ratio)
    out = np.zeros((laws, len(WHEELS), orders.size, run.points.share.size), complex)
    for k, node in enumerate(run.nodes):
        beside = between[:, k] > 0.0
        if node.status[design] != "converged":
            out[..., beside] = np.nan
            continue
        bogie = node.bogie[design]
        wears = of_surfaces(run.running, node, node.wear[design], flange_ratio)
        for wheel in range(len(WHEELS)):
            own: OwnResponse = own_response(bogie, wears, wheel, float(node.spin[wheel]))
            turn = orders[:, None] * spin[None, beside, wheel]
            answer = own.at(orders[:, None], turn)
            out[:, wheel, :, beside] += np.moveaxis(answer * between[beside, k], -1, 0)
    return out


def of_surfaces(
    running: RunningClass,
    node: Node,
    wears: Sequence[WearSensitivity],
    flange_ratio: Sequence[float],
) -> list[WearSensitivity]:
    """Wear of each law with flange contacts by their own measure; arguments as in `own_wear`."""
    found = []
    for wear, ratio in zip(wears, flange_ratio, strict=True):
        share = np.where(node.flange, ratio * running.flange_wear_share, 1.0)
        found.append(
            wear._replace(area=wear.area * share, gradient=wear.gradient * share[..., None])
        )
    return found
