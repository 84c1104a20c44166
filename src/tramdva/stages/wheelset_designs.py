"""The stage `wheelset_designs`: stability and frequency response with any absorber.

Every design of a grid of stiffness and damping is computed by itself; nothing is interpolated.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.stages.axes import axis, best_design, design_axis, reaching
from tramdva.variables.wheelset_designs import VARIABLES
from tramdva.wheelset.model import WheelsetParameters, wheelset_parameters
from tramdva.wheelset.response import peak_receptance, response
from tramdva.wheelset.stability import classify, growth_rate, leading_eigenvalues

__all__ = ["VARIABLES", "compute"]


def compute(cfg: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Stability and frequency response of the wheelset over the absorber's c_T and d_T.

    Parameters
    ----------
    cfg : mapping
        Physical sections with the absorber of the line, ``forced_excitation`` (B), ``study``
        (ranges of c_T, d_T, c_A, c_R and frequency) and ``numerics`` (points of the same).

    Returns
    -------
    dict
        Variables of ``wheelset_designs.nc``. Stability holds at the friction decrease of
        operation, the response at that of the forced excitation; where the wheelset vibrates by
        itself there too, it has no steady response: NaN, and ``forced_instability`` says so.
    """
    study, numerics = cfg["study"], cfg["numerics"]
    operating = wheelset_parameters(cfg)
    forced = operating._replace(B=cfg["forced_excitation"]["B"])
    c_T = design_axis(study["c_T"], numerics["c_T_points"], operating.c_T)
    d_T = design_axis(study["d_T"], numerics["d_T_points"], operating.d_T)
    c_A, c_R = (
        axis(reaching(study[name], getattr(operating, name)), numerics["map_points"])
        for name in ("c_A", "c_R")
    )
    frequency = axis(study["frequency"], numerics["frequency_points"])
    own = {"c_T": c_T[None, :], "d_T": d_T[:, None]}
    plane = {"c_A": c_A[None, :], "c_R": c_R[:, None]}
    forced_designs = _responses(forced, c_T, d_T, frequency)
    without = _response(forced, False, frequency)
    values = {
        "d_T": d_T,
        "c_T": c_T,
        "m_T": operating.m_T,
        "own_d_T": operating.d_T,
        "own_c_T": operating.c_T,
        "c_R": c_R,
        "c_A": c_A,
        "baseline_c_R": operating.c_R,
        "baseline_c_A": operating.c_A,
        "frequency": frequency,
        **_stability(operating._replace(**own), True),
        "forced_instability": classify(leading_eigenvalues(forced._replace(**own), True)),
        **forced_designs,
        "map_growth_rate": np.array(
            [
                [growth_rate(operating._replace(**plane, c_T=c, d_T=d), True) for c in c_T]
                for d in d_T
            ]
        ),
        **{f"none_{name}": value for name, value in _stability(operating, False).items()},
        "none_forced_instability": classify(leading_eigenvalues(forced, False)),
        **{f"none_{name}": value for name, value in without.items()},
        "none_map_growth_rate": growth_rate(operating._replace(**plane), False),
    }
    return values | comparison(values)


def comparison(values: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """What the designs reduce, and the best of them; those that vibrate in operation are none.

    Parameters
    ----------
    values : mapping
        The other variables of ``wheelset_designs``.

    Returns
    -------
    dict
        ``reduction`` (d_T, c_T) of the peak receptance; ``best_c_T`` in N/m, ``best_d_T`` in N s/m.
    """
    peak = np.where(values["growth_rate"] < 0.0, values["peak_receptance"], np.nan)
    c_T, d_T, _ = best_design(peak, values["c_T"], values["d_T"])
    return {
        "reduction": values["none_peak_receptance"] / peak,
        "best_c_T": np.float64(c_T),
        "best_d_T": np.float64(d_T),
    }


def _stability(values: WheelsetParameters, with_absorber: bool) -> dict[str, np.ndarray]:
    leading = leading_eigenvalues(values, with_absorber)
    return {
        "growth_rate": leading.real,
        "leading_frequency": leading.imag / (2.0 * np.pi),
        "instability": classify(leading),
    }


def _responses(
    forced: WheelsetParameters, c_T: np.ndarray, d_T: np.ndarray, frequency: np.ndarray
) -> dict[str, np.ndarray]:
    """Responses of all designs, stacked by damping and stiffness."""
    rows = [_response(forced._replace(c_T=c, d_T=d), True, frequency) for d in d_T for c in c_T]
    shape = d_T.size, c_T.size
    return {
        name: np.array([row[name] for row in rows]).reshape(*shape, *np.shape(rows[0][name]))
        for name in rows[0]
    }


def _response(
    forced: WheelsetParameters, with_absorber: bool, frequency: np.ndarray
) -> dict[str, np.ndarray]:
    """Receptance over the frequency and its peak; NaN where no steady response exists."""
    if not growth_rate(forced, with_absorber) < 0.0:
        return {
            "receptance_amplitude": np.full(frequency.size, np.nan),
            "peak_receptance": np.array(np.nan),
            "peak_frequency": np.array(np.nan),
        }
    peak = peak_receptance(forced, with_absorber, frequency)
    return {
        "receptance_amplitude": np.abs(response(forced, with_absorber, frequency).receptance),
        "peak_receptance": np.array(peak.amplitude),
        "peak_frequency": np.array(peak.frequency),
    }
