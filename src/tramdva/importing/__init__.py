"""Routes out of the files that operators have: alignments, logs of speed and place."""
