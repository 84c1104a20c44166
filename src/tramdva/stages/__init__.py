"""One module per rule: configuration and earlier results in, variables of a result file out."""
