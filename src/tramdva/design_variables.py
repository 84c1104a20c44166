"""Variables of the result files over grids of absorber designs."""

from __future__ import annotations

from tramdva.bogie_variables import CURVING_STATUS
from tramdva.evolution_variables import PEAK_STATUS
from tramdva.result_variables import Stage, flag, real, text
from tramdva.wheelset_variables import INSTABILITIES

SELF_EXCITATIONS = ("stable", "self_excited", "no_oscillation", "no_equilibrium")

STAGES: dict[str, Stage] = {
    "wheelset_designs": Stage(
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
        },
    ),
    "bogie_designs": Stage(
        "Evolution tendency and self-excitation of the bogie over its absorbers' c_T and d_T",
        {
            "d_T": real("d_T", "N m s/rad", "damping of the absorber (N s/m if it translates)"),
            "c_T": real("c_T", "N m/rad", "stiffness of the absorber (N/m if it translates)"),
            "m_T": real("", "kg m^2", "inertia of the absorber (kg if it translates)"),
            "own_d_T": real("", "N m s/rad", "damping of the line's absorber"),
            "own_c_T": real("", "N m/rad", "stiffness of the line's absorber"),
            "wheel": text("wheel", "wheel out of round"),
            "frequency": real("frequency", "Hz", "frequency"),
            "order": real("frequency", "1", "the order of this frequency"),
            **{
                f"{prefix}{name}": variable
                for prefix, design in (("", "d_T c_T "), ("none_", ""))
                for name, variable in (
                    ("growth_rate", real(design, "s-1", "largest growth rate in operation")),
                    ("leading_frequency", real(design, "Hz", "its frequency")),
                    ("self_excitation", flag(design, SELF_EXCITATIONS, "whether it grows")),
                    (
                        "quiet_growth_rate",
                        real(design, "s-1", "the same at the B of forced excitation"),
                    ),
                    (
                        "quiet_self_excitation",
                        flag(design, SELF_EXCITATIONS, "whether it grows at this B"),
                    ),
                    (
                        "tendency",
                        real(f"{design}wheel frequency", "1", "evolution tendency if steady"),
                    ),
                )
            },
            "status": flag("", CURVING_STATUS, "status of the equilibrium without absorbers"),
            "band_status": flag("wheel", PEAK_STATUS, "whether waves grow in the band of design"),
            "band_factor": real(
                "d_T c_T wheel", "1", "largest tendency in this band over that without absorbers"
            ),
        },
    ),
}
