"""The stages from wear to evolution tendency: from earlier results to the variables of a file."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tramdva import evolution
from tramdva.bogie.rough_wheel_files import stored_bogie
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.bogie.vehicle import WHEELS
from tramdva.contact import fastsim, patch
from tramdva.out_of_roundness import level, radius_deviation
from tramdva.wear import WearChart
from tramdva.wear_history import AREAS, ContactHistory, depth_around, passages, wear_orders

NEAR = 0.1  # of the frequency of a peak


def wear_chart(cfg: Mapping[str, Any]) -> WearChart:
    """Wear chart of the section ``wear``."""
    return WearChart(**cfg["wear"])


def wear_grid(cfg: Mapping[str, Any]) -> fastsim.PatchGrid:
    """Cells of the worn patch."""
    return fastsim.patch_grid(cfg["numerics"]["wear_cells_along"], cfg["numerics"]["wear_strips"])


def worn_wheels(cfg: Mapping[str, Any]) -> list[int]:
    """Places of the wheels out of round in `vehicle.WHEELS`."""
    return [WHEELS.index(name) for name in cfg["out_of_roundness"]["wheels"]]


def wear_in_equilibrium(
    cfg: Mapping[str, Any], bogie: RoughBogie, law: patch.ContactLaw
) -> evolution.WearSensitivity:
    """Wear of the wheels out of round and its derivatives, by the configured chart and cells."""
    wheels = cfg["out_of_roundness"]["wheels"]
    return evolution.wear_sensitivity(bogie, law, wear_grid(cfg), wear_chart(cfg), wheels)


def linear_response(
    cfg: Mapping[str, Any],
    bogie: RoughBogie,
    wear: evolution.WearSensitivity,
    frequency: np.ndarray,
    speed: float,
    wheel_radius: float,
) -> np.ndarray:
    """Wear response (wheel, f) of the wheels out of round; see `evolution.linear_wear_response`."""
    wheels = cfg["out_of_roundness"]["wheels"]
    response = evolution.linear_wear_response(bogie, wear, frequency, speed, wheel_radius, wheels)
    return response[:, worn_wheels(cfg)].T


def wear(cfg: Mapping[str, Any], simulation: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """KTH wear around the wheels by the contacts of one simulation.

    Parameters
    ----------
    cfg : sections ``wear`` and ``numerics``
    simulation : variables of ``bogie_simulation``

    Returns
    -------
    Variables of ``wear``.

    Notes
    -----
    The depth is the worn cross-section over the mean width 2 b of the patch, summed over the zones
    of the profile. Orders up to half of the intervals per revolution are kept.
    """
    count = simulation["time"].size
    revolutions = round(simulation["wheel_angle"][-1] / (2.0 * np.pi))
    per_turn = count // revolutions
    angle = 2.0 * np.pi * np.arange(per_turn) / per_turn
    order = int(simulation["order"])
    amplitude = complex(simulation["amplitude_real"], simulation["amplitude_imag"])
    worn = [_worn_wheel(cfg, simulation, w, per_turn // 2) for w in range(simulation["wheel"].size)]
    orders = np.array([wheel["orders"] for wheel in worn])
    response = orders[:, order] / amplitude
    return {
        **{name: simulation[name] for name in ("order", "frequency", "wheel", "status")},
        "amplitude": np.float64(abs(amplitude)),
        "angle": angle,
        "radius_deviation": np.tile(
            radius_deviation([order], [amplitude], angle), (orders.shape[0], 1)
        ),
        "wear_depth": np.array([depth_around(wheel, angle) for wheel in orders]),
        "patch_width": np.array([wheel["width"] for wheel in worn]),
        "mean_wear_depth": orders[:, 0].real,
        "wear_amplitude": np.abs(orders[:, order]),
        "wear_phase": np.angle(response),
        "harmonic_distortion": np.array([_distortion(wheel, order) for wheel in orders]),
        "region": np.array(AREAS),
        "region_share": np.array([wheel["shares"].mean(axis=0) for wheel in worn]),
        "region_share_range": np.array([np.ptp(wheel["shares"], axis=0) for wheel in worn]),
        "region_changes": np.array([wheel["changes"] for wheel in worn]),
    }


def _worn_wheel(cfg, simulation, wheel: int, count: int) -> dict[str, Any]:
    """Orders of the depth (m), width (m), shares (k, 5) and change of region of a wheel."""
    chart, grid = wear_chart(cfg), wear_grid(cfg)
    table, shear_modulus = simulation["kalker_table"], float(simulation["shear_modulus"])
    speed = float(simulation["rolling_speed"][wheel])
    radius = float(simulation["wheel_radius"] * speed / simulation["speed"])
    orders, shares, weight, width = 0.0, 0.0, 0.0, 0.0
    for zone in range(simulation["zone"].size):
        history = ContactHistory(
            *(simulation[name][wheel, zone] for name in ContactHistory._fields)
        )
        found = passages(history, table, shear_modulus, grid, speed, chart)
        angle = simulation["wheel_angle"] + simulation["wheel_lead"][wheel, zone] / radius
        orders = orders + wear_orders(found.area, angle, count)
        load = np.maximum(history.normal_force, 0.0)[:, None]
        shares, weight = shares + load * found.shares, weight + load
        touching = history.normal_force > 0.0
        if touching.any():
            width = max(width, 2.0 * float(history.semi_axis_lateral[touching].mean()))
    shares = shares / np.where(weight > 0.0, weight, 1.0)
    sliding = np.argmax(shares[:, :-1], axis=1)
    return {
        "orders": orders / width if width > 0.0 else np.full(count, np.nan + 0j),
        "width": width,
        "shares": shares,
        "changes": bool(np.any(sliding != sliding[0])),
    }


def _distortion(orders: np.ndarray, order: int) -> float:
    harmonics = np.abs(orders[2 * order :: order])
    return float(np.linalg.norm(harmonics) / abs(orders[order]))


def evolution_tendency(
    cfg: Mapping[str, Any],
    linearisations: Mapping[str, Mapping[str, np.ndarray]],
    worn: Mapping[str, Sequence[Mapping[str, np.ndarray]]],
) -> dict[str, np.ndarray]:
    """Evolution tendency of the simulated orders and of the linearised vehicle (figure 10).

    Parameters
    ----------
    cfg : sections ``wear``, ``out_of_roundness.wheels``, ``study``, ``numerics``
    linearisations : variables of ``bogie_linearisation`` by absorber
    worn : variables of ``wear`` of all orders, rising, by absorber

    Returns
    -------
    Variables of ``evolution_tendency``.
    """
    study, absorbers = cfg["study"], list(cfg["study"]["absorbers"])
    stored = {name: stored_bogie(linearisations[name]) for name in absorbers}
    first = stored[absorbers[0]]
    speed, radius = first.places.speed, first.wheel_radius
    orders = np.array([float(part["order"]) for part in worn[absorbers[0]]])
    axis = np.linspace(
        study["frequency"]["min"], study["frequency"]["max"], cfg["numerics"]["frequency_points"]
    )
    frequency = evolution.excitation_frequency(orders, speed, radius)
    worn_mean, linear, at_orders = [], [], []
    for name in absorbers:
        bogie, law = stored[name].bogie, stored[name].law
        sensitivity = wear_in_equilibrium(cfg, bogie, law)
        worn_mean.append(sensitivity.mean_depth()[worn_wheels(cfg)])
        linear.append(linear_response(cfg, bogie, sensitivity, axis, speed, radius))
        at_orders.append(linear_response(cfg, bogie, sensitivity, frequency, speed, radius))
    linear, at_orders = np.array(linear), np.array(at_orders)
    simulated = _simulated(absorbers, worn)
    # One scale for all curves of a wheel: that of the simulated orders, as in the paper.
    scale = simulated["evolution_tendency"][absorbers.index("none")]
    return {
        **_absorbers(linearisations, absorbers),
        "wheel": np.array(cfg["out_of_roundness"]["wheels"]),
        "order": orders,
        "frequency": frequency,
        **simulated,
        "evolution_tendency_normalised": evolution.normalised(
            simulated["evolution_tendency"], scale
        ),
        **_levels(absorbers, worn, simulated["evolution_tendency"], study["revolutions"]),
        "frequency_axis": axis,
        "order_axis": evolution.order_of_frequency(axis, speed, radius),
        "linearised_wear_response_real": linear.real,
        "linearised_wear_response_imag": linear.imag,
        "linearised_evolution_tendency": evolution.evolution_tendency(linear),
        "linearised_normalised": evolution.normalised(evolution.evolution_tendency(linear), scale),
        "order_linearised_real": at_orders.real,
        "order_linearised_imag": at_orders.imag,
        "linearised_mean_wear_depth": np.array(worn_mean),
        **_peaks(cfg, absorbers, axis, linear, frequency, simulated["evolution_tendency"]),
    }


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
        "evolution_tendency": evolution.evolution_tendency(response),
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


def _peaks(cfg, absorbers, axis, linear, frequency, simulated) -> dict[str, np.ndarray]:
    """Positive peaks without absorbers in the bands of the study, and what is left of them.

    With absorbers a peak may have no top any more: its tendency is the largest within `NEAR` of the
    frequency of the peak without, on the axis and at whole orders.
    """
    bands, tendency = cfg["study"]["peaks"], evolution.evolution_tendency(linear)
    none = absorbers.index("none")
    shape = (*tendency.shape[:2], len(bands))
    top, value, whole = (np.full(shape, np.nan) for _ in range(3))
    for a, w, k in np.ndindex(*shape):
        inside = (axis >= bands[k]["min"]) & (axis <= bands[k]["max"])
        top[a, w, k], _ = evolution.highest_peak(axis[inside], tendency[a, w, inside])
    for a, w, k in np.ndindex(*shape):
        place = top[none, w, k]
        if np.isfinite(place):
            value[a, w, k] = np.max(tendency[a, w, np.abs(axis / place - 1.0) <= NEAR])
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
