"""Nominal and robust optimum of the absorber over the robustness sample."""

from tramdva import job, results
from tramdva import robust_tuning as tuning


def main(*, output: str, code: str, cfg: dict, robustness_sample: list[str]) -> None:
    """Search the absorbers and tell what they leave in every case."""
    values = tuning.robust_tuning(cfg, [results.read(path) for path in robustness_sample])
    results.save(output, "robust_tuning", values, parameters=cfg, code=code)


if __name__ == "__main__":
    with job.logging_to(snakemake.log[0]):
        main(
            output=snakemake.output[0],
            code=snakemake.params.code,
            cfg=snakemake.params.cfg,
            robustness_sample=snakemake.input.robustness_sample,
        )
