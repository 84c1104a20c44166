"""Words and tables of the design sheet, the same for its page and its PDF. For `paper_figures/`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from tramdva.report.sheet_kilometres import kilometre_rows, kilometres
from tramdva.report.sheet_numbers import DASH, in_ranges, number, percent, place_of
from tramdva.report.sheet_verdicts import (
    KMH,
    NAMES,
    NOMINAL,
    NONE,
    PAPER,
    ROBUST,
    Config,
    Values,
    state_of_orders,
    unit_names,
    verdicts,
    worst,
)

SPEEDS_SHOWN = 9
RANGES = {
    "friction": ("coefficient of friction μ₀", ""),
    "friction_decrease": ("friction decrease B in operation", "s/m"),
    "radius": ("curve radius", "m"),
    "speed": ("speed", "km/h"),
    "car_body_mass": ("mass of the car body's share", "t"),
    "wheel_stiffness": ("rubber of the wheels, stiffness", "%"),
    "wheel_damping": ("rubber of the wheels, damping", "%"),
    "primary_stiffness": ("primary suspension, stiffness", "%"),
    "primary_damping": ("primary suspension, damping", "%"),
    "absorber_stiffness": ("rubber of the absorber, stiffness", "%"),
    "absorber_damping": ("rubber of the absorber, damping", "%"),
}

BAND_FOUND = (
    "The band of {min:g} to {max:g} Hz lies about the critical mode that was found without "
    "absorbers, {mode}."
)
BAND_GIVEN = "The band of {min:g} to {max:g} Hz is as the line's file gives it."
GYRATION = (
    "Mass of an absorber from its inertia at a radius of gyration of {:.0f} mm. Its weight is not "
    "in the model: a rotating absorber replaces mass of the axle."
)
TRANSLATION = (
    "Translating absorbers press on the wheels with their weight, and across their direction their "
    "mass moves with the axle; without absorbers there is neither."
)


class Table(NamedTuple):
    """A table of texts, its headings first, and what it is."""

    title: str
    rows: list[list[str]]


class Sheet(NamedTuple):
    """Contents of the sheet."""

    title: str
    verdicts: list[str]
    kilometres: Table
    running: Table
    absorber: Table
    peaks: Table
    orders: Table
    ranges: Table
    notes: list[str]


def sheet(
    cfg: Config,
    tuning: Values,
    stability_map: Values,
    bogie_modes: Values,
    tendency_maps: Values,
    curving_equilibrium: Values,
    polygon_growth: Values,
    route_remedies: Values,
) -> Sheet:
    """Contents of the design sheet from the values of the line and the result files."""
    return Sheet(
        f"Design sheet: {cfg['label']}",
        first_lines(
            kilometres(polygon_growth, route_remedies),
            verdicts(cfg, tuning, stability_map, bogie_modes, tendency_maps),
            mind=state_of_orders(cfg, tendency_maps) == "outside",
        ),
        Table(
            "Distance between turnings on the route, by law of wear", kilometre_rows(polygon_growth)
        ),
        running_table(curving_equilibrium, bogie_modes),
        absorber_table(cfg, tuning),
        peak_table(tuning),
        order_table(tendency_maps),
        range_table(cfg, tuning),
        notes(cfg, tuning),
    )


def first_lines(of_route: list[str], others: list[str], mind: bool) -> list[str]:
    """Kilometres first, but behind the warning that the sheet is not about what grows fastest."""
    warning = others[:1] if mind else []
    return [*warning, *of_route, *others[len(warning) :]]


def running_table(curving: Values, modes: Values) -> Table:
    """Build the table of the steady running: wheel loads, angles of attack, B and its onset."""
    rows = [["", *(str(name).replace("_", " ") for name in curving["wheel"])]]
    names = list(map(str, curving["absorber"]))
    shown = [(k, w) for k, w in ((0, "no absorber"), (1, "line's absorber")) if k < len(names)]
    for k, words in shown:
        if str(curving["status"][k]) != "converged":
            status = str(curving["status"][k]).replace("_", " ")
            rows.append([f"wheel load (kN), {words}: none, {status}", *[DASH] * (len(rows[0]) - 1)])
            continue
        loads = (number(1e-3 * float(load)) for load in curving["wheel_load"][k])
        rows.append([f"wheel load (kN), {words}", *loads])
    angles = dict(zip(map(str, curving["axle"]), curving["angle_of_attack"][0], strict=True))
    of_wheels = (angles[str(name).partition("_")[0]] for name in curving["wheel"])
    rows.append(
        ["angle of attack of the axle (mrad)", *(number(1e3 * float(a)) for a in of_wheels)]
    )
    critical = modes["critical_friction_decrease"]
    onsets = dict(zip(map(str, modes["absorber"]), critical, strict=True))
    margin = ", ".join(
        f"{number(float(onsets[name]))} ({words})"
        for name, words in (("none", "no absorber"), ("paper", "line's absorber"))
        if name in onsets
    )
    title = "Steady running in the curve; self-excitation from B (s/m)"
    return Table(f"{title} {margin}", rows)


def absorber_table(cfg: Config, tuning: Values) -> Table:
    """Build the table of the absorbers, one column each."""
    units, study = unit_names(cfg), cfg["study"]
    turns = cfg["bogie"]["absorber"]["motion"] == "rotation"
    columns = (PAPER, NOMINAL, ROBUST)

    def row(words: str, write) -> list[str]:
        return [words, *(write(k) for k in columns)]

    def plain(name: str, factor: float = 1.0):
        return lambda k: number(float(tuning[name][k]) * factor)

    def load(name: str, factor: float):
        return lambda k: _load(tuning, name, k, factor)

    inertia = "inertia of one" if turns else "mass of one"
    word, unit = ("torque", "mrad") if turns else ("force", "mm")
    rows = [
        ["one at each side of each axle", *(NAMES[k] for k in columns)],
        row(f"{inertia} I_T ({units['I_T']})", plain("I_T")),
        row(f"stiffness c_T ({units['c_T']})", plain("c_T")),
        row(f"    tolerance band of c_T ({units['c_T']})", lambda k: _band(tuning, k, 0)),
        row(f"damping d_T ({units['d_T']})", plain("d_T")),
        row(f"    tolerance band of d_T ({units['d_T']})", lambda k: _band(tuning, k, 1)),
        row("tuned frequency (Hz)", plain("tuned_frequency")),
        row("damping ratio", plain("damping_ratio")),
        row(
            "growth left in the band, as configured", lambda k: percent(tuning["nominal_factor"][k])
        ),
        row("growth left in the worst case", lambda k: worst(tuning, k)),
        row("growth rate at the line's B (1/s)", lambda k: number(tuning["growth_rate"][k, 0, 1])),
        row("added unsprung mass per axle (kg)", lambda k: _mass(tuning, k)),
        row("weight on one mounting (N)", plain("added_weight")),
        row(f"stroke ({unit}): as configured, worst", load("stroke_amplitude", 1e3)),
    ]
    if turns:
        rows.append(
            row(
                f"    at {1e3 * study['rim_radius']:.0f} mm radius (mm): as configured, worst",
                load("stroke_amplitude", 1e3 * study["rim_radius"]),
            )
        )
    rows += [
        row(
            f"{word} on the mounting ({units['torque']}): as configured, worst",
            load("torque_amplitude", 1.0),
        ),
        row("dissipated power of one (W): as configured, worst", load("dissipated_power", 1.0)),
        row(
            f"motion of the axle ({unit}); bare: {_load(tuning, 'carrier_amplitude', NONE, 1e3)}",
            load("carrier_amplitude", 1e3),
        ),
        row(
            "order and frequency of that load",
            lambda k: (
                f"{number(tuning['load_order'][k, 0])} at "
                f"{number(tuning['load_frequency'][k, 0])} Hz"
                if np.isfinite(tuning["load_order"][k, 0])
                else DASH
            ),
        ),
    ]
    title = f"Absorber (stroke, {word} and power by waves of"
    return Table(f"{title} {1e6 * study['wave_amplitude']:g} µm on the wheels)", rows)


def _load(tuning: Values, name: str, design: int, factor: float) -> str:
    """Nominal load and, behind a comma, the largest of the cases that count."""
    values = tuning[name][design]
    if not np.isfinite(values).any():
        return DASH
    worst = tuning[f"worst_{name}"][design]
    return f"{number(values[0] * factor)}, {number(worst * factor)}"


def _band(tuning: Values, design: int, axis: int) -> str:
    if design == PAPER or not np.isfinite(tuning["c_T"][design]):
        return DASH
    low, high = tuning["tolerance"][design, axis]
    below = number(low) if np.isfinite(low) else "open"
    above = number(high) if np.isfinite(high) else "open"
    return f"{below} to {above}"


def _mass(tuning: Values, design: int) -> str:
    mass, share = tuning["added_axle_mass"][design], tuning["added_axle_share"][design]
    return f"{number(mass)} ({percent(share)})" if np.isfinite(mass) else DASH


def peak_table(tuning: Values) -> Table:
    """Build the table of what is left of each peak, with the robust optimum over the sample too."""
    rows = [
        [
            "peak, wheel", "Hz", *(NAMES[k] for k in (PAPER, NOMINAL, ROBUST)),
            "median", "95 % of them",
        ]
    ]  # fmt: skip
    middle, high = (place_of(tuning["quantile"], share) for share in (0.5, 0.95))
    for p, peak in enumerate(map(str, tuning["peak"])):
        for w, wheel in enumerate(map(str, tuning["wheel"])):
            factor = tuning["peak_factor"][:, 0, w, p]
            sample = tuning["peak_factor_quantile"][ROBUST, w, p]
            rows.append(
                [
                    f"{peak.replace('_', ' ')}, {wheel.replace('_', ' ')}",
                    number(float(tuning["peak_frequency"][0, w, p])),
                    *(percent(float(factor[k])) for k in (PAPER, NOMINAL, ROBUST)),
                    percent(float(sample[middle])),
                    percent(float(sample[high])),
                ]
            )
    title = "Growth left at each peak as configured, and of the robust optimum in the sample"
    return Table(title, rows)


def order_table(maps: Values) -> Table:
    """Build the table of the orders that grow over the speed."""
    count = min(SPEEDS_SHOWN, maps["speed"].size)
    rows = [
        ["speed (km/h)", "orders that grow", "fast ones", "fastest", "fast with line's absorber"]
    ]
    for k in np.unique(np.linspace(0, maps["speed"].size - 1, count).round().astype(int)):
        rows.append([f"{KMH * float(maps['speed'][k]):.1f}", *_order_cells(maps, k)])
    low, high = maps["frequency"][[0, -1]]
    title = f"Orders that grow on any wheel, {low:.0f} to {high:.0f} Hz"
    share = percent(float(maps["fast_share"]))
    return Table(f"{title}; fast: at least {share} of the fastest without absorbers", rows)


def _order_cells(maps: Values, speed: int) -> list[str]:
    """Cells of a speed: orders that grow, fast ones, the fastest, fast ones with absorbers."""
    absorbers, steady = list(map(str, maps["absorber"])), maps["speed_status"][:, speed]
    none = absorbers.index("none")
    if str(steady[none]) != "converged":
        return ["no steady running", DASH, DASH, DASH]
    if not maps["order_grows"][none, speed].any():
        return ["none", "none", DASH, "none"]

    def orders(which: str, absorber: int) -> str:
        return in_ranges(maps["order"][maps[which][absorber, speed]].astype(int).tolist())

    cells = [orders("order_grows", none), orders("order_fast", none)]
    fastest, frequency = maps["fastest_order"][speed], maps["fastest_frequency"][speed]
    cells.append(f"{fastest:.0f} ({frequency:.0f} Hz)")
    if "paper" not in absorbers or str(steady[absorbers.index("paper")]) != "converged":
        return [*cells, DASH]
    return [*cells, orders("order_fast", absorbers.index("paper"))]


def range_table(cfg: Config, tuning: Values) -> Table:
    """Build the table of the ranges and of what each alone leaves with the robust optimum."""
    study = cfg["study"]
    own = {
        "friction": cfg["creep_force"]["mu_0"],
        "friction_decrease": cfg["creep_force"]["B"],
        "radius": cfg["track"]["radius"],
        "speed": KMH * cfg["track"]["speed"],
        "car_body_mass": 1e-3 * cfg["bogie"]["car_body"]["mass"],
    }
    rows = [["range", "from", "to", "left at the lower end", "at the upper end"]]
    for name, (words, unit) in RANGES.items():
        section = study["conditions"].get(name) or study["rubber"][name.partition("_")[2]]
        scale = own.get(name, 100.0)
        heading = f"{words} ({unit})" if unit else words
        rows.append(
            [
                heading,
                number(section["min"] * scale),
                number(section["max"] * scale),
                *(percent(left(tuning, ROBUST, name, end)) for end in ("min", "max")),
            ]
        )
    return Table("Ranges, and growth left in the band when one alone is at its end", rows)


def left(tuning: Values, design: int, name: str, end: str) -> float:
    """Factor of a design when one range alone is at its `min` or `max`."""
    if name.startswith("absorber_"):
        ends = list(map(str, tuning["rubber_end"]))
        return float(tuning["rubber_factor"][design, ends.index(f"{name.partition('_')[2]}_{end}")])
    place = np.flatnonzero(tuning["varied"] == f"{name}_{end}")
    return float(tuning["factor"][design, place[0]]) if place.size else np.nan


def notes(cfg: Config, tuning: Values) -> list[str]:
    """Tell assumptions, statuses and limits."""
    pairs = sorted(zip(map(str, tuning["outcome"]), tuning["outcome_cases"], strict=True))
    found = ", ".join(f"{n:.0f} {name.replace('_', ' ')}" for name, n in pairs if n)
    dropped, drawn = int(tuning["uncounted_cases"]), int(tuning["sampled_cases"])
    count = tuning["case"].size
    band, study = cfg["study"]["design_band"], cfg["study"]
    chosen = BAND_FOUND.format(**band) if band.get("mode") else BAND_GIVEN.format(**band)
    turns = cfg["bogie"]["absorber"]["motion"] == "rotation"
    return [
        chosen.replace("_", " "),
        f"Conditions: the line as configured, each range alone at both ends, and {drawn} points of "
        f"a seeded Sobol sequence over all ranges at once. Status of their equilibria: {found}.",
        f"Growth left (factor): largest evolution tendency between {band['min']:g} and "
        f"{band['max']:g} Hz on any wheel, over that without absorbers in the same "
        "condition, or as configured if that is larger. The worst case includes all ends of the "
        "absorber's own stiffness and damping. Tolerance band: factor at most "
        f"{percent(study['tolerance'])} above its best (nominal optimum: as configured; robust: "
        "in the worst case) and no condition self-excited, when one value alone moves; open: "
        "beyond the range that was searched.",
        f"Conditions that do not count in the worst case, since they vibrate by themselves with "
        f"every absorber: {dropped} of {count}. A self-excited condition has no factor and no "
        "load; the share of such conditions is told above. Where only the bogie without absorbers "
        "is self-excited, what grows with them is compared with the line as configured, so that "
        "more than 100 % may be left.",
        f"Evolution tendency at B = {cfg['forced_excitation']['B']:g} s/m (times its "
        f"share), self-excitation at the operating B, between {study['frequency']['min']:g} "
        f"and {study['frequency']['max']:g} Hz. All is linear about the steady running: "
        "loads are proportional to the wave's amplitude, with absorbers within a few per cent up "
        "to some 20 µm. Loads are the largest in the band, at orders that need not be whole; first "
        "as configured, then the largest of the conditions that count.",
        GYRATION.format(1e3 * study["gyration_radius"]) if turns else TRANSLATION,
        "Every value that is assumed is marked ASSUME in the configuration. Absolute growth per "
        "revolution is not credible (the wear chart is dry); factors are.",
    ]
