"""The stage `robustness_sample`: the bogie without absorbers under conditions drawn from ranges.

Case 0 is the line as configured. Then each range alone at its lower and upper end, then points of
a scrambled Sobol sequence over all ranges, the absorber's own stiffness and damping among them.
Any part of the cases is computed alone and is the same as when all are computed at once.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tramdva.attached_tendency import any_absorber
from tramdva.bogie import absorber_ports
from tramdva.bogie.absorber_ports import Motion, Ports
from tramdva.bogie.conditions import Conditions, State, as_configured, reached
from tramdva.bogie.curving import equilibrium, linearise, with_friction_decrease
from tramdva.bogie.line import quiet_bogie_line, run_through
from tramdva.bogie.vehicle import AXLES, WHEELS
from tramdva.evolution_stages import NEAR

FRICTIONS = ("forced", "operating")
ABSORBER_RANGES = ("stiffness", "damping")
# Axis of frequencies: refined about this many modes, at these distances in their growth rates.
_REFINED_MODES = 6
_DISTANCES = np.array([0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5])


def ranges(study: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Ranges of all shares by name: conditions, then the absorber's stiffness and damping."""
    sections = [study["conditions"][name] for name in Conditions._fields]
    sections += [study["rubber"][name] for name in ABSORBER_RANGES]
    names = [*Conditions._fields, *(f"absorber_{name}" for name in ABSORBER_RANGES)]
    return {name: (s["min"], s["max"]) for name, s in zip(names, sections, strict=True)}


def cases(study: Mapping[str, Any], samples: int, seed: int) -> tuple[list[str], np.ndarray]:
    """All cases: what varies in each (`none`, a range with its end, `all`) and the shares (c, r).

    Parameters
    ----------
    study : with ``conditions`` and ``rubber``
    samples : points of the sequence; more of them leave the first ones as they are
    seed : of the scrambling
    """
    from scipy.stats import qmc  # slow to load: only this stage needs it

    names, limits = list(ranges(study)), np.array(list(ranges(study).values()))
    varied, rows = ["none"], [np.ones(len(names))]
    for k, name in enumerate(names[: len(Conditions._fields)]):
        for end, word in enumerate(("min", "max")):
            row = np.ones(len(names))
            row[k] = limits[k, end]
            varied.append(f"{name}_{word}")
            rows.append(row)
    sequence = qmc.Sobol(len(names), rng=np.random.default_rng(seed))
    drawn = sequence.random_base2(int(np.ceil(np.log2(samples))))[:samples]
    rows += list(limits[:, 0] + drawn * (limits[:, 1] - limits[:, 0]))
    return varied + ["all"] * samples, np.array(rows)


def robustness_sample(
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
    nominal = as_configured(line, run_through(line, numerics["curvature_steps"]))
    count = len(Conditions._fields)
    found = [_case(cfg, nominal, Conditions(*map(float, shares[k, :count]))) for k in chosen]
    return {
        "case": chosen.astype(float),
        "varied": np.array([varied[k] for k in chosen]),
        "range": np.array(list(ranges(study))),
        "share": shares[chosen],
        "wheel": np.array(cfg["out_of_roundness"]["wheels"]),
        "friction": np.array(FRICTIONS),
        "speed": np.array([line.track.speed * shares[k, 3] for k in chosen]),
        "unsprung_mass": np.float64(unsprung_mass(nominal)),
        **{name: np.array([case[name] for case in found]) for name in found[0]},
    }


def unsprung_mass(state: State) -> float:
    """Mass in kg of an axle with its wheels, what is fixed to it included."""
    vehicle = state.system.vehicle
    bodies = [f"{AXLES[0]}_axle", *(f"{w}_rim" for w in WHEELS if w.startswith(AXLES[0]))]
    own = [i for i, name in enumerate(vehicle.names) if name.split(" ")[0] in bodies]
    rise = vehicle.rise[own]
    return float(rise @ vehicle.mass[np.ix_(own, own)] @ rise)


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
        **_port_variables(_ports(cfg, state, axis)),
        **_motion_variables(motions, 2 * state.system.size + 4),
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
    found = any_absorber(cfg, state.line, state.system, state.equilibrium, axis)
    return absorber_ports.ports(found.bare, found.inertia, found.output, found.direct)


def _parts(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    return {f"{name}_real": values.real, f"{name}_imag": values.imag}


def _port_variables(found: Ports) -> dict[str, np.ndarray]:
    return {
        **_parts("wear_by_wave", found.output_by_wave),
        **_parts("wear_by_force", found.output_by_force),
        **_parts("place_by_wave", found.place_by_wave),
        **_parts("place_by_force", found.place_by_force),
    }


def _motion_variables(motions: Sequence[Motion], modes: int) -> dict[str, np.ndarray]:
    """Modes per friction; NaN beyond the last, since real ones can come in pairs or not."""

    def filled(values: np.ndarray, axis: int) -> np.ndarray:
        width = [(0, 0)] * values.ndim
        width[axis] = (0, modes - values.shape[axis])
        return np.pad(values, width, constant_values=complex(np.nan, np.nan))

    return {
        **_parts("eigenvalue", np.array([filled(each.eigenvalue, 0) for each in motions])),
        **_parts("mode_place", np.array([filled(each.place, 1) for each in motions])),
        **_parts("mode_forcing", np.array([filled(each.forcing, 0) for each in motions])),
    }


def _no_case(cfg: Mapping[str, Any], nominal: State, status: str) -> dict[str, Any]:
    """Variables of a case without equilibrium: all NaN but its status."""
    axis = _frequencies(cfg, np.zeros(0, complex))
    wheels = len(cfg["out_of_roundness"]["wheels"])
    absorber = nominal.line.bogie.absorber
    carriers = 12 if absorber.motion == "translation" else 4
    modes, n = 2 * nominal.system.size + 4, absorber_ports.ABSORBERS
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
        **_port_variables(empty),
        **_motion_variables([still] * len(FRICTIONS), modes),
    }


def stored_ports(sample: Mapping[str, np.ndarray]) -> Ports:
    """Ports (case, f, ...) of the variables of ``robustness_sample``."""
    return Ports(2.0 * np.pi * sample["frequency"], *(
        _complex(sample, name)
        for name in ("wear_by_wave", "wear_by_force", "place_by_wave", "place_by_force")
    ))  # fmt: skip


def stored_motion(sample: Mapping[str, np.ndarray], case: int, friction: int) -> Motion:
    """Free motion of a case, by their places in the variables of ``robustness_sample``."""
    value, place, forcing = (
        _complex(sample, name, (case, friction))
        for name in ("eigenvalue", "mode_place", "mode_forcing")
    )
    kept = np.isfinite(value.real)
    return Motion(value[kept], place[:, kept], forcing[kept])


def _complex(sample: Mapping[str, np.ndarray], name: str, where: Any = ...) -> np.ndarray:
    return sample[f"{name}_real"][where] + 1j * sample[f"{name}_imag"][where]


def assembled(parts: Sequence[Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Variables of all parts put together, the cases in their order."""
    first = parts[0]
    alone = ("range", "wheel", "friction", "unsprung_mass")
    order = np.argsort(np.concatenate([part["case"] for part in parts]))
    return {
        name: first[name] if name in alone else np.concatenate([p[name] for p in parts])[order]
        for name in first
    }
