"""Bifurcation analysis of smooth systems x' = f(x, p): Hopf points, curves and limit cycles."""
