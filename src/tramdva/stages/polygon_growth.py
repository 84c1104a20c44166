"""The stage `polygon_growth`: growth of wheel orders over kilometres of the route."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tramdva.evolution.out_of_roundness import level
from tramdva.route.alignment import plan_of_route
from tramdva.route.growth import (
    ANGLES,
    DISTANCE_STATUS,
    distance_to_limit,
    grown,
    initial_amplitudes,
    peak_to_peak,
    wheel_life,
)
from tramdva.route.parameters import InitialSpectrum
from tramdva.stages.route_sections import lap_of
from tramdva.variables.polygon_growth import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any],
    route_response: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Growth, levels and distances to the limit of the wheels of the vehicle.

    Parameters
    ----------
    cfg : section ``route``, ``numerics.distances``
    route_response : variables of this file
    file_of : where a file lies that the configuration names: a table of sections

    Returns
    -------
    Variables of ``polygon_growth``.
    """
    given, route = route_response, cfg["route"]
    rate = _rate(given, given["revolutions_per_1000_km"])
    growth = rate.sum(axis=1)  # law, absorber, wheel, order
    coarse = _rate(given, _coarse_revolutions(given)).sum(axis=1)
    orders = given["order"]
    initial = initial_amplitudes(orders, InitialSpectrum.model_validate(route["initial"]))
    distance = np.linspace(0.0, route["horizon_km"], cfg["numerics"]["distances"])
    waves = np.array([grown(initial, one, distance) for one in growth.reshape(-1, orders.size)])
    waves = waves.reshape(*growth.shape[:-1], *waves.shape[1:])  # ..., distance, order
    limits = _distances(cfg, given, growth, initial)
    x, y, number = plan_of_route(lap_of(cfg, file_of).sections)
    return {
        **{
            name: given[name]
            for name in ("wear_law", "absorber", "m_T", "c_T", "d_T", "wheel", "order", "section",
                         "surface")
        },
        "growth_per_1000_km": growth.real,
        "drift_per_1000_km": growth.imag,
        "quadrature_error": np.abs(coarse.real - growth.real),
        **_sections(given, rate),
        "distance": distance,
        "initial_level": level(initial),
        "level": np.moveaxis(level(waves), -1, -2),
        "peak_to_peak": peak_to_peak(orders, waves),
        **limits,
        **_profiles(orders, initial, growth, limits["turning_distance"], route["horizon_km"]),
        "distance_share": given["section_share"].sum(axis=1),
        "section_x": x,
        "section_y": y,
        "plan_section": number.astype(float),
        "hindrance": np.array(_hindrances(given)),
        "shown_wear_law": np.array(route["wear_law"]),
    }  # fmt: skip


def _rate(given: Mapping[str, np.ndarray], revolutions: np.ndarray) -> np.ndarray:
    """Growth and drift (law, class, absorber, wheel, order) in 1000 km, by class."""
    response = given["wear_response_real"] + 1j * given["wear_response_imag"]
    return -np.einsum("cpw,l,lcawop->lcawo", revolutions, given["wear_scale"], response)


def _coarse_revolutions(given: Mapping[str, np.ndarray]) -> np.ndarray:
    """Revolutions in 1000 km by the rule with twice the step over the speeds."""
    weight = given["speed_weight"][..., None]
    share = given["coarse_speed_weight"][..., None] / np.where(weight > 0.0, weight, 1.0)
    return given["revolutions_per_1000_km"] * share


def _sections(given: Mapping[str, np.ndarray], rate: np.ndarray) -> dict[str, np.ndarray]:
    """Shares of the sections in the growth, and what grows most."""
    of_class = given["section_share"] / given["distance_share"]  # section, class
    by_section = np.einsum("lcawo,sc->lawos", rate.real, of_class)
    total = by_section.sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        share = by_section / total[..., None]
    known = np.isfinite(total).all(axis=-1)
    top = np.where(np.isfinite(total), total, -np.inf).argmax(axis=-1)
    fastest = np.take_along_axis(total, top[..., None], -1)[..., 0]
    part = np.take_along_axis(by_section, top[..., None, None], -2)[..., 0, :]
    part = np.where(np.isfinite(part), part, -np.inf)
    names = np.where(known, given["section"][part.argmax(axis=-1)], "")
    wear = _wear(given)
    return {
        "section_share": share,
        "first_wheel": np.where(
            known.all(axis=-1), np.where(known, fastest, -np.inf).argmax(axis=-1), -1
        ).astype(float),
        "fastest_order": np.where(known, given["order"][top], np.nan),
        "fastest_growth": np.where(known, fastest, np.nan),
        "fastest_section": names,
        "wave_growth_per_wear": np.where(known, fastest, np.nan)
        / (0.1 * wear.sum(axis=-1))[:, None, :],
        "mean_wear_per_10000_km": wear,
    }


