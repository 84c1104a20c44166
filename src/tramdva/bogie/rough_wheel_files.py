"""The linearised bogie with wheels out of round as variables of a file, and back."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from tramdva.bogie import running
from tramdva.bogie.integration import ModalContacts
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.bogie.vehicle import WHEELS
from tramdva.contact import fastsim, patch
from tramdva.contact.geometry import ContactTable

TABLE_FIELDS = ContactTable._fields
ZONES = ("tread", "flange", "flank")
_PLACES = ("lateral_position", "tape_circle", "rail", "speed")


class StoredBogie(NamedTuple):
    """What ``bogie_linearisation`` holds.

    bogie : RoughBogie
    law : patch.ContactLaw; places : running.WheelPlaces; wheel_radius : m
    """

    bogie: RoughBogie
    law: patch.ContactLaw
    places: running.WheelPlaces
    wheel_radius: float


def contact_tables(tables: Mapping[str, np.ndarray]) -> tuple[ContactTable, ...]:
    """Contact tables of the zones from the variables of ``contact_geometry.nc``."""
    zones = zip(*(tables[name] for name in TABLE_FIELDS), strict=True)
    return tuple(
        ContactTable(*(float(part) if part.ndim == 0 else part for part in zone)) for zone in zones
    )


def zone_names(count: int) -> list[str]:
    """Names of the zones of a profile, from the tread to the flange."""
    return [ZONES[k] if k < len(ZONES) else f"zone_{k + 1}" for k in range(count)]


def variables(
    bogie: RoughBogie, contacts: running.Contacts, wheel_radius: float, grid: tuple[int, int]
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
    sensitivity = running.RadiusSensitivity(
        values["contact_per_local"], values["contact_per_deviation"], values["force_per_deviation"]
    )
    radius = float(values["wheel_radius"])
    places = running.wheel_places(
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
