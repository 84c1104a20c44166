"""Evolution tendency over speed, curve radius and absorber."""

from tramdva.results import make
from tramdva.stages import tendency_maps

if __name__ == "__main__":
    make(snakemake, tendency_maps)
