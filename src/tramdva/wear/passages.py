"""Wear of a wheel by the passages of its contact: cell by cell, at the angle of the wheel."""

from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.contact import kalker, traction_field
from tramdva.contact.complex_step import quotient, root
from tramdva.contact.fastsim import PatchGrid
from tramdva.wear.chart import CHART, ENERGY, REGIONS, WearChart, wear_coefficient, wear_region
from tramdva.wear.energy import energy_wear_rate

AREAS = (*REGIONS, "adhesion")
ADHESION = len(REGIONS)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _size(x):
    return x if x.real >= 0.0 else -x


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _changes(values, k, j, strips):
    """Change of a field (along, strips) over a cell along and across the patch, in one cell."""
    before, behind = max(k - 1, 0), min(k + 1, values.shape[0] - 1)
    left, right = max(j - 1, 0), min(j + 1, strips - 1)
    along = quotient(_size(values[behind, j] - values[before, j]), float(behind - before))
    return along, quotient(_size(values[k, right] - values[k, left]), float(right - left))


@njit(cache=True, nogil=True, error_model="numpy")
def _real_strips(field):
    """Number of strips but for the padding, which comes last; kernels see one type of it."""
    strips = 0
    for j in range(field.area.shape[1]):
        strips += int(field.area[0, j].real > 0.0)
    return strips


@njit(cache=True, nogil=True, error_model="numpy")
def _slip_of_cells(field, strips, slip):
    for k in range(slip.shape[0]):
        for j in range(strips):
            squared = field.slip_x[k, j] * field.slip_x[k, j]
            squared += field.slip_y[k, j] * field.slip_y[k, j]
            slip[k, j] = root(squared) if squared.real > 0.0 else 0.0 * squared


@njit(cache=True, nogil=True, error_model="numpy")
def _areas_of_regions(field, slip, strips, speed, chart, areas):
    for k in range(slip.shape[0]):
        for j in range(strips):
            region = ADHESION
            if slip[k, j] != 0.0:
                region = wear_region(field.pressure[k, j].real, speed * slip[k, j].real, chart)
            areas[region] += field.area[k, j].real


@njit(cache=True, nogil=True, error_model="numpy")
def _depth_by_coefficient(field, slip, strips, speed, chart, strip_depth):
    """Archard's law with the coefficient of the chart, smoothed or not, or a constant one."""
    worn_area, none = 0.0, 0.0 * slip[0, 0]
    sharp = chart.method == CHART
    pressure_change = slip_change = (none, none)
    for k in range(slip.shape[0]):
        for j in range(strips):
            if slip[k, j] == 0.0:
                continue
            pressure, velocity = field.pressure[k, j], speed * slip[k, j]
            if sharp:
                pressure_change = _changes(field.pressure, k, j, strips)
                along, across = _changes(slip, k, j, strips)
                slip_change = speed * along, speed * across
            coefficient = wear_coefficient(pressure, velocity, chart, pressure_change, slip_change)
            worn = coefficient * pressure * slip[k, j] * field.length_x[k, j]
            depth = quotient(worn, chart.hardness)
            strip_depth[j] += depth
            worn_area += quotient(depth * field.area[k, j], field.length_x[k, j])
    return worn_area


@njit(cache=True, nogil=True, error_model="numpy")
def _depth_by_energy(field, strips, chart, strip_depth):
    worn_area = 0.0
    for k in range(field.area.shape[0]):
        for j in range(strips):
            work = field.traction_x[k, j] * field.slip_x[k, j]
            work += field.traction_y[k, j] * field.slip_y[k, j]
            rate = energy_wear_rate(-work, chart)
            strip_depth[j] += rate * field.length_x[k, j]
            worn_area += rate * field.area[k, j]
    return worn_area


@njit(cache=True, nogil=True, error_model="numpy")
def passage_depth(field, rolling_speed, chart, slip, strip_depth, areas):
    """Wear depth of every strip for one passage of the patch, and where it comes from.

    Parameters
    ----------
    field : TractionField of the patch
    rolling_speed : m/s
    chart : WearChart
    slip : (intervals, strips) array to work in
    strip_depth : (strips,) array, receives the depth in m
    areas : (5,) array, receives the area in m^2 of the cells of each of `AREAS`: of the chart's
        regions by any law

    Returns
    -------
    worn_area : cross-section of removed material in m^2 (depth integrated across the patch;
        times 2 pi R the volume of one revolution).
    """
    strip_depth[:] = 0.0
    areas[:] = 0.0
    strips, speed = _real_strips(field), abs(rolling_speed)
    _slip_of_cells(field, strips, slip)
    _areas_of_regions(field, slip, strips, speed, chart, areas)
    if chart.method == ENERGY:
        return _depth_by_energy(field, strips, chart, strip_depth)
    return _depth_by_coefficient(field, slip, strips, speed, chart, strip_depth)


