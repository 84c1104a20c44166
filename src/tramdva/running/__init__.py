"""What runs the stages beside Snakemake: code hashes, compiled kernels, supervision, logs."""
