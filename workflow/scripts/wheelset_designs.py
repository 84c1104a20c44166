"""Stability and frequency response of the wheelset with any absorber."""

from tramdva import job, results
from tramdva import wheelset_designs as designs


def main(*, output: str, code: str, cfg: dict) -> None:
    """Compute the grid of designs of a line."""
    values = designs.wheelset_designs(cfg)
    results.save(output, "wheelset_designs", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
        )
