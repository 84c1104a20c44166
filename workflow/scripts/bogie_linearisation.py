"""The bogie linearised in its curve, with wheels out of round."""

from tramdva.results import make
from tramdva.stages import bogie_linearisation

if __name__ == "__main__":
    make(snakemake, bogie_linearisation)
