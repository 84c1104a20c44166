"""The stage `robust_tuning`: the absorber that is best in the worst case, and what it leaves."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tramdva.bogie.absorber_growth import Seen, least_stable, seen
from tramdva.evolution.tendency import NEAR, highest_top, order_of_frequency
from tramdva.robustness.criterion import (
    Criterion,
    Design,
    Fleet,
    Optimum,
    Shares,
    fleet,
    optimum,
    references,
    tolerance,
)
from tramdva.robustness.larger_mass import TRIED, Tried, is_of_use, masses_tried
from tramdva.robustness.sample import absorber_shares, assembled, stored_motion
from tramdva.robustness.spread import QUANTILES, spread
from tramdva.variables.arrays import without_numbers
from tramdva.variables.robust_tuning import VARIABLES
from tramdva.variables.shared import CASE_STATUS

__all__ = ["VARIABLES", "compute"]

DESIGNS = ("none", "paper", "nominal", "robust")
NONE, PAPER, NOMINAL, ROBUST = range(4)
RUBBER_ENDS = ("stiffness_min", "stiffness_max", "damping_min", "damping_max")
FORCED, OPERATING = range(2)
LOADS = (
    "carrier_amplitude", "stroke_amplitude", "torque_amplitude", "dissipated_power",
    "load_frequency", "load_order",
)  # fmt: skip
TRIED_VALUES = (
    "tried_I_T", "tried_c_T", "tried_d_T", "tried_nominal_factor", "tried_worst_factor",
)  # fmt: skip


def compute(
    cfg: Mapping[str, Any], robustness_sample: Sequence[Mapping[str, np.ndarray]]
) -> dict[str, np.ndarray]:
    """Nominal and robust optimum of the absorber, and what each leaves in every case.

    Parameters
    ----------
    cfg : ``bogie.absorber``, ``track.gravity``, ``bogie.wheel.radius``, ``study``, ``numerics``
    robustness_sample : variables of all parts

    Returns
    -------
    Variables of ``robust_tuning``.
    """
    sample, study = assembled(robustness_sample), cfg["study"]
    absorber = cfg["bogie"]["absorber"]
    c_T, d_T = (
        np.linspace(study[name]["min"], study[name]["max"], cfg["numerics"]["map_points"])
        for name in ("c_T", "d_T")
    )
    common = {
        **{
            name: sample[name] for name in ("case", "varied", "range", "share", "wheel", "friction")
        },
        "case_status": sample["status"],
        "design": np.array(DESIGNS),
        "map_c_T": c_T,
        "map_d_T": d_T,
    }
    whole = fleet(sample, absorber["I_T"])
    if not (whole.case == 0).any():
        values = _without_nominal(cfg, sample, c_T.size, d_T.size) | common
        return values | spread(values, CASE_STATUS)
    nominal, robust = _criteria(cfg, sample, whole)
    restless = sample["bare_growth_rate"][whole.case, OPERATING] >= 0.0
    suspects = [np.flatnonzero(restless[:1]), np.flatnonzero(restless)]
    at_nominal, nominal_map = optimum(nominal, c_T, d_T, suspects[0])
    at_all, robust_map = optimum(robust, c_T, d_T, suspects[1])
    robust = robust._replace(counted=at_all.counted)
    designs = [None, (absorber["c_T"], absorber["d_T"]), at_nominal.design, at_all.design]
    growth = _growth_rates(cfg, sample, designs)
    steady = growth[..., FORCED] < 0.0
    values = {
        **common,
        "status": np.array(["converged", "converged", at_nominal.status, at_all.status]),
        "map_nominal_factor": nominal_map,
        "map_worst_factor": robust_map,
        **_design_values(cfg, designs),
        "counted": np.isin(sample["case"], sample["case"][whole.case[at_all.counted]]),
        **_factors(cfg, sample, designs, nominal, robust, suspects[1]),
        "tolerance": np.array(
            [
                np.full((2, 2), np.nan),
                np.full((2, 2), np.nan),
                tolerance(nominal, at_nominal, study["tolerance"], c_T, d_T, suspects[0]),
                tolerance(robust, at_all, study["tolerance"], c_T, d_T, suspects[1]),
            ]
        ),
        **_peak_factors(cfg, sample, whole, designs),
        "growth_rate": growth,
        **_loads(cfg, sample, robust.fleet, designs),
        **_heavier(cfg, sample, (nominal, robust), at_all, suspects[1]),
    }
    # A self-excited bogie answers no wave steadily.
    for name in ("factor", "peak_factor", *LOADS):
        there = steady.reshape(*steady.shape, *[1] * (values[name].ndim - 2))
        values[name] = np.where(there, values[name], np.nan)
    return values | spread(values, CASE_STATUS)


def _criteria(
    cfg: Mapping[str, Any], sample: Mapping[str, np.ndarray], whole: Fleet
) -> tuple[Criterion, Criterion]:
    """Criteria of the nominal and of the robust optimum."""
    band = cfg["study"]["design_band"]
    count = len(whole.case)
    near = whole.within(np.full(count, band["min"]), np.full(count, band["max"]))
    reference = references(near.largest(None), near.steady)
    alone = references(near.largest(None)[:1], near.steady[:1])

    cases = {case: _seen(cfg, sample, case, OPERATING) for case in whole.case}

    def growth(case: int, design: Design) -> float:
        return _growth(cfg, cases[case], design)

    everywhere = np.ones(count, bool)
    corners = tuple(dict.fromkeys([(1.0, 1.0), *_corners(cfg["study"])]))
    return (
        Criterion(near.only([0]), alone, everywhere[:1], corners[:1], growth),
        Criterion(near, reference, everywhere, corners, growth),
    )


def _heavier(
    cfg, sample, criteria: tuple[Criterion, Criterion], best: Optimum, suspects: Sequence[int]
) -> dict[str, np.ndarray]:
    """Masses that were tried where no absorber of the configured mass is of use."""
    absorber, tuning = cfg["bogie"]["absorber"], cfg["study"]
    axes = [
        np.linspace(tuning[name]["min"], tuning[name]["max"], cfg["numerics"]["map_points"])
        for name in ("c_T", "d_T")
    ]
    nominal, robust = criteria
    quiet = np.flatnonzero((sample["bare_growth_rate"][robust.fleet.case] < 0.0).all(axis=1))

    def of_inertia(inertia: float) -> tuple[Criterion, Criterion]:
        own = {**cfg, "bogie": {**cfg["bogie"], "absorber": {**absorber, "I_T": inertia}}}
        return _criteria(own, sample, fleet(sample, inertia))

    found: list[Tried] = []
    if robust.grows and not is_of_use(nominal, robust, best, quiet):
        found = list(masses_tried(of_inertia, absorber["I_T"], *axes, suspects, quiet))
    rows = np.full((5, TRIED), np.nan)
    for k, one in enumerate(found):
        factors = one.nominal_factor, one.best.factor
        rows[:, k] = one.inertia, *one.best.design, *factors
    return {
        **dict(zip(TRIED_VALUES, rows, strict=True)),
        "tried_is_enough": np.array([*(one.is_enough for one in found), *[False] * TRIED][:TRIED]),
    }


def _corners(study: Mapping[str, Any]) -> list[Shares]:
    stiffness, damping = study["rubber"]["stiffness"], study["rubber"]["damping"]
    return [(stiffness[c], damping[d]) for c in ("min", "max") for d in ("min", "max")]


def _seen(cfg, sample: Mapping[str, np.ndarray], case: int, friction: int) -> Seen:
    limits = cfg["study"]["frequency"]["min"], cfg["study"]["frequency"]["max"]
    return seen(stored_motion(sample, case, friction), limits)


def _growth(cfg, bare: Seen, design: Design) -> float:
    """Growth rate in 1/s of a bogie with a design; -inf without an oscillation."""
    top = least_stable(bare, cfg["bogie"]["absorber"]["I_T"], *design)
    return -np.inf if top is None else top.real


def _growth_rates(cfg, sample, designs: Sequence[Design | None]) -> np.ndarray:
    """Growth rates (design, case, friction) with the absorber's own shares in each case."""
    out = np.full((len(designs), len(sample["case"]), 2), np.nan)
    out[NONE] = sample["bare_growth_rate"]
    for case in np.flatnonzero(sample["status"] == "converged"):
        c, d = absorber_shares(sample)[:, case]
        for friction in (FORCED, OPERATING):
            bare = _seen(cfg, sample, case, friction)
            for row, design in enumerate(designs):
                if design is not None and np.isfinite(design[0]):
                    out[row, case, friction] = _growth(cfg, bare, (design[0] * c, design[1] * d))
    return out


