"""The stage `contact_geometry`: contact tables of the profiles of a line."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tramdva.contact import locus
from tramdva.contact.tables import TABLE_FIELDS, yaw_reach
from tramdva.stages.contact_sections import line_tables
from tramdva.variables.contact_geometry import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(cfg: Mapping[str, Any], file_of: Callable[[str], Any] = str) -> dict[str, np.ndarray]:
    """Contact tables of the line's profiles: variables of ``contact_geometry.nc``.

    Parameters
    ----------
    cfg : values of the stage
    file_of : where a file lies that the configuration names: a measured profile
    """
    bogie = cfg["bogie"]
    reach = yaw_reach(
        _sharpest_curve(cfg), bogie["half_wheelbase"], bogie["wheel"]["half_distance"]
    )
    tables = line_tables(cfg, reach, file_of)
    found = {name: np.array([getattr(table, name) for table in tables]) for name in TABLE_FIELDS}
    return {**found, "coefficients": found["coefficients"][..., : locus.COLUMNS]}


def _sharpest_curve(cfg: Mapping[str, Any]) -> float:
    """Radius in m of the sharpest curve that any stage asks for."""
    study = cfg["study"]
    varied = study["conditions"]["radius"]["min"] * cfg["track"]["radius"]
    return min(varied, study["radius"]["min"])
