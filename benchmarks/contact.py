"""Time of FASTSIM per cell and of one contact per call, beside C that is written the same way.

Run with OMP_NUM_THREADS=1; times are processor times of this process, the best of several repeats
that alternate with those of the C (`fastsim_strips.c`: the strips side by side, with -O3
-march=native -ffast-math), compiled by gcc if there is one. Forces of both must agree.
"""

import ctypes
import functools
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from numba import njit
from scipy.optimize import brentq

from tramdva.contact import (
    creep_table,
    fastsim,
    geometry,
    kalker,
    patch,
    profiles,
    traction_field,
)

REPEATS, ROUNDS, CALLS = 9, 15, 20_000
A, B, LOAD, FRICTION = 4e-3, 4e-3, 35e3, 0.35
TABLE = kalker.kalker_table(0.28)
FLEXIBILITY = kalker.flexibilities(TABLE, A, B, 82e9)


def best(run, calls=CALLS, repeats=REPEATS):
    """Shortest time per call in s."""
    run(10)
    times = []
    for _ in range(repeats):
        start = time.process_time()
        run(calls)
        times.append((time.process_time() - start) / calls)
    return min(times)


class _Grid(ctypes.Structure):
    """A `fastsim.PatchGrid` as the C takes it."""

    ALONG = ("node", "weight", "step", "middle", "bound_along")
    ACROSS = ("half_length", "offset", "strip_area", "bound_across")
    _fields_ = [
        *[(name, ctypes.c_int) for name in ("nodes", "strips")],
        *[(name, ctypes.c_void_p) for name in ALONG + ACROSS],
    ]


@functools.cache
def compiled_c():
    """Function `repeat` of the C reference; None without gcc."""
    if shutil.which("gcc") is None:
        return None
    source = Path(__file__).with_name("fastsim_strips.c")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "strips.so"
        command = ["gcc", "-O3", "-march=native", "-ffast-math", "-shared", "-fPIC"]
        subprocess.run([*command, str(source), "-o", str(library), "-lm"], check=True)
        repeat = ctypes.CDLL(str(library)).repeat
    repeat.restype = ctypes.c_double
    repeat.argtypes = [ctypes.c_int, *[ctypes.c_double] * 3, *[ctypes.c_void_p] * 4]
    return repeat


def in_c(grid):
    """Function that calls the C a number of times and returns the last forces (3,)."""
    arrays = [getattr(grid, name) for name in _Grid.ALONG + _Grid.ACROSS]
    given = _Grid(grid.node.size, grid.offset.size, *(array.ctypes.data for array in arrays))
    flexibility, work, force = np.array(FLEXIBILITY), fastsim.workspace(grid), np.zeros(3)
    pointers = [flexibility.ctypes.data, ctypes.addressof(given), work.ctypes.data]

    def run(times, kept=(given, flexibility, work)):
        compiled_c()(times, A, B, FRICTION * LOAD, *pointers, force.ctypes.data)
        return force

    return run


@njit
def _forces(times, flexibility, grid, work):
    total = 0.0
    for i in range(times):
        total += fastsim.fastsim_forces(
            A, B, LOAD, FRICTION, 1e-3 + 1e-9 * i, 2e-3, 0.3, flexibility, grid, work
        )[0]
    return total


@njit
def _fastsim_and_flexibilities(times, kalker_table, grid, work):
    total = 0.0
    for i in range(times):
        flexibility = kalker.flexibilities(kalker_table, A, B, 82e9)
        total += fastsim.fastsim_forces(
            A, B, LOAD, FRICTION, 1e-3 + 1e-9 * i, 2e-3, 0.3, flexibility, grid, work
        )[0]
    return total


@njit
def _table(times, table):
    total = 0.0
    for i in range(times):
        total += creep_table.half_space_forces(
            A, B, LOAD, FRICTION, 1e-3 + 1e-9 * i, 2e-3, 0.3, 82e9, table
        )[0]
    return total


@njit
def _field(times, flexibility, grid, field):
    total = 0.0
    for i in range(times):
        total += traction_field.traction_field(
            A, B, LOAD, FRICTION, 1e-3 + 1e-9 * i, 2e-3, 0.3, flexibility, grid, field
        )[0]
    return total


@njit
def _contacts(times, table, law, height, rows, work, result):
    total = 0.0
    for i in range(times):
        total += patch.wheel_contact(
            table, law, -1.0, (-0.1e-3, height + 1e-13 * i), (0.0, -0.01), (4.0, 0.0, 0.0),
            (0.13, 13.3, 0.0), 4.0, 0.0, 0.0, 0.04, rows, work, result,
        )[1]  # fmt: skip
    return total


