"""Steady rolling contact of a Hertzian ellipse on the elastic half-space with Coulomb friction.

The exact theory that `fastsim` simplifies, after Kalker's boundary element method: tractions are
constant in rectangular cells, displacements follow from the integrals of Boussinesq and Cerruti in
closed form, every cell sticks or slides against its traction. Too slow for a vehicle: it makes and
checks the table of `creep_table`.

Everything is reduced: lengths by sqrt(a b), tractions by mu N / (a b), creepages to
X = G a b nu_x / (mu N), Y = G a b nu_y / (mu N), Z = G (a b)^(3/2) phi / (mu N). Then only a / b
and Poisson's ratio remain. Axes and signs as in `fastsim`. Both bodies are of one material.

Notes
-----
Slip over rolling speed, with u = A q the difference of displacements and the leading edge at +a::

    s_x = X - Z y - du_x/dx,   s_y = Y + Z x - du_y/dx,   |q| <= g,   q = -g s/|s| where s != 0

du/dx is the difference between the centre of a cell and that of the next one ahead, and the slip
that of the place between them. Traction and slip of a cell thus stand half a cell apart: errors
are of first order in the cells along a strip and `extrapolated_forces` removes the leading one.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from scipy.linalg import lapack

CONVERGED, NOT_CONVERGED, SINGULAR = 0, 1, 2
MOST_STEPS = 60
TOLERANCE = 1e-6  # of the slip, relative to the largest rigid slip
LARGEST_TURN = 0.5  # rad of a traction in one step


class RollingGrid(NamedTuple):
    """Cells of an ellipse and what they do to each other, reduced; n cells.

    x, y, bound, area : (n,) centres, means of the bound, areas
    slip_x : (n,) place between a cell and the next one ahead, to which its slip belongs
    xx, xy, yy : (n, n) slip in a cell (row) by unit traction in another (column)
    """

    x: np.ndarray
    y: np.ndarray
    bound: np.ndarray
    area: np.ndarray
    slip_x: np.ndarray
    xx: np.ndarray
    xy: np.ndarray
    yy: np.ndarray


class RollingState(NamedTuple):
    """Tractions (2, n) and which cells slide (n,), reduced."""

    traction: np.ndarray
    slides: np.ndarray


class RollingForces(NamedTuple):
    """Forces over mu N, moment over mu N sqrt(a b), share of the area that slides, status."""

    force_x: float
    force_y: float
    moment: float
    sliding: float
    status: int


@njit(cache=True, nogil=True, error_model="numpy")
def _corner(x, y):
    """Antiderivatives over both coordinates of x^2/R^3, y^2/R^3 and x y/R^3."""
    along = y * np.arcsinh(x / abs(y)) if y != 0.0 else 0.0
    across = x * np.arcsinh(y / abs(x)) if x != 0.0 else 0.0
    return along, across, -np.sqrt(x * x + y * y)


@njit(cache=True, nogil=True, error_model="numpy")
def influence(x, y, side_x, side_y, poisson_ratio):
    """Difference of displacements at (x, y) by unit traction on a rectangle around the origin.

    Parameters
    ----------
    x, y : m; side_x, side_y : sides of the rectangle in m
    poisson_ratio : of both bodies

    Returns
    -------
    u_x by q_x, u_x by q_y (equal to u_y by q_x), u_y by q_y, times the shear modulus, in m.

    Notes
    -----
    pi G u_x = integral of ((1 - nu)/R + nu x^2/R^3) q_x + (nu x y/R^3) q_y (Cerruti, two bodies)
    """
    p = _corner(x + 0.5 * side_x, y + 0.5 * side_y)
    q = _corner(x - 0.5 * side_x, y + 0.5 * side_y)
    r = _corner(x + 0.5 * side_x, y - 0.5 * side_y)
    s = _corner(x - 0.5 * side_x, y - 0.5 * side_y)
    along = p[0] - q[0] - r[0] + s[0]
    across = p[1] - q[1] - r[1] + s[1]
    mixed = p[2] - q[2] - r[2] + s[2]
    nu = poisson_ratio
    return (
        (along + (1.0 - nu) * across) / np.pi,
        nu * mixed / np.pi,
        ((1.0 - nu) * along + across) / np.pi,
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _fill_slips(x, y, side_x, side_y, ahead, poisson_ratio, xx, xy, yy):
    for i in range(x.size):
        for j in range(x.size):
            far_x, far_y, sides = x[i] - x[j], y[i] - y[j], (side_x[j], side_y[j])
            here = influence(far_x, far_y, sides[0], sides[1], poisson_ratio)
            there = influence(far_x + ahead[i], far_y, sides[0], sides[1], poisson_ratio)
            xx[i, j] = (here[0] - there[0]) / ahead[i]
            xy[i, j] = (here[1] - there[1]) / ahead[i]
            yy[i, j] = (here[2] - there[2]) / ahead[i]


def _chord_area(x: np.ndarray) -> np.ndarray:
    """Antiderivative of sqrt(1 - x^2)."""
    return 0.5 * (x * np.sqrt(np.maximum(1.0 - x**2, 0.0)) + np.arcsin(x))


def rolling_grid(
    semi_axis_ratio: float,
    cells_along: int,
    strips: int,
    poisson_ratio: float = 0.28,
    shear: float = 0.0,
) -> RollingGrid:
    """Grid over the ellipse with a / b = `semi_axis_ratio`, a along rolling.

    Of an ellipse that is turned against rolling, a is the half length of the strip through the
    centre, b the half width, and the strip at y has its centre at `shear` y.

    Strips are narrower towards the tips of the ellipse; each has the mean chord of the ellipse
    over its width and the Hertzian share of the load, and so have its equally long cells: full
    sliding gives mu N on any grid.
    """
    if not semi_axis_ratio > 0.0 or cells_along < 2 or strips < 2:
        raise ValueError(
            "a rolling grid needs a positive ratio of semi-axes and 2 x 2 cells, not "
            f"{semi_axis_ratio}, {cells_along} x {strips}"
        )
    root = np.sqrt(semi_axis_ratio)
    across = np.sin(np.linspace(-0.5 * np.pi, 0.5 * np.pi, strips + 1))
    along = np.linspace(-1.0, 1.0, cells_along + 1)
    width = np.diff(across)
    half = root * np.diff(_chord_area(across)) / width
    load = np.outer(
        0.75 * np.diff(across - across**3 / 3.0), np.diff(_chord_area(along)) * 2.0 / np.pi
    )
    y, side_x, side_y = (
        np.repeat(v, cells_along)
        for v in (
            0.5 * (across[1:] + across[:-1]) / root,
            half * 2.0 / cells_along,
            width / root,
        )
    )
    x = np.outer(half, 0.5 * (along[1:] + along[:-1])).ravel() + shear * y
    area = side_x * side_y
    slips = [np.empty((x.size, x.size)) for _ in range(3)]
    _fill_slips(x, y, side_x, side_y, side_x, poisson_ratio, *slips)
    return RollingGrid(x, y, load.ravel() / area, area, x + 0.5 * side_x, *slips)


def linear_coefficients(grid: RollingGrid) -> np.ndarray:
    """C11, C22, C23, C33 of Kalker's linear theory: no cell slides and no traction is bounded.

    Errors are of first order in the cells along a strip.
    """
    matrix = np.block([[grid.xx, grid.xy], [grid.xy, grid.yy]])
    none, one = np.zeros(grid.x.size), np.ones(grid.x.size)
    rigid = np.stack([np.append(one, none), np.append(none, one), np.append(-grid.y, grid.slip_x)])
    forces = np.linalg.solve(matrix, rigid.T) * np.append(grid.area, grid.area)[:, None]
    along, across = np.split(forces, 2)
    return np.array(
        [
            along[:, 0].sum(),
            across[:, 1].sum(),
            across[:, 2].sum(),
            grid.x @ across[:, 2] - grid.y @ along[:, 2],
        ]
    )


def _slip(grid: RollingGrid, rigid: np.ndarray, traction: np.ndarray) -> np.ndarray:
    q_x, q_y = traction
    return rigid + np.stack([grid.xx @ q_x + grid.xy @ q_y, grid.xy @ q_x + grid.yy @ q_y])


@njit(cache=True, nogil=True, error_model="numpy")
def _fill_system(xx, xy, yy, bound, slides, tangent, slip_size, place, matrix):
    """Matrix of a step, see `_step`; `place` is a cell's first row and column."""
    for j in range(slides.size):
        l, bx, by = place[j], bound[j] * tangent[0, j], bound[j] * tangent[1, j]  # noqa: E741
        for i in range(slides.size):
            k, s_xx, s_xy, s_yy = place[i], xx[i, j], xy[i, j], yy[i, j]
            t_x, t_y = tangent[0, i], tangent[1, i]
            if slides[j]:
                s_x, s_y = s_xx * bx + s_xy * by, s_xy * bx + s_yy * by
                if slides[i]:
                    matrix[k, l] = t_x * s_x + t_y * s_y
                else:
                    matrix[k, l] = s_x
                    matrix[k + 1, l] = s_y
            elif slides[i]:
                matrix[k, l] = t_x * s_xx + t_y * s_xy
                matrix[k, l + 1] = t_x * s_xy + t_y * s_yy
            else:
                matrix[k, l] = s_xx
                matrix[k, l + 1] = matrix[k + 1, l] = s_xy
                matrix[k + 1, l + 1] = s_yy
        if slides[j]:
            matrix[l, l] += slip_size[j]


