"""Wear of a wheel by the passage of its contact."""
