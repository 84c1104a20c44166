"""Figures, tables, design sheet and explorer, for the scripts in `paper_figures`."""
