"""Plan of a route: where its sections lie, from their lengths and radii."""

from collections.abc import Sequence

import numpy as np

from tramdva.route.parameters import RouteSection

STEP = 5.0  # m
SIGN = {"left": 1.0, "right": -1.0, "straight": 0.0}


def plan(sections: Sequence[RouteSection]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points of the way there, which begins at the origin along x.

    Parameters
    ----------
    sections : in their order; transitions are clothoids outside of the length of a curve

    Returns
    -------
    x, y : (k,) m; section : (k,) number of the section of each point
    """
    lengths, curvatures, number = [], [], []
    for place, section in enumerate(sections):
        full = SIGN[section.turn] / (section.radius_m or np.inf)
        ramp = section.transition_m if full else 0.0
        for length, at in (
            (ramp, lambda u, k=full: k * u),
            (section.length_m, lambda u, k=full: k + 0.0 * u),
            (ramp, lambda u, k=full: k * (1.0 - u)),
        ):
            count = int(np.ceil(length / STEP))
            if count:
                middle = (np.arange(count) + 0.5) / count
                lengths += [length / count] * count
                curvatures += list(at(middle))
                number += [place] * count
    step, curvature = np.array(lengths), np.array(curvatures)
    end = np.cumsum(step * curvature)
    heading = end - 0.5 * step * curvature
    # The chord of a step with constant curvature is shorter than its arc.
    chord = step * np.sinc(0.5 * step * curvature / np.pi)
    x, y = np.cumsum(chord * np.cos(heading)), np.cumsum(chord * np.sin(heading))
    return np.append(0.0, x), np.append(0.0, y), np.append(number[:1], number)
