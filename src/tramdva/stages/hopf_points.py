"""The stage `hopf_points`: Hopf points over the stiffness of the axle (figure 3)."""

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.stages.wheelset_sections import absorber_variants
from tramdva.variables.arrays import table
from tramdva.variables.hopf_points import VARIABLES
from tramdva.wheelset.hopf import WheelsetHopfPoint, hopf_points_along
from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters

__all__ = ["VARIABLES", "compute"]

logger = logging.getLogger(__name__)


def compute(cfg: Mapping[str, Any], stability_map: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Hopf points in c_A for each absorber variant (figure 3).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``absorber_variants`` and ``numerics`` (tolerance, max_iterations).
    stability_map : mapping
        Variables of ``stability_map.nc``: the growth rates over c_A at the baseline's c_R.

    Returns
    -------
    dict
        Variables of ``hopf_points.nc``.
    """
    baseline = wheelset_parameters(cfg)
    rows: list[dict[str, Any]] = []
    for k, (name, c_T, d_T) in enumerate(absorber_variants(cfg)):
        values = baseline._replace(c_T=c_T, d_T=d_T)
        found = hopf_points_along(
            values,
            not np.isnan(c_T),
            "c_A",
            stability_map["c_A"],
            stability_map["baseline_growth_rate"][k],
            **cfg["numerics"],
        )
        logger.info("%s: %d Hopf points", name, len(found))
        rows += [_hopf_row(name, values, point) for point in found]
    return table(VARIABLES, "hopf_point", rows)


def _hopf_row(name: str, values: WheelsetParameters, point: WheelsetHopfPoint) -> dict[str, Any]:
    return {
        "absorber": name,
        "m_T": values.m_T if point.with_absorber else np.nan,
        "c_T": values.c_T,
        "d_T": values.d_T,
        "c_A": point.values.c_A,
        "frequency": point.frequency,
        "first_lyapunov_coefficient": point.first_lyapunov_coefficient,
        "residual": point.scaled.residual,
        "status": "converged" if point.converged else "not_converged",
    }
