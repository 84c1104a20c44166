"""Simulation of the bogie with wheels out of round by one order."""

from tramdva import job, results
from tramdva.bogie import simulation_stage
from tramdva.out_of_roundness import read_measurement


def main(
    *,
    output: str,
    code: str,
    cfg: dict,
    order: int,
    contact_geometry: str,
    bogie_linearisation: str,
    scriptdir: str,
) -> None:
    """Simulate whole revolutions."""
    measured = cfg["out_of_roundness"]["measured"]
    values = simulation_stage.bogie_simulation(
        cfg,
        order,
        results.read(contact_geometry),
        results.read(bogie_linearisation),
        read_measurement(job.configuration_file(measured, scriptdir)) if measured else None,
    )
    results.save(output, "bogie_simulation", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            order=int(snakemake.wildcards.order),
            contact_geometry=snakemake.input.contact_geometry,
            bogie_linearisation=snakemake.input.bogie_linearisation,
            scriptdir=snakemake.scriptdir,
        )
