"""The line at a glance, before anything that takes long."""

from tramdva.results import make
from tramdva.stages import preflight

if __name__ == "__main__":
    make(snakemake, preflight)