class ContactHistory(NamedTuple):
    """What wear needs of one contact, arrays (k,) over time in SI; zero normal force: apart."""

    semi_axis_longitudinal: np.ndarray
    semi_axis_lateral: np.ndarray
    normal_force: np.ndarray
    friction: np.ndarray
    longitudinal_creepage: np.ndarray
    lateral_creepage: np.ndarray
    spin_creepage: np.ndarray


class Passages(NamedTuple):
    """Wear of the passages in a history.

    area : (k,) m^2, cross-section worn away
    shares : (k, 5) of the patch in the regions of the chart and in adhesion; zero when apart
    """

    area: np.ndarray
    shares: np.ndarray


@njit(cache=True, nogil=True, error_model="numpy")
def _passages(history, kalker_table, shear_modulus, grid, field, rolling_speed, chart, out):
    area, shares = out
    depth, slip = np.empty(grid.offset.size), np.empty(field.area.shape)
    for i in range(area.size):
        a, b, normal = history[0, i], history[1, i], history[2, i]
        if not normal > 0.0:
            continue
        flexibility = kalker.flexibilities(kalker_table, a, b, shear_modulus)
        traction_field.traction_field(
            a, b, normal, history[3, i], history[4, i], history[5, i], history[6, i],
            flexibility, grid, field,
        )  # fmt: skip
        area[i] = passage_depth(field, rolling_speed, chart, slip, depth, shares[i])
        total = shares[i].sum()
        for j in range(shares.shape[1]):  # an assignment of arrays compiles seconds of messages
            shares[i, j] /= total


def passages(
    history: ContactHistory,
    kalker_table: np.ndarray,
    shear_modulus: float,
    grid: PatchGrid,
    rolling_speed: float,
    chart: WearChart,
) -> Passages:
    """Wear of each moment of a history, as if the patch were passed in that state.

    Parameters
    ----------
    history : ContactHistory
    kalker_table : of `kalker`; shear_modulus : Pa
    grid : PatchGrid, cells of the patch
    rolling_speed : m/s
    chart : WearChart
    """
    values = np.array([np.asarray(column, float) for column in history])
    count = values.shape[1]
    out = np.zeros(count), np.zeros((count, len(AREAS)))
    field = traction_field.empty_field(grid)
    _passages(
        values, kalker_table, shear_modulus, grid, field, float(rolling_speed),
        chart, out,
    )  # fmt: skip
    return Passages(*out)


def wear_orders(area: np.ndarray, angle: np.ndarray, count: int) -> np.ndarray:
    """Orders 0 .. count - 1 of the worn cross-section around the wheel, mean of the revolutions.

    Parameters
    ----------
    area : (k,) m^2 per passage, at equal steps of time over whole revolutions
    angle : (k,) rad, material point in contact
    count : orders

    Returns
    -------
    (count,) complex, such that the cross-section is Re sum W_n exp(i n angle).

    Notes
    -----
    In a time dt the patch takes area V dt, whatever material points are in it: where the contact
    moves ahead it spreads this over a longer stretch. The integral of the cross-section times
    exp(-i n angle) over the angle is therefore that of area exp(-i n angle) over time.
    """
    orders = 2.0 / area.size * _fourier_sums(area, np.exp(-1j * angle), count)
    orders[0] *= 0.5
    return orders


@njit(cache=True, nogil=True, error_model="numpy")
def _fourier_sums(area, turn, count):
    """Sums (count,) of area turn^n, powers by multiplication: they err by n times the rounding."""
    sums = np.zeros(count, np.complex128)
    for k in range(area.size):
        term = complex(area[k], 0.0)
        for n in range(count):
            sums[n] += term
            term *= turn[k]
    return sums


def depth_around(orders: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Value at wheel angles (rad) of a function of which the orders 0, 1, 2, ... are given."""
    return (np.exp(1j * np.outer(angle, np.arange(orders.size))) @ orders).real
