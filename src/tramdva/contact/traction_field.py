"""Traction and slip of every cell of the patch, for wear and for pictures.

The same march as `fastsim.fastsim_forces`, with results kept per interval of every strip: n nodes
make n + 1 intervals, the first from the leading edge to the first node, the last to the trailing
edge. Dissipated power equals force times creepage exactly: slip is scaled by one factor per patch
(one under pure creepage; the three flexibilities make it 0.78 .. 1.02 under spin), tractions by
another that replaces the trapezoidal by the Gaussian sum (1 + O(n^-2)). See `docs/contact.md`.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.contact.fastsim import PatchGrid


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


def empty_field(grid: PatchGrid) -> TractionField:
    """Arrays for `traction_field`, to be reused from call to call."""
    shape = (grid.step.size, grid.offset.size)
    return TractionField(*(np.zeros(shape) for _ in TractionField._fields))


@njit(cache=True, nogil=True, error_model="numpy")
def _fill_geometry(a, b, peak_pressure, grid, field):
    for k in range(grid.step.size):
        for j in range(grid.offset.size):
            half = a * grid.half_length[j]
            field.position_x[k, j] = grid.middle[k] * half
            field.position_y[k, j] = grid.offset[j] * b
            field.length_x[k, j] = grid.step[k] * half
            field.area[k, j] = grid.step[k] * half * b * grid.strip_weight[j]
            field.pressure[k, j] = peak_pressure * grid.half_length[j] * grid.pressure_along[k]


@njit(cache=True, nogil=True, error_model="numpy")
def _march_strip(j, a, b, scale, creepages, flexibility, grid, field):
    """Tractions and unscaled slip of strip j; returns its force and moment integrals."""
    nu_x, nu_y, phi = creepages
    half, y = a * grid.half_length[j], b * grid.offset[j]
    rate_x = nu_x / flexibility[0] - phi * y / flexibility[2]
    rate_y, rate_spin = nu_y / flexibility[1], phi / flexibility[2]
    limit = scale * grid.bound_across[j]
    qx = qy = force_x = force_y = moment = 0.0
    for k in range(grid.step.size):
        length = grid.step[k] * half
        trial_x = qx - length * rate_x
        trial_y = qy - length * (rate_y + rate_spin * grid.middle[k] * half)
        capacity = grid.bound_along[k] * limit
        trial = np.sqrt(trial_x * trial_x + trial_y * trial_y)
        factor = capacity / trial if trial > capacity else 1.0
        new_x, new_y = trial_x * factor, trial_y * factor
        field.traction_x[k, j] = 0.5 * (qx + new_x)
        field.traction_y[k, j] = 0.5 * (qy + new_y)
        field.slip_x[k, j] = flexibility[0] * (new_x - trial_x) / length
        field.slip_y[k, j] = flexibility[1] * (new_y - trial_y) / length
        qx, qy = new_x, new_y
        if k < grid.node.size:
            area = grid.weight[k] * half * b * grid.strip_weight[j]
            force_x += area * qx
            force_y += area * qy
            moment += area * (grid.node[k] * half * qy - y * qx)
    return force_x, force_y, moment


@njit(cache=True, nogil=True, error_model="numpy")
def _dissipation(field):
    """Integral of -traction times slip over the patch, N (power over rolling speed)."""
    total = 0.0
    for k in range(field.area.shape[0]):
        for j in range(field.area.shape[1]):
            work = field.traction_x[k, j] * field.slip_x[k, j]
            work += field.traction_y[k, j] * field.slip_y[k, j]
            total -= field.area[k, j] * work
    return total


@njit(cache=True, nogil=True, error_model="numpy")
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
    _fill_geometry(0.0, 0.0, 0.0, grid, field)
    for k in range(field.area.shape[0]):
        for j in range(field.area.shape[1]):
            field.slip_x[k, j] = 0.0
            field.slip_y[k, j] = 0.0
            field.traction_x[k, j] = 0.0
            field.traction_y[k, j] = 0.0


@njit(cache=True, nogil=True, error_model="numpy")
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
    if normal_force <= 0.0 or friction_coefficient <= 0.0:
        _clear(grid, field)
        return 0.0, 0.0, 0.0, 0.0
    _fill_geometry(a, b, 1.5 * normal_force / (np.pi * a * b), grid, field)
    creepages = (longitudinal_creepage, lateral_creepage, spin_creepage)
    scale = friction_coefficient * normal_force / (a * b)
    force_x = force_y = moment = 0.0
    for j in range(grid.offset.size):
        fx, fy, mz = _march_strip(j, a, b, scale, creepages, flexibility, grid, field)
        force_x += fx
        force_y += fy
        moment += mz
    cell_work = _cell_work(field, creepages)
    dissipated = _dissipation(field)
    if dissipated <= 0.0 or cell_work <= 0.0:
        return force_x, force_y, moment, 0.0
    slip_factor = cell_work / dissipated
    work = -(force_x * creepages[0] + force_y * creepages[1] + moment * creepages[2])
    _scale(slip_factor, work / cell_work, field)
    return force_x, force_y, moment, slip_factor
