"""Wear laws brought to the wear that was measured.

No wear coefficient is known better than to a factor of ten, and the whole route sees rain, leaves
and grease. The mean loss of radius is measured in every workshop: growth follows from the law's
growth per mean wear times that.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tramdva.route.classes import OWN_WHEELS, Case
from tramdva.route.parameters import MeasuredWear
from tramdva.route.response import ClassRun, mean_depth

PER_1000_KM = 1e6  # m
METRES = 1e-4  # per 1000 km, of mm per 10 000 km


class Scales(NamedTuple):
    """Factors (laws,) on the wear: of the tread, and of the flange over that."""

    tread: np.ndarray
    flange: np.ndarray


def revolutions(run: ClassRun, case: Case) -> np.ndarray:
    """Revolutions (speeds, wheels) of the own wheels in 1000 km of the route."""
    per_metre = run.spin() / (2.0 * np.pi * run.speed[:, None])
    share = case.share * run.points.weight[:, None]
    return PER_1000_KM * share * per_metre[:, case.places]


def depths(run: ClassRun, case: Case, laws: int) -> np.ndarray:
    """Wear depth (laws, surfaces, own wheels, speeds) in m per revolution by the laws alone."""
    return np.array([mean_depth(run, law)[:, case.places] for law in range(laws)])


def scales(
    runs: Sequence[ClassRun], cases: Sequence[Case], laws: int, measured: MeasuredWear
) -> Scales:
    """Measured wear over that of each law.

    The mean of the wheels counts: over the life of a tram they change places. NaN where a class of
    the route has no steady running.
    """
    of_law = sum(
        np.einsum("pw,lswp->ls", revolutions(runs[one.running], one),
                  depths(runs[one.running], one, laws))
        for one in cases
    ) / len(OWN_WHEELS)  # fmt: skip
    tread = METRES * measured.tread_mm_per_10000_km / of_law[:, 0]
    if measured.flange_mm_per_10000_km is None:
        return Scales(tread, np.ones_like(tread))
    return Scales(tread, METRES * measured.flange_mm_per_10000_km / of_law[:, 1] / tread)
