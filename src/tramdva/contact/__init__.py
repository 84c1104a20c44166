"""Wheel-rail contact: profiles, geometry, normal and tangential forces of one patch.

Read in this order: `profiles` (shapes), `geometry` (where they touch), `hertz` (normal
force and ellipse), `kalker` and `fastsim` (creep forces), `patch` (all of it for one wheel,
as one compiled call for a vehicle model). Physics, axes and accuracy: `docs/contact.md`.
"""
