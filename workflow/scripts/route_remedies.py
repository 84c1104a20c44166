"""What changes of the route buy, and what scatter of the speed leaves of an absorber's effect."""

from tramdva.results import make
from tramdva.stages import route_remedies

if __name__ == "__main__":
    make(snakemake, route_remedies)
