"""A part of the robustness sample: the bogie under varied conditions."""

from tramdva import job, results
from tramdva import robustness_sample as sample


def main(*, output: str, code: str, cfg: dict, contact_geometry: str, part: int) -> None:
    """Compute the cases of a part."""
    values = sample.robustness_sample(cfg, results.read(contact_geometry), part)
    results.save(output, "robustness_sample", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            contact_geometry=snakemake.input.contact_geometry,
            part=int(snakemake.wildcards.part),
        )