def _wear(given: Mapping[str, np.ndarray]) -> np.ndarray:
    """Mean loss of radius (law, wheel, surface) in mm in 10 000 km, as scaled."""
    depth = np.einsum("cpw,lcswp->lws", given["revolutions_per_1000_km"], given["mean_wear_depth"])
    surface = np.stack([np.ones_like(given["wear_scale"]), given["flange_wear_ratio"]], axis=-1)
    return 1e4 * given["wear_scale"][:, None, None] * surface[:, None, :] * depth


def _distances(
    cfg: Mapping[str, Any],
    given: Mapping[str, np.ndarray],
    growth: np.ndarray,
    initial: np.ndarray,
) -> dict[str, Any]:
    """Distances to the limit, of each wheel and of the vehicle, and the life of its wheels."""
    turning, horizon = cfg["route"]["turning"], cfg["route"]["horizon_km"]
    limit = 1e-3 * turning["peak_to_peak_mm"]
    found = [
        distance_to_limit(given["order"], initial, one, limit, horizon)
        for one in growth.reshape(-1, growth.shape[-1])
    ]
    km = np.array([one.km for one in found]).reshape(growth.shape[:-1])
    status = np.array([one.status for one in found]).reshape(growth.shape[:-1])
    first = np.where(np.isfinite(km), km, np.inf).argmin(axis=-1)
    soonest = np.take_along_axis(km, first[..., None], -1)[..., 0]
    of_vehicle = np.take_along_axis(status, first[..., None], -1)[..., 0]
    # A wheel without a steady answer may be the first: then nothing is told of the vehicle.
    unknown = (status == DISTANCE_STATUS[-1]).any(axis=-1)
    soonest = np.where(unknown, np.nan, soonest)
    of_vehicle = np.where(unknown, DISTANCE_STATUS[-1], of_vehicle)
    longest = [_longest(given["absorber"], *row) for row in zip(soonest, of_vehicle, strict=True)]
    tread = 1e-7 * cfg["route"]["measured_wear"]["tread_mm_per_10000_km"]  # m per km
    life = [
        wheel_life(one, 1e-3 * turning["cut_mm"], tread, 1e-3 * turning["usable_radius_mm"])
        if one > 0.0
        else np.nan
        for one in soonest.ravel()
    ]
    return {
        "limit": np.float64(limit),
        "distance_to_limit": km,
        "distance_status": status,
        "turning_distance": soonest,
        "turning_status": of_vehicle,
        "wheel_life": np.array(life).reshape(soonest.shape),
        "longest_absorber": np.array(longest),
        "laws_agree": len(set(longest)) == 1 and longest[0] != "",
    }


def _profiles(
    orders: np.ndarray, initial: np.ndarray, growth: np.ndarray, turning: np.ndarray, horizon: float
) -> dict[str, np.ndarray]:
    """Radius deviations (law, absorber, wheel, angle) when the vehicle's wheels are turned."""
    angle = np.linspace(0.0, 2.0 * np.pi, ANGLES + 1)
    at = np.where(np.isfinite(turning), turning, horizon)
    exponent = growth * (at / 1000.0)[..., None, None]
    waves = initial * np.exp(np.minimum(exponent.real, 300.0) + 1j * exponent.imag)
    return {
        "angle": angle,
        "turned_profile": (waves @ np.exp(1j * np.outer(orders, angle))).real,
    }


def _longest(absorbers: np.ndarray, km: np.ndarray, status: np.ndarray) -> str:
    """Absorber with the longest distance; several beyond the horizon are told by the first."""
    reach = np.where(status == "beyond_horizon", np.inf, np.where(np.isfinite(km), km, -np.inf))
    return str(absorbers[reach.argmax()]) if reach.max() > -np.inf else ""


def _hindrances(given: Mapping[str, np.ndarray]) -> list[str]:
    """Where an absorber has no steady answer: status and class, the first one; else empty."""
    found = []
    for k in range(given["absorber"].size):
        status = given["status"][:, k]
        wrong = np.argwhere(status != "converged")
        found.append("")
        if wrong.size:
            at, point = wrong[0]
            found[-1] = f"{status[at, point]}: {given['class'][at]}"
    return found
