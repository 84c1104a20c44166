"""How far CONTACT's printed forces stand from their own limit, and the table from both.

    OMP_NUM_THREADS=1 python benchmarks/contact_discretisation.py

Every case of tests/reference/contact/hertzian_rolling.csv is solved by `tramdva.contact.rolling` on
CONTACT's own grid (equal rectangles whose centres lie in the ellipse, Hertz pressure of the centre)
with 20 and with 40 of them along and across, and on fine strips of the ellipse. On the grid of 40
the solver should give what CONTACT prints; grids of 20 and 40 extrapolate to a limit that knows
nothing of strips. Takes some two minutes.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from tramdva.contact import creep_table, rolling

CASES = Path(__file__).resolve().parents[1] / "tests/reference/contact/hertzian_rolling.csv"
SHEAR_MODULUS, POISSON_RATIO = 82e9, 0.28
# Cells ahead of a cell's centre, where CONTACT takes the rigid slip by spin if told nothing else.
PLACE_OF_SLIP = 1.0 / 6.0


class Case(NamedTuple):
    """Semi-axes in m, limit mu N in N, creepages, CONTACT's force over the limit."""

    a: float
    b: float
    limit: float
    creepages: tuple[float, float, float]
    printed: np.ndarray

    def reduced(self) -> tuple[float, float, float]:
        """Creepages as `rolling` takes them."""
        mean = np.sqrt(self.a * self.b)
        scale = SHEAR_MODULUS * mean**2 / self.limit
        nu_x, nu_y, phi = self.creepages
        return scale * nu_x, scale * nu_y, scale * mean * phi


def cases() -> list[Case]:
    """The cases that CONTACT itself solved."""
    rows = pd.read_csv(CASES, comment="#")
    out = []
    for row in rows[rows.method == "CONTACT"].itertuples():
        limit = row.mu * row.FN_N
        creepages = (row.cksi, row.ceta, 1e3 * row.cphi_per_mm)
        printed = np.array([row.Fx_N, row.Fy_N]) / limit
        out.append(Case(1e-3 * row.a_mm, 1e-3 * row.b_mm, limit, creepages, printed))
    return out


def rectangles(ratio: float, cells: int) -> rolling.RollingGrid:
    """CONTACT's grid of an ellipse with a / b = `ratio`."""
    centre = (np.arange(cells) + 0.5) * 2.0 / cells - 1.0
    x, y = (v.ravel() for v in np.meshgrid(centre, centre))
    x, y = x[x * x + y * y < 1.0], y[x * x + y * y < 1.0]
    bound = np.sqrt(1.0 - x * x - y * y)
    root = np.sqrt(ratio)
    side_x, side_y = np.full(x.size, 2.0 / cells * root), np.full(x.size, 2.0 / cells / root)
    area = side_x * side_y
    x, y = root * x, y / root
    slips = [np.empty((x.size, x.size)) for _ in range(3)]
    rolling._fill_slips(x, y, side_x, side_y, side_x, POISSON_RATIO, *slips)
    bound /= bound @ area
    return rolling.RollingGrid(x, y, bound, area, x + PLACE_OF_SLIP * side_x, *slips)


def on_rectangles(grid: rolling.RollingGrid, case: Case) -> np.ndarray:
    """Force (2,) over the limit."""
    return np.array(rolling.steady_rolling(grid, *case.reduced())[0][:2])


def on_strips(ratio: float, some: list[Case]) -> np.ndarray:
    """Force (cases, 2) over the limit by extrapolation, mean of an even and an odd grid."""
    found = []
    for strips in (24, 25):
        pair = [rolling.rolling_grid(ratio, n, strips, POISSON_RATIO) for n in (32, 16)]
        found.append([rolling.extrapolated_forces(*pair, case.reduced())[0][:2] for case in some])
    return np.mean(found, axis=0)


def by_table(case: Case) -> np.ndarray:
    """Force (2,) over the limit by the table of the vehicle."""
    force = creep_table.half_space_forces(
        case.a, case.b, case.limit, 1.0, *case.creepages, SHEAR_MODULUS,
        creep_table.creep_table(POISSON_RATIO),
    )  # fmt: skip
    return np.array(force[:2]) / case.limit


def table_of_ratio(ratio: float, some: list[Case]) -> pd.DataFrame:
    """Distances in % of mu N, a row per case."""
    strips = on_strips(ratio, some)
    coarse, fine = (
        np.array([on_rectangles(grid, case) for case in some])
        for grid in (rectangles(ratio, cells) for cells in (20, 40))
    )
    printed = np.array([case.printed for case in some])
    table = np.array([by_table(case) for case in some])
    gaps = {
        "solver on CONTACT's grid, to CONTACT": fine - printed,
        "limit of that grid (20, 40), to CONTACT": 2.0 * fine - coarse - printed,
        "limit on strips, to CONTACT": strips - printed,
        "limit of that grid, to limit on strips": 2.0 * fine - coarse - strips,
        "table, to CONTACT": table - printed,
        "table, to limit on strips": table - strips,
        "table, to CONTACT less the error of its grid": table - (printed + strips - fine),
    }
    out = pd.DataFrame({name: 100.0 * np.hypot(*gap.T) for name, gap in gaps.items()})
    out["spin"] = [case.creepages[2] != 0.0 for case in some]
    return out


def main() -> None:
    """Print every case, then mean and maximum."""
    known = cases()
    rows = []
    for ratio in sorted({case.a / case.b for case in known}):
        some = [case for case in known if case.a / case.b == ratio]
        rows.append(table_of_ratio(ratio, some))
        rows[-1].insert(0, "case", [f"{case.a / case.b:g} {case.creepages}" for case in some])
    found = pd.concat(rows, ignore_index=True)
    names = found.columns[1:-1]
    with pd.option_context("display.width", 250, "display.max_columns", None):
        print(found.rename(columns={name: name[:24] for name in names}).to_string())
    without = ~found.spin
    for word, some in (("all", found), ("no spin", found[without]), ("spin", found[~without])):
        print(f"\n{word}, % of mu N: mean / max")
        for name in names:
            print(f"  {name:48s} {some[name].mean():5.2f} / {some[name].max():.2f}")


if __name__ == "__main__":
    main()
