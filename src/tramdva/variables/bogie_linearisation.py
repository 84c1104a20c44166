"""Variables of `bogie_linearisation.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import CURVING_STATUS

VARIABLES = Stage(
    "bogie_linearisation",
    "The bogie linearised in its curve without self-excitation, wheels out of round included",
    {
        "absorber": text("", "absorber of the bogie"),
        "m_T": real("", "kg m^2", "inertia of the absorber (kg if it translates)"),
        "c_T": real("", "N m/rad", "stiffness of the absorber (N/m if it translates)"),
        "d_T": real("", "N m s/rad", "damping of the absorber (N s/m if it translates)"),
        "wheel": text("wheel", "wheel"),
        "zone": text("zone", "zone of the profile"),
        "speed": real("", "m/s", "speed of the vehicle"),
        "wheel_radius": real("", "m", "rolling radius r_0"),
        "lateral_position": real("wheel", "m", "wheel centres from the track centre, left"),
        "tape_circle": real("", "m", "tape circle outboard of the wheel centre"),
        "rail": real("", "m", "top of the rail outside the tape circle"),
        "friction": real("friction_number", "1", "mu_0, A and B (s/m)"),
        "modulus": real("", "N/m^2", "E* of wheel and rail"),
        "shear_modulus": real("", "N/m^2", "shear modulus"),
        "hertz_table": real("hertz_node hertz_column", "1", "table of the Hertzian ellipse"),
        "kalker_table": real("kalker_node kalker_column", "1", "Kalker's creep coefficients"),
        "patch_cells": real("direction", "1", "cells of the patch along, strips across"),
        "creep_law": text("", "law of the creep forces"),
        "creep_linear_table": real(
            "creep_node creep_column", "1", "creep coefficients of the half-space, C11 and C22"
        ),
        "rolling_speed": real("wheel", "m/s", "speed of the wheels along their rails"),
        "curvature": real("frame", "m-1", "curvature at bogie centre, front and rear axle"),
        "eigenvalue_real": real("mode", "s-1", "growth rate of the modes"),
        "eigenvalue_imag": real("mode", "s-1", "angular frequency of the modes"),
        "output": real("modal local", "1", "local variables of contacts per modal state"),
        "forcing": real("contact_force modal", "1", "modal forcing per contact force"),
        "local": real("local", "1", "local variables of the contacts in equilibrium, SI"),
        "force": real("contact_force", "1", "forces of the contacts in equilibrium, SI"),
        "jacobian": real("contact_force local", "1", "derivatives of these forces, SI"),
        "contact": real("wheel zone result", "1", "results of the contacts, SI"),
        "contact_per_local": real(
            "wheel zone result wheel_local", "1", "their derivatives in the wheel's variables"
        ),
        "contact_per_deviation": real(
            "wheel zone result deviation", "1", "and in radius deviation (m) and its rate (m/s)"
        ),
        "force_per_deviation": real(
            "wheel zone wheel_force deviation", "1", "derivatives of the forces in the same"
        ),
        "residual": real("", "m/s^2", "largest remaining acceleration of the equilibrium"),
        "status": flag("", CURVING_STATUS, "status of the equilibrium"),
    },
)
