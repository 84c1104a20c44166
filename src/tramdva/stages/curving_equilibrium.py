"""The stage `curving_equilibrium`: steady running of the bogie in its curve."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie.absorbers import absorber_family, carried_over, tuned_absorber
from tramdva.bogie.curving import angle_of_attack, wheel_loads
from tramdva.bogie.names import AXLES, WHEELS
from tramdva.bogie.tram import BogieLine, Running, absorber, changed, run_through
from tramdva.contact import patch
from tramdva.contact.tables import zone_names
from tramdva.stages.bogie_sections import DESIGNS, bogie_line, frequency_limits
from tramdva.variables.curving_equilibrium import VARIABLES

__all__ = ["VARIABLES", "compute"]

CONTACT_VARIABLES = {
    "normal_force": patch.NORMAL_FORCE,
    "contact_angle": patch.CONTACT_ANGLE,
    "longitudinal_creepage": patch.LONGITUDINAL_CREEPAGE,
    "lateral_creepage": patch.LATERAL_CREEPAGE,
    "spin_creepage": patch.SPIN_CREEPAGE,
    "slip_velocity": patch.SLIP_VELOCITY,
    "semi_axis_longitudinal": patch.SEMI_AXIS_LONGITUDINAL,
    "semi_axis_lateral": patch.SEMI_AXIS_LATERAL,
    "wheel_position": patch.WHEEL_POSITION,
    "forward_shift": patch.FORWARD_SHIFT,
}


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    absorber_tuning: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """Steady curving without absorber, with the paper's and with a tuned one.

    Parameters
    ----------
    cfg : sections of the bogie, ``creep_force`` and ``numerics``
    contact_geometry, absorber_tuning : variables of these files

    Returns
    -------
    Variables of ``curving_equilibrium.nc``.
    """
    line = bogie_line(cfg, contact_geometry)
    none = run_through(line)
    designs = _designs(line, none, cfg, absorber_tuning)
    runs = [changed(line, absorber(line, *design), none) for design in designs]
    results = np.array([run.equilibrium.results for run in runs])
    touching = results[..., patch.STATUS] != patch.NO_CONTACT
    zones = zone_names(results.shape[2])
    contacts = len(WHEELS) * len(zones)
    stiffness, damping = np.array(designs).T
    inertia = np.where(np.isnan(stiffness), np.nan, line.bogie.absorber.I_T)
    return {
        "absorber": np.array(DESIGNS),
        "m_T": inertia,
        "c_T": stiffness,
        "d_T": damping,
        "contact": np.array([f"{wheel}_{zone}" for wheel in WHEELS for zone in zones]),
        "wheel": np.array(WHEELS),
        "axle": np.array(AXLES),
        **{
            name: np.where(touching, results[..., column], np.nan).reshape(len(runs), contacts)
            for name, column in CONTACT_VARIABLES.items()
        },
        "wheel_load": np.array([list(wheel_loads(run.equilibrium).values()) for run in runs]),
        "straight_wheel_load": np.array(
            [list(wheel_loads(run.straight_equilibrium).values()) for run in runs]
        ),
        "angle_of_attack": np.array([angle_of_attack(run.curve, run.equilibrium) for run in runs]),
        "needed_yaw": np.array([run.equilibrium.needed_yaw for run in runs]),
        "residual": np.array([run.equilibrium.residual for run in runs]),
        "status": np.array([run.equilibrium.status for run in runs]),
    }


def _designs(line: BogieLine, none: Running, cfg, tuning) -> list[tuple[float, float]]:
    """Stiffness and damping per design of `DESIGNS`.

    The tuned one starts from the design of least receptance of the basic model or, where there is
    none, from the paper's absorber.
    """
    own = line.bogie.absorber
    usable = (tuning["design"] == "h_infinity") & (tuning["status"] == "converged")
    start = (own.c_T, own.d_T)
    if usable.any():
        k = int(np.argmax(usable))
        start = carried_over(own.I_T, tuning["m_T"][k], tuning["c_T"][k], tuning["d_T"][k])
    # Without an equilibrium there is nothing to tune, and each trial would fail slowly.
    if none.equilibrium.status == "converged":
        family = absorber_family(line, none)
        start = tuned_absorber(family, frequency_limits(cfg), start)
    return [(np.nan, np.nan), (own.c_T, own.d_T), start]
