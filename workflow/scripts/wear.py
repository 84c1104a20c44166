"""KTH wear around the wheels by the contacts of one order."""

from tramdva.results import make
from tramdva.stages import wear

if __name__ == "__main__":
    make(snakemake, wear)
