"""Which mode of a vehicle is the second bending, found by its shape.

The class of the largest strain energy names a mode, but not for ever: in a curve so sharp that the
outer wheel touches with its flank as well, the second bending bends the layer of that wheel more
than the axle. Its shape tells it apart still: an axle in antisymmetric bending carries both rims
the same way across the track, and they roll with it.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bogie.curving import System
from tramdva.bogie.modes import Modes
from tramdva.bogie.names import AXLE_OF_WHEEL, AXLES, WHEELS

# Lateral and vertical motion and roll times 0.3 m of outer rim, inner rim and middle of the axle
# bridge in the second bending of the paper's front and rear axle; the largest is 1.
SECOND_BENDING = {
    "front": np.array([-0.32, -0.735, 1.0, 0.02, 0.03, 0.49, 0.59, -0.03, -0.53]),
    "rear": np.array([-0.06, -0.04, 0.65, -0.31, 0.54, 1.0, 0.71, -0.01, -0.73]),
}
ARM = 0.3  # m, at which a roll counts as a motion
# Modes whose shapes correlate less are others: of the paper's line in curves of 18 to 100 m the
# second bending of the front axle keeps 0.80 to 1.00.
ALIKE = 0.75


class Tracked(NamedTuple):
    """A mode and how much it is like the reference.

    index : in `Modes`; axle : whose; likeness : 0 to 1, modal assurance criterion
    """

    index: int
    axle: str
    likeness: float


def shape_of_axle(system: System, axle: str, shape: np.ndarray) -> np.ndarray:
    """Motion (9, modes) of both rims and the middle of an axle in modes of shape (k, modes)."""
    vehicle, k = system.vehicle, system.size
    rims = [f"{w}_rim" for w, a in zip(WHEELS, AXLE_OF_WHEEL, strict=True) if AXLES[a] == axle]
    rows = [vehicle.motion_of[body][[1, 2, 3], :k] for body in (*rims, f"{axle}_axle")]
    scale = np.tile([1.0, 1.0, ARM], 3)
    return scale[:, None] * (np.vstack(rows) @ shape)


def likeness(reference: np.ndarray, shapes: np.ndarray) -> np.ndarray:
    """Modal assurance criterion (modes,) of shapes (9, modes) with a reference (9,)."""
    overlap = np.abs(reference.conj() @ shapes) ** 2
    return overlap / (np.sum(np.abs(reference) ** 2) * np.sum(np.abs(shapes) ** 2, axis=0))


def second_bending(system: System, found: Modes) -> list[Tracked]:
    """Second bending of the front and of the rear axle among modes; without those that have none.

    Each axle's is the mode most like the paper's that moves this axle more than the other.
    """
    tracked = []
    motion = {axle: shape_of_axle(system, axle, found.shape) for axle in AXLES}
    size = {axle: np.sum(np.abs(part) ** 2, axis=0) for axle, part in motion.items()}
    for axle, other in (AXLES, AXLES[::-1]):
        alike = np.where(
            size[axle] > size[other], likeness(SECOND_BENDING[axle], motion[axle]), 0.0
        )
        best = int(np.argmax(alike)) if alike.size else -1
        if best >= 0 and alike[best] >= ALIKE:
            tracked.append(Tracked(best, axle, float(alike[best])))
    return tracked
