"""The linearised bogie with wheels out of round as variables of a file, and back."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from tramdva.bogie import wheel_forces
from tramdva.bogie.integration import ModalContacts
from tramdva.bogie.names import WHEELS
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.contact import creep_table, fastsim, patch
from tramdva.contact.tables import zone_names

CREEP_LAWS = tuple(patch.METHODS)  # by their number
_PLACES = ("lateral_position", "tape_circle", "rail", "speed")


class StoredBogie(NamedTuple):
    """What ``bogie_linearisation`` holds.

    bogie : RoughBogie
    law : patch.ContactLaw; places : running.WheelPlaces; wheel_radius : m
    """

    bogie: RoughBogie
    law: patch.ContactLaw
    places: wheel_forces.WheelPlaces
    wheel_radius: float


def variables(
    bogie: RoughBogie, contacts: wheel_forces.Contacts, wheel_radius: float, grid: tuple[int, int]
) -> dict[str, np.ndarray]:
    """Variables of ``bogie_linearisation``; `grid`: cells along and strips of the patch."""
    places, law = contacts.places, contacts.law
    sensitivity = bogie.sensitivity
    return {
        "wheel": np.array(WHEELS),
        "zone": np.array(zone_names(bogie.results.shape[1])),
        **{name: np.asarray(getattr(places, name), float) for name in _PLACES},
        "wheel_radius": np.float64(wheel_radius),
        "friction": np.array(law.friction),
        "modulus": np.float64(law.modulus),
        "shear_modulus": np.float64(law.shear_modulus),
        "hertz_table": law.hertz_table,
        "kalker_table": law.kalker_table,
        "patch_cells": np.array(grid, float),
        "creep_law": np.array(CREEP_LAWS[law.method]),
        "creep_linear_table": law.creep_table.linear,
        "rolling_speed": bogie.rolling_speed,
        "curvature": bogie.curvatures,
        "eigenvalue_real": bogie.eigenvalue.real,
        "eigenvalue_imag": bogie.eigenvalue.imag,
        **bogie.modal._asdict(),
        "contact": bogie.results,
        "contact_per_local": sensitivity.local,
        "contact_per_deviation": sensitivity.deviation,
        "force_per_deviation": sensitivity.force,
    }


def stored_bogie(values: Mapping[str, np.ndarray]) -> StoredBogie:
    """Linearised bogie from the variables of its file."""
    modal = ModalContacts(*(values[name] for name in ModalContacts._fields))
    sensitivity = wheel_forces.RadiusSensitivity(
        values["contact_per_local"], values["contact_per_deviation"], values["force_per_deviation"]
    )
    radius = float(values["wheel_radius"])
    places = wheel_forces.wheel_places(
        float(abs(values["lateral_position"][0])),
        *(float(values[name]) for name in ("tape_circle", "rail", "speed")),
        radius,
    )
    law = patch.law_of_tables(
        values["hertz_table"],
        values["kalker_table"],
        float(values["modulus"]),
        float(values["shear_modulus"]),
        tuple(map(float, values["friction"])),
        fastsim.patch_grid(*map(int, values["patch_cells"])),
        creep_table.with_linear(values["creep_linear_table"]),
        method=patch.METHODS[str(values["creep_law"])],
    )
    bogie = RoughBogie(
        values["eigenvalue_real"] + 1j * values["eigenvalue_imag"],
        modal,
        values["curvature"],
        values["contact"],
        sensitivity,
        values["rolling_speed"],
    )
    return StoredBogie(bogie, law, places, radius)
