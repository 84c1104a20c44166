"""Contact tables of the line's profiles."""

from tramdva import job, results
from tramdva.bogie import line


def main(*, output: str, code: str, cfg: dict) -> None:
    """Compute the contact tables."""
    values = line.contact_geometry(cfg)
    results.save(output, "contact_geometry", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
        )
