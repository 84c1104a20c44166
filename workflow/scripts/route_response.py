"""Wear of the wheels by their own waves on the route."""

from tramdva.results import make
from tramdva.stages import route_response

if __name__ == "__main__":
    make(snakemake, route_response)
