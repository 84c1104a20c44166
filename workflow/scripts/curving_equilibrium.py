"""Steady running of the bogie in the curve."""

from tramdva.results import make
from tramdva.stages import curving_equilibrium

if __name__ == "__main__":
    make(snakemake, curving_equilibrium)
