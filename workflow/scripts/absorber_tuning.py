"""Designs of the absorber, Table 2."""

from tramdva import absorber, job, results


def main(*, output: str, code: str, cfg: dict, critical_hopf_curve: str) -> None:
    """Tune the absorber by several criteria."""
    values = absorber.absorber_tuning(cfg, results.read(critical_hopf_curve))
    results.save(output, "absorber_tuning", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            critical_hopf_curve=snakemake.input.critical_hopf_curve,
        )
