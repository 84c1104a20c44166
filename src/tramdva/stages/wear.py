"""The stage `wear`: KTH wear around the wheels by the contacts of one order."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.evolution.out_of_roundness import radius_deviation
from tramdva.stages.wear_sections import chart_of, wear_grid
from tramdva.variables.wear import VARIABLES
from tramdva.wear.passages import AREAS, ContactHistory, depth_around, passages, wear_orders

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any], bogie_simulation: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """KTH wear around the wheels by the contacts of one simulation.

    Parameters
    ----------
    cfg : sections ``wear`` and ``numerics``
    bogie_simulation : variables of this file

    Returns
    -------
    Variables of ``wear``.

    Notes
    -----
    The depth is the worn cross-section over the mean width 2 b of the patch, summed over the zones
    of the profile. Orders up to half of the intervals per revolution are kept.
    """
    simulation = bogie_simulation
    count = simulation["time"].size
    revolutions = round(simulation["wheel_angle"][-1] / (2.0 * np.pi))
    per_turn = count // revolutions
    angle = 2.0 * np.pi * np.arange(per_turn) / per_turn
    order = int(simulation["order"])
    amplitude = complex(simulation["amplitude_real"], simulation["amplitude_imag"])
    worn = [_worn_wheel(cfg, simulation, w, per_turn // 2) for w in range(simulation["wheel"].size)]
    orders = np.array([wheel["orders"] for wheel in worn])
    response = orders[:, order] / amplitude
    deviation = np.tile(radius_deviation([order], [amplitude], angle), (orders.shape[0], 1))
    depth = np.array([depth_around(wheel, angle) for wheel in orders])
    return {
        **{
            name: simulation[name] for name in ("absorber", "order", "frequency", "wheel", "status")
        },
        "amplitude": np.float64(abs(amplitude)),
        "angle": angle,
        "radius_deviation": deviation,
        "largest_radius_deviation": np.abs(deviation).max(axis=1),
        "wear_depth": depth,
        "wear_depth_variation": np.abs(depth - depth.mean(axis=1, keepdims=True)).max(axis=1),
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
    chart, grid = chart_of(cfg), wear_grid(cfg)
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
