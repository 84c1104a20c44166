"""Conditions drawn from ranges, and the bogie under them as its absorbers see it.

Case 0 is the line as configured. Then each range alone at its lower and upper end, then points of
a scrambled Sobol sequence over all ranges, the absorber's own stiffness and damping among them.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tramdva.bogie.absorber_ports import Attachable, Motion, Ports
from tramdva.bogie.conditions import Conditions, State
from tramdva.bogie.names import AXLES, WHEELS

FRICTIONS = ("forced", "operating")
ABSORBER_RANGES = ("stiffness", "damping")


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


def conditions_of(shares: np.ndarray) -> list[Conditions]:
    """Conditions of cases from their shares (c, r); those of the absorber are left out."""
    return [Conditions(*map(float, row[: len(Conditions._fields)])) for row in shares]


def absorber_shares(sample: Mapping[str, np.ndarray]) -> np.ndarray:
    """Shares (2, c) of the absorber's stiffness and damping in the cases of a sample."""
    return sample["share"][:, -len(ABSORBER_RANGES) :].T


def unsprung_mass(state: State) -> float:
    """Mass in kg of an axle with its wheels, what is fixed to it included."""
    vehicle = state.system.vehicle
    bodies = [f"{AXLES[0]}_axle", *(f"{w}_rim" for w in WHEELS if w.startswith(AXLES[0]))]
    own = [i for i, name in enumerate(vehicle.names) if name.split(" ")[0] in bodies]
    rise = vehicle.rise[own]
    return float(rise @ vehicle.mass[np.ix_(own, own)] @ rise)


def _parts(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    return {f"{name}_real": values.real, f"{name}_imag": values.imag}


def port_variables(found: Attachable) -> dict[str, np.ndarray]:
    """Variables of ``robustness_sample`` that hold the ports of cases."""
    ports = found.ports
    return {
        **_parts("bare_wear_by_wave", found.without_absorbers),
        **_parts("bare_place_by_wave", found.place_without),
        **_parts("wear_by_wave", ports.output_by_wave),
        **_parts("wear_by_force", ports.output_by_force),
        **_parts("place_by_wave", ports.place_by_wave),
        **_parts("place_by_force", ports.place_by_force),
    }


def motion_variables(motions: Sequence[Motion], modes: int) -> dict[str, np.ndarray]:
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


def stored_ports(sample: Mapping[str, np.ndarray]) -> Attachable:
    """Ports (case, f, ...) of the variables of ``robustness_sample``."""
    ports = Ports(2.0 * np.pi * sample["frequency"], *(
        _complex(sample, name)
        for name in ("wear_by_wave", "wear_by_force", "place_by_wave", "place_by_force")
    ))  # fmt: skip
    alone = (_complex(sample, f"bare_{name}_by_wave") for name in ("wear", "place"))
    return Attachable(*alone, ports)


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
