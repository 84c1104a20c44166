"""The stage `bogie_designs`: evolution tendency and self-excitation with any absorber.

Every design of a grid of stiffness and damping is computed by itself; nothing is interpolated.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tramdva.bogie.absorber_growth import least_stable, seen_by_absorbers
from tramdva.bogie.absorbers import family_of
from tramdva.bogie.conditions import as_configured
from tramdva.bogie.curving import linearise, oscillations
from tramdva.bogie.tram import BogieLine, Running, changed, run_through
from tramdva.evolution.any_absorber import any_absorber
from tramdva.evolution.tendency import (
    band_axis,
    finer_near_modes,
    growth_left,
    largest,
    order_of_frequency,
)
from tramdva.stages.axes import best_design, design_axis
from tramdva.stages.bogie_sections import bogie_line, quiet_bogie_line
from tramdva.stages.wheels_out_of_round import wearing
from tramdva.variables.bogie_designs import VARIABLES

__all__ = ["VARIABLES", "compute"]


class _Excitation(NamedTuple):
    """Whether the bogie vibrates by itself: growth rate in 1/s, its frequency in Hz, and kind."""

    growth_rate: float
    leading_frequency: float
    self_excitation: str


def compute(
    cfg: Mapping[str, Any], contact_geometry: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """Evolution tendency and growth rates of the bogie over the absorbers' c_T and d_T.

    Parameters
    ----------
    cfg : sections of the bogie, ``wear``, ``out_of_roundness.wheels``, ``study``, ``numerics``
    contact_geometry : variables of this file

    Returns
    -------
    Variables of ``bogie_designs``. Growth rates hold at the friction decrease of operation, the
    tendency at that of the forced excitation; where the bogie vibrates by itself there too, or
    has no equilibrium, it is NaN and ``quiet_self_excitation`` says so.
    """
    study, numerics = cfg["study"], cfg["numerics"]
    lines = bogie_line(cfg, contact_geometry), quiet_bogie_line(cfg, contact_geometry)
    operating, quiet = (run_through(line) for line in lines)
    own = lines[0].bogie.absorber
    c_T = design_axis(study["c_T"], numerics["c_T_points"], own.c_T)
    d_T = design_axis(study["d_T"], numerics["d_T_points"], own.d_T)
    ends = study["frequency"]
    frequency = np.linspace(ends["min"], ends["max"], numerics["frequency_points"])
    excited = _over_designs(lines[0], operating, c_T, d_T, study["self_excitation"])
    excited_quietly = _over_designs(lines[1], quiet, c_T, d_T, study["self_excitation"])
    none = _none(operating, quiet, study["self_excitation"])
    steady = {
        "none": none["none_quiet_self_excitation"] == "stable",
        "designs": excited_quietly["self_excitation"] == "stable",
    }
    track, radius = lines[0].track, lines[0].bogie.wheel.radius
    values = {
        "d_T": d_T,
        "c_T": c_T,
        "m_T": own.I_T,
        "own_d_T": own.d_T,
        "own_c_T": own.c_T,
        "wheel": np.array(cfg["out_of_roundness"]["wheels"]),
        "frequency": frequency,
        "order": order_of_frequency(frequency, track.speed, radius),
        **excited,
        **{f"quiet_{name}": excited_quietly[name] for name in ("growth_rate", "self_excitation")},
        **none,
        **_tendencies(cfg, lines[1], quiet, c_T, d_T, frequency, steady),
        **_in_band(cfg, lines[1], quiet, c_T, d_T, steady),
    }
    return values | comparison(values)


def comparison(values: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """What each of the designs leaves, and the best; those that vibrate in operation are none.

    Parameters
    ----------
    values : mapping
        The other variables of ``bogie_designs``.

    Returns
    -------
    dict
        ``worst_band_factor`` (d_T, c_T); ``best_c_T`` in N m/rad and ``best_d_T`` in N m s/rad (N/m
        and N s/m if the absorber translates); ``largest_tendency`` (wheel).
    """
    left = growth_left(values["band_tendency"], values["none_band_tendency"])
    worst = np.where(values["self_excitation"] == "stable", left, np.nan)
    c_T, d_T, _ = best_design(worst, values["c_T"], values["d_T"])
    return {
        "worst_band_factor": worst,
        "best_c_T": np.float64(c_T),
        "best_d_T": np.float64(d_T),
        "largest_tendency": largest(values["none_tendency"]),
    }


def _excitation(top: complex | None) -> _Excitation:
    """Least stable oscillation of a linearised vehicle by its eigenvalue in 1/s."""
    if top is None:
        return _Excitation(np.nan, np.nan, "no_oscillation")
    kind = "stable" if top.real < 0.0 else "self_excited"
    return _Excitation(float(top.real), float(top.imag / (2.0 * np.pi)), kind)


def _of_run(run: Running, limits: Mapping[str, float]) -> _Excitation:
    if run.equilibrium.status != "converged":
        return _Excitation(np.nan, np.nan, "no_equilibrium")
    matrix = linearise(run.curve, run.equilibrium.state).matrix
    values = oscillations(np.linalg.eigvals(matrix), (limits["min"], limits["max"]))
    return _excitation(values[np.argmax(values.real)] if values.size else None)


def _none(operating: Running, quiet: Running, limits: Mapping[str, float]) -> dict[str, Any]:
    """The same of the bogie without absorbers."""
    loud, calm = _of_run(operating, limits), _of_run(quiet, limits)
    return {
        **{f"none_{name}": value for name, value in loud._asdict().items()},
        "none_quiet_growth_rate": calm.growth_rate,
        "none_quiet_self_excitation": calm.self_excitation,
    }


def _over_designs(
    line: BogieLine, known: Running, c_T: np.ndarray, d_T: np.ndarray, limits: Mapping[str, float]
) -> dict[str, np.ndarray]:
    """Least stable oscillation (d_T, c_T) by name."""
    found = [_Excitation(np.nan, np.nan, "no_equilibrium")] * (d_T.size * c_T.size)
    design = line.bogie.absorber
    if known.equilibrium.status == "converged":
        run = changed(line, design, known)
        if run.equilibrium.status == "converged":
            bare = seen_by_absorbers(family_of(design, run), known, (limits["min"], limits["max"]))
            found = [_excitation(least_stable(bare, design.I_T, c, d)) for d in d_T for c in c_T]
    shape = d_T.size, c_T.size
    return {
        name: np.array([getattr(entry, name) for entry in found]).reshape(shape)
        for name in _Excitation._fields
    }


def _tendencies(cfg, line: BogieLine, quiet: Running, c_T, d_T, frequency, steady) -> dict:
    """Tendency (d_T, c_T, wheel, f) of every steady design, and without absorbers."""
    wheels = cfg["out_of_roundness"]["wheels"]
    tendency = np.full((d_T.size, c_T.size, len(wheels), frequency.size), np.nan)
    without = np.full((len(wheels), frequency.size), np.nan)
    if quiet.equilibrium.status == "converged":
        attached = any_absorber(wearing(cfg), as_configured(line, quiet), frequency)
        if steady["none"]:
            without = attached.without().T
        for i, j in zip(*np.nonzero(steady["designs"]), strict=True):
            tendency[i, j] = attached.tendency(c_T[j], d_T[i]).T
    return {
        "status": quiet.equilibrium.status,
        "tendency": tendency,
        "none_tendency": without,
    }


def _in_band(cfg, line: BogieLine, quiet: Running, c_T, d_T, steady) -> dict[str, np.ndarray]:
    """Largest tendency of every steady design in the band of design, finely looked at."""
    axis = band_axis(cfg["study"]["design_band"]["min"], cfg["study"]["design_band"]["max"])
    if quiet.equilibrium.status == "converged":
        linear = linearise(quiet.curve, quiet.equilibrium.state)
        axis = finer_near_modes(axis, np.linalg.eigvals(linear.matrix))
    found = _tendencies(cfg, line, quiet, c_T, d_T, axis, steady)
    without = found["none_tendency"].max(axis=1)
    with_it = found["tendency"].max(axis=-1)
    grows = without > 0.0
    return {
        "band_tendency": with_it,
        "none_band_tendency": without,
        "band_status": np.where(grows, "found", "no_peak"),
        "band_factor": with_it / np.where(grows, without, np.nan),
    }
