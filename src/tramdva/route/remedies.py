"""What an operator could change on a route, and the kilometres that it buys.

Each remedy changes sections of the route or the wheels; the vehicle is computed anew at the mean
speed of the conditions that are new, all others are kept. The scale of the wear stays that of the
route as it is: there it was measured.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from tramdva.bogie.conditions import Conditions, under
from tramdva.bogie.tram import BogieLine
from tramdva.evolution.tendency import Wearing
from tramdva.route.classes import Case, RunningClass
from tramdva.route.parameters import RouteSection
from tramdva.route.response import ClassRun, Middle, at_mean_speed, own_wear
from tramdva.route.scaling import Scales, revolutions
from tramdva.route.speeds import intervals, speed_points

LUBRICATED = 0.15  # of the dry wear of a flange; lubrication divides it by five to ten
SLOWER = 1.0  # km/h
MORE_SCATTER = 5.0  # per cent of the mean
SOFTER, HARDER = 0.7, 1.4  # stiffness of the wheels' rubber over the line's
SLOWEST = 1.8  # km/h


class Remedy(NamedTuple):
    """A change of the route or the wheels.

    kind : what is done; section : number of the section, or -1 for all
    sections : of the route with it; wheel_stiffness : over the line's
    """

    kind: str
    section: int
    sections: tuple[RouteSection, ...]
    wheel_stiffness: float = 1.0


def remedies(sections: Sequence[RouteSection], worst: Sequence[int]) -> list[Remedy]:
    """Remedies to try; in single sections those that make the wheels grow most.

    Parameters
    ----------
    sections : of the route
    worst : numbers of sections
    """
    found = []
    for place in worst:
        section = sections[place]
        if section.speed_km_h - SLOWER >= SLOWEST:
            slower = {"speed_km_h": section.speed_km_h - SLOWER}
            found.append(Remedy("slower", place, _changed(sections, place, slower)))
        if section.radius_m is not None and section.flange_wear_share > LUBRICATED:
            greased = {"flange_wear_share": LUBRICATED}
            found.append(Remedy("lubricated", place, _changed(sections, place, greased)))
    mixed = tuple(
        one.model_copy(
            update={"speed_scatter_percent": min(one.speed_scatter_percent + MORE_SCATTER, 20.0)}
        )
        for one in sections
    )
    found.append(Remedy("mixed_speeds", -1, mixed))
    found.append(Remedy("softer_wheels", -1, tuple(sections), SOFTER))
    found.append(Remedy("harder_wheels", -1, tuple(sections), HARDER))
    return found


def _changed(
    sections: Sequence[RouteSection], place: int, update: dict[str, float]
) -> tuple[RouteSection, ...]:
    return tuple(
        one.model_copy(update=update) if k == place else one for k, one in enumerate(sections)
    )


class Conditioned:
    """The vehicle in classes of running conditions, each computed once.

    line : BogieLine, as configured
    law : of wear, for all wheels
    most_points : of speed
    """

    def __init__(self, line: BogieLine, law: Wearing, most_points: int):
        self.line, self.law, self.most_points = line, law, most_points
        self._known: dict[tuple, Middle] = {}

    def middle(self, running: RunningClass, wheel_stiffness: float = 1.0) -> Middle:
        """Vehicle without absorbers at the mean speed of a class."""
        # Lubrication and scatter change no equilibrium.
        key = (*running[:3], repr(running.friction), wheel_stiffness)
        if key not in self._known:
            line = under(self.line, Conditions(wheel_stiffness=wheel_stiffness))
            self._known[key] = at_mean_speed(line, running, {"none": None}, [self.law])
        return self._known[key]._replace(running=running)

    def runs(self, classes: Sequence[RunningClass], wheel_stiffness: float) -> list[ClassRun]:
        """Classes over their scatter, by the vehicle at their mean speeds."""
        middles = [self.middle(one, wheel_stiffness) for one in classes]
        steps = max(intervals(one.running.scatter, one.width, self.most_points) for one in middles)
        return [
            ClassRun(
                one.running,
                speed_points(one.running.scatter, steps)._replace(node=np.array([steps // 2])),
                [one.node],
            )
            for one in middles
        ]


def growth(
    runs: Sequence[ClassRun], cases: Sequence[Case], orders: np.ndarray, scale: Scales
) -> np.ndarray:
    """Growth (wheels, orders) in 1000 km of the vehicle's wheels without absorbers.

    Parameters
    ----------
    runs : of the classes; cases : in which the vehicle meets them
    orders : (o,); scale : of one law

    Returns
    -------
    NaN where a class has no steady answer.
    """
    answers = [own_wear(run, "none", orders, scale.flange)[0].real for run in runs]
    total = np.zeros((4, orders.size))
    for case in cases:
        turned = revolutions(runs[case.running], case)
        total -= np.einsum("pw,wop->wo", turned, answers[case.running][case.places])
    return float(scale.tread[0]) * total


def worst_sections(
    sections: Sequence[RouteSection],
    of_sections: Callable[[int], np.ndarray],
    most: int,
) -> list[int]:
    """Numbers of the curves that add most to the fastest growing order of any wheel.

    Parameters
    ----------
    sections : of the route
    of_sections : growth (wheels, orders) by a section
    most : sections at most
    """
    parts = np.array([of_sections(k) for k in range(len(sections))])
    total = parts.sum(axis=0)
    wheel, order = np.unravel_index(int(np.argmax(total)), total.shape)
    by_section = parts[:, wheel, order]
    ranked = np.argsort(-by_section, kind="stable")[:most]
    return [int(k) for k in ranked if by_section[k] > 0.0]
