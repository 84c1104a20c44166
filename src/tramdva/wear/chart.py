"""KTH wear of one wheel passage: the wear chart of Jendel and Archard's law per cell.

A point of the wheel that crosses the patch slides ``|s| dx`` in every cell of length dx (``|s|``:
slip velocity over rolling speed) and loses the depth (Archard)::

    dz = k(p, v) p |s| dx / H,      v = |s| V,

with the Hertzian pressure p, hardness H and the wear coefficient k of the chart (Jendel, Wear
253, 2002). Depths are per passage, that is per revolution for a point of the wheel.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

REGIONS = ("mild", "severe", "mild_fast", "seizure")
CHART, SMOOTHED, CONSTANT = 0, 1, 2
METHODS = {"chart": CHART, "smoothed": SMOOTHED, "constant": CONSTANT}
PARAMETER_COUNT = 13


@dataclass(frozen=True)
class WearChart:
    """Wear coefficients and limits of the KTH chart.

    Attributes
    ----------
    hardness : Pa, of the softer body
    coefficient_mild, coefficient_severe, coefficient_mild_fast, coefficient_seizure :
        dimensionless k of the four regions
    velocity_low, velocity_high : m/s, limits of the severe region
    pressure_share : seizure above this share of the hardness
    velocity_width, pressure_width_share : half-width of the smoothed steps, m/s and share of H
    coefficient_constant : dimensionless, for the method 'constant'
    method : 'chart', 'smoothed' or 'constant'
    """

    hardness: float = 2.7e9  # ASSUME: wheel steel, 2.6 to 3.0 GPa
    coefficient_mild: float = 5e-4  # ASSUME: middle of 1-10e-4, chart of Jendel
    coefficient_severe: float = 35e-4  # ASSUME: middle of 30-40e-4
    coefficient_mild_fast: float = 5e-4  # ASSUME: middle of 1-10e-4
    coefficient_seizure: float = 350e-4  # ASSUME: middle of 300-400e-4
    velocity_low: float = 0.2
    velocity_high: float = 0.7
    pressure_share: float = 0.8
    velocity_width: float = 0.05  # ASSUME: the chart gives sharp steps
    pressure_width_share: float = 0.05  # ASSUME: the chart gives sharp steps
    coefficient_constant: float = 5e-4  # ASSUME: the mild coefficient
    method: str = "chart"

    def __post_init__(self):
        if self.method not in METHODS:
            raise ValueError(f"wear method '{self.method}' is unknown; allowed: {list(METHODS)}")
        for name, value in self.__dict__.items():
            if name != "method" and not (np.isfinite(value) and value > 0.0):
                raise ValueError(f"wear chart: {name} = {value} must be finite and positive")
        if self.velocity_low + self.velocity_width > self.velocity_high - self.velocity_width:
            raise ValueError("wear chart: velocity_low and velocity_high are too close together")

    def as_array(self) -> np.ndarray:
        """Plain numbers for the compiled functions, SI, in the order of the attributes."""
        numbers = [value for name, value in self.__dict__.items() if name != "method"]
        return np.array([*numbers, float(METHODS[self.method]), 0.0])


@njit(cache=True, nogil=True, error_model="numpy")
def wear_region(pressure, slip_velocity, chart):
    """Index into REGIONS for pressure in Pa and slip velocity in m/s."""
    if pressure > chart[7] * chart[0]:
        return 3
    if slip_velocity < chart[5]:
        return 0
    return 1 if slip_velocity <= chart[6] else 2


@njit(cache=True, nogil=True, error_model="numpy")
def _step(x, width):
    """Smooth step from 0 at -width to 1 at +width with continuous slope."""
    t = min(max(0.5 * (x / width + 1.0), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _ramp(x):
    return 0.5 * x * x if x > 0.0 else 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def _share_above(excess, along, across):
    """Share of a cell in which a linear field lies above a limit.

    Parameters
    ----------
    excess : of the cell's middle over the limit
    along, across : change of the field over the cell in both directions, absolute values
    """
    wide, narrow = max(along, across), min(along, across)
    if wide <= 0.0:
        return 1.0 if excess > 0.0 else 0.0
    if narrow < 1e-6 * wide:
        return min(max(excess / wide + 0.5, 0.0), 1.0)
    outer, inner = 0.5 * (wide + narrow), 0.5 * (wide - narrow)
    total = _ramp(excess + outer) - _ramp(excess + inner) - _ramp(excess - inner)
    return min((total + _ramp(excess - outer)) / (wide * narrow), 1.0)


@njit(cache=True, nogil=True, error_model="numpy")
def wear_coefficient(
    pressure, slip_velocity, chart, pressure_change=(0.0, 0.0), slip_change=(0.0, 0.0)
):
    """Dimensionless wear coefficient k of a cell.

    Parameters
    ----------
    pressure : Pa; slip_velocity : m/s
    chart : from `WearChart.as_array`
    pressure_change, slip_change : change of both over the cell along and across the patch, not
        negative. The chart's steps are averaged over the cell, exactly where the field is linear:
        the wear of a patch then has no stairs.
    """
    method = int(chart[11])
    if method == CONSTANT:
        return chart[10]
    if method == CHART:
        # Shares below the limit, so that the limit itself counts as severe.
        low = 1.0 - _share_above(chart[5] - slip_velocity, slip_change[0], slip_change[1])
        high = _share_above(slip_velocity - chart[6], slip_change[0], slip_change[1])
        excess = pressure - chart[7] * chart[0]
        seizure = _share_above(excess, pressure_change[0], pressure_change[1])
    else:
        low = _step(slip_velocity - chart[5], chart[8])
        high = _step(slip_velocity - chart[6], chart[8])
        seizure = _step(pressure / chart[0] - chart[7], chart[9])
    k = chart[1] + low * (chart[2] - chart[1]) + high * (chart[3] - chart[2])
    return k + seizure * (chart[4] - k)
