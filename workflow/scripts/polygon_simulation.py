"""A wheel that wears on in one running condition, all orders at once."""

from tramdva.results import make
from tramdva.stages import polygon_simulation

if __name__ == "__main__":
    make(snakemake, polygon_simulation)
