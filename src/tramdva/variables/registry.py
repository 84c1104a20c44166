"""The variables of every result file: name, dimensions, unit and meaning.

Others read the files by these names. A variable that bears the name of its only dimension is the
coordinate of this dimension. Texts are fixed-length strings, flags are int8 with `flag_values`
and `flag_meanings`; a truth is the flag `false true`. No stage imports this table, so that a
variable of one file concerns no other.
"""

from __future__ import annotations

from tramdva.variables import (
    absorber_tuning,
    basic_model,
    bogie_designs,
    bogie_linearisation,
    bogie_modes,
    bogie_simulation,
    contact_geometry,
    critical_hopf_curve,
    curve_entry,
    curving_equilibrium,
    cycle_amplitudes,
    evolution_tendency,
    frequency_response,
    growth_band,
    hopf_curves,
    hopf_points,
    limit_cycles,
    polygon_growth,
    polygon_simulation,
    preflight,
    robust_tuning,
    robustness_sample,
    route_remedies,
    route_response,
    route_tuning,
    stability_map,
    tendency_maps,
    wear,
    wheelset_designs,
)
from tramdva.variables.kinds import Stage

STAGES: dict[str, Stage] = {
    module.VARIABLES.name: module.VARIABLES
    for module in (
        stability_map,
        hopf_points,
        limit_cycles,
        hopf_curves,
        critical_hopf_curve,
        cycle_amplitudes,
        absorber_tuning,
        frequency_response,
        contact_geometry,
        basic_model,
        preflight,
        curving_equilibrium,
        bogie_modes,
        growth_band,
        curve_entry,
        bogie_linearisation,
        bogie_simulation,
        wear,
        evolution_tendency,
        tendency_maps,
        wheelset_designs,
        bogie_designs,
        robustness_sample,
        robust_tuning,
        route_tuning,
        route_response,
        route_remedies,
        polygon_growth,
        polygon_simulation,
    )
}
