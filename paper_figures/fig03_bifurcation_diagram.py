"""Figure 3."""

from pathlib import Path

import matplotlib.pyplot as plt

from tramdva import job, results

STYLE = Path(__file__).parent / "tramdva.mplstyle"


def main(*, pdf: str, png: str, code: str, cfg: dict, hopf_points: str, limit_cycles: str) -> None:
    """Draw figure 3."""
    plt.style.use(STYLE)
    figure, axes = plt.subplots()
    axes.set_title(cfg["label"] + str(len(results.read(limit_cycles))))
    for path in (pdf, png):
        figure.savefig(path)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            pdf=snakemake.output.pdf,
            png=snakemake.output.png,
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            hopf_points=snakemake.input.hopf_points,
            limit_cycles=snakemake.input.limit_cycles,
        )
