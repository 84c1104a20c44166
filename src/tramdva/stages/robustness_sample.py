"""The stage `robustness_sample`: the bogie without absorbers under varied conditions.

Any part of the cases is computed alone and is the same as when all are computed at once.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie import absorber_ports
from tramdva.bogie.absorber_ports import Motion, Ports
from tramdva.bogie.conditions import Conditions, State, as_configured, reached, under
from tramdva.bogie.curving import equilibrium, linearise, with_friction_decrease
from tramdva.bogie.tram import run_through
from tramdva.evolution.any_absorber import wear_ports
from tramdva.evolution.tendency import NEAR
from tramdva.robustness.sample import (
    FRICTIONS,
    cases,
    conditions_of,
    motion_variables,
    port_variables,
    ranges,
    unsprung_mass,
)
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.stages.wheels_out_of_round import wearing
from tramdva.variables.robustness_sample import VARIABLES

__all__ = ["VARIABLES", "compute"]

# Axis of frequencies: refined about this many modes, at these distances in their growth rates.
_REFINED_MODES = 6
_DISTANCES = np.array([0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5])


def compute(
    cfg: Mapping[str, Any], contact_geometry: Mapping[str, np.ndarray], part: int
) -> dict[str, np.ndarray]:
    """One part of the cases.

    Parameters
    ----------
    cfg : sections of the bogie, ``wear``, ``out_of_roundness.wheels``, ``study``, ``numerics``
    contact_geometry : variables of this file
    part : number of the part, from 0

    Returns
    -------
    Variables of ``robustness_sample``; NaN where a case has no equilibrium.
    """
    numerics, study = cfg["numerics"], cfg["study"]
    varied, shares = cases(study, numerics["samples"], numerics["seed"])
    chosen = np.array_split(np.arange(len(varied)), numerics["parts"])[part]
    # The absorbers are attached later: of theirs, only place and inertia count here.
    absorber = cfg["bogie"]["absorber"] | {"c_T": 1.0, "d_T": 0.0}
    line = quiet_bogie_line(
        {**cfg, "bogie": cfg["bogie"] | {"absorber": absorber}}, contact_geometry
    )
    nominal = as_configured(line, run_through(line))
    found = [_case(cfg, nominal, conditions) for conditions in conditions_of(shares[chosen])]
    return {
        "case": chosen.astype(float),
        "varied": np.array([varied[k] for k in chosen]),
        "range": np.array(list(ranges(study))),
        "share": shares[chosen],
        "wheel": np.array(cfg["out_of_roundness"]["wheels"]),
        "friction": np.array(FRICTIONS),
        "speed": np.array(
            [under(line, conditions).track.speed for conditions in conditions_of(shares[chosen])]
        ),
        "unsprung_mass": np.float64(unsprung_mass(nominal)),
        **{name: np.array([case[name] for case in found]) for name in found[0]},
    }


def _case(cfg: Mapping[str, Any], nominal: State, conditions: Conditions) -> dict[str, Any]:
    """Ports and free motion of the bogie under some conditions."""
    state = nominal
    if nominal.equilibrium.status == "converged" and conditions != nominal.conditions:
        state = reached(nominal, conditions)
    steady, status = None, state.equilibrium.status
    if status == "converged":
        decrease = conditions.friction_decrease * cfg["creep_force"]["B"]
        system = with_friction_decrease(state.system, decrease)
        steady = State(state.line, conditions, system, equilibrium(system, state.equilibrium.state))
        status = steady.equilibrium.status
    if steady is None or status != "converged":
        return _no_case(cfg, nominal, status)
    limits = cfg["study"]["frequency"]["min"], cfg["study"]["frequency"]["max"]
    motions = [_motion(each) for each in (state, steady)]
    axis = _frequencies(cfg, motions[0].eigenvalue)
    values = {
        "frequency": axis,
        "bare_growth_rate": np.array(
            [absorber_ports.growth_rate(each.eigenvalue, limits) for each in motions]
        ),
        **port_variables(_ports(cfg, state, axis)),
        **motion_variables(motions, state.system.states),
    }
    responses = [value for name, value in values.items() if name.startswith("wear_by")]
    finite = all(np.isfinite(value).all() for value in responses)
    return {"status": "converged" if finite else "not_finite", **values}


def _motion(state: State) -> Motion:
    linear = linearise(state.system, state.equilibrium.state)
    return absorber_ports.motion(state.system, linear, state.line.bogie.absorber)


def _axis(cfg: Mapping[str, Any]) -> np.ndarray:
    """Frequencies in Hz of all cases: bands and what is near their peaks."""
    bands = [*cfg["study"]["peaks"], cfg["study"]["design_band"]]
    low = min(band["min"] for band in bands) * (1.0 - NEAR)
    high = max(band["max"] for band in bands) * (1.0 + NEAR)
    return np.linspace(low, high, int(np.ceil((high - low) / cfg["numerics"]["frequency_step"])))


def _frequencies(cfg: Mapping[str, Any], eigenvalue: np.ndarray) -> np.ndarray:
    """Frequencies in Hz of a case, rising: finer about the modes of least damping."""
    axis = _axis(cfg)
    frequency = eigenvalue.imag / (2.0 * np.pi)
    inside = np.flatnonzero((frequency > axis[0]) & (frequency < axis[-1]))
    least = inside[np.argsort(np.abs(eigenvalue.real[inside]), kind="stable")[:_REFINED_MODES]]
    distance = np.concatenate([-_DISTANCES[:0:-1], _DISTANCES])
    near = frequency[least, None] + np.abs(eigenvalue.real[least, None]) / (2 * np.pi) * distance
    fine = np.full(_REFINED_MODES * distance.size, axis[-1])
    fine[: near.size] = np.clip(near.ravel(), axis[0], axis[-1])
    return np.sort(np.concatenate([axis, fine]))


def _ports(cfg: Mapping[str, Any], state: State, axis: np.ndarray) -> Ports:
    """Wear of the wheels out of round and motion of the absorbers' places at frequencies in Hz."""
    return wear_ports(wearing(cfg), state.line, state.system, state.equilibrium, axis).ports


def _no_case(cfg: Mapping[str, Any], nominal: State, status: str) -> dict[str, Any]:
    """Variables of a case without equilibrium: all NaN but its status."""
    axis = _frequencies(cfg, np.zeros(0, complex))
    wheels = len(cfg["out_of_roundness"]["wheels"])
    absorber = nominal.line.bogie.absorber
    carriers = 12 if absorber.motion == "translation" else 4
    modes, n = nominal.system.states, absorber_ports.ABSORBERS
    none = complex(np.nan, np.nan)
    empty = Ports(
        axis,
        np.full((axis.size, wheels), none),
        np.full((axis.size, wheels, n), none),
        np.full((axis.size, n), none),
        np.full((axis.size, n, n), none),
    )
    still = Motion(
        np.full(modes, none), np.full((carriers, modes), none), np.full((modes, carriers), none)
    )
    return {
        "status": status,
        "frequency": axis,
        "bare_growth_rate": np.full(len(FRICTIONS), np.nan),
        **port_variables(empty),
        **motion_variables([still] * len(FRICTIONS), modes),
    }