@njit
def _places(times, table, height, rows):
    total = 0.0
    for i in range(times):
        total += geometry.locate_contact(table, 0.1e-3, height + 1e-13 * i, 0.0, 0.01, rows)[0]
    return total


def grids():
    """Rows of time per cell."""
    for cells, strips in ((10, 10), (12, 11), (12, 12), (16, 16), (20, 20), (40, 40)):
        grid = fastsim.patch_grid(cells, strips)
        work = fastsim.workspace(grid)

        def run(n, grid=grid, work=work):
            _forces(n, FLEXIBILITY, grid, work)

        count = cells * strips
        if compiled_c() is None:
            ours = best(run)
            print(f"FASTSIM {cells:2d} x {strips:2d}  {ours / count * 1e9:5.1f} ns/cell")
            continue
        reference = in_c(grid)
        here = fastsim.fastsim_forces(
            A, B, LOAD, FRICTION, 1e-3, 2e-3, 0.3, FLEXIBILITY, grid, work
        )
        np.testing.assert_allclose(reference(1), here, rtol=1e-11)
        times = np.array(
            [[best(run, repeats=1), best(reference, repeats=1)] for _ in range(ROUNDS)]
        )
        ours, c = times.min(axis=0)
        print(
            f"FASTSIM {cells:2d} x {strips:2d}  {ours * 1e6:6.2f} us"
            f"  {ours / count * 1e9:5.1f} ns/cell   C {c / count * 1e9:5.1f} ns/cell"
            f"   ratio {ours / c:4.2f}"
        )


def laws():
    """Time of the table of the half-space beside FASTSIM 12 x 12 with its flexibilities."""
    grid, table = fastsim.patch_grid(12, 12), creep_table.creep_table()
    work = fastsim.workspace(grid)
    plain = best(lambda n: _fastsim_and_flexibilities(n, TABLE, grid, work))
    ours = best(lambda n: _table(n, table))
    print(f"half-space table  {ours * 1e6:6.2f} us   FASTSIM 12 x 12 {plain * 1e6:6.2f} us", end="")
    print(f"   ratio {ours / plain:4.2f}   {table.coefficients.nbytes / 1e6:.1f} MB")


def contacts():
    """Rows of time per contact."""
    table = geometry.contact_tables(profiles.tram_wheel(), profiles.grooved_rail(), 0.3)[1]
    memory = table.coefficients.nbytes / 1e6
    ways = (
        (10, 10, "fastsim"),
        (12, 11, "fastsim"),
        (12, 12, "fastsim"),
        (12, 12, "half_space"),
        (20, 20, "fastsim"),
    )
    for cells, strips, method in ways:
        law = patch.contact_law(0.35, 0.36, 0.7, cells_along=cells, strips=strips, method=method)
        scratch = patch.contact_workspace(law)

        def excess(z, law=law, scratch=scratch):
            patch.wheel_contact(
                table, law, -1.0, (-0.1e-3, z), (0.0, -0.01), (4.0, 0.0, 0.0), (0.13, 13.3, 0.0),
                4.0, 0.0, 0.0, 0.04, *scratch,
            )  # fmt: skip
            return scratch[2][patch.NORMAL_FORCE] - 43e3

        height = brentq(excess, -1e-3, 3e-3)
        ours = best(lambda n, a=(table, law, height, *scratch): _contacts(n, *a))
        angle = np.degrees(scratch[2][patch.CONTACT_ANGLE])
        name = f"{cells:2d} x {strips:2d}" if method == "fastsim" else "  table"
        print(f"contact {name}  {ours * 1e6:6.2f} us (43 kN at {angle:.0f} deg)")
        away = best(lambda n, a=(table, law, height + 1e-3, *scratch): _contacts(n, *a))
        print(f"        lifted off {away * 1e6:6.2f} us")
    rows = np.zeros((geometry.WINDOW, 8))
    print(f"geometry alone   {best(lambda n: _places(n, table, -height, rows)) * 1e6:6.2f} us")
    print(f"table of one zone {memory:.1f} MB")


def cells():
    """Time of the field of cells that wear needs."""
    grid = fastsim.patch_grid(40, 40)
    field = traction_field.empty_field(grid)
    ours = best(lambda n: _field(n, FLEXIBILITY, grid, field), 500)
    print(f"field   40 x 40  {ours * 1e6:6.2f} us  {ours / 1600 * 1e9:5.1f} ns/cell")


if __name__ == "__main__":
    grids()
    laws()
    contacts()
    cells()
