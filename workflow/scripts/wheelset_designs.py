"""Stability and frequency response of the wheelset with any absorber."""

from tramdva.results import make
from tramdva.stages import wheelset_designs

if __name__ == "__main__":
    make(snakemake, wheelset_designs)
