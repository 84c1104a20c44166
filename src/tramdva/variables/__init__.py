"""One module per result file: names, dimensions, units and meanings of its variables."""
