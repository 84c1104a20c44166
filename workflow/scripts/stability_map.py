"""Stability maps of figure 2."""

from tramdva import job, results, stability


def main(*, output: str, code: str, cfg: dict) -> None:
    """Compute the stability maps of a line."""
    values = stability.stability_map(cfg)
    results.save(output, "stability_map", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
        )
