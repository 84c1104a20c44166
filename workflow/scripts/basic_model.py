"""Basic model of the line, from its file and its bogie."""

from tramdva.results import make
from tramdva.stages import basic_model

if __name__ == "__main__":
    make(snakemake, basic_model)
