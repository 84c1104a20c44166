"""Make the table of creep forces that `tramdva.contact.creep_table` reads.

    OMP_NUM_THREADS=1 python benchmarks/creep_force_table.py FOLDER

Solves steady rolling on the half-space at the nodes, a quarter of an hour on one core. What is
solved is kept in FOLDER, ratio by ratio: a run that was stopped goes on. Writes
src/tramdva/contact/creep_table.npz and prints the digest that belongs into `creep_table.DIGEST`.

Where the last adhesion vanishes under much spin and little creepage the forces have a sharp crest
on patches that are not short along rolling. There the nodes of the spin stand twice as dense;
elsewhere the nodes between them are filled by splines.
"""

import sys
import time
from pathlib import Path

import numpy as np

from tramdva.contact import creep_table, rolling

VERSION = 1
RATIOS, SPINS, CREEPAGES, DIRECTIONS = 15, 13, 17, 13
DENSE_RATIO, DENSE_SPINS, DENSE_CREEPAGES = 0.45, slice(3, 10), 9  # where nodes are doubled
LOG_RATIOS = np.linspace(-creep_table.LOG_RATIO_END, creep_table.LOG_RATIO_END, RATIOS)
LINEAR_RATIOS = 43  # nodes of the linear coefficients, over the same range


def grids(ratio: float) -> list[tuple[rolling.RollingGrid, rolling.RollingGrid]]:
    """Fine and coarse grid, twice: with m and m + 1 strips.

    Where the slip turns about a pole inside the patch, an even and an odd number of strips err to
    opposite sides. Long ellipses need more cells along, short ones more strips.
    """
    half = round(12 * ratio**0.1)
    strips = round(16 * ratio**-0.1)
    return [
        tuple(rolling.rolling_grid(ratio, n * half, m, creep_table.POISSON_RATIO) for n in (2, 1))
        for m in (strips, strips + 1)
    ]


def linear_coefficients(ratio: float) -> np.ndarray:
    """C11, C22, C23, C33 without the error of first order."""
    fine, coarse = (
        rolling.linear_coefficients(
            rolling.rolling_grid(ratio, cells, 18, creep_table.POISSON_RATIO)
        )
        for cells in (28, 14)
    )
    return 2.0 * fine - coarse


def full_sliding(ratio: float, X: float, Y: float, Z: float, nodes: int = 240) -> np.ndarray:
    """Forces and moment where every place slides along its rigid slip."""
    angle = (np.arange(nodes) + 0.5) * 2.0 * np.pi / nodes
    node, weight = np.polynomial.legendre.leggauss(nodes)
    height, weight = 0.5 * (1.0 + node), 0.5 * weight  # of the Hertz pressure, sqrt(1 - r^2)
    radius = np.sqrt(1.0 - height**2)
    root = np.sqrt(ratio)
    x = root * np.outer(radius, np.cos(angle))
    y = np.outer(radius, np.sin(angle)) / root
    load = 3.0 * np.outer(weight * height**2, np.ones(nodes)) / nodes
    s_x, s_y = X - Z * y, Y + Z * x
    size = np.maximum(np.hypot(s_x, s_y), np.finfo(float).tiny)
    q_x, q_y = -load * s_x / size, -load * s_y / size
    return np.array([q_x.sum(), q_y.sum(), (x * q_y - y * q_x).sum()])


def ratio_samples(ratio: float, spins: np.ndarray, creepages: int = CREEPAGES) -> np.ndarray:
    """Forces and moment at nodes of one ratio: (len(spins), CREEPAGES, DIRECTIONS, 3).

    `spins` are coordinates from 0 to 1. Only the first `creepages` nodes of the creepage are
    solved, the others are NaN.
    """
    pairs = grids(ratio)
    c11, c22 = linear_coefficients(ratio)[:2]
    spin_scale = creep_table.spin_scale(c11, c22, ratio)
    half_turn = 0.5 * np.pi
    found = np.full((len(spins), CREEPAGES, DIRECTIONS, 3), np.nan)
    for i, spin in enumerate(spins):
        for k, angle in enumerate(np.linspace(0.0, np.pi, DIRECTIONS)):
            # From full sliding to less creepage, each case starting from its neighbour.
            starts = [(None, None)] * len(pairs)
            way_x, way_y = np.sin(angle) / c11, np.cos(angle) / c22
            for j in range(creepages - 1, -1, -1):
                creep = j / (CREEPAGES - 1)
                if j == CREEPAGES - 1:
                    found[i, j, k] = full_sliding(ratio, way_x, way_y, 0.0)
                elif spin == 1.0:
                    size = np.tan(half_turn * creep)
                    found[i, j, k] = full_sliding(
                        ratio, size * way_x, size * way_y, 1.0 / spin_scale
                    )
                elif j == 0 and spin == 0.0:
                    found[i, j, k] = 0.0
                elif j == 0 and k > 0:
                    found[i, j, k] = found[i, 0, 0]
                else:
                    w_s = creep_table.SCALE * np.tan(half_turn * spin)
                    w = np.hypot(creep_table.SCALE, w_s) * np.tan(half_turn * creep)
                    found[i, j, k], starts = average(
                        pairs, (w * way_x, w * way_y, w_s / spin_scale), starts
                    )
    return found


