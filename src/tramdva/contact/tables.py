"""Contact tables of the zones (tread, flange) of a line's profiles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from tramdva.contact import geometry, profiles
from tramdva.contact.geometry import ContactTable

if TYPE_CHECKING:
    from tramdva.contact.parameters import ContactGeometry, RailProfile, WheelProfile

# Range of the contact tables: m of lateral shift, rad of roll and yaw.
SHIFT_RANGE, ROLL_RANGE, YAW_RANGE = 7e-3, 0.0125, 0.045


def parametric_wheel(wheel: WheelProfile) -> profiles.Profile:
    """Wheel profile of the parameters, m."""
    return profiles.tram_wheel(
        wheel.flange_root_radius,
        wheel.flange_angle,
        wheel.conicity,
        wheel.tread_inner,
        wheel.tread_outer,
    )


def parametric_rail(rail: RailProfile) -> profiles.Profile:
    """Rail profile of the parameters, m."""
    return profiles.grooved_rail(
        rail.crown_radius,
        rail.corner_radius,
        rail.corner_start,
        field_half_width=rail.field_half_width,
    )


TABLE_FIELDS = ContactTable._fields
ZONES = ("tread", "flange")


def zone_names(count: int) -> list[str]:
    """Names of the zones of a profile, from the tread to the flange."""
    return [ZONES[k] if k < len(ZONES) else f"zone_{k + 1}" for k in range(count)]


def zone_tables(
    contact_geometry: ContactGeometry,
    wheel_radius: float,
    shift_step: float = 2.5e-5,
    yaw_nodes: int = 24,
    wheel: profiles.Profile | None = None,
    rail: profiles.Profile | None = None,
) -> tuple:
    """Contact tables of the zones of the profiles: the given ones, else those of the parameters.

    `shift_step` in m and the number of nodes over the yaw angle: a conformal flange root, whose
    locus is an arc of few mm that shrinks with the yaw angle, needs fine ones.
    """
    position = contact_geometry.rail.lateral_position
    return geometry.contact_tables(
        wheel or parametric_wheel(contact_geometry.wheel),
        rail or parametric_rail(contact_geometry.rail),
        wheel_radius,
        shift_range=(-position - SHIFT_RANGE, -position + SHIFT_RANGE),
        roll_limit=ROLL_RANGE,
        yaw_limit=YAW_RANGE,
        gap_scale=contact_geometry.gap_scale,
        shift_step=shift_step,
        yaw_nodes=yaw_nodes,
    )


def stored_tables(tables: Mapping[str, np.ndarray]) -> tuple[ContactTable, ...]:
    """Contact tables of the zones from the variables of ``contact_geometry.nc``."""
    zones = zip(*(tables[name] for name in TABLE_FIELDS), strict=True)
    return tuple(
        ContactTable(*(float(part) if part.ndim == 0 else part for part in zone)) for zone in zones
    )
