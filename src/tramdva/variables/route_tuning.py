"""Variables of `route_tuning.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, flag, real, text, truth

ROUTE_TUNING_STATUS = ("found", "not_quiet", "no_design", "no_steady_answer")

VARIABLES = Stage(
    "route_tuning",
    "The absorber that buys the most kilometres on the route, by material, mass and detuning",
    {
        "wear_law": text("", "law of wear by which is searched"),
        "bare_distance": real("", "km", "distance without absorbers, by the energy of the waves"),
        "material": text("material", "material of the absorber's spring"),
        "material_c_T": real("material", "N m/rad", "its best stiffness (N/m if it translates)"),
        "material_d_T": real("material", "N m s/rad", "its damping (N s/m if it translates)"),
        "temperature": text("temperature", "of the material"),
        "material_distance": real(
            "material temperature", "km", "distance, by the energy of the waves"
        ),
        "material_status": flag("material", ROUTE_TUNING_STATUS, "how the search ended"),
        "best_material": text("", "material with the longest distance, empty: none"),
        "I_T": real("", "kg m^2", "inertia of the absorber (kg if it translates)"),
        "c_T": real("", "N m/rad", "stiffness of the best absorber (N/m if it translates)"),
        "d_T": real("", "N m s/rad", "damping of the best absorber (N s/m if it translates)"),
        "status": flag("", ROUTE_TUNING_STATUS, "how the search ended"),
        "quiet": truth("", "whether no condition of the route vibrates by itself in operation"),
        "mass_share": real("mass_share", "1", "inertia over the line's"),
        "mass_c_T": real("mass_share", "N m/rad", "best stiffness (N/m if it translates)"),
        "mass_d_T": real("mass_share", "N m s/rad", "its damping (N s/m if it translates)"),
        "mass_distance": real("mass_share", "km", "distance at its worst temperature"),
        "stiffness_share": real("stiffness_share", "1", "stiffness over that of the best"),
        "detuned_distance": real("stiffness_share", "km", "distance with this stiffness"),
    },
)
