"""The absorber that buys the most kilometres on the route."""

from tramdva.results import make
from tramdva.stages import route_tuning

if __name__ == "__main__":
    make(snakemake, route_tuning)
