"""Variables of `robustness_sample.nc`."""

from __future__ import annotations

from tramdva.variables.kinds import Stage, Variable, flag, real
from tramdva.variables.shared import CASE_STATUS, CASES


def _complex(name: str, dimensions: str, unit: str, long_name: str) -> dict[str, Variable]:
    """Describe a complex variable, kept as two."""
    return {
        f"{name}_real": real(dimensions, unit, long_name),
        f"{name}_imag": real(dimensions, unit, "its imaginary part"),
    }


VARIABLES = Stage(
    "robustness_sample",
    "The bogie without absorbers under varied conditions, as its absorbers see it",
    {
        **CASES,
        "status": flag("case", CASE_STATUS, "status of the equilibria"),
        "speed": real("case", "m/s", "speed of the vehicle"),
        "unsprung_mass": real("", "kg", "axle with its wheels as configured"),
        "frequency": real("case node", "Hz", "frequency"),
        "bare_growth_rate": real("case friction", "s-1", "largest growth rate without absorbers"),
        **_complex(
            "bare_wear_by_wave", "case node wheel", "1", "wear response to waves without absorbers"
        ),
        **_complex(
            "bare_place_by_wave", "case node place", "rad/m", "motion of their places without them"
        ),
        # The others with the mass of translating absorbers across their direction, and its weight.
        **_complex("wear_by_wave", "case node wheel", "1", "wear response to waves"),
        **_complex(
            "wear_by_force",
            "case node wheel place",
            "(N m)-1 m",
            "wear by torques (forces) of the absorbers",
        ),
        **_complex("place_by_wave", "case node place", "rad/m", "motion of their places by waves"),
        **_complex(
            "place_by_force",
            "case node place other_place",
            "rad/(N m)",
            "motion of their places by torques (forces) there",
        ),
        **_complex("eigenvalue", "case friction mode", "s-1", "eigenvalue, NaN beyond the last"),
        **_complex(
            "mode_place", "case friction carrier mode", "1", "motion of the places per mode, SI"
        ),
        **_complex(
            "mode_forcing", "case friction mode carrier", "1", "forcing of the mode there, SI"
        ),
    },
)
