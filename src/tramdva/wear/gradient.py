"""Derivative of the wear of a passage in all that the contact tells it, by the complex step.

Wear depends on the patch through the march over its strips, clipped tractions and the steps of
the chart: differences of it are either too coarse or catch a single cell at a step. Here the same
march (`contact.traction_field`, `wear.archard_depth`) is written a second time for complex
numbers: with an imaginary part of 1e-30 in one input the imaginary part of the result is the exact
derivative of the discrete patch, its averaged steps included.
"""

import numpy as np

from tramdva.contact import kalker
from tramdva.contact.fastsim import PatchGrid
from tramdva.wear.chart import CHART, CONSTANT, WearChart

_TINY = 1e-30


def worn_area(
    inputs: np.ndarray,
    flexibility: np.ndarray,
    grid: PatchGrid,
    rolling_speed: float,
    chart: WearChart,
) -> complex:
    """Cross-section of removed material in m^2 per passage; arguments may be complex.

    Parameters
    ----------
    inputs : (7,) as the fields of `wear.passages.ContactHistory`, SI
    flexibility : (3,) in m/Pa, from `kalker.flexibilities`
    grid : PatchGrid
    rolling_speed : m/s
    chart : WearChart
    """
    a, b, normal, friction, nu_x, nu_y, phi = inputs
    real = grid.strip_weight > 0.0
    offset, half_length = grid.offset[real], grid.half_length[real]
    y, half = b * offset, a * half_length
    limit = friction * normal / (a * b) * grid.bound_across[real]
    rate_x = nu_x / flexibility[0] - phi * y / flexibility[2]
    qx, qy = np.zeros((2, y.size), complex)
    rows = []
    for k, step in enumerate(grid.step):
        length, x = step * half, grid.middle[k] * half
        trial_x = qx - length * rate_x
        trial_y = qy - length * (nu_y / flexibility[1] + phi / flexibility[2] * x)
        capacity = grid.bound_along[k] * limit
        trial = np.sqrt(trial_x**2 + trial_y**2)
        slides = trial.real > capacity.real
        factor = np.where(slides, capacity / np.where(slides, trial, 1.0), 1.0)
        new_x, new_y = trial_x * factor, trial_y * factor
        slip_x = flexibility[0] * (new_x - trial_x) / length
        slip_y = flexibility[1] * (new_y - trial_y) / length
        area = step * half * b * grid.strip_weight[real]
        pressure = 1.5 * normal / (np.pi * a * b) * half_length * grid.pressure_along[k]
        rows.append((x, area, pressure, 0.5 * (qx + new_x), 0.5 * (qy + new_y), slip_x, slip_y))
        qx, qy = new_x, new_y
    x, area, pressure, p_x, p_y, s_x, s_y = (np.array(column) for column in zip(*rows, strict=True))
    cell_work = -np.sum(area * (p_x * (nu_x - phi * y) + p_y * (nu_y + phi * x)))
    dissipated = -np.sum(area * (p_x * s_x + p_y * s_y))
    if dissipated.real <= 0.0 or cell_work.real <= 0.0:
        return 0.0 + 0.0j
    slip = _root(s_x**2 + s_y**2) * cell_work / dissipated
    k = _coefficient(pressure, rolling_speed * slip, chart)
    return np.sum(k * pressure * slip * area) / chart.hardness


def _root(square: np.ndarray) -> np.ndarray:
    """Square root; zero, where a cell adheres, stays zero."""
    return np.where(square == 0.0, 0.0, np.sqrt(np.where(square == 0.0, 1.0, square)))


def _changes(values: np.ndarray) -> list[np.ndarray]:
    """Change of a field (along, strips) over each cell along and across the patch."""
    out = []
    for axis in range(2):
        count = values.shape[axis]
        low, high = np.maximum(np.arange(count) - 1, 0), np.minimum(np.arange(count) + 1, count - 1)
        change = np.take(values, high, axis) - np.take(values, low, axis)
        change /= (high - low)[:, None] if axis == 0 else high - low
        out.append(np.where(change.real < 0.0, -change, change))
    return out


