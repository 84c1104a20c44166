"""Hopf curves of figure 4."""

from tramdva.results import make
from tramdva.stages import hopf_curves

if __name__ == "__main__":
    make(snakemake, hopf_curves)
