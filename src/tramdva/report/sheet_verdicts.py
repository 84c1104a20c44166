"""First lines of the design sheet: each belongs to one of states that exclude each other.

`state_of_bogie`, `state_of_orders` and `state_of_tuning` find the state in the result files; the
tables beside them hold its sentence. Nothing is said of what was not computed but why it was not.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.report.design_names import NAMED
from tramdva.report.sheet_numbers import number, percent

Config = Mapping[str, Any]  # values of the configuration
Values = Mapping[str, np.ndarray]  # variables of a result file, SI units
KMH = 3.6
NONE, PAPER, NOMINAL, ROBUST = range(4)
NAMES = tuple(NAMED[name] for name in ("none", "paper", "nominal", "robust"))
FORCED, OPERATING = range(2)  # of the friction in growth rates

BOGIE = {
    "no_equilibrium": "no steady running was found ({status}): nothing else was computed.",
    "no_oscillation": "no oscillation between {low:g} and {high:g} Hz was found.",
    "always": "it vibrates by itself at every B from 0 on{at_B}.",
    "at_some": "it vibrates by itself at small B already, but not at every B{at_B}.",
    "from_onset": "self-excitation from B = {onset} s/m on{at_B}.",
    "never": "no onset of self-excitation up to B = {top:g} s/m{at_B}.",
}
ORDERS = {
    "no_equilibrium": (
        "Without absorbers, {speed} km/h: no growth of orders was computed, there is no steady "
        "running ({status})."
    ),
    "self_excited": (
        "Without absorbers, {speed} km/h: growth of orders means nothing, since the bogie vibrates "
        "by itself even at the friction of forced excitation."
    ),
    "none_grows": (
        "Without absorbers, {speed} km/h: no order grows between {low:.0f} and {high:.0f} Hz."
    ),
    "outside": (
        "Mind: without absorbers, {speed} km/h, order {order:.0f} grows fastest, at "
        "{frequency:.0f} Hz, outside the band of {band_low:g} to {band_high:g} Hz for which "
        "absorbers are designed here: the rest of this sheet is not about it."
    ),
    "inside": (
        "Without absorbers, {speed} km/h: order {order:.0f} grows fastest, at {frequency:.0f} Hz, "
        "within the band of {band_low:g} to {band_high:g} Hz for which absorbers are designed here."
    ),
}
TUNING = {
    "no_equilibrium": (
        "No recommendation: the line as configured has no steady running in its curve."
    ),
    "not_computed": (
        "No recommendation: no growth was computed, since without absorbers the bogie vibrates by "
        "itself in every condition, even at the friction of forced excitation."
    ),
    "nothing_grows": (
        "No absorber is needed: between {low:g} and {high:g} Hz no order grows in any of the "
        "conditions that were computed, and none vibrates by itself."
    ),
    "nothing_to_tune": (
        "No tuning: between {low:g} and {high:g} Hz no order grows in any of the conditions that "
        "were computed; against self-excitation see the map of the bogie."
    ),
    "self_excited": (
        "No recommendation: with every absorber of this mass ({I_T} {I_T_unit}) some condition "
        "vibrates by itself. {other_mass}"
    ),
    "worse_than_nothing": (
        "No recommendation: this mass ({I_T} {I_T_unit}) cannot do it. The best absorber that was "
        "found leaves {robust} of the growth between {low:g} and {high:g} Hz, and in some "
        "condition is worse than none; the line's leaves {paper}. {other_mass}"
    ),
    "keep_the_line's": (
        "Recommended: the line's absorber as it is. Of the growth between {low:g} and {high:g} Hz "
        "it leaves {paper}; the best that was found within the ranges leaves {robust}."
    ),
    "some_self_excited": (
        "Recommended: the robust optimum, {design}. Of the growth between {low:g} and {high:g} Hz "
        "it leaves {robust}. Some conditions that another absorber would keep quiet vibrate by "
        "themselves."
    ),
    "recommended": (
        "Recommended: the robust optimum, {design}. Of the growth between {low:g} and {high:g} Hz "
        "it leaves {robust}; the line's absorber leaves {paper}."
    ),
}

OTHER_MASS = {
    "found": (
        "{I_T} {I_T_unit} could: c_T = {c_T}, d_T = {d_T} leave {nominal}, in the worst case "
        "{worst}, and disturb no condition that was quiet."
    ),
    "none": "No mass up to {I_T} {I_T_unit} could: another place or direction may.",
    "not_tried": "A larger mass, or another place or direction, may.",
}
RECOMMENDED = {"keep_the_line's": PAPER, "some_self_excited": ROBUST, "recommended": ROBUST}
ABOVE = (
    " More than 100 % is more than the line as configured, in a condition that vibrates by itself "
    "without absorbers."
)


def verdicts(
    cfg: Config, tuning: Values, stability_map: Values, modes: Values, maps: Values
) -> list[str]:
    """First lines of the sheet, the one about orders outside the band first where there is one."""
    orders = of_orders(cfg, maps)
    others = [*self_excitation(cfg, stability_map, modes), *spread(tuning)]
    first = [orders] if state_of_orders(cfg, maps) == "outside" else []
    return [*first, *others, *([] if first else [orders]), recommendation(cfg, tuning)]


def self_excitation(cfg: Config, stability_map: Values, modes: Values) -> list[str]:
    """Tell whether the wheelset and the bogie vibrate by themselves, and from which B on."""
    B = cfg["creep_force"]["B"]
    critical = float(stability_map["baseline_critical_B"])
    if np.isnan(critical):
        lines = ["Wheelset alone (basic model): it does not vibrate by itself, whatever B is."]
    else:
        does = "it vibrates by itself" if critical <= B else "it does not vibrate by itself"
        lines = [
            f"Wheelset alone (basic model): self-excitation from B = {number(critical)} s/m on; "
            f"at the line's B = {B:g} s/m {does}."
        ]
    for row, name in enumerate(map(str, modes["absorber"])):
        if name in ("none", "paper"):
            words = "without absorbers" if name == "none" else "with the line's absorbers"
            lines.append(f"Bogie in its curve, {words}: {of_bogie(cfg, modes, row)}")
    return lines


def state_of_bogie(modes: Values, row: int) -> str:
    """State of the bogie with one absorber, a key of `BOGIE`."""
    if str(modes["status"][row]) != "converged":
        return "no_equilibrium"
    growth = modes["largest_growth_rate"][row]
    if not np.isfinite(growth).any():
        return "no_oscillation"
    excited = growth[np.isfinite(growth)] >= 0.0
    if excited.all() and modes["operating_growth_rate"][row] >= 0.0:
        return "always"
    if excited[0]:
        return "at_some"
    return "never" if np.isnan(modes["critical_friction_decrease"][row]) else "from_onset"


def of_bogie(cfg: Config, modes: Values, row: int) -> str:
    """Sentence about the bogie with one absorber."""
    growth, frequency = modes["operating_growth_rate"][row], modes["operating_frequency"][row]
    does = "vibrates by itself" if growth >= 0.0 else "does not vibrate by itself"
    rate = f"growth rate {number(growth)} 1/s at {number(frequency)} Hz"
    state, B = state_of_bogie(modes, row), cfg["creep_force"]["B"]
    limits = cfg["study"]["frequency"]
    return BOGIE[state].format(
        status=str(modes["status"][row]).replace("_", " "),
        low=limits["min"],
        high=limits["max"],
        onset=number(float(modes["critical_friction_decrease"][row])),
        top=cfg["study"]["B_max"],
        at_B=f" ({rate} at B = {B:g} s/m)"
        if state == "always"
        else f"; at B = {B:g} s/m it {does} ({rate})",
    )


def at_own_speed(cfg: Config, maps: Values) -> int:
    """Place of the speed of the maps that is nearest to the line's."""
    return int(np.abs(maps["speed"] - cfg["track"]["speed"]).argmin())


