"""From sections of the configuration to the contact tables of a line."""

from collections.abc import Callable, Mapping
from typing import Any

from tramdva.contact.geometry import ContactTable
from tramdva.contact.measured_profile import measured_profile
from tramdva.contact.parameters import ContactProfiles
from tramdva.contact.tables import zone_tables


def line_tables(
    cfg: Mapping[str, Any], yaw_limit: float, file_of: Callable[[str], Any] = str
) -> tuple[ContactTable, ...]:
    """Contact tables of the zones of a line's profiles, measured or parametric.

    Parameters
    ----------
    cfg : sections ``contact_geometry`` and ``bogie``, ``shift_step`` and ``yaw_nodes`` of
        ``numerics``
    yaw_limit : rad, up to which the tables reach
    file_of : where a file lies that the configuration names: a measured profile
    """
    profiles = {}
    for kind in ("wheel", "rail"):
        given = cfg["contact_geometry"][kind]
        if given["measured"]:
            path = file_of(given["measured"])
            profiles[kind] = measured_profile(path, kind, given["measured_noise"])
    own = {name: cfg["contact_geometry"][name] for name in ContactProfiles.model_fields}
    return zone_tables(
        ContactProfiles.model_validate(own),
        cfg["bogie"]["wheel"]["radius"],
        cfg["numerics"]["shift_step"],
        cfg["numerics"]["yaw_nodes"],
        yaw_limit=yaw_limit,
        **profiles,
    )