def _ramp(x: np.ndarray) -> np.ndarray:
    return np.where(x.real > 0.0, 0.5 * x * x, 0.0)


def _share_above(excess: np.ndarray, changes: list[np.ndarray]) -> np.ndarray:
    """Share of each cell above a limit; see `wear`."""
    first_wider = changes[0].real >= changes[1].real
    wide = np.where(first_wider, changes[0], changes[1])
    narrow = np.where(first_wider, changes[1], changes[0])
    flat, strip = wide.real <= 0.0, narrow.real < 1e-6 * wide.real
    safe_wide, safe_narrow = np.where(flat, 1.0, wide), np.where(strip | flat, 1.0, narrow)
    outer, inner = 0.5 * (wide + narrow), 0.5 * (wide - narrow)
    total = _ramp(excess + outer) - _ramp(excess + inner) - _ramp(excess - inner)
    share = (total + _ramp(excess - outer)) / (safe_wide * safe_narrow)
    line = excess / safe_wide + 0.5
    share = np.where(strip, np.where(line.real < 0.0, 0.0, line), share)
    share = np.where(share.real > 1.0, 1.0, share)
    return np.where(flat, (excess.real > 0.0).astype(complex), share)


def _step(x: np.ndarray, width: float) -> np.ndarray:
    t = 0.5 * (x / width + 1.0)
    t = np.where(t.real < 0.0, 0.0, np.where(t.real > 1.0, 1.0, t))
    return t * t * (3.0 - 2.0 * t)


def _coefficient(pressure: np.ndarray, velocity: np.ndarray, chart: WearChart) -> np.ndarray:
    if chart.method == CONSTANT:
        return np.full(pressure.shape, chart.coefficient_constant, complex)
    if chart.method == CHART:
        changes = _changes(velocity)
        low = 1.0 - _share_above(chart.velocity_low - velocity, changes)
        high = _share_above(velocity - chart.velocity_high, changes)
        excess = pressure - chart.pressure_share * chart.hardness
        seizure = _share_above(excess, _changes(pressure))
    else:
        low = _step(velocity - chart.velocity_low, chart.velocity_width)
        high = _step(velocity - chart.velocity_high, chart.velocity_width)
        share = pressure / chart.hardness - chart.pressure_share
        seizure = _step(share, chart.pressure_width_share)
    k = chart.coefficient_mild + low * (chart.coefficient_severe - chart.coefficient_mild)
    k = k + high * (chart.coefficient_mild_fast - chart.coefficient_severe)
    return k + seizure * (chart.coefficient_seizure - k)


def worn_area_gradient(
    inputs: np.ndarray,
    kalker_table: np.ndarray,
    shear_modulus: float,
    grid: PatchGrid,
    rolling_speed: float,
    chart: WearChart,
) -> tuple[float, np.ndarray]:
    """Worn area in m^2 of a passage and its derivatives (7,) in its inputs, SI.

    Kalker's flexibilities follow the semi-axes: their derivatives are central differences of the
    interpolated table.
    """
    inputs = np.asarray(inputs, float)

    def flexibility(a: float, b: float) -> np.ndarray:
        return np.array(kalker.flexibilities(kalker_table, a, b, shear_modulus))

    value = flexibility(*inputs[:2])
    slope = np.zeros((inputs.size, 3))
    for i in range(2):
        change = np.zeros(2)
        change[i] = 1e-5 * inputs[i]
        up, down = flexibility(*(inputs[:2] + change)), flexibility(*(inputs[:2] - change))
        slope[i] = (up - down) / (2.0 * change[i])
    gradient = np.empty(inputs.size)
    for i in range(inputs.size):
        moved = inputs.astype(complex)
        moved[i] += 1j * _TINY
        area = worn_area(moved, value + 1j * _TINY * slope[i], grid, rolling_speed, chart)
        gradient[i] = area.imag / _TINY
    return float(worn_area(inputs + 0j, value + 0j, grid, rolling_speed, chart).real), gradient