def _design_values(cfg, designs: Sequence[Design | None]) -> dict[str, np.ndarray]:
    """Values of the absorbers themselves by design."""
    absorber, study = cfg["bogie"]["absorber"], cfg["study"]
    stiffness, damping = np.array([design or (np.nan, np.nan) for design in designs]).T
    there = np.array([design is not None for design in designs])
    inertia = np.where(there, absorber["I_T"], np.nan)
    turns = absorber["motion"] == "rotation"
    mass = inertia / study["gyration_radius"] ** 2 if turns else inertia
    return {
        "I_T": inertia,
        "c_T": stiffness,
        "d_T": damping,
        "tuned_frequency": np.sqrt(stiffness / inertia) / (2.0 * np.pi),
        "damping_ratio": damping / (2.0 * np.sqrt(stiffness * inertia)),
        "added_mass": mass,
        "added_weight": mass * cfg["track"]["gravity"],
    }


def _factors(
    cfg, sample, designs, nominal: Criterion, robust: Criterion, suspects: Sequence[int]
) -> dict[str, np.ndarray]:
    """What designs leave of the growth in the band of design."""
    cases, rows = len(sample["case"]), robust.fleet.case
    shares = tuple(absorber_shares(sample)[:, rows])
    factor, reference = np.full((len(designs), cases), np.nan), np.full(cases, np.nan)
    reference[rows] = robust.reference
    rubber = np.full((len(designs), len(RUBBER_ENDS)), np.nan)
    worst, alone, restless = (np.full(len(designs), np.nan) for _ in range(3))
    ends = cfg["study"]["rubber"]
    for k, design in enumerate(designs):
        if design is not None and not np.isfinite(design[0]):
            continue
        factor[k, rows] = robust.factors(design, shares)
        if design is None or not robust.grows:
            continue
        if robust.counted.any():
            worst[k] = robust.worst(design)
            restless[k] = len(robust.violated(design, suspects))
        if nominal.grows:
            alone[k] = nominal.worst(design)
            for e, name in enumerate(RUBBER_ENDS):
                kind, _, end = name.partition("_")
                share = ends[kind][end]
                pair = (share, 1.0) if kind == "stiffness" else (1.0, share)
                rubber[k, e] = nominal.factors(design, pair)[0]
    return {
        "factor": factor,
        "reference": reference,
        "worst_factor": worst,
        "self_excited_cases": restless,
        "nominal_factor": alone,
        "rubber_end": np.array(RUBBER_ENDS),
        "rubber_factor": rubber,
    }


