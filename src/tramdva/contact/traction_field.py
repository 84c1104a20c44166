"""Traction and slip of every cell of the patch, for wear and for pictures.

The same march as `fastsim.fastsim_forces`, with results kept per interval of every strip: n nodes
make n + 1 intervals, the first from the leading edge to the first node, the last to the trailing
edge. Dissipated power equals force times creepage exactly: slip is scaled by one factor per patch
(one under pure creepage; the three flexibilities make it 0.78 .. 1.02 under spin), tractions by
another that replaces the trapezoidal by the Gaussian sum (1 + O(n^-2)). See `docs/contact.md`.

All of it compiles for numbers and for complex ones that carry a derivative (`complex_step`).
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.contact.complex_step import quotient, root
from tramdva.contact.fastsim import FAST, PatchGrid

SMALLEST = 1e-300  # keeps the last interval, where the bound is zero, from 0 / 0


class TractionField(NamedTuple):
    """Fields of one patch, arrays of shape (intervals along, strips), leading edge first.

    position_x, position_y in m, length_x in m (interval along rolling), area in m^2,
    traction_x, traction_y in Pa (on the wheel, mean of the interval), slip_x, slip_y
    (velocity of the wheel relative to the rail over rolling speed), pressure in Pa (Hertz).
    """

    position_x: np.ndarray
    position_y: np.ndarray
    length_x: np.ndarray
    area: np.ndarray
    traction_x: np.ndarray
    traction_y: np.ndarray
    slip_x: np.ndarray
    slip_y: np.ndarray
    pressure: np.ndarray


def empty_field(grid: PatchGrid, dtype: type = float) -> TractionField:
    """Arrays of float or complex for `traction_field`, to be reused from call to call."""
    shape = (grid.step.size, grid.offset.size)
    return TractionField(*(np.zeros(shape, dtype) for _ in TractionField._fields))


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def _fill_geometry(a, b, peak_pressure, grid, field):
    for k in range(grid.step.size):
        for j in range(grid.offset.size):
            half = a * grid.half_length[j]
            field.position_x[k, j] = grid.middle[k] * half
            field.position_y[k, j] = grid.offset[j] * b
            field.length_x[k, j] = grid.step[k] * half
            field.area[k, j] = grid.step[k] * half * b * grid.strip_weight[j]
            field.pressure[k, j] = peak_pressure * grid.half_length[j] * grid.pressure_along[k]


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def _march(a, b, scale, creepages, flexibility, grid, field, state):
    """Tractions and unscaled slip of all strips, side by side; integrals of force and moment.

    `state` (2, strips) holds the tractions at the last node, zero at the start.
    """
    nu_x, nu_y, phi = creepages
    flexibility_x, flexibility_y, flexibility_spin = flexibility
    rate_y, rate_spin = nu_y / flexibility_y, phi / flexibility_spin
    qx, qy = state[0], state[1]
    force_x = force_y = moment = 0.0
    for k in range(grid.step.size):
        step, middle, bound = grid.step[k], grid.middle[k], grid.bound_along[k]
        inside = k < grid.node.size
        weight = grid.weight[k] * a * b if inside else 0.0
        node = grid.node[k] * a if inside else 0.0
        traction_x, traction_y = field.traction_x[k], field.traction_y[k]
        slip_x, slip_y = field.slip_x[k], field.slip_y[k]
        for j in range(qx.size):
            half, y = a * grid.half_length[j], b * grid.offset[j]
            length = step * half
            trial_x = qx[j] - length * (nu_x / flexibility_x - y * rate_spin)
            trial_y = qy[j] - length * (rate_y + rate_spin * middle * half)
            capacity = bound * scale * grid.bound_across[j]
            squared, limit = trial_x * trial_x + trial_y * trial_y, capacity * capacity
            slides = squared.real > limit.real
            larger = squared if slides else limit
            larger = larger if larger.real > SMALLEST else larger + SMALLEST
            factor = quotient(capacity, root(larger)) if slides else 1.0 + 0.0 * capacity
            new_x, new_y = trial_x * factor, trial_y * factor
            traction_x[j] = 0.5 * (qx[j] + new_x)
            traction_y[j] = 0.5 * (qy[j] + new_y)
            slip_x[j] = quotient(flexibility_x * (new_x - trial_x), length)
            slip_y[j] = quotient(flexibility_y * (new_y - trial_y), length)
            qx[j] = new_x
            qy[j] = new_y
            area = weight * grid.half_length[j] * grid.strip_weight[j]
            force_x += area * new_x
            force_y += area * new_y
            moment += area * (node * grid.half_length[j] * new_y - y * new_x)
    return force_x, force_y, moment


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def _dissipation(field):
    """Integral of -traction times slip over the patch, N (power over rolling speed)."""
    total = 0.0
    for k in range(field.area.shape[0]):
        for j in range(field.area.shape[1]):
            work = field.traction_x[k, j] * field.slip_x[k, j]
            work += field.traction_y[k, j] * field.slip_y[k, j]
            total -= field.area[k, j] * work
    return total


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def _cell_work(field, creepages):
    """Integral of -traction times rigid slip over the patch, N."""
    nu_x, nu_y, phi = creepages
    total = 0.0
    for k in range(field.area.shape[0]):
        for j in range(field.area.shape[1]):
            work = field.traction_x[k, j] * (nu_x - phi * field.position_y[k, j])
            work += field.traction_y[k, j] * (nu_y + phi * field.position_x[k, j])
            total -= field.area[k, j] * work
    return total


@njit(cache=True, nogil=True, error_model="numpy")
def _clear(grid, field):
    zero = field.area.dtype.type(0.0)
    _fill_geometry(zero, zero, zero, grid, field)
    for k in range(field.area.shape[0]):
        for j in range(field.area.shape[1]):
            field.slip_x[k, j] = 0.0
            field.slip_y[k, j] = 0.0
            field.traction_x[k, j] = 0.0
            field.traction_y[k, j] = 0.0


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def _scale(slip_factor, traction_factor, field):
    for k in range(field.area.shape[0]):
        for j in range(field.area.shape[1]):
            field.slip_x[k, j] *= slip_factor
            field.slip_y[k, j] *= slip_factor
            field.traction_x[k, j] *= traction_factor
            field.traction_y[k, j] *= traction_factor


@njit(cache=True, nogil=True, error_model="numpy")
def traction_field(
    semi_axis_longitudinal,
    semi_axis_lateral,
    normal_force,
    friction_coefficient,
    longitudinal_creepage,
    lateral_creepage,
    spin_creepage,
    flexibility,
    grid,
    field,
):
    """Fill `field`; forces and moment as `fastsim_forces`, and the slip factor.

    Parameters
    ----------
    As in `fastsim.fastsim_forces`; `field` from `empty_field`.

    Returns
    -------
    longitudinal_force in N, lateral_force in N, spin_moment in N m, slip_factor (dimensionless;
    by how much the slip was scaled to dissipate the work of the tractions; 0 without slip).
    """
    a, b = semi_axis_longitudinal, semi_axis_lateral
    if normal_force.real <= 0.0 or friction_coefficient.real <= 0.0:
        _clear(grid, field)
        return 0.0, 0.0, 0.0, 0.0
    _fill_geometry(a, b, 1.5 * normal_force / (np.pi * a * b), grid, field)
    creepages = (longitudinal_creepage, lateral_creepage, spin_creepage)
    scale = friction_coefficient * normal_force / (a * b)
    state = np.zeros((2, grid.offset.size), field.area.dtype)
    force_x, force_y, moment = _march(a, b, scale, creepages, flexibility, grid, field, state)
    cell_work = _cell_work(field, creepages)
    dissipated = _dissipation(field)
    if dissipated.real <= 0.0 or cell_work.real <= 0.0:
        return force_x, force_y, moment, 0.0
    slip_factor = cell_work / dissipated
    work = -(force_x * creepages[0] + force_y * creepages[1] + moment * creepages[2])
    _scale(slip_factor, work / cell_work, field)
    return force_x, force_y, moment, slip_factor
