"""Hopf points of figure 3."""

from tramdva.results import make
from tramdva.stages import hopf_points

if __name__ == "__main__":
    make(snakemake, hopf_points)
