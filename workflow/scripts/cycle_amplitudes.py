"""Cycle amplitudes of figure 6."""

from tramdva import job, results, sustained_vibration


def main(*, output: str, code: str, cfg: dict, critical_hopf_curve: str) -> None:
    """Follow the limit cycles over the stiffness of the absorber."""
    values = sustained_vibration.cycle_amplitudes(cfg, results.read(critical_hopf_curve))
    results.save(output, "cycle_amplitudes", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            critical_hopf_curve=snakemake.input.critical_hopf_curve,
        )
