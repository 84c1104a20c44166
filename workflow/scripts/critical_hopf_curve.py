"""Critical Hopf curve of figure 5."""

from tramdva.results import make
from tramdva.stages import critical_hopf_curve

if __name__ == "__main__":
    make(snakemake, critical_hopf_curve)
