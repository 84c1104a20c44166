"""Wear of a wheel from the history of its contacts: KTH wear cell by cell, at the wheel's angle."""

from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.contact import kalker, traction_field
from tramdva.contact.fastsim import PatchGrid
from tramdva.wear import REGIONS, WearChart, archard_depth, region_areas

AREAS = (*REGIONS, "adhesion")


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
    depth = np.empty(grid.offset.size)
    for i in range(area.size):
        a, b, normal = history[0, i], history[1, i], history[2, i]
        if not normal > 0.0:
            continue
        flexibility = kalker.flexibilities(kalker_table, a, b, shear_modulus)
        traction_field.traction_field(
            a, b, normal, history[3, i], history[4, i], history[5, i], history[6, i],
            flexibility, grid, field,
        )  # fmt: skip
        area[i] = archard_depth(field, rolling_speed, chart, depth)
        region_areas(field, rolling_speed, chart, shares[i])
        shares[i] /= shares[i].sum()


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
        chart.as_array(), out,
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
    orders = 2.0 / area.size * (np.exp(-1j * np.outer(np.arange(count), angle)) @ area)
    orders[0] *= 0.5
    return orders


def depth_around(orders: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Value at wheel angles (rad) of a function of which the orders 0, 1, 2, ... are given."""
    return (np.exp(1j * np.outer(angle, np.arange(orders.size))) @ orders).real
