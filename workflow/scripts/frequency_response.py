"""Frequency response of figure 7."""

from tramdva.results import make
from tramdva.stages import frequency_response

if __name__ == "__main__":
    make(snakemake, frequency_response)