def _peak_factors(cfg, sample, whole: Fleet, designs) -> dict[str, np.ndarray]:
    """What designs leave of each peak (design, case, wheel, peak).

    The largest tendency within `NEAR` of the peak without absorbers; reference as in `references`.
    A case without the peak, or self-excited, is compared at the frequency of the nominal one's.
    """
    peaks = cfg["study"]["peaks"]
    shape = (len(sample["case"]), len(sample["wheel"]), len(peaks))
    factor = np.full((len(designs), *shape), np.nan)
    top = np.full(shape, np.nan)
    bare = whole.tendency(None)
    for p, peak in enumerate(peaks):
        for w in range(shape[1]):
            curves = zip(whole.frequency, bare[..., w], strict=True)
            own = np.array([_top(axis, curve, peak) for axis, curve in curves])
            own[~whole.steady] = np.nan
            top[whole.case, w, p] = own
            place = np.where(np.isfinite(own), own, own[0])
            if not np.isfinite(place).any():
                continue
            seen = np.flatnonzero(np.isfinite(place))
            part = whole.only(seen).within(place[seen] * (1.0 - NEAR), place[seen] * (1.0 + NEAR))
            reference = _peak_reference(part.largest(None)[:, w], part, own[seen])
            shares = tuple(absorber_shares(sample)[:, part.case])
            for k, design in enumerate(designs):
                if design is None or np.isfinite(design[0]):
                    value = part.largest(design, shares)[:, w]
                    factor[k, part.case, w, p] = value / reference
    return {
        "peak": np.array([peak["name"] for peak in peaks]),
        "peak_frequency": top,
        "peak_factor": factor,
    }


