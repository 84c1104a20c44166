"""Hopf points of figure 3."""

from tramdva import job, results, self_excitation


def main(*, output: str, code: str, cfg: dict, stability_map: str) -> None:
    """Locate the Hopf points over the stiffness of the axle."""
    values = self_excitation.hopf_points(cfg, results.read(stability_map))
    results.save(output, "hopf_points", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            stability_map=snakemake.input.stability_map,
        )
