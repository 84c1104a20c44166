"""Evolution tendency and self-excitation of the bogie with any absorber."""

from tramdva import bogie_designs as designs
from tramdva import job, results


def main(*, output: str, code: str, cfg: dict, contact_geometry: str) -> None:
    """Compute the grid of designs of a line."""
    values = designs.bogie_designs(cfg, results.read(contact_geometry))
    results.save(output, "bogie_designs", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            contact_geometry=snakemake.input.contact_geometry,
        )
