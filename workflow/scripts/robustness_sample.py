"""A part of the robustness sample: the bogie under varied conditions."""

from tramdva.results import make
from tramdva.stages import robustness_sample

if __name__ == "__main__":
    make(snakemake, robustness_sample)
