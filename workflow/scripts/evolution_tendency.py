"""Wear response and evolution tendency, figure 10."""

from tramdva.results import make
from tramdva.stages import evolution_tendency

if __name__ == "__main__":
    make(snakemake, evolution_tendency)