def average(pairs, creepages, starts):
    """Mean over the pairs of grids, and the states."""
    results = [
        rolling.extrapolated_forces(*pair, creepages, start)
        for pair, start in zip(pairs, starts, strict=True)
    ]
    forces = np.mean([force for force, _ in results], axis=0)
    if not np.isfinite(forces).all():
        raise RuntimeError(f"no solution at the reduced creepages {creepages}")
    return forces, [states for _, states in results]


def spline_of_samples(nodes: int, start: str, end: str) -> np.ndarray:
    """Matrix (nodes + 2, nodes) from samples to coefficients of uniform cubic B-splines.

    `start` and `end` say what closes the system there: 'even' or 'odd' about the end, or 'free',
    one cubic over the last two intervals. An even spline takes another slope at the start by
    `slope_at_start`.
    """
    system, right = np.zeros((nodes + 2, nodes + 2)), np.zeros((nodes + 2, nodes))
    for i in range(nodes):
        system[i + 1, i : i + 3] = np.array([1.0, 4.0, 1.0]) / 6.0
        right[i + 1, i] = 1.0
    for row, kind, order in ((0, start, 1), (-1, end, -1)):
        if kind == "free":
            system[row, ::order][:5] = [1.0, -4.0, 6.0, -4.0, 1.0]
        else:
            system[row, ::order][[0, 2]] = [1.0, -1.0 if kind == "even" else 1.0]
    return np.linalg.solve(system, right)


def slope_at_start(nodes: int) -> np.ndarray:
    """Coefficients (nodes + 2,) of the spline with slope 1 at its start and zero at all nodes."""
    system = np.zeros((nodes + 2, nodes + 2))
    for i in range(nodes):
        system[i + 1, i : i + 3] = [1.0, 4.0, 1.0]
    system[0, [0, 2]] = 0.5 * (nodes - 1) * np.array([-1.0, 1.0])
    system[-1, -5:] = [1.0, -4.0, 6.0, -4.0, 1.0]
    return np.linalg.solve(system, np.eye(nodes + 2)[0])


def creepage_splines(samples: np.ndarray, moment_slope: np.ndarray) -> np.ndarray:
    """Splines over the creepage, whose slopes at its start belong to a differentiable function.

    There the direction has no meaning: a slope is a sine (force_x) or cosine of the angle. With
    spin that of the samples is projected on it. Without spin it is known from the linear theory,
    and better so: the sliding zone of small creepages is thinner than a cell and the samples err
    by up to a hundredth of themselves. `moment_slope` is C23 / C22 of every ratio.
    """
    free, even = (spline_of_samples(CREEPAGES, start, "free") for start in ("free", "even"))
    slope_of_samples = 0.5 * (CREEPAGES - 1) * (free[2] - free[0])
    slope = np.einsum("k,ajklc->ajlc", slope_of_samples, samples)
    angle = np.linspace(0.0, np.pi, DIRECTIONS)
    waves = np.stack([np.sin(angle), np.cos(angle), np.cos(angle)], axis=-1)
    size = (slope * waves).sum(axis=2) / (waves**2).sum(axis=0)
    linear = np.stack([-np.ones(RATIOS), -np.ones(RATIOS), moment_slope], axis=-1)
    size[:, 0] = 0.5 * np.pi * creep_table.SCALE * linear
    slope = size[:, :, None, :] * waves
    return np.einsum("bk,ajklc->ajblc", even, samples) + np.einsum(
        "b,ajlc->ajblc", slope_at_start(CREEPAGES), slope
    )


