"""Variables of `wheelset_designs.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real
from tramdva.variables.shared import INSTABILITIES

VARIABLES = Stage(
    "wheelset_designs",
    "Stability and frequency response of the wheelset over its absorber's c_T and d_T",
    {
        "d_T": real("d_T", "N s/m", "damping of the absorber"),
        "c_T": real("c_T", "N/m", "stiffness of the absorber"),
        "m_T": real("", "kg", "mass of the absorber"),
        "own_d_T": real("", "N s/m", "damping of the line's absorber"),
        "own_c_T": real("", "N/m", "stiffness of the line's absorber"),
        "c_R": real("c_R", "N/m", "stiffness of the resilient wheel"),
        "c_A": real("c_A", "N/m", "stiffness of axle and primary suspension"),
        "baseline_c_R": real("", "N/m", "stiffness of the resilient wheel of the line"),
        "baseline_c_A": real("", "N/m", "stiffness of axle and suspension of the line"),
        "frequency": real("frequency", "Hz", "frequency"),
        **{
            f"{prefix}{name}": variable
            for prefix, design in (("", "d_T c_T "), ("none_", ""))
            for name, variable in (
                ("growth_rate", real(design, "s-1", "largest growth rate in operation")),
                ("leading_frequency", real(design, "Hz", "frequency of its eigenvalue")),
                ("instability", flag(design, INSTABILITIES, "kind of instability")),
                (
                    "forced_instability",
                    flag(design, INSTABILITIES, "the same at the B of forced excitation"),
                ),
                (
                    "receptance_amplitude",
                    real(f"{design}frequency", "m/N", "receptance of the rim if steady"),
                ),
                ("peak_receptance", real(design, "m/N", "largest receptance if steady")),
                ("peak_frequency", real(design, "Hz", "its frequency")),
                (
                    "map_growth_rate",
                    real(f"{design}c_R c_A", "s-1", "largest growth rate, NaN: no equilibrium"),
                ),
            )
        },
        "reduction": real(
            "d_T c_T", "1", "peak receptance without absorber over that with, NaN: self-excited"
        ),
        "best_c_T": real("", "N/m", "stiffness of the stable design of lowest peak, NaN: none"),
        "best_d_T": real("", "N s/m", "its damping"),
    },
)
