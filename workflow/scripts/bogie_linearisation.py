"""The bogie linearised in its curve, with wheels out of round."""

from tramdva import job, results
from tramdva.bogie import stages


def main(
    *, output: str, code: str, cfg: dict, contact_geometry: str, curving_equilibrium: str | None
) -> None:
    """Linearise the bogie with one absorber; the tuned one is in ``curving_equilibrium``."""
    tuned = None
    if curving_equilibrium is not None:
        designs = results.read(curving_equilibrium)
        k = list(designs["absorber"]).index("tuned")
        tuned = float(designs["c_T"][k]), float(designs["d_T"][k])
    values = stages.bogie_linearisation(cfg, results.read(contact_geometry), tuned)
    results.save(output, "bogie_linearisation", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            contact_geometry=snakemake.input.contact_geometry,
            curving_equilibrium=snakemake.input.get("curving_equilibrium") or None,
        )
