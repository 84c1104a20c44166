"""Variables of the result files from wheels out of round to the evolution tendency."""

from __future__ import annotations

from tramdva.bogie_variables import BOGIE_ABSORBERS, CURVING_STATUS
from tramdva.result_variables import Stage, flag, real, text, truth

WAVE_STATUS = ("periodic", "not_periodic", "contact_lost", "outside_profile", "not_finite")
PEAK_STATUS = ("found", "no_peak")

STAGES: dict[str, Stage] = {
    "bogie_linearisation": Stage(
        "The bogie linearised in its curve without self-excitation, wheels out of round included",
        {
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
    ),
    "bogie_simulation": Stage(
        "Contacts of wheels with a wave of one order over whole revolutions",
        {
            "order": real("", "1", "waves around the wheel"),
            "frequency": real("", "Hz", "frequency of the waves"),
            "wheel": text("wheel", "wheel out of round"),
            "zone": text("zone", "zone of the profile"),
            "speed": real("", "m/s", "speed of the vehicle"),
            "wheel_radius": real("", "m", "rolling radius r_0"),
            "kalker_table": real("kalker_node kalker_column", "1", "Kalker's creep coefficients"),
            "shear_modulus": real("", "N/m^2", "shear modulus"),
            "amplitude_real": real("", "m", "complex amplitude of the waves"),
            "amplitude_imag": real("", "m", "its imaginary part"),
            "time": real("time", "s", "time"),
            "wheel_angle": real(
                "time", "rad", "angle of the material point below the wheel centre"
            ),
            "radius_deviation": real("wheel time", "m", "radius deviation at the wheel angle"),
            "rolling_speed": real("wheel", "m/s", "speed of the wheels along their rails"),
            **{
                name: real("wheel zone time", unit, meaning)
                for name, unit, meaning in (
                    ("normal_force", "N", "normal force, zero when apart"),
                    ("contact_angle", "rad", "angle of the contact plane"),
                    ("longitudinal_creepage", "1", "longitudinal creepage"),
                    ("lateral_creepage", "1", "lateral creepage"),
                    ("spin_creepage", "m-1", "spin creepage"),
                    ("friction", "1", "coefficient of friction"),
                    ("semi_axis_longitudinal", "m", "semi-axis along the rail"),
                    ("semi_axis_lateral", "m", "semi-axis across the rail"),
                    ("forward_shift", "m", "contact ahead of the wheel's centre"),
                    ("wheel_lead", "m", "contact ahead of its circle's lowest point"),
                )
            },
            "transient": real("", "1", "revolutions before the output"),
            "difference": real("", "1", "of the last revolution from its limit, over the response"),
            "status": flag("", WAVE_STATUS, "how the run ended"),
        },
    ),
    "wear": Stage(
        "KTH wear of the wheels by the contacts of one order",
        {
            "order": real("", "1", "waves around the wheel"),
            "frequency": real("", "Hz", "frequency of the waves"),
            "wheel": text("wheel", "wheel out of round"),
            "amplitude": real("", "m", "amplitude of the waves"),
            "angle": real("angle", "rad", "wheel angle of the material point"),
            "radius_deviation": real("wheel angle", "m", "radius deviation, crest positive"),
            "wear_depth": real("wheel angle", "m", "depth worn away per revolution, mean width"),
            "patch_width": real("wheel", "m", "mean width over which the wear is averaged"),
            "mean_wear_depth": real("wheel", "m", "mean depth per revolution"),
            "wear_amplitude": real("wheel", "m", "amplitude of the depth at the order"),
            "wear_phase": real("wheel", "rad", "its phase against the crest"),
            "harmonic_distortion": real(
                "wheel", "1", "effective value of twice, three ... times the order over its own"
            ),
            "region": text("region", "region of the wear chart, adhesion last"),
            "region_share": real("wheel region", "1", "share of time and patch in the region"),
            "region_share_range": real("wheel region", "1", "largest less smallest share of patch"),
            "region_changes": truth(
                "wheel", "whether the largest region of the sliding patch changes in a period"
            ),
            "status": flag("", WAVE_STATUS, "status of the simulation"),
        },
    ),
    "evolution_tendency": Stage(
        "Wear response and evolution tendency of wheel orders (figure 10)",
        {
            **BOGIE_ABSORBERS,
            "wheel": text("wheel", "wheel out of round"),
            "order": real("order", "1", "waves around the wheel"),
            "frequency": real("order", "Hz", "frequency of the order"),
            **{
                name: real("absorber wheel order", unit, meaning)
                for name, unit, meaning in (
                    ("wear_response_amplitude", "1", "wear depth per revolution over deviation"),
                    ("wear_response_phase", "rad", "phase of the wear against the crest"),
                    ("evolution_tendency", "1", "-cos(phase) amplitude, growth per revolution"),
                    ("evolution_tendency_normalised", "1", "over the largest without absorber"),
                    ("mean_wear_depth", "m", "mean depth per revolution"),
                    ("harmonic_distortion", "1", "harmonics of the wear over the order's own"),
                )
            },
            "region_changes": truth("absorber wheel order", "whether the wear region changes"),
            "level": real("wheel order", "dB", "level of the radius deviation re 1 um"),
            "level_after": real(
                "absorber wheel order", "dB", "level after the study's number of revolutions"
            ),
            "status": flag("absorber order", WAVE_STATUS, "status of the simulation"),
            "frequency_axis": real("frequency_axis", "Hz", "frequency of the linearised vehicle"),
            "order_axis": real("frequency_axis", "1", "the order of this frequency"),
            "linearised_wear_response_real": real(
                "absorber wheel frequency_axis", "1", "wear response of the linearised vehicle"
            ),
            "linearised_wear_response_imag": real(
                "absorber wheel frequency_axis", "1", "its imaginary part"
            ),
            "linearised_evolution_tendency": real(
                "absorber wheel frequency_axis", "1", "evolution tendency, growth per revolution"
            ),
            "linearised_normalised": real(
                "absorber wheel frequency_axis", "1", "over the largest without absorber"
            ),
            "order_linearised_real": real(
                "absorber wheel order", "1", "linearised wear response at the orders"
            ),
            "order_linearised_imag": real("absorber wheel order", "1", "its imaginary part"),
            "linearised_mean_wear_depth": real("absorber wheel", "m", "mean depth in equilibrium"),
            "peak": text("peak", "positive peak, by the mode behind it"),
            "peak_frequency": real("absorber wheel peak", "Hz", "frequency of the peak"),
            "peak_tendency": real("absorber wheel peak", "1", "largest tendency near it"),
            "peak_order_tendency": real("absorber wheel peak", "1", "the same at whole orders"),
            "peak_factor": real("absorber wheel peak", "1", "tendency over that without absorber"),
            "peak_order_factor": real("absorber wheel peak", "1", "the same at whole orders"),
            "peak_status": flag("absorber wheel peak", PEAK_STATUS, "whether there is a peak"),
        },
    ),
    "tendency_maps": Stage(
        "Evolution tendency over speed, curve radius and absorber, linearised",
        {
            **BOGIE_ABSORBERS,
            "wheel": text("wheel", "wheel out of round"),
            "frequency": real("frequency", "Hz", "frequency"),
            "speed": real("speed", "m/s", "speed of the vehicle"),
            "speed_tendency": real(
                "absorber wheel speed frequency", "1", "evolution tendency per revolution"
            ),
            "speed_growth_rate": real(
                "absorber speed", "s-1", "largest growth rate in the band of design"
            ),
            "speed_status": flag("absorber speed", CURVING_STATUS, "status of the equilibrium"),
            "radius": real("radius", "m", "curve radius"),
            "radius_tendency": real(
                "absorber wheel radius frequency", "1", "evolution tendency per revolution"
            ),
            "radius_growth_rate": real(
                "absorber radius", "s-1", "largest growth rate in the band of design"
            ),
            "radius_status": flag("absorber radius", CURVING_STATUS, "status of the equilibrium"),
            "map_d_T": real("map_d_T", "N m s/rad", "damping of the absorber"),
            "map_c_T": real("map_c_T", "N m/rad", "stiffness of the absorber"),
            "map_factor": real(
                "wheel map_d_T map_c_T",
                "1",
                "largest tendency near the second bending mode over that without absorber",
            ),
            "map_worst_factor": real("map_d_T map_c_T", "1", "of the wheels, the largest factor"),
        },
    ),
}
