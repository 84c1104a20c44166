"""Where a figure or a number comes from: inventory, records, crate, archive."""
