"""Stability maps of figure 2."""

from tramdva.results import make
from tramdva.stages import stability_map

if __name__ == "__main__":
    make(snakemake, stability_map)
