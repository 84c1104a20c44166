"""The stage `stability_map`: stability maps of the wheelset (figure 2)."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.stages.axes import axis, reaching
from tramdva.stages.wheelset_sections import absorber_coordinates, absorber_variants
from tramdva.variables.stability_map import VARIABLES
from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters
from tramdva.wheelset.stability import (
    characteristic_polynomial,
    classify,
    critical_friction_decrease,
    growth_rate,
    hurwitz_determinants,
    leading_eigenvalues,
)

__all__ = ["VARIABLES", "compute"]


def _map(values: WheelsetParameters, with_absorber: bool) -> dict[str, np.ndarray]:
    leading = leading_eigenvalues(values, with_absorber)
    coefficients = characteristic_polynomial(values, with_absorber)
    determinants = hurwitz_determinants(coefficients)
    agrees = np.isnan(leading) | (np.all(determinants > 0.0, axis=-1) == (leading.real < 0.0))
    return {
        "growth_rate": leading.real,
        "frequency": np.where(leading.imag > 0.0, leading.imag / (2.0 * np.pi), 0.0),
        "hurwitz_h5": determinants[..., -2],
        "coefficient_a6": coefficients[..., -1],
        "instability": classify(leading),
        "routh_hurwitz_agrees": agrees,
    }


def compute(cfg: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Stability maps of figure 2.

    Parameters
    ----------
    cfg : mapping
        Sections ``curve``, ``creep_force``, ``wheelset``, ``absorber`` (m_T),
        ``absorber_variants``, ``study`` (ranges of c_A, c_R, d_T, c_T) and ``numerics`` (points).

    Returns
    -------
    dict
        Variables of ``stability_map.nc``: maps over (c_R, c_A) without absorber and for each
        variant, the
        map over (d_T, c_T) of the baseline, and the baseline's growth rates over c_A alone.
    """
    baseline = wheelset_parameters(cfg)
    points = cfg["numerics"]["points"]
    limits = {key: cfg["study"][key] for key in ("c_A", "c_R", "d_T", "c_T")}
    limits |= {key: reaching(limits[key], getattr(baseline, key)) for key in ("c_A", "c_R")}
    axes = {key: axis(ends, points) for key, ends in limits.items()}
    variants = absorber_variants(cfg)
    plane = {"c_A": axes["c_A"][None, :], "c_R": axes["c_R"][:, None]}
    maps, lines = [], []
    for _, c_T, d_T in variants:
        values = baseline._replace(c_T=c_T, d_T=d_T)
        mounted = not np.isnan(c_T)
        maps.append(_map(values._replace(**plane), mounted))
        lines.append(growth_rate(values._replace(c_A=axes["c_A"]), mounted))
    absorber = _map(baseline._replace(d_T=axes["d_T"][:, None], c_T=axes["c_T"][None, :]), True)
    stacked = {name: np.stack([single[name] for single in maps]) for name in maps[0]}
    return {
        **absorber_coordinates(cfg),
        **axes,
        **stacked,
        **{f"absorber_{name}": value for name, value in absorber.items()},
        "baseline_growth_rate": np.stack(lines),
        "baseline_c_A": baseline.c_A,
        "baseline_c_R": baseline.c_R,
        "baseline_critical_B": critical_friction_decrease(baseline, False),
    }
