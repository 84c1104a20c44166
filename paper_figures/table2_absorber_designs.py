"""Table 2: designs of the absorber side by side."""

import csv

from tramdva import job, results

COLUMNS = {
    "m_T": "m_T (kg)",
    "c_T": "c_T (N/m)",
    "d_T": "d_T (N s/m)",
    "peak_receptance": "peak receptance (m/N)",
    "reduction": "reduction (-)",
    "peak_frequency": "peak frequency (Hz)",
    "growth_rate": "growth rate (1/s)",
    "critical_c_T": "critical c_T (N/m)",
    "stroke_per_force": "stroke per force (m/N)",
}


def main(*, output: str, code: str, absorber_tuning: str) -> None:
    """Write the designs as a table, a row each."""
    designs = results.read(absorber_tuning)
    with results.atomically(output) as part, part.open("w", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["design", *COLUMNS.values(), "status"])
        for row, design in enumerate(designs["design"]):
            numbers = [f"{designs[name][row]:.6g}" for name in COLUMNS]
            table.writerow([design, *numbers, designs["status"][row]])


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            absorber_tuning=snakemake.input.absorber_tuning,
        )
