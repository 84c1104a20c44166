"""How sure the growth rate of the bogie is."""

from tramdva.results import make
from tramdva.stages import growth_band

if __name__ == "__main__":
    make(snakemake, growth_band)
