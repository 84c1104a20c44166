"""From the section ``route`` of the configuration to sections, classes and cases."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tramdva.route.classes import (
    Case,
    Passage,
    RunningClass,
    cases_of,
    classes_of,
    lap_length,
)
from tramdva.route.parameters import RouteSection
from tramdva.route.sections import read_sections


class Lap(NamedTuple):
    """A lap of the route.

    sections : of the way there; classes : that occur; passages : of the lap; length : m
    """

    sections: Sequence[RouteSection]
    classes: list[RunningClass]
    passages: list[Passage]
    length: float

    def cases(self) -> list[Case]:
        """Cases in the order in which they are met first."""
        return cases_of(self.passages)

    def shares(self, case: Case) -> list[float]:
        """Share of the lap's length that is run in a case, by section."""
        found = [0.0] * len(self.sections)
        for one in self.passages:
            if (one.running, one.turn, one.leading) == case[:3]:
                found[one.section] += one.length / self.length
        return found


def lap_of(cfg: Mapping[str, Any], file_of: Callable[[str], Any] = str) -> Lap:
    """Lap of the route of a line.

    Parameters
    ----------
    cfg : with the section ``route``
    file_of : where a file lies that the configuration names: a table of sections
    """
    route = cfg["route"]
    if route["file"]:
        sections = read_sections(file_of(route["file"]))
    else:
        sections = tuple(RouteSection.model_validate(one) for one in route["sections"])
    classes, passages = classes_of(sections, route["way"], route["ends"])
    return Lap(sections, classes, passages, lap_length(passages))


def route_orders(cfg: Mapping[str, Any]) -> np.ndarray:
    """Orders (o,) of the wheels, whole numbers, as ``numerics.orders`` says."""
    wanted = cfg["numerics"]["orders"]
    return np.arange(wanted["first"], wanted["last"] + 1, wanted["step"])


def case_name(case: Case, running: RunningClass) -> str:
    """Name of a case for readers."""
    where = "straight"
    if running.curvature > 0.0:
        where = f"{1.0 / running.curvature:g} m {case.turn}"
    cant = f", cant {1e3 * running.cant:g} mm" if running.cant else ""
    return f"{where}, {3.6 * running.speed:g} km/h{cant}, {case.leading} leads"
