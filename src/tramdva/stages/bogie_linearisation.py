"""The stage `bogie_linearisation`: the bogie in its curve in the small, wheels out of round."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.stored import variables
from tramdva.bogie.tram import changed, run_through
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.variables.bogie_linearisation import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any],
    absorber: str,
    contact_geometry: Mapping[str, np.ndarray],
    curving_equilibrium: Mapping[str, np.ndarray] | None = None,
) -> dict[str, np.ndarray]:
    """The bogie in its curve without self-excitation, linearised with its wheels out of round.

    Parameters
    ----------
    cfg : sections of the bogie, without ``bogie.absorber`` for the bogie without absorbers
    absorber : ``none``, ``paper`` (the line's own) or ``tuned``
    contact_geometry : variables of this file
    curving_equilibrium : variables of this file, for the tuned absorber

    Returns
    -------
    Variables of ``bogie_linearisation``.
    """
    bogie = dict(cfg["bogie"])
    if curving_equilibrium is not None:
        row = list(curving_equilibrium["absorber"]).index(absorber)
        bogie["absorber"] = bogie["absorber"] | {
            name: float(curving_equilibrium[name][row]) for name in ("c_T", "d_T")
        }
    line = quiet_bogie_line({**cfg, "bogie": bogie}, contact_geometry)
    run = run_through(line)
    design = getattr(line.bogie, "absorber", None)
    if design is not None:
        run = changed(line, design, run)
    return {
        "absorber": np.array(absorber),
        **{
            name: np.float64(getattr(design, own, np.nan))
            for name, own in (("m_T", "I_T"), ("c_T", "c_T"), ("d_T", "d_T"))
        },
        **variables(
            rough_bogie(run.curve, run.equilibrium),
            run.curve.contacts,
            line.bogie.wheel.radius,
            line.grid,
        ),
        "residual": np.float64(run.equilibrium.residual),
        "status": np.array(run.equilibrium.status),
    }
