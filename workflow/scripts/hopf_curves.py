"""Hopf curves of figure 4."""

from tramdva import critical_absorber, job, results


def main(*, output: str, code: str, cfg: dict) -> None:
    """Follow the Hopf points in the stiffnesses of axle and absorber."""
    values = critical_absorber.hopf_curves(cfg)
    results.save(output, "hopf_curves", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
        )
