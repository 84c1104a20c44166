"""The stage `evolution_tendency`: evolution tendency with every absorber (figure 10)."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tramdva.bogie.stored import stored_bogie
from tramdva.evolution.out_of_roundness import level
from tramdva.evolution.tendency import (
    NEAR,
    band_axis,
    evolution_tendency,
    excitation_frequency,
    finer_near_modes,
    growth_left,
    highest_peak,
    largest,
    linear_wear_response,
    normalised,
    order_of_frequency,
    wear_sensitivity,
)
from tramdva.stages.wheels_out_of_round import wearing
from tramdva.variables.evolution_tendency import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any],
    bogie_linearisation: Sequence[Mapping[str, np.ndarray]],
    wear: Sequence[Mapping[str, np.ndarray]],
) -> dict[str, np.ndarray]:
    """Evolution tendency of the simulated orders and of the linearised vehicle (figure 10).

    Parameters
    ----------
    cfg : sections ``wear``, ``out_of_roundness.wheels``, ``study``, ``numerics``
    bogie_linearisation : variables of these files; each says which absorber it is of
    wear : variables of these files of all orders and absorbers, in any order

    Returns
    -------
    Variables of ``evolution_tendency``.
    """
    study, absorbers = cfg["study"], list(cfg["study"]["absorbers"])
    linearisations = {str(values["absorber"]): values for values in bogie_linearisation}
    worn = {name: _of_absorber(wear, name) for name in absorbers}
    stored = {name: stored_bogie(linearisations[name]) for name in absorbers}
    first = stored[absorbers[0]]
    speed, radius = first.places.speed, first.wheel_radius
    orders = np.array([float(part["order"]) for part in worn[absorbers[0]]])
    axis = np.linspace(
        study["frequency"]["min"], study["frequency"]["max"], cfg["numerics"]["frequency_points"]
    )
    frequency = excitation_frequency(orders, speed, radius)
    worn_by = wearing(cfg)
    worn_mean, linear, at_orders = [], [], []
    for name in absorbers:
        bogie, law = stored[name].bogie, stored[name].law
        sensitivity = wear_sensitivity(bogie, law, worn_by)
        worn_mean.append(sensitivity.mean_depth()[worn_by.places])
        for found, at in ((linear, axis), (at_orders, frequency)):
            response = linear_wear_response(bogie, sensitivity, at, speed, radius, worn_by.wheels)
            found.append(response[:, worn_by.places].T)
    linear, at_orders = np.array(linear), np.array(at_orders)
    fine = finely(cfg, [linearisations[name] for name in absorbers])
    simulated = _simulated(absorbers, worn)
    # One scale for all curves of a wheel: that of the simulated orders, as in the paper.
    scale = simulated["evolution_tendency"][absorbers.index("none")]
    peaks = _peaks(cfg, fine, frequency, simulated["evolution_tendency"])
    return {
        **_absorbers(linearisations, absorbers),
        "wheel": np.array(cfg["out_of_roundness"]["wheels"]),
        "order": orders,
        "frequency": frequency,
        **simulated,
        "largest_tendency": largest(scale),
        "fastest_order": fastest_order(orders, frequency, scale, study["design_band"]),
        "evolution_tendency_normalised": normalised(simulated["evolution_tendency"], scale),
        **_levels(absorbers, worn, simulated["evolution_tendency"], study["revolutions"]),
        "frequency_axis": axis,
        "order_axis": order_of_frequency(axis, speed, radius),
        "linearised_wear_response_real": linear.real,
        "linearised_wear_response_imag": linear.imag,
        "linearised_evolution_tendency": evolution_tendency(linear),
        "linearised_normalised": normalised(evolution_tendency(linear), scale),
        "order_linearised_real": at_orders.real,
        "order_linearised_imag": at_orders.imag,
        "linearised_mean_wear_depth": np.array(worn_mean),
        **fine.in_band(),
        **peaks,
        "peak_tendency_normalised": normalised(peaks["peak_tendency"], scale),
    }


class Fine(NamedTuple):
    """Linearised tendency at frequencies that are finer near the modes.

    band : ``min`` and ``max`` in Hz, of design
    absorbers : (a,) names; frequency : (a, f) Hz; tendency : (a, wheels, f)
    """

    band: Mapping[str, float]
    absorbers: list[str]
    frequency: np.ndarray
    tendency: np.ndarray

    def in_band(self) -> dict[str, np.ndarray]:
        """Largest tendency (absorber, wheel) in the band of design, and what is left of it."""
        inside = (self.frequency >= self.band["min"]) & (self.frequency <= self.band["max"])
        top = np.where(inside[:, None], self.tendency, -np.inf).max(axis=-1)
        return {
            "band_tendency": top,
            "band_growth_left": growth_left(top, top[self.absorbers.index("none")]),
        }


def finely(cfg: Mapping[str, Any], linearisations: Sequence[Mapping[str, np.ndarray]]) -> Fine:
    """Tendency of the linearised vehicle with each absorber; arguments as in `compute`."""
    study, worn_by = cfg["study"], wearing(cfg)
    axis = np.linspace(
        study["frequency"]["min"], study["frequency"]["max"], cfg["numerics"]["frequency_points"]
    )
    band = band_axis(study["design_band"]["min"], study["design_band"]["max"])
    frequency, tendency = [], []
    for one in map(stored_bogie, linearisations):
        frequency.append(finer_near_modes(np.union1d(axis, band), one.bogie.eigenvalue))
        sensitivity = wear_sensitivity(one.bogie, one.law, worn_by)
        response = linear_wear_response(
            one.bogie, sensitivity, frequency[-1], one.places.speed, one.wheel_radius,
            worn_by.wheels,
        )  # fmt: skip
        tendency.append(evolution_tendency(response[:, worn_by.places].T))
    names = [str(values["absorber"]) for values in linearisations]
    return Fine(study["design_band"], names, np.array(frequency), np.array(tendency))


def fastest_order(
    order: np.ndarray, frequency: np.ndarray, tendency: np.ndarray, band: Mapping[str, float]
) -> np.ndarray:
    """Order (wheels,) of the largest tendency in a band; of all, where no order lies in it.

    Parameters
    ----------
    order, frequency : (k,), the latter in Hz
    tendency : (wheels, k), NaN where a simulation did not run steadily
    band : ``min`` and ``max`` in Hz

    Returns
    -------
    (wheels,) array, NaN for a wheel without any tendency there
    """
    inside = (frequency >= band["min"]) & (frequency <= band["max"])
    chosen = inside if inside.any() else np.ones(order.size, bool)
    growing = np.where(np.isfinite(tendency) & chosen, tendency, -np.inf)
    return np.where(np.isfinite(growing).any(axis=1), order[growing.argmax(axis=1)], np.nan)


def _of_absorber(wear: Sequence[Mapping[str, np.ndarray]], name: str) -> list:
    """Files of an absorber by rising order."""
    own = [part for part in wear if part["absorber"] == name]
    return sorted(own, key=lambda part: float(part["order"]))


def _absorbers(linearisations, absorbers: Sequence[str]) -> dict[str, np.ndarray]:
    return {
        "absorber": np.array(absorbers),
        **{
            name: np.array([float(linearisations[a][name]) for a in absorbers])
            for name in ("m_T", "c_T", "d_T")
        },
    }


def _simulated(absorbers: Sequence[str], worn) -> dict[str, np.ndarray]:
    """Results of the simulations by absorber, wheel, order; NaN where one did not run steadily."""

    def of(name: str) -> np.ndarray:
        return np.moveaxis(np.array([[part[name] for part in worn[a]] for a in absorbers]), 1, -1)

    status = of("status")
    steady = (status == "periodic")[:, None]
    amplitude = of("wear_amplitude") / of("amplitude")[:, None]
    response = np.where(steady, amplitude * np.exp(1j * of("wear_phase")), np.nan)
    return {
        "wear_response_amplitude": np.abs(response),
        "wear_response_phase": np.where(steady, of("wear_phase"), np.nan),
        "evolution_tendency": evolution_tendency(response),
        "mean_wear_depth": np.where(steady, of("mean_wear_depth"), np.nan),
        "harmonic_distortion": np.where(steady, of("harmonic_distortion"), np.nan),
        "region_changes": of("region_changes"),
        "status": status,
    }


def _levels(absorbers, worn, tendency: np.ndarray, revolutions: float) -> dict[str, np.ndarray]:
    """Levels of the orders in dB, now and after some revolutions of exponential growth."""
    amplitude = np.array([float(part["amplitude"]) for part in worn[absorbers[0]]])
    return {
        "level": np.tile(level(amplitude), (tendency.shape[1], 1)),
        "level_after": level(amplitude * np.exp(tendency * revolutions)),
    }


def _peaks(cfg, fine: Fine, frequency, simulated) -> dict[str, np.ndarray]:
    """Positive peaks without absorbers in the bands of the study, and what is left of them.

    With absorbers a peak may have no top any more: its tendency is the largest within `NEAR` of the
    frequency of the peak without, on the axis and at whole orders.
    """
    bands, tendency, axes = cfg["study"]["peaks"], fine.tendency, fine.frequency
    none = fine.absorbers.index("none")
    shape = (*tendency.shape[:2], len(bands))
    top, value, whole = (np.full(shape, np.nan) for _ in range(3))
    for a, w, k in np.ndindex(*shape):
        axis, own = np.unique(axes[a], return_index=True)
        inside = (axis >= bands[k]["min"]) & (axis <= bands[k]["max"])
        top[a, w, k], _ = highest_peak(axis[inside], tendency[a, w, own][inside])
    for a, w, k in np.ndindex(*shape):
        place = top[none, w, k]
        if np.isfinite(place):
            value[a, w, k] = np.max(tendency[a, w, np.abs(axes[a] / place - 1.0) <= NEAR])
            near = np.abs(frequency / place - 1.0) <= NEAR
            whole[a, w, k] = np.max(simulated[a, w, near], initial=-np.inf)
    whole = np.where(np.isfinite(whole), whole, np.nan)
    return {
        "peak": np.array([band["name"] for band in bands]),
        "peak_frequency": top,
        "peak_tendency": value,
        "peak_order_tendency": whole,
        "peak_factor": value / value[none],
        "peak_order_factor": np.where(whole[none] > 0.0, whole / whole[none], np.nan),
        "peak_status": np.where(np.isfinite(top), "found", "no_peak"),
    }
