"""Cycle amplitudes of figure 6."""

from tramdva.results import make
from tramdva.stages import cycle_amplitudes

if __name__ == "__main__":
    make(snakemake, cycle_amplitudes)
