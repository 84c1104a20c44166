"""The stage `hopf_curves`: Hopf curves of axle and absorber (figure 4)."""

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bifurcation.hopf import HopfCurve
from tramdva.variables.arrays import table
from tramdva.variables.hopf_curves import VARIABLES
from tramdva.wheelset.critical import curves_at, hopf_frequency
from tramdva.wheelset.hopf import physical_values
from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters

__all__ = ["VARIABLES", "compute"]

logger = logging.getLogger(__name__)


def compute(cfg: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Hopf curves in (c_A, c_T) for several d_T (figure 4).

    Parameters
    ----------
    cfg : mapping
        Physical sections, ``study`` (list d_T, ranges of c_A and c_T) and ``numerics`` (max_points,
        tolerance).

    Returns
    -------
    dict
        Variables of ``hopf_curves.nc``. The points of one curve (``curve``) stand in order.

    Notes
    -----
    Every curve that crosses one of the rows of constant c_T is found: the Hopf points of each row
    start a curve unless one already passes there.
    """
    baseline = wheelset_parameters(cfg)
    points: list[dict[str, Any]] = []
    special: list[dict[str, Any]] = []
    number = 0
    for d_T in cfg["study"]["d_T"]:
        for curve in curves_at(baseline._replace(d_T=d_T), cfg["study"], cfg["numerics"]):
            points += _curve_rows(number, baseline, curve)
            special += _special_rows(baseline, curve)
            number += 1
        logger.info("d_T = %g N s/m: %d curves so far", d_T, number)
    return {
        **table(VARIABLES, "curve_point", points),
        **table(VARIABLES, "special_point", special),
    }


def _curve_rows(number: int, values: WheelsetParameters, curve: HopfCurve) -> list[dict[str, Any]]:
    rows = []
    for point, l_1 in zip(curve.points, curve.first_lyapunov_coefficients, strict=True):
        own = physical_values(values, True, point.parameters)
        rows.append(
            {
                "curve": number,
                "d_T": own.d_T,
                "c_A": own.c_A,
                "c_T": own.c_T,
                "frequency": hopf_frequency(values, point),
                "first_lyapunov_coefficient": l_1,
                "residual": point.residual,
            }
        )
    return rows


def _special_rows(values: WheelsetParameters, curve: HopfCurve) -> list[dict[str, Any]]:
    rows = []
    for kind, point in curve.special:
        own = physical_values(values, True, point.parameters)
        rows.append(
            {
                "special_kind": kind,
                "special_d_T": own.d_T,
                "special_c_A": own.c_A,
                "special_c_T": own.c_T,
            }
        )
    return rows
