"""The stage `contact_geometry`: contact tables of the profiles of a line."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tramdva.contact.measured_profile import measured_profile
from tramdva.contact.parameters import ContactGeometry
from tramdva.contact.tables import TABLE_FIELDS, yaw_reach, zone_tables
from tramdva.variables.contact_geometry import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(cfg: Mapping[str, Any], file_of: Callable[[str], Any] = str) -> dict[str, np.ndarray]:
    """Contact tables of the line's profiles: variables of ``contact_geometry.nc``.

    Parameters
    ----------
    cfg : values of the stage
    file_of : where a file lies that the configuration names: a measured profile
    """
    profiles, bogie = {}, cfg["bogie"]
    for kind in ("wheel", "rail"):
        given = cfg["contact_geometry"][kind]
        if given["measured"]:
            path = file_of(given["measured"])
            profiles[kind] = measured_profile(path, kind, given["measured_noise"])
    tables = zone_tables(
        ContactGeometry.model_validate(cfg["contact_geometry"]),
        bogie["wheel"]["radius"],
        cfg["numerics"]["shift_step"],
        cfg["numerics"]["yaw_nodes"],
        yaw_limit=yaw_reach(
            _sharpest_curve(cfg), bogie["half_wheelbase"], bogie["wheel"]["half_distance"]
        ),
        **profiles,
    )
    return {name: np.array([getattr(table, name) for table in tables]) for name in TABLE_FIELDS}


def _sharpest_curve(cfg: Mapping[str, Any]) -> float:
    """Radius in m of the sharpest curve that any stage asks for."""
    study = cfg["study"]
    varied = study["conditions"]["radius"]["min"] * cfg["track"]["radius"]
    return min(varied, study["radius"]["min"])
