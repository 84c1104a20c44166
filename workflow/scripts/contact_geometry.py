"""Contact tables of the line's profiles."""

from tramdva import job, results
from tramdva.bogie import line
from tramdva.contact.measured_profile import measured_profile


def main(
    *, output: str, code: str, cfg: dict, measured_wheel: str | None, measured_rail: str | None
) -> None:
    """Compute the contact tables."""
    files = {"wheel": measured_wheel, "rail": measured_rail}
    profiles = {
        kind: measured_profile(path, kind, cfg["contact_geometry"][kind]["measured_noise"])
        for kind, path in files.items()
        if path
    }
    values = line.contact_geometry(cfg, **profiles)
    results.save(output, "contact_geometry", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            measured_wheel=snakemake.input.get("measured_wheel") or None,
            measured_rail=snakemake.input.get("measured_rail") or None,
        )
