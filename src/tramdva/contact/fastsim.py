"""FASTSIM: tangential traction of an elliptic patch by Kalker's simplified theory.

Axes of the patch: right-handed, x along rolling, y lateral, third axis along the normal.
Creepages are velocities of the wheel relative to the rail over the rolling speed (spin: over
speed, 1/m, positive about the third axis); forces act on the wheel, opposite to the slip.

Differences from the textbook algorithm, derived in `docs/contact.md`:

* Nodes along the strips and strips are those of Gauss and Legendre, in every strip scaled to
  its own length. Adhesion is integrated exactly and full sliding gives mu N exactly.
* All strips advance together, one node after the other: the inner loop is over strips and
  compiles to vector instructions.
* The patch may be turned against rolling: its strips' centres then lie on a slanted line.
* The traction bound may be parabolic, elliptic, or `balanced` (default): every strip carries its
  Hertzian share of mu N and the exponent along the strip stands midway between the other two.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

FAST = {"contract", "reassoc", "nsz", "arcp"}
STRIP_BLOCK = 4


class PatchGrid(NamedTuple):
    """Nodes and weights of the unit patch; plain arrays, usable in compiled code.

    Along a strip (leading edge +1, trailing edge -1; n nodes, n + 1 intervals):
    node (n,), weight (n,), step (n + 1,), middle (n + 1,), bound_along (n + 1,),
    pressure_along (n + 1,) mean of sqrt(1 - x^2) in the interval.
    Across (m strips, padded to whole blocks with weight zero): offset (m,), half_length (m,),
    strip_weight (m,), strip_area (m,) weight times half length, bound_across (m,).
    """

    node: np.ndarray
    weight: np.ndarray
    step: np.ndarray
    middle: np.ndarray
    bound_along: np.ndarray
    pressure_along: np.ndarray
    offset: np.ndarray
    half_length: np.ndarray
    strip_weight: np.ndarray
    strip_area: np.ndarray
    bound_across: np.ndarray


# Exponents of the bound: (1 - y^2)^across (1 - x^2)^along, x relative to the strip.
BOUNDS = {"parabolic": (1.0, 1.0), "elliptic": (0.5, 0.5), "balanced": (0.5, 0.75)}


def _ellipse_area(x: np.ndarray) -> np.ndarray:
    return 0.5 * (x * np.sqrt(1.0 - x**2) + np.arcsin(x))


def patch_grid(cells_along: int, strips: int, bound: str = "balanced") -> PatchGrid:
    """Grid of the unit patch.

    Parameters
    ----------
    cells_along : nodes per strip, at least 2
    strips : number of strips, at least 2
    bound : 'balanced', 'parabolic' or 'elliptic' shape of the traction bound
    """
    if cells_along < 2 or strips < 2:
        raise ValueError(f"a patch grid needs at least 2 x 2 cells, not {cells_along} x {strips}")
    if bound not in BOUNDS:
        raise ValueError(f"traction bound '{bound}' is unknown; allowed: {', '.join(BOUNDS)}")
    across, along = BOUNDS[bound]
    x, weight = np.polynomial.legendre.leggauss(cells_along)
    x, weight = x[::-1].copy(), weight[::-1].copy()
    y, strip_weight = np.polynomial.legendre.leggauss(strips)
    padding = -strips % STRIP_BLOCK
    y = np.concatenate([y, np.zeros(padding)])
    strip_weight = np.concatenate([strip_weight, np.zeros(padding)])
    half_length = np.sqrt(1.0 - y**2)
    edges = np.concatenate([[1.0], x, [-1.0]])
    bound_along = np.append((1.0 - x**2) ** along, 0.0)
    bound_across = (1.0 - y**2) ** across
    total = (weight @ bound_along[:-1]) * (strip_weight @ (half_length * bound_across))
    return PatchGrid(
        node=x,
        weight=weight,
        step=edges[:-1] - edges[1:],
        middle=0.5 * (edges[:-1] + edges[1:]),
        bound_along=bound_along,
        pressure_along=np.diff(_ellipse_area(edges)) / np.diff(edges),
        offset=y,
        half_length=half_length,
        strip_weight=strip_weight,
        strip_area=strip_weight * half_length,
        bound_across=bound_across / total,
    )


def workspace(grid: PatchGrid) -> np.ndarray:
    """Scratch array for `fastsim_forces`, one per thread."""
    return np.zeros((5, grid.offset.size))


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def _march(grid, qx, qy, drive_x, drive_y, limit, area, half_length, offset, rate_spin, shear):
    """Advance all strips over every node; integrals of q_x, q_y and of the moment.

    `drive_x` and `drive_y` hold the change of q per unit of strip coordinate without the spin along
    the strip, `limit` the bound of the strip; half lengths and offsets are in units of a and b, and
    so is `rate_spin`. `shear` carries the strips' centres into the moment.
    """
    force_x = force_y = moment_x = moment_y = 0.0
    for k in range(grid.node.size):
        step, bound, weight = grid.step[k], grid.bound_along[k], grid.weight[k]
        spin_rate = grid.middle[k] * rate_spin
        total_x = total_y = arm_x = arm_y = 0.0
        for j in range(qx.size):
            half = half_length[j]
            trial_x = qx[j] - step * drive_x[j]
            trial_y = qy[j] - step * (drive_y[j] + spin_rate * half * half)
            capacity = bound * limit[j]
            squared = trial_x * trial_x + trial_y * trial_y
            scale = capacity / np.sqrt(max(squared, capacity * capacity))
            trial_x *= scale
            trial_y *= scale
            qx[j] = trial_x
            qy[j] = trial_y
            part_x = area[j] * trial_x
            part_y = area[j] * trial_y
            total_x += part_x
            total_y += part_y
            arm_x += offset[j] * (part_x - shear * part_y)
            arm_y += half * part_y
        force_x += weight * total_x
        force_y += weight * total_y
        moment_x += weight * arm_x
        moment_y += weight * grid.node[k] * arm_y
    return force_x, force_y, moment_x, moment_y


@njit(cache=True, nogil=True, error_model="numpy", fastmath=FAST)
def fastsim_forces(
    semi_axis_longitudinal,
    semi_axis_lateral,
    normal_force,
    friction_coefficient,
    longitudinal_creepage,
    lateral_creepage,
    spin_creepage,
    flexibility,
    grid,
    work,
    shear=0.0,
):
    """Creep forces and spin moment on the wheel.

    Parameters
    ----------
    semi_axis_longitudinal, semi_axis_lateral : m
    normal_force : N
    friction_coefficient : one value for the patch
    longitudinal_creepage, lateral_creepage : dimensionless
    spin_creepage : 1/m
    flexibility : (L1, L2, L3) in m/Pa, from `kalker.flexibilities`
    grid : PatchGrid
    work : (5, strips) scratch array from `workspace`
    shear : of a turned patch: the strip at the lateral place y has its centre at shear y

    Returns
    -------
    longitudinal_force in N, lateral_force in N, spin_moment in N m.

    Examples
    --------
    A round patch under 35 kN: at small creepage the force is ``C22 G a b nu_y`` with Kalker's
    C22, in full slip ``mu N`` = 12250 N.

    >>> from tramdva.contact import fastsim, kalker
    >>> a = b = 4.2e-3
    >>> table = kalker.kalker_table(poisson_ratio=0.27)
    >>> flexibility = kalker.flexibilities(table, a, b, 8.2e10)
    >>> grid = fastsim.patch_grid(cells_along=40, strips=40)
    >>> C_22 = kalker.creep_coefficients(table, a / b)[1]
    >>> for nu_y in (1e-5, 0.1):
    ...     _, F_y, _ = fastsim.fastsim_forces(
    ...         a, b, 35e3, 0.35, 0.0, nu_y, 0.0, flexibility, grid, fastsim.workspace(grid))
    ...     print(f"{F_y:.0f} N, linear {-C_22 * 8.2e10 * a * b * nu_y:.0f} N")
    -53 N, linear -53 N
    -12250 N, linear -534217 N
    """
    a, b = semi_axis_longitudinal, semi_axis_lateral
    if normal_force <= 0.0 or friction_coefficient <= 0.0:
        return 0.0, 0.0, 0.0
    nu_x, nu_y, phi = longitudinal_creepage, lateral_creepage, spin_creepage
    rate_x, rate_y, rate_spin = nu_x / flexibility[0], nu_y / flexibility[1], phi / flexibility[2]
    scale = friction_coefficient * normal_force / (a * b)
    qx, qy, drive_x, drive_y, limit = work[0], work[1], work[2], work[3], work[4]
    for j in range(qx.size):
        qx[j] = 0.0
        qy[j] = 0.0
        drive_x[j] = a * grid.half_length[j] * (rate_x - rate_spin * b * grid.offset[j])
        drive_y[j] = a * grid.half_length[j] * (rate_y + rate_spin * shear * b * grid.offset[j])
        limit[j] = scale * grid.bound_across[j]
    force_x, force_y, moment_x, moment_y = _march(
        grid,
        qx,
        qy,
        drive_x,
        drive_y,
        limit,
        grid.strip_area,
        grid.half_length,
        grid.offset,
        a * a * rate_spin,
        shear,
    )
    return a * b * force_x, a * b * force_y, a * b * (a * moment_y - b * moment_x)
