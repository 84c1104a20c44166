"""Frequency response of figure 7."""

from tramdva import absorber, job, results


def main(*, output: str, code: str, cfg: dict, absorber_tuning: str) -> None:
    """Compute the receptance of each design."""
    values = absorber.frequency_response(cfg, results.read(absorber_tuning))
    results.save(output, "frequency_response", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            absorber_tuning=snakemake.input.absorber_tuning,
        )