def _step(grid, state, direction, slip):
    """Newton step with given sliding cells; None where the matrix is singular.

    A sliding cell has the angle t of its traction g (cos t, sin t) as unknown and no slip along
    the tangent tau as equation, a sticking one both tractions and both slips::

        [ tau.B g tau + |s|   tau.B ] [ dt ]     [ tau.s ]      sliding cells
        [      B g tau          B   ] [ dq ] = - [   s   ]      sticking cells

    Single precision is enough for a correction.
    """
    slides = state.slides
    tangent = np.stack([-direction[1], direction[0]])
    across = (tangent * slip).sum(axis=0)
    against = np.maximum(-(direction * slip).sum(axis=0), 0.0)
    end = np.cumsum(np.where(slides, 1, 2))
    place = np.concatenate([[0], end[:-1]])
    matrix = np.empty((end[-1], end[-1]), dtype=np.float32, order="F")
    _fill_system(grid.xx, grid.xy, grid.yy, grid.bound, slides, tangent, against, place, matrix)
    right = np.empty(end[-1], dtype=np.float32)
    sliding, sticking = place[slides], place[~slides]
    right[sliding] = -across[slides]
    right[sticking], right[sticking + 1] = -slip[:, ~slides]
    _, _, change, info = lapack.sgesv(matrix, right, overwrite_a=1, overwrite_b=1)
    if info != 0 or not np.isfinite(change).all():
        return None
    traction = state.traction.copy()
    turn = np.clip(change[sliding], -LARGEST_TURN, LARGEST_TURN)
    traction[:, slides] = grid.bound[slides] * (
        np.cos(turn) * direction[:, slides] + np.sin(turn) * tangent[:, slides]
    )
    traction[:, ~slides] += np.stack([change[sticking], change[sticking + 1]])
    return RollingState(traction, slides)


