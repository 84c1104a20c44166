"""Growth of wheel orders over kilometres of the route."""

from tramdva.results import make
from tramdva.stages import polygon_growth

if __name__ == "__main__":
    make(snakemake, polygon_growth)
