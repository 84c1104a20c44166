"""Wheel orders: out-of-roundness, wear response, evolution tendency (figure 10)."""