def _peak_reference(bare: np.ndarray, part: Fleet, top: np.ndarray) -> np.ndarray:
    """Reference (s,) of one peak; the line as configured is first, if it has the peak."""
    height = np.where(np.isfinite(top), bare, -np.inf)
    own = height[0] if part.case[0] == 0 and np.isfinite(height[0]) else -np.inf
    return np.maximum(height, own)


def _top(frequency: np.ndarray, tendency: np.ndarray, band: Mapping[str, float]) -> float:
    """Frequency in Hz of the highest positive peak in a band; NaN if there is none."""
    inside = (frequency >= band["min"]) & (frequency <= band["max"])
    axis, first = np.unique(frequency[inside], return_index=True)
    top = highest_top(tendency[inside][first])
    return np.nan if top is None else float(axis[top])


def _loads(cfg, sample, near: Fleet, designs) -> dict[str, np.ndarray]:
    """Stroke, torque and power of an absorber and motion of its place in the band of design.

    By a wave of the study's amplitude, at the frequency (Hz) that is worst for each; nominal, and
    the largest of all cases with the absorber's own shares. A self-excited case has none.
    """
    amplitude, cases = cfg["study"]["wave_amplitude"], len(sample["case"])
    names = ("carrier", "stroke", "torque", "power")
    out = {f"{name}_amplitude": np.full((len(designs), cases), np.nan) for name in names}
    load_frequency = np.full((len(designs), cases), np.nan)
    turn = near.modes.angular_frequency
    c, d = absorber_shares(sample)[:, near.case, None]
    for k, design in enumerate(designs):
        if design is not None and not np.isfinite(design[0]):
            continue
        if design is None:
            carrier, nothing = np.abs(near.bare_place).max(axis=2), np.zeros_like(turn)
            values = {"carrier": amplitude * carrier, **dict.fromkeys(names[1:], nothing)}
        else:
            stiffness, damping = design[0] * c, design[1] * d
            carrier = np.abs(near.modes.carrier(near.inertia, stiffness, damping)).max(axis=2)
            stroke = np.abs(near.modes.stroke(near.inertia, stiffness, damping)).max(axis=2)
            values = {
                "carrier": amplitude * carrier,
                "stroke": amplitude * stroke,
                "torque": amplitude * np.abs(stiffness + 1j * turn * damping) * stroke,
                "power": 0.5 * damping * (turn * amplitude * stroke) ** 2,
            }
        for name, value in values.items():
            out[f"{name}_amplitude"][k, near.case] = value.max(axis=1)
        decisive = values["carrier" if design is None else "torque"].argmax(axis=1)
        load_frequency[k, near.case] = near.frequency[np.arange(len(decisive)), decisive]
    speed = sample["speed"]
    return {
        "carrier_amplitude": out["carrier_amplitude"],
        "stroke_amplitude": out["stroke_amplitude"],
        "torque_amplitude": out["torque_amplitude"],
        "dissipated_power": out["power_amplitude"],
        "load_frequency": load_frequency,
        "load_order": order_of_frequency(load_frequency, speed, cfg["bogie"]["wheel"]["radius"]),
        "unsprung_mass": sample["unsprung_mass"],
    }


def _without_nominal(cfg, sample, c_points: int, d_points: int) -> dict[str, np.ndarray]:
    """Variables where the line as configured has no equilibrium: NaN, and a status that says so."""
    peaks, absorber = cfg["study"]["peaks"], cfg["bogie"]["absorber"]
    lengths = {
        "case": len(sample["case"]),
        "range": len(sample["range"]),
        "wheel": len(sample["wheel"]),
        "friction": len(sample["friction"]),
        "design": len(DESIGNS),
        "rubber_end": len(RUBBER_ENDS),
        "peak": len(peaks),
        "map_c_T": c_points,
        "map_d_T": d_points,
        "axis": 2,
        "end": 2,
        "outcome": len(CASE_STATUS),
        "quantile": len(QUANTILES),
        "tried": TRIED,
    }
    missing = (np.nan, np.nan)
    return {
        **without_numbers(VARIABLES, lengths),
        "status": np.array(["no_equilibrium"] * len(DESIGNS)),
        **_design_values(cfg, [None, (absorber["c_T"], absorber["d_T"]), missing, missing]),
        "rubber_end": np.array(RUBBER_ENDS),
        "peak": np.array([peak["name"] for peak in peaks]),
        "unsprung_mass": sample["unsprung_mass"],
    }