def spin_splines(samples: np.ndarray) -> np.ndarray:
    """Splines over the spin.

    With it everything but force_x changes sign if the lateral creepage does, too: about the angle
    pi/2 symmetric parts of force_x and antisymmetric ones of the others are even in the spin, the
    rest is odd.
    """
    mirrored = samples[:, :, :, ::-1] * np.array([1.0, -1.0, -1.0])
    even, odd = (spline_of_samples(samples.shape[1], kind, "free") for kind in ("even", "odd"))
    return np.einsum("sj,ajklc->asklc", even, 0.5 * (samples + mirrored)) + np.einsum(
        "sj,ajklc->asklc", odd, 0.5 * (samples - mirrored)
    )


def with_nodes_between(samples: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Samples at twice as many spins; NaN in `between` is filled by the splines of `samples`."""
    c = spin_splines(samples)
    splines = (c[:, :-3] + 23.0 * (c[:, 1:-2] + c[:, 2:-1]) + c[:, 3:]) / 48.0
    found = np.empty((RATIOS, 2 * SPINS - 1, *samples.shape[2:]))
    found[:, ::2] = samples
    found[:, 1::2] = np.where(np.isnan(between), splines, between)
    return found


def spline_coefficients(samples: np.ndarray, moment_slope: np.ndarray) -> np.ndarray:
    """Coefficients of the tensor spline: two more than samples on every axis but the last.

    Against rolling direction forces are mirrored, so force_x is odd and the others are even in
    the angle at both of its ends.
    """
    # The direction comes last: the spin's splines mirror its nodes.
    found = spin_splines(creepage_splines(samples, moment_slope))
    found = np.einsum("ai,isblc->asblc", spline_of_samples(RATIOS, "free", "free"), found)
    angles = [spline_of_samples(DIRECTIONS, kind, kind) for kind in ("odd", "even", "even")]
    return np.stack(
        [np.einsum("dl,asbl->asbd", angle, found[..., i]) for i, angle in enumerate(angles)],
        axis=-1,
    )


def write_table(samples: np.ndarray, file: Path) -> str:
    """Write the table; its digest."""
    log_ratios = np.linspace(LOG_RATIOS[0], LOG_RATIOS[-1], LINEAR_RATIOS)
    inverse = np.array([1.0 / linear_coefficients(np.exp(log))[:2] for log in log_ratios])
    at_nodes = np.array([linear_coefficients(np.exp(log)) for log in LOG_RATIOS])
    coefficients = spline_coefficients(samples, at_nodes[:, 2] / at_nodes[:, 1])
    about = (
        f"version {VERSION}, made by benchmarks/creep_force_table.py: forces over mu N and moment "
        "over mu N sqrt(a b) on the half-space, Poisson's ratio 0.28; axes: tramdva.contact."
        "creep_table"
    )
    np.savez_compressed(file, coefficients=coefficients, inverse_linear=inverse, about=about)
    return creep_table.digest(coefficients, inverse)


def kept(path: Path, ratio: float, *arguments) -> np.ndarray:
    """Samples from their file, solved first if it is not there."""
    if not path.exists():
        start = time.process_time()
        np.save(path, ratio_samples(ratio, *arguments))
        print(f"{path.stem}, a/b = {ratio:.4f}: {time.process_time() - start:.0f} s", flush=True)
    return np.load(path)


def main(folder: Path) -> None:
    """Solve what is missing in `folder`, one ratio of semi-axes after the other."""
    folder.mkdir(parents=True, exist_ok=True)
    spins = np.linspace(0.0, 1.0, SPINS)
    middle = 0.5 * (spins[1:] + spins[:-1])
    samples = np.zeros((RATIOS, SPINS, CREEPAGES, DIRECTIONS, 3))
    between = np.full((RATIOS, SPINS - 1, CREEPAGES, DIRECTIONS, 3), np.nan)
    for i, ratio in enumerate(np.exp(LOG_RATIOS).tolist()):
        samples[i] = kept(folder / f"{i:02d}.npy", ratio, spins)
        if ratio > DENSE_RATIO:
            between[i, DENSE_SPINS] = kept(
                folder / f"{i:02d}_between.npy", ratio, middle[DENSE_SPINS], DENSE_CREEPAGES
            )
    digest = write_table(with_nodes_between(samples, between), creep_table.FILE)
    print("DIGEST =", digest)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
