"""Evolution tendency and self-excitation of the bogie with any absorber."""

from tramdva.results import make
from tramdva.stages import bogie_designs

if __name__ == "__main__":
    make(snakemake, bogie_designs)
