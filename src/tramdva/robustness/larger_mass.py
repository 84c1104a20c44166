"""The least mass of an absorber that can do it, where the configured one cannot.

Stiffness and damping of a heavier absorber are sought in ranges that grow in proportion: its own
frequencies and damping ratios are the same. Few masses are tried, each by a whole search. Weight
and inertia across the direction of an absorber that translates stay those of the configured one.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from tramdva.robustness.criterion import Criterion, Optimum, optimum

STEPS = (2.0, 4.0)  # times the configured mass; the first that can do it ends the way up
TRIED = len(STEPS) + 1  # the last is between that one and the one before


class Tried(NamedTuple):
    """A mass that was tried.

    inertia : kg m^2 or kg; best : of the robust search; nominal_factor : of its design
    is_enough : whether an absorber of this mass is of use
    """

    inertia: float
    best: Optimum
    nominal_factor: float
    is_enough: bool


def is_of_use(nominal: Criterion, robust: Criterion, best: Optimum, quiet: Sequence[int]) -> bool:
    """Whether a design calms the line as configured, leaves less, and disturbs nothing quiet.

    Parameters
    ----------
    nominal, robust : of the line as configured, and of all cases
    best : the design, and which cases count
    quiet : rows that do not vibrate by themselves without absorbers
    """
    if not np.isfinite(best.factor):
        return False
    if robust.self_excited(0, best.design, robust.corners[:1]):
        return False
    if nominal.grows and nominal.worst(best.design) >= 1.0:
        return False
    rows = [row for row in quiet if best.counted[row]]
    left = robust.factors(best.design)[rows]
    own = robust.corners[:1]
    return not (left >= 1.0).any() and not any(
        robust.self_excited(row, best.design, own) for row in rows
    )


def masses_tried(
    criteria: Callable[[float], tuple[Criterion, Criterion]],
    inertia: float,
    c_T: np.ndarray,
    d_T: np.ndarray,
    suspects: Sequence[int],
    quiet: Sequence[int],
) -> Iterator[Tried]:
    """Try heavier absorbers until one can do it, and one between.

    Parameters
    ----------
    criteria : nominal and robust criterion of an inertia
    inertia : as configured, which cannot do it
    c_T, d_T : (m,) ranges of the configured inertia
    suspects : rows that are self-excited without absorbers; quiet : those that are not

    Notes
    -----
    Each takes as long as the search with the configured one.
    """

    def tried(times: float) -> Tried:
        nominal, robust = criteria(times * inertia)
        best, _ = optimum(robust, times * c_T, times * d_T, suspects)
        robust = robust._replace(counted=best.counted)
        found = np.isfinite(best.factor) and nominal.grows
        alone = nominal.worst(best.design) if found else np.nan
        enough = is_of_use(nominal, robust, best, quiet)
        return Tried(times * inertia, best, alone, enough)

    before = 1.0
    for times in STEPS:
        found = tried(times)
        yield found
        if found.is_enough:
            yield tried(float(np.sqrt(before * times)))
            return
        before = times
