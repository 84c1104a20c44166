"""Designs of the absorber, Table 2."""

from tramdva.results import make
from tramdva.stages import absorber_tuning

if __name__ == "__main__":
    make(snakemake, absorber_tuning)