def full_sliding(grid: RollingGrid, rigid: np.ndarray) -> RollingState:
    """Every cell slides along its rigid slip (2, n): the limit of large creepage."""
    size = np.maximum(np.hypot(*rigid), np.finfo(float).tiny)
    return RollingState(-grid.bound * rigid / size, np.ones(grid.x.size, dtype=bool))


def rigid_slip(grid: RollingGrid, X: float, Y: float, Z: float) -> np.ndarray:
    """Rigid slip over rolling speed, reduced: (2, n) at the places `slip_x`, y."""
    return np.stack([X - Z * grid.y, Y + Z * grid.slip_x])


def steady_rolling(
    grid: RollingGrid, X: float, Y: float, Z: float, start: RollingState | None = None
) -> tuple[RollingForces, RollingState]:
    """Forces and tractions of steady rolling.

    Parameters
    ----------
    grid : from `rolling_grid`
    X, Y, Z : reduced longitudinal, lateral and spin creepage
    start : state of a neighbouring case; full sliding without it

    Notes
    -----
    Kalker's active set with Newton's method for the directions of sliding: a sticking cell starts
    to slide where its traction exceeds the bound, a sliding one sticks where it would slide along
    its traction. Forces are NaN where it does not converge.
    """
    rigid = rigid_slip(grid, X, Y, Z)
    largest = np.hypot(*rigid).max()
    state = start or full_sliding(grid, rigid)
    if largest == 0.0:
        nothing = RollingState(np.zeros_like(rigid), np.zeros(grid.x.size, dtype=bool))
        return _forces(grid, nothing, CONVERGED), nothing
    for _ in range(MOST_STEPS):
        slip = _slip(grid, rigid, state.traction)
        size = np.hypot(*state.traction)
        direction = state.traction / np.maximum(size, np.finfo(float).tiny)
        along = (direction * slip).sum(axis=0)
        slides = np.where(state.slides, along <= 0.0, size > grid.bound * (1.0 + 1e-9))
        if np.array_equal(slides, state.slides):
            across = np.abs(direction[0] * slip[1] - direction[1] * slip[0])
            if np.where(slides, across, np.hypot(*slip)).max() < TOLERANCE * largest:
                return _forces(grid, state, CONVERGED), state
        else:
            traction = np.where(slides, grid.bound * direction, state.traction)
            state = RollingState(traction, slides)
            slip = _slip(grid, rigid, traction)
        found = _step(grid, state, direction, slip)
        if found is None:
            return _forces(grid, state, SINGULAR), state
        state = found
    return _forces(grid, state, NOT_CONVERGED), state


def _forces(grid: RollingGrid, state: RollingState, status: int) -> RollingForces:
    q_x, q_y = state.traction * grid.area
    numbers = [q_x.sum(), q_y.sum(), grid.x @ q_y - grid.y @ q_x]
    if status != CONVERGED:
        numbers = [np.nan] * 3
    sliding = grid.area @ state.slides / grid.area.sum()
    return RollingForces(*(float(number) for number in numbers), float(sliding), status)


def extrapolated_forces(
    fine: RollingGrid,
    coarse: RollingGrid,
    creepages: tuple[float, float, float],
    starts: tuple[RollingState | None, RollingState | None] = (None, None),
) -> tuple[np.ndarray, tuple[RollingState, RollingState]]:
    """Force and moment without the error of first order.

    Parameters
    ----------
    fine, coarse : grids with equal strips and 2 : 1 cells along them
    creepages : X, Y, Z
    starts : states of a neighbouring case, fine and coarse

    Returns
    -------
    (3,) force_x, force_y, moment, reduced, NaN where one grid does not converge; both states.
    """
    first, first_state = steady_rolling(fine, *creepages, starts[0])
    second, second_state = steady_rolling(coarse, *creepages, starts[1])
    return 2.0 * np.array(first[:3]) - np.array(second[:3]), (first_state, second_state)
