"""Multibody model of the two-axle tram bogie in a curve.

Read in this order: `track` (where the frames of reference go), `axle` (the flexible axle bridge),
`vehicle` (bodies and joints, assembled), `running` (vehicle and wheel-rail contact as one compiled
right-hand side), `curving` (equilibrium, linearisation), `modes` (names, critical friction
decrease), `integration` (time integration), `curve_entry` (figure 9). Equations: `docs/bogie.md`.
"""
