"""Limit cycles of figure 3."""

from tramdva import job, results, sustained_vibration


def main(*, output: str, code: str, cfg: dict, hopf_points: str) -> None:
    """Follow the limit cycles from the Hopf points."""
    values = sustained_vibration.limit_cycles(cfg, results.read(hopf_points))
    results.save(output, "limit_cycles", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            hopf_points=snakemake.input.hopf_points,
        )
