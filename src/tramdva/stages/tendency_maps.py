"""The stage `tendency_maps`: evolution tendency over speed, curve radius and absorber."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tramdva.bogie.conditions import State, as_configured, reached
from tramdva.bogie.curving import linearise, oscillations
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.rough_wheels import RoughBogie
from tramdva.bogie.tram import absorber as absorber_of
from tramdva.bogie.tram import run_through
from tramdva.evolution.any_absorber import any_absorber
from tramdva.evolution.growing_orders import growing_orders
from tramdva.evolution.tendency import (
    band_axis,
    evolution_tendency,
    finer_near_modes,
    growth_left,
    largest,
    linear_wear_response,
    wear_sensitivity,
)
from tramdva.stages.axes import best_design
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.stages.wheels_out_of_round import wearing
from tramdva.variables.tendency_maps import VARIABLES

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    bogie_linearisation: Sequence[Mapping[str, np.ndarray]],
) -> dict[str, np.ndarray]:
    """Evolution tendency of the linearised vehicle over speed, radius and absorber.

    Parameters
    ----------
    cfg : sections of the bogie, ``wear``, ``out_of_roundness.wheels``, ``study``, ``numerics``
    contact_geometry : variables of this file
    bogie_linearisation : variables of these files: the values of the absorbers

    Returns
    -------
    Variables of ``tendency_maps``.
    """
    study, numerics = cfg["study"], cfg["numerics"]
    designs = {
        str(linear["absorber"]): tuple(float(linear[name]) for name in ("m_T", "c_T", "d_T"))
        for linear in bogie_linearisation
    }
    line = quiet_bogie_line(cfg, contact_geometry)
    known = as_configured(line, run_through(line))
    frequency = np.linspace(
        study["frequency"]["min"], study["frequency"]["max"], numerics["frequency_points"]
    )
    speed = np.linspace(study["speed"]["min"], study["speed"]["max"], numerics["speeds"])
    radius = np.geomspace(study["radius"]["min"], study["radius"]["max"], numerics["radii"])
    inertia, stiffness, damping = np.array([designs[name] for name in study["absorbers"]]).T
    over_speed = _over(cfg, known, designs, "speed", speed, frequency)
    over_radius = _over(cfg, known, designs, "radius", radius, frequency)
    values = {
        "absorber": np.array(study["absorbers"]),
        "m_T": inertia,
        "c_T": stiffness,
        "d_T": damping,
        "wheel": np.array(cfg["out_of_roundness"]["wheels"]),
        "frequency": frequency,
        "speed": speed,
        "speed_tendency": over_speed["tendency"],
        "speed_growth_rate": over_speed["growth_rate"],
        "speed_status": over_speed["status"],
        "radius": radius,
        "radius_tendency": over_radius["tendency"],
        "radius_growth_rate": over_radius["growth_rate"],
        "radius_status": over_radius["status"],
        **_over_absorbers(cfg, known),
    }
    return values | conclusions(values, cfg["bogie"]["wheel"]["radius"])


def conclusions(values: Mapping[str, np.ndarray], wheel_radius: float) -> dict[str, np.ndarray]:
    """Orders that grow over the speed, and the best designs of the maps.

    Parameters
    ----------
    values : the other variables of ``tendency_maps``; wheel_radius : m

    Returns
    -------
    The variables of ``tendency_maps`` that follow from those given.
    """
    none = list(values["absorber"]).index("none")
    bare = values["speed_tendency"][none]
    c_T, d_T = values["map_c_T"], values["map_d_T"]
    best = np.array([best_design(factor, c_T, d_T) for factor in values["map_factor"]]).T
    compromise = best_design(values["map_worst_factor"], c_T, d_T)
    return {
        "largest_speed_tendency": largest(bare.reshape(bare.shape[0], -1)),
        **growing_orders(values, wheel_radius),
        **dict(zip(("best_c_T", "best_d_T", "best_factor"), best, strict=True)),
        **dict(
            zip(("compromise_c_T", "compromise_d_T", "compromise_factor"), compromise, strict=True)
        ),
    }


def _over(cfg, known: State, designs, name: str, values, frequency) -> dict[str, np.ndarray]:
    """Tendency (absorber, wheel, value, f) over values of a field of the track.

    From the line's own value upwards and downwards, each start from its neighbour.
    """
    absorbers, wheels = cfg["study"]["absorbers"], cfg["out_of_roundness"]["wheels"]
    tendency = np.full((len(absorbers), len(wheels), values.size, frequency.size), np.nan)
    growth = np.full((len(absorbers), values.size), np.nan)
    status = np.full((len(absorbers), values.size), "not_converged", dtype="U20")
    shares = values / getattr(known.line.track, name)
    own = int(np.argmin(np.abs(shares - 1.0)))
    for i, absorber in enumerate(absorbers):
        design = absorber_of(known.line, *designs[absorber][1:])
        for way in (range(own, values.size), range(own - 1, -1, -1)):
            state = known
            for k in way:
                conditions = state.conditions._replace(**{name: float(shares[k])})
                state = reached(state, conditions, design)
                status[i, k] = state.equilibrium.status
                if state.equilibrium.status != "converged":
                    break
                bogie = rough_bogie(state.system, state.equilibrium)
                growth[i, k] = _growth_rate(bogie, cfg["study"]["frequency"])
                worn = wear_sensitivity(bogie, state.system.contacts.law, wearing(cfg))
                places, radius = state.system.contacts.places, state.line.bogie.wheel.radius
                response = linear_wear_response(
                    bogie, worn, frequency, places.speed, radius, wheels
                )
                tendency[i, :, k] = evolution_tendency(response[:, wearing(cfg).places].T)
    return {"tendency": tendency, "growth_rate": growth, "status": status}


def _growth_rate(bogie: RoughBogie, limits: Mapping[str, float]) -> float:
    """Largest growth rate in 1/s of the oscillations within limits (Hz); NaN if there are none."""
    values = oscillations(bogie.eigenvalue, (limits["min"], limits["max"]))
    return float(values.real.max()) if values.size else np.nan


def _over_absorbers(cfg, known: State) -> dict[str, np.ndarray]:
    """Largest tendency in the band of design with an absorber over that without."""
    study, points = cfg["study"], cfg["numerics"]["map_points"]
    d_T = np.linspace(study["d_T"]["min"], study["d_T"]["max"], points)
    c_T = np.linspace(study["c_T"]["min"], study["c_T"]["max"], points)
    axis = band_axis(study["design_band"]["min"], study["design_band"]["max"])
    matrix = linearise(known.system, known.equilibrium.state).matrix
    axis = finer_near_modes(axis, np.linalg.eigvals(matrix))
    attached = any_absorber(wearing(cfg), known, axis)
    without = attached.without().max(axis=0)
    left = np.array([[attached.tendency(c, d).max(axis=0) for c in c_T] for d in d_T])
    return {
        "map_d_T": d_T,
        "map_c_T": c_T,
        "map_factor": np.moveaxis(left / np.where(without > 0.0, without, np.nan), -1, 0),
        "map_worst_factor": growth_left(left, without),
    }
