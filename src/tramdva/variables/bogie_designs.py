"""Variables of `bogie_designs.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import CURVING_STATUS, PEAK_STATUS

SELF_EXCITATIONS = ("stable", "self_excited", "no_oscillation", "no_equilibrium")

VARIABLES = Stage(
    "bogie_designs",
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
        "band_tendency": real(
            "d_T c_T wheel", "1", "largest tendency in this band, looked at finely near the modes"
        ),
        "none_band_tendency": real("wheel", "1", "the same without absorbers"),
        "band_factor": real(
            "d_T c_T wheel", "1", "largest tendency in this band over that without absorbers"
        ),
        "worst_band_factor": real(
            "d_T c_T",
            "1",
            "largest tendency in this band on any wheel over that without absorbers, NaN: "
            "self-excited in operation",
        ),
        "best_c_T": real("", "N m/rad", "stiffness of the least of these factors, NaN: none"),
        "best_d_T": real("", "N m s/rad", "its damping"),
        "largest_tendency": real("wheel", "1", "largest absolute tendency without absorbers"),
    },
)
