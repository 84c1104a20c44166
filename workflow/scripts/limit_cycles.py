"""Limit cycles of figure 3."""

from tramdva.results import make
from tramdva.stages import limit_cycles

if __name__ == "__main__":
    make(snakemake, limit_cycles)
