"""Evolution tendency over speed, curve radius and absorber."""

from tramdva import job, results
from tramdva import tendency_maps as maps


def main(
    *, output: str, code: str, cfg: dict, contact_geometry: str, bogie_linearisation: list[str]
) -> None:
    """Compute the maps; the absorbers' values are those of their linearisations."""
    linear = [results.read(path) for path in bogie_linearisation]
    designs = [tuple(float(values[name]) for name in ("m_T", "c_T", "d_T")) for values in linear]
    values = maps.tendency_maps(
        cfg,
        results.read(contact_geometry),
        dict(zip(cfg["study"]["absorbers"], designs, strict=True)),
    )
    results.save(output, "tendency_maps", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            contact_geometry=snakemake.input.contact_geometry,
            bogie_linearisation=snakemake.input.bogie_linearisation,
        )
