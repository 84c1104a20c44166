"""From sections of the configuration to the contact tables of a line."""

from collections.abc import Callable, Mapping
from typing import Any

from tramdva.contact.geometry import ContactTable
from tramdva.contact.measured_profile import measured_profile
from tramdva.contact.parameters import ContactProfiles
from tramdva.contact.profiles import Profile, inclined
from tramdva.contact.tables import parametric_rail, parametric_wheel, zone_tables


def line_profile(cfg: Mapping[str, Any], kind: str, file_of: Callable[[str], Any] = str) -> Profile:
    """Profile of a line's wheels or rails as they run, measured or parametric.

    Parameters
    ----------
    cfg : section ``contact_geometry``
    kind : ``wheel`` or ``rail``
    file_of : where a file lies that the configuration names: a measured profile
    """
    own = {name: cfg["contact_geometry"][name] for name in ContactProfiles.model_fields}
    given = getattr(ContactProfiles.model_validate(own), kind)
    if not given.measured:
        return parametric_wheel(given) if kind == "wheel" else parametric_rail(given)
    profile = measured_profile(file_of(given.measured), kind, given.measured_noise)
    return profile if kind == "wheel" else inclined(profile, given.inclination)


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
    own = {name: cfg["contact_geometry"][name] for name in ContactProfiles.model_fields}
    return zone_tables(
        ContactProfiles.model_validate(own),
        cfg["bogie"]["wheel"]["radius"],
        cfg["numerics"]["shift_step"],
        cfg["numerics"]["yaw_nodes"],
        yaw_limit=yaw_limit,
        **{kind: line_profile(cfg, kind, file_of) for kind in ("wheel", "rail")},
    )
