"""Ride of the bogie into the curve, figure 9."""

from tramdva.results import make
from tramdva.stages import curve_entry

if __name__ == "__main__":
    make(snakemake, curve_entry)
