"""Ride of the bogie into the curve, figure 9."""

from tramdva import job, results
from tramdva.bogie import stages


def main(
    *, output: str, code: str, cfg: dict, contact_geometry: str, curving_equilibrium: str
) -> None:
    """Integrate the ride without and with absorbers."""
    values = stages.curve_entry(
        cfg, results.read(contact_geometry), results.read(curving_equilibrium)
    )
    results.save(output, "curve_entry", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            contact_geometry=snakemake.input.contact_geometry,
            curving_equilibrium=snakemake.input.curving_equilibrium,
        )
