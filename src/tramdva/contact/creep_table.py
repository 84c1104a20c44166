"""Creep forces of the half-space out of a table: nearly exact, and as fast as `fastsim`.

The table holds force over mu N and moment over mu N sqrt(a b) of steady rolling as a tensor of
uniform cubic B-splines over

* ln(a/b) between -ln 16 and ln 16; beyond, the curves keep the shape of the end, to
  LARGEST_RATIO with the errors of `docs/contact.md`; further `holds_for` says no,
* 2/pi atan(w_s / 1.5), how much spin there is,
* ``2/pi atan(w / |(1.5, w_s)|)``, how much creepage beside it; 1 is full sliding,
* ``atan2(|w_x|, w_y) / pi``, its direction

with w_x = C11 X, w_y = C22 Y, ``w = |(w_x, w_y)|``,
``w_s = |(C11 sqrt(b/a), C22 sqrt(a/b))| |Z| / 2`` and the reduced creepages X, Y, Z of `rolling`:
every creepage from none to infinite has a place. The other signs follow by symmetry, smoothly.
`benchmarks/creep_force_table.py` makes the table for Poisson's ratio 0.28; another one enters by
C11 and C22, in proportion to Kalker's table.

Axes, signs and units as in `fastsim`.
"""

import functools
import hashlib
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numba import njit

from tramdva.contact import kalker
from tramdva.contact.interpolation import hermite, locate, sample_spline

FILE = Path(__file__).with_name("creep_table.npz")
# With this digest of the numbers the table is part of the code, also for who hashes the code.
DIGEST = "74f848cc4a0074d41da8"
POISSON_RATIO = 0.28
LOG_RATIO_END = float(np.log(16.0))
LARGEST_RATIO = 32.0  # of the semi-axes, either way
SCALE = 1.5  # reduced creepage in the middle of its coordinate
COMPONENTS = 4  # two forces, the moment, and a zero that fills a vector register
FAST = {"contract", "reassoc", "nsz", "arcp"}


class CreepTable(NamedTuple):
    """Arrays that `half_space_forces` reads; built by `creep_table`.

    coefficients : (ratios, spins, creepages, directions, COMPONENTS) of the B-splines, two more
        than nodes on every axis

    linear : as `kalker.kalker_table`, 1/C11 and 1/C22 of this theory and their slopes
    """

    coefficients: np.ndarray
    linear: np.ndarray


class TableFileError(Exception):
    """The file of the table is not the one that this version of the code knows."""


def creep_table(poisson_ratio: float = POISSON_RATIO, file: Path = FILE) -> CreepTable:
    """Read the table.

    Parameters
    ----------
    poisson_ratio : of both bodies; exact for 0.28, see `docs/contact.md` for others
    file : made by `benchmarks/creep_force_table.py`

    Raises
    ------
    TableFileError
        If the numbers are not those of `DIGEST`.
    """
    coefficients, inverse = stored_numbers(file)
    return CreepTable(coefficients, linear_table(inverse, poisson_ratio))


def with_linear(linear: np.ndarray) -> CreepTable:
    """Table with the linear theory of another one: the file alone is read."""
    return CreepTable(stored_numbers(FILE)[0], linear)


