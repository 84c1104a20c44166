"""Steady running of the bogie in the curve."""

from tramdva import job, results
from tramdva.bogie import stages


def main(*, output: str, code: str, cfg: dict, contact_geometry: str, absorber_tuning: str) -> None:
    """Compute the equilibria without and with absorbers."""
    values = stages.curving_equilibrium(
        cfg, results.read(contact_geometry), results.read(absorber_tuning)
    )
    results.save(output, "curving_equilibrium", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            contact_geometry=snakemake.input.contact_geometry,
            absorber_tuning=snakemake.input.absorber_tuning,
        )
