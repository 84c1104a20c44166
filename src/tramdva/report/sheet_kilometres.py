"""First lines of the design sheet about the route: kilometres, the curve to blame, what would help.

Each sentence belongs to one of states that exclude each other, as in `sheet_verdicts`.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tramdva.report.design_names import WEAR_LAWS, design_name
from tramdva.report.sheet_numbers import DASH, number, percent

Values = Mapping[str, np.ndarray]  # variables of a result file, SI units
MEASURES = {
    "slower": "1 km/h slower in {section}",
    "lubricated": "lubricated flanges in {section}",
    "mixed_speeds": "5 % more scatter of the speeds",
    "softer_wheels": "wheels softer by 30 %",
    "harder_wheels": "wheels harder by 40 %",
    "turned_earlier": "turning at half the limit",
}
ROUTE = {
    "no_steady_answer": (
        "Kilometres without absorbers: none were computed, since in a condition of the route there "
        "is no steady answer to waves ({hindrance})."
    ),
    "beyond_horizon": (
        "On its route no wheel reaches {limit} mm of out-of-roundness within {horizon} km without "
        "absorbers."
    ),
    "beyond_at_once": (
        "Kilometres: none, since a wheel that was just turned is out of round by {limit} mm."
    ),
    "reached": (
        "On its route the first wheel is out of round by {limit} mm after {km} km without "
        "absorbers: order {order} grows fastest, most of it in {section}."
    ),
}
ABSORBERS = "With absorbers it is {kilometres}."
LAWS_AGREE = (
    "All laws of wear, scaled to the measured wear, name {absorber} as the best ({low} to {high} "
    "km without absorbers)."
)
LAWS_DISAGREE = (
    "The laws of wear disagree on the best absorber ({named}; {low} to {high} km without "
    "absorbers): the kilometres do not decide between absorbers."
)
HELP = "What would help most without absorbers: {measures} (life of the wheels)."
SMALL_WAVES = (
    "Kilometres are those of small waves; beyond some 10 µm waves grow more slowly, so that the "
    "first wheel lasts longer than told."
)


def kilometres(growth: Values, remedies: Values) -> list[str]:
    """First lines about the route.

    Parameters
    ----------
    growth : variables of ``polygon_growth``
    remedies : variables of ``route_remedies``
    """
    law, none = _shown(growth), list(map(str, growth["absorber"])).index("none")
    status = str(growth["turning_status"][law, none])
    wheel = max(int(growth["first_wheel"][law, none]), 0)
    order = growth["fastest_order"][law, none, wheel]
    lines = [
        ROUTE[status].format(
            hindrance=str(growth["hindrance"][none]).replace("_", " "),
            limit=number(1e3 * float(growth["limit"])),
            horizon=_km(growth["distance"][-1]),
            km=_km(growth["turning_distance"][law, none]),
            order=f"{order:.0f}" if np.isfinite(order) else DASH,
            section=str(growth["fastest_section"][law, none, wheel]),
        )
    ]
    others = [
        f"{_distance(growth, law, k)} ({design_name(str(name))})"
        for k, name in enumerate(growth["absorber"])
        if k != none
    ]
    if others:
        lines.append(ABSORBERS.format(kilometres=", ".join(others)))
    lines += _of_laws(growth, none)
    lines += _of_measures(remedies)
    return [*lines, SMALL_WAVES] if status == "reached" else lines


def _shown(growth: Values) -> int:
    return list(map(str, growth["wear_law"])).index(str(growth["shown_wear_law"]))


def _km(value: float) -> str:
    return f"{float(f'{value:.2g}'):,.0f}".replace(",", " ") if np.isfinite(value) else DASH


def _distance(growth: Values, law: int, absorber: int) -> str:
    """Distance between turnings in words."""
    status = str(growth["turning_status"][law, absorber])
    if status == "reached":
        return f"{_km(growth['turning_distance'][law, absorber])} km"
    return {"beyond_horizon": "beyond the horizon", "beyond_at_once": "0 km"}.get(
        status, "no steady answer"
    )


def _of_laws(growth: Values, none: int) -> list[str]:
    """Tell whether the laws of wear agree on the best absorber."""
    bare = growth["turning_distance"][:, none]
    named = list(map(str, growth["longest_absorber"]))
    if not np.isfinite(bare).any() or not all(named):
        return []
    ends = {"low": _km(np.nanmin(bare)), "high": _km(np.nanmax(bare))}
    if bool(growth["laws_agree"]):
        return [LAWS_AGREE.format(absorber=_with_article(named[0]), **ends)]
    words = "; ".join(
        f"{WEAR_LAWS.get(str(law), str(law))}: {design_name(name)}"
        for law, name in zip(growth["wear_law"], named, strict=True)
    )
    return [LAWS_DISAGREE.format(named=words, **ends)]


def _with_article(name: str) -> str:
    return design_name(name) if name == "none" else f"the {design_name(name)}"


def _of_measures(remedies: Values) -> list[str]:
    """Tell the three measures that buy most."""
    if str(remedies["bare_status"]) != "computed":
        return []
    gain = remedies["remedy_wheel_life"] / float(remedies["bare_wheel_life"]) - 1.0
    words = []
    for k in range(gain.size):  # the best come first in the file
        if not gain[k] > 0.005 or len(words) == 3:
            break
        measure = MEASURES[str(remedies["remedy"][k])]
        words.append(
            f"{measure.format(section=str(remedies['remedy_section'][k]))} "
            f"(+{percent(float(gain[k]))})"
        )
    return [HELP.format(measures=", ".join(words))] if words else []


def kilometre_rows(growth: Values) -> list[list[str]]:
    """Rows of the table: distance between turnings by absorber, a column for each law of wear."""
    rows = [
        ["absorber", *(WEAR_LAWS.get(str(law), str(law)) for law in growth["wear_law"])],
    ]
    for k, name in enumerate(growth["absorber"]):
        cells = (_distance(growth, law, k) for law in range(growth["wear_law"].size))
        rows.append([design_name(str(name)), *cells])
    life = (
        _km(value) + " km" if np.isfinite(value) else DASH for value in growth["wheel_life"][:, 0]
    )
    rows.append([f"life of the wheels, {design_name(str(growth['absorber'][0]))}", *life])
    return rows
