"""Variables of `polygon_simulation.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text
from tramdva.variables.shared import BOGIE_ABSORBERS, WAVE_STATUS

SIMULATION_STATUS = (
    "limit_reached",
    "saturated",
    "horizon",
    "step_limit",
    "not_periodic",
    "outside_profile",
    "not_finite",
    "no_equilibrium",
    "self_excited",
)
ORDER_KINDS = ("grows_by_itself", "driven_by_others", "does_not_grow", "not_examined")

VARIABLES = Stage(
    "polygon_simulation",
    "A wheel that wears on in one running condition, all orders at once",
    {
        **BOGIE_ABSORBERS,
        "condition": text("", "running condition in which the fastest order grows most"),
        "radius": real("", "m", "its curve radius, NaN on straight track"),
        "speed": real("", "m/s", "its speed"),
        "wheel": text("", "wheel of the vehicle, seen from its end A"),
        "place": text("", "where this wheel runs in the bogie there"),
        "spin": real("absorber", "rad/s", "rate of turning of the wheel"),
        "distance_share": real("", "1", "share of the route's distance run in this condition"),
        "revolutions_per_km": real("absorber", "km-1", "revolutions of the wheel"),
        "wear_law": text("", "law of wear"),
        "wear_scale": real("", "1", "measured wear of the tread over that by the law"),
        "order": real("order", "1", "waves around the wheel"),
        "small_response_real": real(
            "absorber order", "1", "wear response per revolution of small waves, real part"
        ),
        "small_response_imag": real("absorber order", "1", "the same, imaginary part"),
        "distance": real("absorber point", "km", "distance in this condition"),
        "amplitude_real": real("absorber point order", "m", "amplitude of the order, real part"),
        "amplitude_imag": real("absorber point order", "m", "amplitude, imaginary part"),
        "level": real("absorber point order", "dB", "level, re 1 um"),
        "small_wave_level": real("absorber point order", "dB", "level if all waves were small"),
        "described_level": real(
            "absorber point rank",
            "dB",
            "level by the describing function, each order by itself; NaN beyond its amplitudes",
        ),
        "peak_to_peak": real("absorber point", "m", "out-of-roundness, peak to peak"),
        "mean_wear": real("absorber point", "m", "mean loss of radius"),
        "limit": real("", "m", "out-of-roundness at which wheels are turned, peak to peak"),
        "distance_to_limit": real("absorber", "km", "distance to the limit, NaN where none"),
        "small_wave_distance_to_limit": real(
            "absorber", "km", "the same if all waves were small, NaN where none"
        ),
        "distance_to_lifting": real(
            "absorber", "km", "distance from which the wheel leaves the rail at times, or NaN"
        ),
        "angle": real("angle", "rad", "material point of the wheel"),
        "last_profile": real("absorber angle", "m", "radius deviation at the end of the run"),
        "examined_distance": real("absorber", "km", "distance at which orders are told apart"),
        "growth_per_1000_km": real(
            "absorber order", "1", "growth there of large orders, e-folds; NaN for the others"
        ),
        "own_growth_per_1000_km": real(
            "absorber order", "1", "part of it that is proportional to the order"
        ),
        "order_kind": flag(
            "absorber order", ORDER_KINDS, "whether an order grows by itself or by others' waves"
        ),
        "described_order": real(
            "absorber rank", "1", "orders alone on the wheel, those that grow fastest"
        ),
        "wave_amplitude": real("wave_amplitude", "m", "their amplitudes"),
        "described_response_real": real(
            "absorber rank wave_amplitude",
            "1",
            "wear response per revolution over the amplitude (describing function), real part",
        ),
        "described_response_imag": real(
            "absorber rank wave_amplitude", "1", "the same, imaginary part"
        ),
        "harmonics": real(
            "absorber rank wave_amplitude",
            "1",
            "effective value of the harmonics in the wear, over that of the order",
        ),
        "described_status": flag("absorber rank wave_amplitude", WAVE_STATUS, "of the simulation"),
        "saturation_amplitude": real(
            "absorber rank",
            "m",
            "amplitude at which a tenth of the growth of small waves is left, NaN where none",
        ),
        "status": flag("absorber", SIMULATION_STATUS, "how the run ended"),
        "evaluations": real("absorber", "1", "steady revolutions that were simulated"),
        "friction_decrease": real(
            "", "s/m", "B of the friction, of forced excitation: without self-excitation"
        ),
        "self_excited_in_operation": flag(
            "absorber",
            ("stable", "self_excited", "no_equilibrium"),
            "whether the vehicle there vibrates by itself at the friction of operation: then its "
            "limit cycle wears the wheels as well and the results do not hold",
        ),
    },
)
