"""The stage `robustness_sample`: the bogie without absorbers under varied conditions.

Any part of the cases is computed alone and is the same as when all are computed at once.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie import absorber_ports
from tramdva.bogie.absorber_ports import Attachable, Motion, Ports
from tramdva.bogie.absorber_weight import carrying
from tramdva.bogie.conditions import Conditions, State, as_configured, reached, under
from tramdva.bogie.curving import linearise, near, with_friction_decrease
from tramdva.bogie.tram import run_through
from tramdva.evolution.any_absorber import wear_ports
from tramdva.evolution.tendency import NEAR, band_axis, finer_near_modes
from tramdva.robustness.sample import (
    FRICTIONS,
    cases,
    conditions_of,
    motion_variables,
    port_variables,
    ranges,
    unsprung_mass,
)
from tramdva.stages.bogie_sections import frequency_limits, quiet_bogie_line
from tramdva.stages.wheels_out_of_round import wearing
from tramdva.variables.robustness_sample import VARIABLES

__all__ = ["VARIABLES", "compute"]

Frictions = tuple[State, State]  # by `FRICTIONS`


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
    found, status = _steady(cfg, state)
    if status != "converged":
        return _no_case(cfg, nominal, status)
    (bare, laden), limits = found, frequency_limits(cfg)
    motions = [_motion(each) for each in bare]
    alone = [absorber_ports.growth_rate(each.eigenvalue, limits) for each in motions]
    axis = finer_near_modes(_axis(cfg), motions[0].eigenvalue)
    if laden is not bare:
        motions = [_motion(each) for each in laden]
    values = {
        "frequency": axis,
        "bare_growth_rate": np.array(alone),
        **port_variables(wear_ports(wearing(cfg), bare[0], laden[0], axis)),
        **motion_variables(motions, state.system.states),
    }
    responses = [value for name, value in values.items() if "wear_by" in name]
    finite = all(np.isfinite(value).all() for value in responses)
    return {"status": "converged" if finite else "not_finite", **values}


def _steady(cfg: Mapping[str, Any], state: State) -> tuple[tuple[Frictions, Frictions], str]:
    """States with the friction decreases of `FRICTIONS`, without absorbers and under their weight.

    And the first status of theirs that tells of no steady running, else `converged`.
    """
    bare = (state, _operating(cfg, state))
    laden = bare
    if all(each.equilibrium.status == "converged" for each in bare):
        heavy = carrying(state)
        laden = bare if heavy is state else (heavy, _operating(cfg, heavy))
    statuses = [each.equilibrium.status for each in (*bare, *laden)]
    return (bare, laden), next((s for s in statuses if s != "converged"), "converged")


def _operating(cfg: Mapping[str, Any], state: State) -> State:
    """Equilibrium at the friction decrease of operation, from that of the forced excitation."""
    if state.equilibrium.status != "converged":
        return state
    decrease = state.conditions.friction_decrease * cfg["creep_force"]["B"]
    system = with_friction_decrease(state.system, decrease)
    return state._replace(system=system, equilibrium=near(system, state.equilibrium.state))


def _motion(state: State) -> Motion:
    linear = linearise(state.system, state.equilibrium.state)
    return absorber_ports.motion(state.system, linear, state.line.bogie.absorber)


def _axis(cfg: Mapping[str, Any]) -> np.ndarray:
    """Frequencies in Hz of all cases: bands and what is near their peaks."""
    bands = [*cfg["study"]["peaks"], cfg["study"]["design_band"]]
    low = min(band["min"] for band in bands) * (1.0 - NEAR)
    high = max(band["max"] for band in bands) * (1.0 + NEAR)
    even = np.linspace(low, high, int(np.ceil((high - low) / cfg["numerics"]["frequency_step"])))
    band = cfg["study"]["design_band"]
    return np.union1d(even, band_axis(band["min"], band["max"]))


def _no_case(cfg: Mapping[str, Any], nominal: State, status: str) -> dict[str, Any]:
    """Variables of a case without equilibrium: all NaN but its status."""
    axis = finer_near_modes(_axis(cfg), np.zeros(0, complex))
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
    alone = Attachable(empty.output_by_wave, empty.place_by_wave, empty)
    still = Motion(
        np.full(modes, none), np.full((carriers, modes), none), np.full((modes, carriers), none)
    )
    return {
        "status": status,
        "frequency": axis,
        "bare_growth_rate": np.full(len(FRICTIONS), np.nan),
        **port_variables(alone),
        **motion_variables([still] * len(FRICTIONS), modes),
    }
