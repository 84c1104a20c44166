"""Table 2: designs of the absorber side by side."""

import numpy as np

from tramdva import results
from tramdva.report import figures, tables
from tramdva.report.figures import KILO, MEGA
from tramdva.report.script import run

MM_PER_KN = 1e-6  # m/N

# Heading, unit and name of each column.
COLUMNS = {
    "mass m_T (kg)": (1.0, "m_T"),
    "stiffness c_T (MN/m)": (MEGA, "c_T"),
    "damping d_T (kN s/m)": (KILO, "d_T"),
    "peak frequency (Hz)": (1.0, "peak_frequency"),
    "peak receptance (mm/kN)": (MM_PER_KN, "peak_receptance"),
    "reduction of the peak (times)": (1.0, "reduction"),
    "growth rate at the operating B (1/s)": (1.0, "growth_rate"),
    "critical c_T at this d_T (MN/m)": (MEGA, "critical_c_T"),
    "stroke per force (mm/kN)": (MM_PER_KN, "stroke_per_force"),
}


def main(*, table: str, page: str, code: str, absorber_tuning: str) -> None:
    """Write the table for spreadsheets and as a page.

    Parameters
    ----------
    table, page : str
        The table as CSV and as HTML.
    code : str
        Hash of the code.
    absorber_tuning : str
        Result file.
    """
    rows = [["design", *COLUMNS, "status"], *designs(results.read(absorber_tuning))]
    tables.save(table, page, "Designs of the absorber", rows)


def designs(tuning: dict[str, np.ndarray]) -> list[list[str]]:
    """Rows of the table as texts: no absorber, then each design."""
    reference = {
        name.removeprefix("reference_"): value[None]
        for name, value in tuning.items()
        if name.startswith("reference_")
    }
    rows = [[figures.design_name("none"), *numbers(reference, 0), ""]]
    for row, design in enumerate(tuning["design"]):
        status = str(tuning["status"][row]).replace("_", " ")
        rows.append([figures.design_name(str(design)), *numbers(tuning, row), status])
    return rows


def numbers(tuning: dict[str, np.ndarray], row: int) -> list[str]:
    """Cells of one design to four digits, empty where there is no number."""
    cells = []
    for unit, name in COLUMNS.values():
        value = tuning[name][row] / unit if name in tuning else np.nan
        cells.append(f"{value:#.4g}".rstrip(".") if np.isfinite(value) else "")
    return cells


if __name__ == "__main__":
    run(main, snakemake)
