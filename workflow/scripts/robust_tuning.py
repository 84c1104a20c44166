"""Nominal and robust optimum of the absorber over the robustness sample."""

from tramdva.results import make
from tramdva.stages import robust_tuning

if __name__ == "__main__":
    make(snakemake, robust_tuning)
