"""Simulation of the bogie with wheels out of round by one order."""

from tramdva.results import make
from tramdva.stages import bogie_simulation

if __name__ == "__main__":
    make(snakemake, bogie_simulation)
