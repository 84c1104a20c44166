"""The stage `frequency_response`: response with every design of the absorber (figure 7)."""

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.stages.axes import axis
from tramdva.variables.frequency_response import VARIABLES
from tramdva.wheelset.model import equilibrium, wheelset_parameters
from tramdva.wheelset.response import Response, response
from tramdva.wheelset.stability import growth_rate

__all__ = ["VARIABLES", "compute"]

logger = logging.getLogger(__name__)


def compute(cfg: Mapping[str, Any], absorber_tuning: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Frequency response without absorber and with every design (figure 7).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``forced_excitation`` (B), ``study`` (frequency range) and ``numerics``
        (points).
    absorber_tuning : mapping
        Variables of ``absorber_tuning.nc``.

    Returns
    -------
    dict
        Variables of ``frequency_response.nc``; designs without a solution stay NaN.
    """
    values = wheelset_parameters(cfg)._replace(B=cfg["forced_excitation"]["B"])
    frequency = axis(cfg["study"]["frequency"], cfg["numerics"]["points"])
    parameters = {name: np.append(np.nan, absorber_tuning[name]) for name in ("m_T", "c_T", "d_T")}
    responses = [response(values, False, frequency)]
    missing = np.full(frequency.size, np.nan)
    for m_T, c_T, d_T in zip(*(column[1:] for column in parameters.values()), strict=True):
        design = values._replace(m_T=m_T, c_T=c_T, d_T=d_T)
        solved = np.isfinite(c_T)
        responses.append(
            response(design, True, frequency) if solved else Response(missing, missing)
        )
    receptance = np.array([r.receptance for r in responses])
    stable = growth_rate(values, False) < 0.0
    if not stable:
        logger.warning(
            "without absorber the wheelset is unstable: its response is not a steady state"
        )
    amplitude = np.abs(receptance)
    bare = amplitude[0]
    tops = np.flatnonzero((bare[1:-1] > bare[:-2]) & (bare[1:-1] > bare[2:])) + 1
    return {
        "design": np.append("none", absorber_tuning["design"]),
        **parameters,
        "status": np.append("converged" if stable else "self_excited", absorber_tuning["status"]),
        "frequency": frequency,
        "receptance_amplitude": amplitude,
        "receptance_phase": np.angle(receptance),
        "stroke_amplitude": np.array([np.abs(r.stroke) for r in responses]),
        "peak_frequency": frequency[tops],
        "peak_receptance": bare[tops],
        "y_R_equilibrium": np.array(equilibrium(values, False).y_R),
    }