def state_of_orders(cfg: Config, maps: Values) -> str:
    """State of the growth of orders without absorbers at the line's speed, a key of `ORDERS`."""
    none, own = list(map(str, maps["absorber"])).index("none"), at_own_speed(cfg, maps)
    if str(maps["speed_status"][none, own]) != "converged":
        return "no_equilibrium"
    if maps["speed_growth_rate"][none, own] >= 0.0:
        return "self_excited"
    if not np.isfinite(maps["fastest_order"][own]):
        return "none_grows"
    band, frequency = cfg["study"]["design_band"], maps["fastest_frequency"][own]
    return "inside" if band["min"] <= frequency <= band["max"] else "outside"


def of_orders(cfg: Config, maps: Values) -> str:
    """Sentence about the order that grows fastest."""
    none, own = list(map(str, maps["absorber"])).index("none"), at_own_speed(cfg, maps)
    band = cfg["study"]["design_band"]
    return ORDERS[state_of_orders(cfg, maps)].format(
        speed=f"at {KMH * maps['speed'][own]:.1f}",
        status=str(maps["speed_status"][none, own]).replace("_", " "),
        low=maps["frequency"][0],
        high=maps["frequency"][-1],
        order=maps["fastest_order"][own],
        frequency=maps["fastest_frequency"][own],
        band_low=band["min"],
        band_high=band["max"],
    )


def spread(tuning: Values) -> list[str]:
    """Tell in how many of the sampled cases the bogie vibrates by itself."""
    count = int(tuning["sampled_steady_cases"])
    if not count:
        return ["None of the sampled conditions has a steady running: nothing can be told of them."]
    parts = [
        f"{words} {percent(share)}"
        for words, share in zip(NAMES, tuning["self_excited_share"], strict=True)
        if np.isfinite(share)
    ]
    return [f"Share of {count} sampled conditions with self-excitation: {', '.join(parts)}."]


