"""The stage `absorber_tuning`: designs of the absorber side by side (Table 2)."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.stages.axes import axis
from tramdva.variables.absorber_tuning import VARIABLES
from tramdva.wheelset.critical import critical_point_at
from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters
from tramdva.wheelset.response import peak_receptance, peak_stroke
from tramdva.wheelset.stability import growth_rate
from tramdva.wheelset.tuning import (
    Design,
    den_hartog,
    den_hartog_sqrt2,
    h_infinity,
    minimal_abscissa_damping,
    minimal_spectral_abscissa,
)

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any], critical_hopf_curve: Mapping[str, Any]
) -> dict[str, np.ndarray]:
    """Absorber designs of given mass side by side (Table 2).

    Parameters
    ----------
    cfg : mapping
        Physical sections with the absorber of the line, ``forced_excitation`` (B), ``study``
        (frequency range) and ``numerics`` (frequency_points).
    critical_hopf_curve : mapping
        Variables of ``critical_hopf_curve.nc``.

    Returns
    -------
    dict
        Variables of ``absorber_tuning.nc``. Receptances and strokes hold at the B of the forced
        excitation, the growth rate and the critical stiffness at that of operation.
    """
    operating = wheelset_parameters(cfg)
    forced = operating._replace(B=cfg["forced_excitation"]["B"])
    frequency = axis(cfg["study"]["frequency"], cfg["numerics"]["frequency_points"])
    stiffness = den_hartog(forced).c_T
    designs = {
        "paper": Design(operating.c_T, operating.d_T),
        "den_hartog": den_hartog(forced),
        "den_hartog_sqrt2": den_hartog_sqrt2(forced),
        "abscissa_damping": minimal_abscissa_damping(forced._replace(c_T=stiffness)),
        "spectral_abscissa": minimal_spectral_abscissa(forced),
        "h_infinity": h_infinity(forced, operating.B, frequency),
    }
    reference = peak_receptance(forced, False, frequency)
    rows = [_design_row(design, forced, operating.B, frequency) for design in designs.values()]
    critical = [_critical_c_T(operating, row["d_T"], critical_hopf_curve) for row in rows]
    return {
        "design": np.array(list(designs)),
        **{name: np.array([row[name] for row in rows]) for name in rows[0]},
        "critical_c_T": np.array(critical),
        "reduction": reference.amplitude / np.array([row["peak_receptance"] for row in rows]),
        "reference_peak_receptance": np.array(reference.amplitude),
        "reference_peak_frequency": np.array(reference.frequency),
        "reference_growth_rate": growth_rate(operating, False),
    }


def _design_row(
    design: Design | None, forced: WheelsetParameters, operating_B: float, frequency: np.ndarray
) -> dict[str, Any]:
    if design is None:
        names = (
            "c_T",
            "d_T",
            "peak_receptance",
            "peak_frequency",
            "growth_rate",
            "stroke_per_force",
        )
        return {"m_T": forced.m_T, **dict.fromkeys(names, np.nan), "status": "self_excited"}
    values = forced._replace(c_T=design.c_T, d_T=design.d_T)
    peak = peak_receptance(values, True, frequency)
    growth = float(growth_rate(values._replace(B=operating_B), True))
    return {
        "m_T": values.m_T,
        "c_T": design.c_T,
        "d_T": design.d_T,
        "peak_receptance": peak.amplitude,
        "peak_frequency": peak.frequency,
        "growth_rate": growth,
        "stroke_per_force": peak_stroke(values, frequency).amplitude,
        "status": "self_excited" if growth >= 0.0 else "converged",
    }


def _critical_c_T(operating: WheelsetParameters, d_T: float, critical: Mapping[str, Any]) -> float:
    """Critical stiffness (N/m) at a damping, solved from the nearest upper point; or NaN.

    Points that leave other axle stiffnesses unstable limit nothing.
    """
    upper = (critical["branch"] == "upper") & critical["stabilises_all_c_A"]
    known = critical["d_T"][upper]
    if not known.size or not known.min() <= d_T <= known.max():
        return np.nan
    k = int(np.argmin(np.abs(known - d_T)))
    guess = operating._replace(
        d_T=d_T, c_T=float(critical["c_T"][upper][k]), c_A=float(critical["c_A"][upper][k])
    )
    found = critical_point_at(guess)
    return np.nan if found is None else found.c_T
