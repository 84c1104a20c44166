"""How much of an absorber's effect a scatter of the speed leaves, in one curve.

The growth of an order is averaged over the speeds, with the waves of the wheels in phase as in
figure 10 or with each wheel by itself.
"""

import numpy as np

from tramdva.bogie.names import WHEELS
from tramdva.evolution.tendency import excitation_frequency, linear_wear_response
from tramdva.route.response import ClassRun, own_wear


def own_growth(run: ClassRun, design: str, orders: np.ndarray) -> np.ndarray:
    """Growth (4, o) per revolution of the wheels by their own waves, mean of the speeds."""
    return -(own_wear(run, design, orders, [1.0])[0].real @ run.points.weight)


def in_phase_growth(
    run: ClassRun, design: str, orders: np.ndarray, wheels: tuple[str, ...], wheel_radius: float
) -> np.ndarray:
    """Growth (4, o) per revolution with waves in phase on some wheels, mean of the speeds.

    Parameters
    ----------
    run : ClassRun; design : name of the absorber
    orders : (o,); wheels : names of the wheels out of round; wheel_radius : m
    """
    between, speeds = run.points.between(), run.speed
    total = np.zeros((len(WHEELS), orders.size))
    for k, node in enumerate(run.nodes):
        if node.status[design] != "converged":
            return np.full_like(total, np.nan)
        beside = np.flatnonzero(between[:, k] > 0.0)
        speed = float(speeds[run.points.node[k]])
        frequency = excitation_frequency(orders[:, None], speeds[None, beside], wheel_radius)
        (wear,) = node.wear[design]
        answer = linear_wear_response(
            node.bogie[design], wear, frequency.ravel(), speed, wheel_radius, wheels
        ).reshape(*frequency.shape, len(WHEELS))
        share = run.points.weight[beside] * between[beside, k]
        total -= np.einsum("opw,p->wo", answer.real, share)
    return total
