"""The linearised bogie with wheels out of round as variables of a file, and back."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tramdva.bogie import running
from tramdva.bogie.integration import ModalBasis
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.bogie.vehicle import AXLE_OF_WHEEL, SIDE, WHEELS
from tramdva.contact import patch
from tramdva.contact.geometry import ContactTable

TABLE_FIELDS = ContactTable._fields
ZONES = ("tread", "flange")
_LAW = ("mu_0", "A", "B", "youngs_modulus", "poisson_ratio", "cells_along", "strips")
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


def variables(bogie: RoughBogie, places: running.WheelPlaces, law: Mapping[str, Any]) -> dict:
    """Variables of ``bogie_linearisation``; `law` holds the numbers named in the registry."""
    basis, sensitivity = bogie.basis, bogie.sensitivity
    return {
        "wheel": np.array(WHEELS),
        "zone": np.array(zone_names(bogie.results.shape[1])),
        **{name: np.asarray(getattr(places, name), float) for name in _PLACES},
        "wheel_radius": np.float64(places.speed / places.spin_rate),
        **{name: np.float64(law[name]) for name in _LAW},
        "rolling_speed": bogie.rolling_speed,
        "curvature": bogie.curvatures,
        "eigenvalue_real": basis.eigenvalue.real,
        "eigenvalue_imag": basis.eigenvalue.imag,
        "output": basis.output,
        "forcing": basis.forcing,
        "local": basis.local,
        "force": basis.force,
        "jacobian": basis.jacobian,
        "contact": bogie.results,
        "contact_per_local": sensitivity.local,
        "contact_per_deviation": sensitivity.deviation,
        "force_per_deviation": sensitivity.force,
    }


def stored_bogie(values: Mapping[str, np.ndarray]) -> StoredBogie:
    """Linearised bogie from the variables of its file."""
    empty = np.zeros((0, 0))
    basis = ModalBasis(
        values["eigenvalue_real"] + 1j * values["eigenvalue_imag"],
        np.zeros(0), empty, empty, empty,
        values["output"], values["forcing"], values["local"], values["force"], values["jacobian"],
    )  # fmt: skip
    sensitivity = running.RadiusSensitivity(
        values["contact_per_local"], values["contact_per_deviation"], values["force_per_deviation"]
    )
    speed, radius = float(values["speed"]), float(values["wheel_radius"])
    places = running.WheelPlaces(
        np.array(SIDE),
        np.array(AXLE_OF_WHEEL) + 1,
        values["lateral_position"],
        float(values["tape_circle"]),
        float(values["rail"]),
        speed,
        speed / radius,
    )
    law = patch.contact_law(
        *(float(values[name]) for name in _LAW[:5]), *(int(values[name]) for name in _LAW[5:])
    )
    bogie = RoughBogie(
        basis, values["curvature"], values["contact"], sensitivity, values["rolling_speed"]
    )
    return StoredBogie(bogie, law, places, radius)
