"""Modes and self-excitation of the bogie."""

from tramdva.results import make
from tramdva.stages import bogie_modes

if __name__ == "__main__":
    make(snakemake, bogie_modes)
