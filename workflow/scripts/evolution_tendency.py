"""Wear response and evolution tendency, figure 10."""

from tramdva import evolution_stages, job, results


def main(
    *, output: str, code: str, cfg: dict, bogie_linearisation: list[str], wear: list[str]
) -> None:
    """Compute the tendency; files of all absorbers, and of all orders of each, in order."""
    absorbers = cfg["study"]["absorbers"]
    linear = [results.read(path) for path in bogie_linearisation]
    count = len(wear) // len(absorbers)
    worn = [results.read(path) for path in wear]
    values = evolution_stages.evolution_tendency(
        cfg,
        dict(zip(absorbers, linear, strict=True)),
        {name: worn[k * count : (k + 1) * count] for k, name in enumerate(absorbers)},
    )
    results.save(output, "evolution_tendency", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            bogie_linearisation=snakemake.input.bogie_linearisation,
            wear=snakemake.input.wear,
        )
