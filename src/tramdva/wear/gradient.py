"""Derivative of the wear of a passage in all that the contact tells it, by the complex step.

Wear depends on the patch through the march over its strips, clipped tractions and the regimes of
its law: differences of it are either too coarse or catch a single cell at a step. Here the kernel
of the value runs with complex numbers: the imaginary part of its result is the exact derivative of
the discrete patch, averaged steps, scaled slip and Kalker's flexibilities included.
"""

import numpy as np
from numba import njit

from tramdva.contact import kalker, traction_field
from tramdva.contact.complex_step import STEP
from tramdva.contact.fastsim import PatchGrid
from tramdva.wear.chart import WearChart
from tramdva.wear.passages import AREAS, passage_depth


@njit(cache=True, nogil=True, error_model="numpy")
def _gradient(
    inputs, kalker_table, shear_modulus, grid, field, rolling_speed, chart, areas, gradient
):
    value = 0.0
    slip, depth = np.empty_like(field.area), np.empty(grid.offset.size, np.complex128)
    contact = np.empty(inputs.size, np.complex128)
    for i in range(inputs.size):
        for other in range(inputs.size):
            contact[other] = inputs[other]
        # In proportion to the value where that is not small: imaginary parts alike for all.
        step = STEP * max(abs(inputs[i]), 1e-3)
        contact[i] = complex(inputs[i], step)
        flexibility = kalker.complex_flexibilities(
            kalker_table, contact[0], contact[1], shear_modulus
        )
        traction_field.traction_field(
            contact[0], contact[1], contact[2], contact[3], contact[4], contact[5], contact[6],
            flexibility, grid, field,
        )  # fmt: skip
        area = passage_depth(field, rolling_speed, chart, slip, depth, areas)
        gradient[i] = area.imag / step
        value = area.real
    return value


def worn_area_gradient(
    inputs: np.ndarray,
    kalker_table: np.ndarray,
    shear_modulus: float,
    grid: PatchGrid,
    rolling_speed: float,
    chart: WearChart,
) -> tuple[float, np.ndarray]:
    """Worn area in m^2 of a passage and its derivatives (7,) in its inputs, SI.

    Parameters
    ----------
    inputs : (7,) as the fields of `wear.passages.ContactHistory`, SI
    kalker_table : of `kalker`; shear_modulus : Pa
    grid : PatchGrid, cells of the patch
    rolling_speed : m/s
    chart : WearChart
    """
    inputs = np.asarray(inputs, float)
    gradient = np.zeros(inputs.size)
    if not inputs[2] > 0.0:
        return 0.0, gradient
    field = traction_field.empty_field(grid, complex)
    value = _gradient(
        inputs, kalker_table, shear_modulus, grid, field, float(rolling_speed), chart,
        np.zeros(len(AREAS)), gradient,
    )  # fmt: skip
    return value, gradient
