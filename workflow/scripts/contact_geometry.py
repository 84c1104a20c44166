"""Contact tables of the line's profiles."""

from tramdva import job, results
from tramdva.bogie import line
from tramdva.contact.measured_profile import measured_profile


def main(*, output: str, code: str, cfg: dict, scriptdir: str) -> None:
    """Compute the contact tables."""
    profiles = {}
    for kind in ("wheel", "rail"):
        given = cfg["contact_geometry"][kind]
        if given["measured"]:
            path = job.configuration_file(given["measured"], scriptdir)
            profiles[kind] = measured_profile(path, kind, given["measured_noise"])
    values = line.contact_geometry(cfg, **profiles)
    results.save(output, "contact_geometry", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            scriptdir=snakemake.scriptdir,
        )