@functools.cache
def stored_numbers(file: Path) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients, padded, and 1/C11 and 1/C22 of the file; nobody may write to them.

    Raises
    ------
    TableFileError
        If the numbers are not those of `DIGEST`.
    """
    with np.load(file) as stored:
        coefficients, inverse = stored["coefficients"], stored["inverse_linear"]
    if (found := digest(coefficients, inverse)) != DIGEST:
        raise TableFileError(f"{file.name} has the digest {found}, expected {DIGEST}")
    padded = np.zeros((*coefficients.shape[:4], COMPONENTS))
    padded[..., :3] = coefficients
    return padded, inverse


def digest(coefficients: np.ndarray, inverse_linear: np.ndarray) -> str:
    """Digest of the numbers of a table, 20 hexadecimal digits."""
    both = coefficients.tobytes() + inverse_linear.tobytes()
    return hashlib.sha256(both).hexdigest()[:20]


def linear_table(inverse: np.ndarray, poisson_ratio: float) -> np.ndarray:
    """Table of 1/C11 and 1/C22 over all ratios of semi-axes.

    Parameters
    ----------
    inverse : (n, 2) 1/C11 and 1/C22 at n equal steps of ln(a/b) over the range of the table, for
        POISSON_RATIO
    poisson_ratio : the dependence on it is that of Kalker's table, as is that on the ratio outside
        the range
    """
    wanted, made = (kalker.kalker_table(ratio) for ratio in (poisson_ratio, POISSON_RATIO))
    inside = np.linspace(-LOG_RATIO_END, LOG_RATIO_END, len(inverse))
    outside = np.linspace(LOG_RATIO_END, kalker.LOG_RATIO_LIMIT, 8)[1:]
    values = [
        inverse[i] * (inverse_kalker(wanted, log) / inverse_kalker(made, log))
        for i, log in enumerate(inside)
    ]
    low, high = (
        [end * inverse_kalker(wanted, log) / inverse_kalker(wanted, at) for log in logs]
        for end, at, logs in (
            (values[0], inside[0], -outside[::-1]),
            (values[-1], inside[-1], outside),
        )
    )
    return sample_spline(
        np.concatenate([-outside[::-1], inside, outside]),
        np.array([*low, *values, *high]),
        -kalker.LOG_RATIO_LIMIT, kalker.LOG_RATIO_STEP, kalker.LOG_RATIO_COUNT,
    )  # fmt: skip


def inverse_kalker(table: np.ndarray, log_ratio: float) -> np.ndarray:
    """1/C11 and 1/C22 of a table of `kalker` at ln(a/b)."""
    return 1.0 / np.array(kalker.creep_coefficients(table, float(np.exp(log_ratio)))[:2])


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def holds_for(semi_axis_longitudinal, semi_axis_lateral):
    """Whether the ratio of semi-axes is one for which the errors of the table are known."""
    a, b = semi_axis_longitudinal, semi_axis_lateral
    return a <= LARGEST_RATIO * b and b <= LARGEST_RATIO * a


@njit(cache=True, nogil=True, error_model="numpy")
def spin_scale(c11, c22, semi_axis_ratio):
    """Factor of the reduced spin that makes it comparable with C11 X and C22 Y."""
    return 0.5 * np.sqrt(c11 * c11 / semi_axis_ratio + c22 * c22 * semi_axis_ratio)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _place(position, size):
    """First coefficient at `position` in [0, 1], and the four weights.

    Beyond the ends as at the end; what is not a number stays so.
    """
    last = size - 3
    t, index = position * last, 0
    if t >= last:
        t, index = 1.0, last - 1
    elif t > 0.0:
        index = int(t)
        t -= index
    elif t <= 0.0:
        t = 0.0
    s, tt = 1.0 - t, t * t
    first, fourth = s * s * s / 6.0, tt * t / 6.0
    second = 0.5 * tt * t - tt + 2.0 / 3.0
    return index, (first, second, 1.0 - first - second - fourth, fourth)


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def _contract(coefficients, ratio, spin, creep, direction):
    """Sum of the 256 coefficients around a place with their weights: three components."""
    along = along_2 = along_3 = along_4 = 0.0
    start = direction[0]
    w0, w1, w2, w3 = direction[1]
    for i in range(4):
        for j in range(4):
            weight_ij = ratio[1][i] * spin[1][j]
            for k in range(4):
                weight = weight_ij * creep[1][k]
                row = coefficients[ratio[0] + i, spin[0] + j, creep[0] + k]
                p, q, r, s = row[start], row[start + 1], row[start + 2], row[start + 3]
                along += weight * (w0 * p[0] + w1 * q[0] + w2 * r[0] + w3 * s[0])
                along_2 += weight * (w0 * p[1] + w1 * q[1] + w2 * r[1] + w3 * s[1])
                along_3 += weight * (w0 * p[2] + w1 * q[2] + w2 * r[2] + w3 * s[2])
                along_4 += weight * (w0 * p[3] + w1 * q[3] + w2 * r[3] + w3 * s[3])
    return along, along_2, along_3, along_4


@njit(cache=True, nogil=True, error_model="numpy")
def half_space_forces(
    semi_axis_longitudinal,
    semi_axis_lateral,
    normal_force,
    friction_coefficient,
    longitudinal_creepage,
    lateral_creepage,
    spin_creepage,
    shear_modulus,
    table,
):
    """Creep forces and spin moment on the wheel.

    Parameters
    ----------
    semi_axis_longitudinal, semi_axis_lateral : m
    normal_force : N
    friction_coefficient : one value for the patch
    longitudinal_creepage, lateral_creepage : dimensionless
    spin_creepage : 1/m
    shear_modulus : Pa
    table : CreepTable

    Returns
    -------
    longitudinal_force in N, lateral_force in N, spin_moment in N m.
    """
    a, b = semi_axis_longitudinal, semi_axis_lateral
    limit = friction_coefficient * normal_force
    if normal_force <= 0.0 or friction_coefficient <= 0.0:
        return 0.0, 0.0, 0.0
    log_ratio = np.log(a / b)
    index, fraction = locate(
        table.linear, -kalker.LOG_RATIO_LIMIT, kalker.LOG_RATIO_STEP, log_ratio
    )
    c11, c22 = (
        1.0 / hermite(table.linear, index, fraction, 0),
        1.0 / hermite(table.linear, index, fraction, 1),
    )
    mean = np.sqrt(a * b)
    scale = shear_modulus * mean * mean / limit
    # Mirrored so that the spin is positive: lateral force and moment change sign with it.
    side = 1.0 if spin_creepage >= 0.0 else -1.0
    w_x = abs(c11 * scale * longitudinal_creepage)
    w_y = side * c22 * scale * lateral_creepage
    w_s = side * spin_scale(c11, c22, a / b) * scale * mean * spin_creepage
    creep = np.sqrt(w_x * w_x + w_y * w_y)
    beside = np.sqrt(SCALE * SCALE + w_s * w_s)
    shape = table.coefficients.shape
    force_x, force_y, moment, _ = _contract(
        table.coefficients,
        _place(0.5 + 0.5 * log_ratio / LOG_RATIO_END, shape[0]),
        _place(2.0 / np.pi * np.arctan(w_s / SCALE), shape[1]),
        _place(2.0 / np.pi * np.arctan(creep / beside), shape[2]),
        _place(np.arctan2(w_x, w_y) / np.pi, shape[3]),
    )
    forward = 1.0 if longitudinal_creepage >= 0.0 else -1.0
    return forward * limit * force_x, side * limit * force_y, side * limit * mean * moment
