"""Variables of `basic_model.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.shared import CURVING_STATUS

# What the bogie gives to the basic model: unit and meaning.
QUANTITIES = {
    "r_C": ("m", "curve radius at the outer wheel"),
    "gamma": ("rad", "angle of attack, negative"),
    "outer_speed": ("m/s", "running speed of the outer wheel"),
    "F_N": ("N", "normal force at the inner wheel"),
    "a": ("m", "semi-axis of the inner wheel's contact patch along the rail"),
    "b": ("m", "semi-axis of the inner wheel's contact patch across the rail"),
    "c_22": ("1", "Kalker's coefficient C22 of this patch"),
    "m_A": ("kg", "reduced mass of axle and wheel hub"),
    "m_R": ("kg", "equivalent mass of the wheel rim"),
    "c_A": ("N/m", "effective stiffness of axle and primary suspension"),
    "d_A": ("N s/m", "effective damping of axle and primary suspension"),
    "c_R": ("N/m", "effective stiffness of the resilient wheel"),
    "d_R": ("N s/m", "effective damping of the resilient wheel"),
    "m_T": ("kg", "mass of the absorber"),
    "c_T": ("N/m", "stiffness of the absorber"),
    "d_T": ("N s/m", "damping of the absorber"),
}
REDUCTION_STATUS = ("derived", *CURVING_STATUS[1:], "no_attack", "no_mode", "no_chain")

VARIABLES = Stage(
    "basic_model",
    "The basic model of the line: what its file gives, and the reduction of its bogie",
    {
        **{name: real("", unit, meaning) for name, (unit, meaning) in QUANTITIES.items()},
        **{
            f"reduced_{name}": real("", unit, f"{meaning}, from the bogie")
            for name, (unit, meaning) in QUANTITIES.items()
        },
        "quantity": text("quantity", "symbol of a value of the basic model"),
        "given": truth("quantity", "whether the line's file gives it"),
        "mode": text("mode", "mode of the vehicle that the reduction keeps"),
        "mode_frequency": real("mode", "Hz", "its frequency without creep force at the wheel"),
        "mode_growth_rate": real("mode", "s-1", "its growth rate"),
        "mode_mass": real("mode", "kg", "its modal mass at the contact point of the inner wheel"),
        "critical_mode": text(
            "", "mode that vibrates by itself without absorbers, else second bending"
        ),
        "critical_frequency": real("", "Hz", "its frequency"),
        "critical_growth_rate": real("", "s-1", "its growth rate"),
        "critical_likeness": real(
            "", "1", "likeness of its shape and the paper's second bending, NaN: another"
        ),
        "band_min": real("", "Hz", "lower end of the band about it that absorbers are for"),
        "band_max": real("", "Hz", "upper end of this band"),
        "peak": text("peak", "mode behind a peak of figure 10"),
        "peak_min": real("peak", "Hz", "lower end of its band"),
        "peak_max": real("peak", "Hz", "upper end of its band"),
        "band_reason": text("", "why there is no band; empty where there is one"),
        "status": flag("", REDUCTION_STATUS, "how the reduction ended"),
        "reason": text("", "why the line has no basic model; empty where it has one"),
    },
)
