"""Variables of `evolution_tendency.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.shared import BOGIE_ABSORBERS, PEAK_STATUS, WAVE_STATUS

VARIABLES = Stage(
    "evolution_tendency",
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
        "largest_tendency": real("wheel", "1", "largest absolute tendency without absorber"),
        "fastest_order": real(
            "wheel",
            "1",
            "order that grows fastest in the band of design without absorber, NaN: none ran",
        ),
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
        "band_tendency": real(
            "absorber wheel", "1", "largest linearised tendency in the band of design"
        ),
        "band_growth_left": real(
            "absorber", "1", "the same on any wheel over that without absorbers"
        ),
        "peak": text("peak", "positive peak, by the mode behind it"),
        "peak_frequency": real("absorber wheel peak", "Hz", "frequency of the peak"),
        "peak_tendency": real("absorber wheel peak", "1", "largest tendency near it"),
        "peak_tendency_normalised": real(
            "absorber wheel peak", "1", "the same over the largest without absorber"
        ),
        "peak_order_tendency": real("absorber wheel peak", "1", "the same at whole orders"),
        "peak_factor": real("absorber wheel peak", "1", "tendency over that without absorber"),
        "peak_order_factor": real("absorber wheel peak", "1", "the same at whole orders"),
        "peak_status": flag("absorber wheel peak", PEAK_STATUS, "whether there is a peak"),
    },
)
