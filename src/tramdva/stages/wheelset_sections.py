"""From sections of the configuration to what the basic model takes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def absorber_variants(cfg: Mapping[str, Any]) -> list[tuple[str, float, float]]:
    """Name, c_T (N/m) and d_T (N s/m) of each variant, ``none`` (NaN) first."""
    listed = [(v["name"], v["c_T"], v["d_T"]) for v in cfg["absorber_variants"]]
    return [("none", np.nan, np.nan), *listed]


def absorber_coordinates(cfg: Mapping[str, Any]) -> dict[str, Any]:
    """Coordinates along the dimension ``absorber``."""
    variants = absorber_variants(cfg)
    names: Sequence[str] = [name for name, _, _ in variants]
    c_T = np.array([c for _, c, _ in variants])
    return {
        "absorber": np.array(names),
        "m_T": np.where(np.isnan(c_T), np.nan, cfg["absorber"]["m_T"]),
        "absorber_c_T": c_T,
        "absorber_d_T": np.array([d for _, _, d in variants]),
    }
