"""Contact tables of the line's profiles."""

from tramdva.results import make
from tramdva.stages import contact_geometry

if __name__ == "__main__":
    make(snakemake, contact_geometry)
