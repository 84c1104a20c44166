"""Critical Hopf curve of figure 5."""

from tramdva import critical_absorber, job, results


def main(*, output: str, code: str, cfg: dict, hopf_curves: str) -> None:
    """Follow the points where the Hopf points merge."""
    values = critical_absorber.critical_hopf_curve(cfg, results.read(hopf_curves))
    results.save(output, "critical_hopf_curve", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            hopf_curves=snakemake.input.hopf_curves,
        )
