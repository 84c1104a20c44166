"""From sections of the configuration to the bogie of a line."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie.parameters import BareBogie, Bogie, Track
from tramdva.bogie.tram import BogieLine, Running, absorber, changed, run_through
from tramdva.contact.parameters import ContactGeometry
from tramdva.contact.tables import stored_tables


def bogie_line(cfg: Mapping[str, Any], tables: Mapping[str, np.ndarray]) -> BogieLine:
    """Bogie of a line from its configuration and the variables of ``contact_geometry.nc``."""
    force, numerics = cfg["creep_force"], cfg["numerics"]
    bogie = Bogie if "absorber" in cfg["bogie"] else BareBogie
    return BogieLine(
        bogie.model_validate(cfg["bogie"]),
        Track.model_validate(cfg["track"]),
        ContactGeometry.model_validate(cfg["contact_geometry"]),
        (force["mu_0"], force["A"], force["B"]),
        stored_tables(tables),
        (numerics["cells_along"], numerics["strips"]),
        numerics["cutoff_frequency"],
        numerics["elements_per_section"],
    )


def quiet_bogie_line(cfg: Mapping[str, Any], tables: Mapping[str, np.ndarray]) -> BogieLine:
    """Bogie of a line with the friction of ``forced_excitation``: without self-excitation."""
    force = cfg["creep_force"] | cfg["forced_excitation"]
    return bogie_line({**cfg, "creep_force": force}, tables)


DESIGNS = ("none", "paper", "tuned")


def frequency_limits(cfg: Mapping[str, Any]) -> tuple[float, float]:
    """Frequencies in Hz within which oscillations count."""
    return cfg["study"]["frequency"]["min"], cfg["study"]["frequency"]["max"]


def known_runs(
    cfg: Mapping[str, Any], line: BogieLine, designs: Mapping[str, np.ndarray]
) -> list[Running]:
    """Equilibria of the designs in ``curving_equilibrium.nc``."""
    none = run_through(line)
    return [
        changed(line, absorber(line, c_T, d_T), none)
        for c_T, d_T in zip(designs["c_T"], designs["d_T"], strict=True)
    ]
