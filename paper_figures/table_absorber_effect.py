"""Effect of the absorbers on the peaks of the evolution tendency, beside the paper's words."""

import numpy as np

from tramdva import results
from tramdva.report import figures, tables
from tramdva.report.script import run

# What the paper says of the peaks (1), (2), (3): frequency in Hz and factor by the absorbers.
PAPER = {
    ("first_bending", "outer"): ("(1) about 20", "slightly below 1"),
    ("first_bending", "inner"): ("(1) about 20", "slightly below 1"),
    ("second_bending", "outer"): ("(2) about 55", "about 1/3"),
    ("second_bending", "inner"): ("(2) about 55", "about 1/2"),
    ("resilient_wheel", "outer"): ("(3) about 120", "slightly below 1"),
    ("resilient_wheel", "inner"): ("(3) about 120", "slightly below 1"),
}
OF_THE_PAPER = ["paper: frequency (Hz)", "paper: factor"]
HEADINGS = [
    "wheel", "peak", "absorber", "frequency (Hz)", "share of the largest",
    "factor", "factor at whole orders", *OF_THE_PAPER,
]  # fmt: skip


def main(*, table: str, page: str, code: str, line: str, evolution_tendency: str) -> None:
    """Write the table for spreadsheets and as a page; the paper's words are about its own line."""
    rows = [HEADINGS, *peaks(results.read(evolution_tendency))]
    if line != "paper":
        rows = [row[: -len(OF_THE_PAPER)] for row in rows]
    tables.save(table, page, "Effect of the absorbers", rows)


def peaks(tendency: dict[str, np.ndarray]) -> list[list[str]]:
    """Rows by wheel, peak and absorber as texts."""
    rows = []
    for w, wheel in enumerate(map(str, tendency["wheel"])):
        for p, peak in enumerate(map(str, tendency["peak"])):
            known = PAPER.get((peak, wheel.partition("_")[2]), ("", ""))
            for a, absorber in enumerate(map(str, tendency["absorber"])):
                place = a, w, p
                rows.append(
                    [
                        wheel.replace("_", " "),
                        peak.replace("_", " "),
                        figures.design_name(absorber),
                        number(tendency["peak_frequency"][place], "{:.1f}"),
                        number(tendency["peak_tendency_normalised"][place], "{:.3f}"),
                        number(tendency["peak_factor"][place], "{:.2f}"),
                        number(tendency["peak_order_factor"][place], "{:.2f}"),
                        *(known if absorber == "paper" else (known[0], "")),
                    ]
                )
    return rows


def number(value: float, form: str) -> str:
    """Write a number, or nothing where there is none."""
    return form.format(value) if np.isfinite(value) else ""


if __name__ == "__main__":
    run(main, snakemake)
