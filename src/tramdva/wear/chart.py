"""KTH wear of one wheel passage: the wear chart of Jendel and Archard's law per cell.

The chart as it is, with smooth steps, or one coefficient: `laws` has all laws of wear.

A point of the wheel that crosses the patch slides ``|s| dx`` in every cell of length dx (``|s|``:
slip velocity over rolling speed) and loses the depth (Archard)::

    dz = k(p, v) p |s| dx / H,      v = |s| V,

with the Hertzian pressure p, hardness H and the wear coefficient k of the chart (Jendel, Wear
253, 2002). Depths are per passage, that is per revolution for a point of the wheel.

Kernels compile for numbers and for complex ones that carry a derivative (`complex_step`).
"""

from collections import namedtuple

from numba import njit

from tramdva.contact.complex_step import quotient
from tramdva.wear.parameters import Wear

REGIONS = ("mild", "severe", "mild_fast", "seizure")
CHART, SMOOTHED, CONSTANT, ENERGY = 0, 1, 2, 3
METHODS = {"chart": CHART, "smoothed": SMOOTHED, "constant": CONSTANT, "energy": ENERGY}

# The parameters of wear by name, as the compiled functions take them; method: of `METHODS`.
WearChart = namedtuple("WearChart", Wear.model_fields)


def wear_chart(parameters: Wear) -> WearChart:
    """Parameters of wear for the compiled functions, SI units."""
    return WearChart(**parameters.model_dump() | {"method": METHODS[parameters.method]})


@njit(cache=True, nogil=True, error_model="numpy")
def wear_region(pressure, slip_velocity, chart):
    """Index into REGIONS for pressure in Pa and slip velocity in m/s."""
    if pressure > chart.pressure_share * chart.hardness:
        return 3
    if slip_velocity < chart.velocity_low:
        return 0
    return 1 if slip_velocity <= chart.velocity_high else 2


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _clipped(x):
    x = x if x.real > 0.0 else 0.0 * x
    return x if x.real < 1.0 else 1.0 + 0.0 * x


@njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def _step(x, width):
    """Smooth step from 0 at -width to 1 at +width with continuous slope."""
    t = _clipped(0.5 * (quotient(x, width) + 1.0))
    return t * t * (3.0 - 2.0 * t)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _ramp(x):
    return 0.5 * x * x if x.real > 0.0 else 0.0 * x


@njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def _share_above(excess, along, across):
    """Share of a cell in which a linear field lies above a limit.

    Parameters
    ----------
    excess : of the cell's middle over the limit
    along, across : change of the field over the cell in both directions, absolute values
    """
    first = along.real >= across.real
    wide, narrow = (along, across) if first else (across, along)
    if 2.0 * abs(excess.real) >= (wide + narrow).real:  # the limit does not cut the cell
        return 1.0 if excess.real > 0.0 else 0.0
    if narrow.real < 1e-6 * wide.real:
        return _clipped(quotient(excess, wide) + 0.5)
    outer, inner = 0.5 * (wide + narrow), 0.5 * (wide - narrow)
    total = _ramp(excess + outer) - _ramp(excess + inner) - _ramp(excess - inner)
    share = quotient(total + _ramp(excess - outer), wide * narrow)
    return share if share.real < 1.0 else 1.0


@njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def wear_coefficient(
    pressure, slip_velocity, chart, pressure_change=(0.0, 0.0), slip_change=(0.0, 0.0)
):
    """Dimensionless wear coefficient k of a cell by the chart, smoothed or not, or constant.

    Parameters
    ----------
    pressure : Pa; slip_velocity : m/s
    chart : WearChart
    pressure_change, slip_change : change of both over the cell along and across the patch, not
        negative. The chart's steps are averaged over the cell, exactly where the field is linear:
        the wear of a patch then has no stairs.
    """
    method = chart.method
    if method == CONSTANT:
        return chart.coefficient_constant
    if method == CHART:
        # Shares below the limit, so that the limit itself counts as severe.
        low = 1.0 - _share_above(chart.velocity_low - slip_velocity, slip_change[0], slip_change[1])
        high = _share_above(slip_velocity - chart.velocity_high, slip_change[0], slip_change[1])
        excess = pressure - chart.pressure_share * chart.hardness
        seizure = _share_above(excess, pressure_change[0], pressure_change[1])
    else:
        low = _step(slip_velocity - chart.velocity_low, chart.velocity_width)
        high = _step(slip_velocity - chart.velocity_high, chart.velocity_width)
        seizure = _step(
            quotient(pressure, chart.hardness) - chart.pressure_share, chart.pressure_width_share
        )
    k = (
        chart.coefficient_mild
        + low * (chart.coefficient_severe - chart.coefficient_mild)
        + high * (chart.coefficient_mild_fast - chart.coefficient_severe)
    )
    return k + seizure * (chart.coefficient_seizure - k)
