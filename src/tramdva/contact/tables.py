"""Contact tables of the zones (tread, flange) of a line's profiles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from tramdva.contact import geometry, locus, profiles
from tramdva.contact.geometry import ContactTable

if TYPE_CHECKING:
    from tramdva.contact.parameters import ContactProfiles, RailProfile, WheelProfile

# Range of the contact tables: m of lateral shift, rad of roll; the yaw that `yaw_nodes` are for.
SHIFT_RANGE, ROLL_RANGE, YAW_RANGE = 7e-3, 0.0125, 0.045
SPLIT_ANGLES = 7  # yaw angles at which jumps of the contact are looked for
_VIBRATION = 2e-3  # rad of yaw beside the steady one


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
    """Rail profile of the parameters as it lies in the track, m."""
    upright = profiles.grooved_rail(
        rail.crown_radius,
        rail.corner_radius,
        rail.corner_start,
        field_half_width=rail.field_half_width,
    )
    return profiles.inclined(upright, rail.inclination)


def points_in_mm(profile: profiles.Profile) -> np.ndarray:
    """Points (n, 2) of a profile as files hold them: y outwards and z downwards in mm."""
    return np.column_stack([profile.position, profile.depth]) / profiles.MM


def turned_in_track(points: np.ndarray, rail: RailProfile) -> np.ndarray:
    """Points (n, 2) of a measured rail as they lie in the track; in one unit."""
    return np.column_stack(profiles.turned(*points.T, rail.inclination))


TABLE_FIELDS = ContactTable._fields
ZONES = ("tread", "flange", "flank")


def zone_names(count: int) -> list[str]:
    """Names of the zones of a profile, from the tread to the flange."""
    return [ZONES[k] if k < len(ZONES) else f"zone_{k + 1}" for k in range(count)]


def yaw_reach(radius: float, half_wheelbase: float, half_distance: float) -> float:
    """Yaw angle in rad of a wheel against its rail up to which contact tables must reach.

    Parameters
    ----------
    radius : m, of the sharpest curve that they serve
    half_wheelbase, half_distance : m, of the bogie

    Notes
    -----
    The angle of the chord, the bogie's yaw in the play of its flanges, the turn of the rail at the
    wheel that a yawed axle puts ahead, and some more for vibrations.
    """
    attack = half_wheelbase / radius + 0.5 * SHIFT_RANGE / half_wheelbase
    return attack * (1.0 + half_distance / radius) + _VIBRATION


def zone_tables(
    contact_geometry: ContactProfiles,
    wheel_radius: float,
    shift_step: float = 2.5e-5,
    yaw_nodes: int = 24,
    wheel: profiles.Profile | None = None,
    rail: profiles.Profile | None = None,
    yaw_limit: float = YAW_RANGE,
) -> tuple:
    """Contact tables of the zones of the profiles: the given ones, else those of the parameters.

    `shift_step` in m and the number of nodes over a yaw angle of 0.045 rad: a conformal flange
    root, whose locus is an arc of few mm that shrinks with the yaw angle, needs fine ones. Tables
    that reach another `yaw_limit` (rad) keep the distance of the nodes. Zones are split wherever
    contact jumps at some yaw angle, as from root to flank of a wheel that is much yawed.
    """
    nodes = 1 + int(np.ceil((yaw_nodes - 1) * (np.tan(yaw_limit) / np.tan(YAW_RANGE)) ** 2))
    position = contact_geometry.rail.lateral_position
    return geometry.contact_tables(
        wheel or parametric_wheel(contact_geometry.wheel),
        rail or parametric_rail(contact_geometry.rail),
        wheel_radius,
        shift_range=(-position - SHIFT_RANGE, -position + SHIFT_RANGE),
        roll_limit=ROLL_RANGE,
        yaw_limit=yaw_limit,
        gap_scale=contact_geometry.gap_scale,
        shift_step=shift_step,
        yaw_nodes=nodes,
        split_yaw=tuple(np.linspace(0.0, yaw_limit, SPLIT_ANGLES)),
    )


def stored_tables(tables: Mapping[str, np.ndarray]) -> tuple[ContactTable, ...]:
    """Contact tables of the zones from the variables of ``contact_geometry.nc``."""
    stored = tables["coefficients"]
    coefficients = np.zeros((*stored.shape[:-1], locus.STRIDE))
    coefficients[..., : stored.shape[-1]] = stored
    whole = {**tables, "coefficients": coefficients}
    zones = zip(*(whole[name] for name in TABLE_FIELDS), strict=True)
    return tuple(
        ContactTable(*(float(part) if part.ndim == 0 else part for part in zone)) for zone in zones
    )