def state_of_tuning(tuning: Values) -> str:
    """State of the search for the best absorber, a key of `TUNING`."""
    status = str(tuning["status"][ROBUST])
    if status == "no_equilibrium":
        return "no_equilibrium"
    bare = tuning["growth_rate"][NONE]
    if not (bare[:, FORCED] < 0.0).any():
        return "not_computed"
    if status == "nothing_grows":
        return "nothing_to_tune" if (bare[:, OPERATING] >= 0.0).any() else "nothing_grows"
    if not np.isfinite(tuning["c_T"][ROBUST]):
        return "self_excited"
    if is_worse_than_nothing(tuning, ROBUST):
        return "worse_than_nothing"
    if _line_is_as_good(tuning):
        return "keep_the_line's"
    return "some_self_excited" if status == "self_excited" else "recommended"


def is_worse_than_nothing(tuning: Values, design: int) -> bool:
    """Whether an absorber leaves more than there was, or lets the line or a quiet case vibrate.

    A condition that vibrates by itself without absorbers is not held against one.
    """
    bare, growth = tuning["growth_rate"][NONE], tuning["growth_rate"][design]
    quiet = (bare < 0.0).all(axis=1) & tuning["counted"]
    more = tuning["factor"][design, quiet] >= 1.0
    louder = growth[np.append(0, np.flatnonzero(quiet)), OPERATING] >= 0.0
    all_quiet = not (bare[tuning["counted"]] >= 0.0).any()
    at_ends = all_quiet and tuning["worst_factor"][design] >= 1.0  # of the rubber's ranges
    return bool(tuning["nominal_factor"][design] >= 1.0 or more.any() or louder.any() or at_ends)


def _line_is_as_good(tuning: Values) -> bool:
    """Whether the line's absorber leaves no more in the worst case, without self-excitation."""
    quiet = tuning["self_excited_cases"][PAPER] <= tuning["self_excited_cases"][ROBUST]
    better = tuning["worst_factor"][PAPER] <= tuning["worst_factor"][ROBUST]
    return bool(quiet and better and not is_worse_than_nothing(tuning, PAPER))


def recommendation(cfg: Config, tuning: Values) -> str:
    """Tell the absorber that is recommended, or why there is none."""
    band, units, state = cfg["study"]["design_band"], unit_names(cfg), state_of_tuning(tuning)
    advised = RECOMMENDED.get(state)
    above = advised is not None and tuning["worst_factor"][advised] >= 1.0
    return (TUNING[state] + (ABOVE if above else "")).format(
        low=band["min"],
        high=band["max"],
        I_T=number(float(tuning["I_T"][PAPER])),
        I_T_unit=units["I_T"],
        design=f"c_T = {number(tuning['c_T'][ROBUST])} {units['c_T']}, "
        f"d_T = {number(tuning['d_T'][ROBUST])} {units['d_T']}",
        robust=_left(tuning, ROBUST),
        paper=_left(tuning, PAPER),
        other_mass=of_other_masses(cfg, tuning),
    )


def of_other_masses(cfg: Config, tuning: Values) -> str:
    """Tell the least mass of those tried that can do it, or that none can."""
    units, tried = unit_names(cfg), tuning["tried_I_T"]
    if not np.isfinite(tried).any():
        return OTHER_MASS["not_tried"]
    enough = np.where(tuning["tried_is_enough"], tried, np.inf)
    if not np.isfinite(enough).any():
        largest = number(float(np.nanmax(tried)))
        return OTHER_MASS["none"].format(I_T=largest, I_T_unit=units["I_T"])
    k = int(np.argmin(enough))
    return OTHER_MASS["found"].format(
        I_T=number(float(tried[k])),
        I_T_unit=units["I_T"],
        c_T=f"{number(float(tuning['tried_c_T'][k]))} {units['c_T']}",
        d_T=f"{number(float(tuning['tried_d_T'][k]))} {units['d_T']}",
        nominal=percent(tuning["tried_nominal_factor"][k]),
        worst=percent(tuning["tried_worst_factor"][k]),
    )


def _left(tuning: Values, design: int) -> str:
    """What a design leaves as configured and in the worst case."""
    return f"{percent(tuning['nominal_factor'][design])}, in the worst case {worst(tuning, design)}"


def worst(tuning: Values, design: int) -> str:
    """What a design leaves in the worst case, or in how many it vibrates by itself."""
    excited = tuning["self_excited_cases"][design]
    if np.isfinite(excited) and excited > 0.0:
        return f"self-excited in {excited:.0f} of {tuning['counted_cases']:.0f}"
    return percent(tuning["worst_factor"][design])


def unit_names(cfg: Config) -> dict[str, str]:
    """Units of the absorber: of rotation, or of translation."""
    if cfg["bogie"]["absorber"]["motion"] == "rotation":
        return {"I_T": "kg m²", "c_T": "N m/rad", "d_T": "N m s/rad", "torque": "N m"}
    return {"I_T": "kg", "c_T": "N/m", "d_T": "N s/m", "torque": "N"}
