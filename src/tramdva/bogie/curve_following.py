"""The way of the vehicle from the straight track into its curve, as a branch of equilibria.

Continuation in the share of curvature and cant: a secant predicts, Newton's method corrects. The
first stretch, on which the flanges first reach the rails, belongs to `curving.equilibrium`, which
needs no start nearby but ten times as long.
"""

import logging

import numpy as np

from tramdva.bogie.curving import Equilibrium, System, corrected, equilibrium

logger = logging.getLogger(__name__)

FIRST_CURVATURE = 1.0 / 300.0  # 1/m
HALVINGS = 6  # of the first stretch
SHORTEST_STEP, LARGEST_STEP = 2.0**-12, 0.25  # share of the curve's curvature


def on_the_way(straight: System, curve: System, share: float) -> System:
    """Vehicle on a track with a share of the curve's curvature and cant.

    Curvatures and loads of the frames are linear in the curvature and cant of the track.
    """
    return straight._replace(
        curvatures=(1.0 - share) * straight.curvatures + share * curve.curvatures,
        load=(1.0 - share) * straight.load + share * curve.load,
    )


def enter_curve(
    straight: System, curve: System, start: np.ndarray, tolerance: float = 1e-9
) -> Equilibrium:
    """Equilibrium in the curve, followed from that on the straight track.

    Parameters
    ----------
    straight, curve : the same vehicle on both tracks
    start : (2 n - 4,) state of the equilibrium on the straight track
    tolerance : as in `curving.equilibrium`

    Returns
    -------
    Equilibrium in the curve. Where the branch cannot be followed to its end, the state at which a
    search from the last one that was found stops, with the status that tells why.
    """
    curvature = float(np.abs(curve.curvatures - straight.curvatures).max())
    if curvature <= FIRST_CURVATURE:
        return equilibrium(curve, start, tolerance)
    first = FIRST_CURVATURE / curvature
    found = _first_stretch(straight, curve, start, first)
    if found is None:
        return equilibrium(curve, start, tolerance)
    known, share, state, step = None, first, found.state, 0.5 * first
    while share < 1.0:
        target = min(1.0, share + step)
        guess = state
        if known is not None:
            guess = state + (state - known[1]) * ((target - share) / (share - known[0]))
        found = corrected(on_the_way(straight, curve, target), guess, tolerance)
        if found is not None:
            known, share, state = (share, state), target, found.state
            step = min(1.5 * step, LARGEST_STEP)
            continue
        step *= 0.5
        if step < SHORTEST_STEP:
            logger.info("equilibrium lost at %.3f of the curvature", share)
            return equilibrium(curve, state, tolerance)
    return found


def _first_stretch(
    straight: System, curve: System, start: np.ndarray, share: float, halvings: int = HALVINGS
) -> Equilibrium | None:
    """Equilibrium at a first share of the curve, by way of smaller ones if needed."""
    system = on_the_way(straight, curve, share)
    found = equilibrium(system, start, 1e-3, 150)
    if found.status == "converged":
        return found
    if halvings == 0:
        return None
    nearer = _first_stretch(straight, curve, start, 0.5 * share, halvings - 1)
    if nearer is None:
        return None
    found = equilibrium(system, nearer.state, 1e-3, 150)
    return found if found.status == "converged" else None
