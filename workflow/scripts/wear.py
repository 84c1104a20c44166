"""KTH wear around the wheels by the contacts of one order."""

from tramdva import evolution_stages, job, results


def main(*, output: str, code: str, cfg: dict, bogie_simulation: str) -> None:
    """Compute the wear of one order."""
    values = evolution_stages.wear(cfg, results.read(bogie_simulation))
    results.save(output, "wear", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            bogie_simulation=snakemake.input.bogie_simulation,
        )
