"""Variables of `frequency_response.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import STATUS

VARIABLES = Stage(
    "frequency_response",
    "Frequency response of the rim to a force at the contact (figure 7)",
    {
        "design": text("design", "design, none first"),
        "m_T": real("design", "kg", "mass of the absorber"),
        "c_T": real("design", "N/m", "stiffness of the absorber"),
        "d_T": real("design", "N s/m", "damping of the absorber"),
        "status": flag("design", STATUS, "status of the design; without solution all is NaN"),
        "frequency": real("frequency", "Hz", "frequency"),
        "receptance_amplitude": real("design frequency", "m/N", "amplitude of receptance"),
        "receptance_phase": real("design frequency", "rad", "phase of receptance"),
        "stroke_amplitude": real("design frequency", "m/N", "stroke of the absorber per force"),
        "peak_frequency": real("peak", "Hz", "frequency of a peak without absorber"),
        "peak_receptance": real("peak", "m/N", "receptance there"),
        "y_R_equilibrium": real("", "m", "position of the rim in equilibrium"),
    },
)
