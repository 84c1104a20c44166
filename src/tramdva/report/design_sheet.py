"""Words and tables of the design sheet, the same for its page and its PDF. For `paper_figures/`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

KMH = 3.6
NONE, PAPER, NOMINAL, ROBUST = range(4)
NAMES = ("no absorber", "line's absorber", "nominal optimum", "robust optimum")
SPEEDS_SHOWN = 9
FAST = 0.1  # of the growth of the fastest order
DASH = "–"
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

GYRATION = (
    "Mass of an absorber from its inertia at a radius of gyration of {:.0f} mm. Its weight is not "
    "in the model: a rotating absorber replaces mass of the axle."
)
TRANSLATION = (
    "The weight of the translating absorbers acts on the mounting as told, but is left out of the "
    "wheel loads; their inertia across the direction is in the model."
)


class Table(NamedTuple):
    """A table of texts, its headings first, and what it is."""

    title: str
    rows: list[list[str]]


class Sheet(NamedTuple):
    """Contents of the sheet."""

    title: str
    verdicts: list[str]
    absorber: Table
    peaks: Table
    orders: Table
    ranges: Table
    notes: list[str]


def number(value: float, digits: int = 3) -> str:
    """Write a number with a few digits, or a dash where there is none."""
    if not np.isfinite(value):
        return DASH
    if value == 0.0:
        return "0"
    if not 1e-3 <= abs(value) < 1e5:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        return f"{mantissa.replace('-', '−')}·10{_raised(int(exponent))}"
    size = int(np.floor(np.log10(abs(float(f"{value:.{digits - 1}e}")))))
    return f"{value:.{max(digits - 1 - size, 0)}f}".replace("-", "−")


def _raised(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def percent(share: float) -> str:
    """Write a share in per cent, or a dash."""
    if not np.isfinite(share):
        return DASH
    return f"{100.0 * share:.0f} %" if share == 0.0 or share >= 0.0095 else f"{100 * share:.1f} %"


def sheet(
    cfg: Mapping[str, Any],
    tuning: Mapping[str, np.ndarray],
    stability_map: Mapping[str, np.ndarray],
    bogie_modes: Mapping[str, np.ndarray],
    tendency_maps: Mapping[str, np.ndarray],
) -> Sheet:
    """Contents of the design sheet from the values of the line and the result files."""
    return Sheet(
        f"Design sheet: {cfg['label']}",
        [
            *self_excitation(cfg, stability_map, bogie_modes),
            *spread(tuning),
            recommendation(cfg, tuning),
        ],
        absorber_table(cfg, tuning),
        peak_table(tuning),
        order_table(cfg, tendency_maps),
        range_table(cfg, tuning),
        notes(cfg, tuning),
    )


def self_excitation(cfg, stability_map, modes) -> list[str]:
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
        if name not in ("none", "paper"):
            continue
        words = "without absorbers" if name == "none" else "with the line's absorbers"
        lines.append(f"Bogie in its curve, {words}: {_bogie(cfg, modes, row)}")
    return lines


def _bogie(cfg, modes, row: int) -> str:
    status = str(modes["status"][row])
    if status != "converged":
        return f"no steady running was found ({status.replace('_', ' ')})."
    growth, frequency = modes["operating_growth_rate"][row], modes["operating_frequency"][row]
    critical = float(modes["critical_friction_decrease"][row])
    B, top = cfg["creep_force"]["B"], cfg["study"]["B_max"]
    onset = f"self-excitation from B = {number(critical)} s/m on"
    if np.isnan(critical):
        onset = f"no onset of self-excitation up to B = {top:g} s/m"
    does = "vibrates by itself" if growth >= 0.0 else "does not vibrate by itself"
    return (
        f"{onset}; at B = {B:g} s/m it {does} "
        f"(growth rate {number(growth)} 1/s at {number(frequency)} Hz)."
    )


def spread(tuning) -> list[str]:
    """Tell in how many of the sampled cases the bogie vibrates by itself."""
    drawn = tuning["varied"] == "all"
    there = drawn & (tuning["case_status"] == "converged")
    if not there.any():
        return ["None of the sampled conditions has a steady running: nothing can be told of them."]
    parts = [
        f"{words} {percent(np.mean(tuning['growth_rate'][k, there, 1] >= 0.0))}"
        for k, words in enumerate(NAMES)
        if np.isfinite(tuning["growth_rate"][k, there, 1]).any()
    ]
    return [f"Share of {there.sum()} sampled conditions with self-excitation: {', '.join(parts)}."]


def recommendation(cfg, tuning) -> str:
    """Tell the absorber that is recommended, or why there is none."""
    status = str(tuning["status"][ROBUST])
    if status == "no_equilibrium":
        return "No recommendation: the line as configured has no steady running in its curve."
    band = cfg["study"]["design_band"]
    where = f"{band['min']:g} and {band['max']:g} Hz"
    if status == "nothing_grows":
        words = f"between {where} no order grows in any of the conditions"
        if (tuning["growth_rate"][NONE, :, 1] >= 0.0).any():
            return f"No tuning: {words}; against self-excitation see the map of the bogie."
        return f"No absorber is needed: {words}, and none vibrates by itself."
    units = unit_names(cfg)
    if not np.isfinite(tuning["c_T"][ROBUST]):
        return "No recommendation: with every absorber some condition vibrates by itself."
    words = (
        f"Recommended: the robust optimum, c_T = {number(tuning['c_T'][ROBUST])} {units['c_T']}, "
        f"d_T = {number(tuning['d_T'][ROBUST])} {units['d_T']}. Of the growth between {where} it "
        f"leaves {percent(tuning['nominal_factor'][ROBUST])}, in the worst case "
        f"{percent(tuning['worst_factor'][ROBUST])}."
    )
    if status == "self_excited":
        words += " Some conditions that another absorber would keep quiet vibrate by themselves."
    return words


def unit_names(cfg) -> dict[str, str]:
    """Units of the absorber: of rotation, or of translation."""
    if cfg["bogie"]["absorber"]["motion"] == "rotation":
        return {"I_T": "kg m²", "c_T": "N m/rad", "d_T": "N m s/rad", "torque": "N m"}
    return {"I_T": "kg", "c_T": "N/m", "d_T": "N s/m", "torque": "N"}


def absorber_table(cfg, tuning) -> Table:
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

    axle = 2.0 / float(tuning["unsprung_mass"])
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
        row("growth left in the worst case", lambda k: _worst(tuning, k)),
        row("growth rate at the line's B (1/s)", lambda k: number(tuning["growth_rate"][k, 0, 1])),
        row("added unsprung mass per axle (kg)", lambda k: _mass(tuning, k, axle)),
        row("weight on one mounting (N)", plain("added_mass", cfg["track"]["gravity"])),
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


def _load(tuning, name: str, design: int, factor: float) -> str:
    """Nominal load and, behind a comma, the largest of the cases that count."""
    values = tuning[name][design]
    if not np.isfinite(values).any():
        return DASH
    counted = values[tuning["counted"] & np.isfinite(values)]
    worst = counted.max() if counted.size else np.nan
    return f"{number(values[0] * factor)}, {number(worst * factor)}"


def _band(tuning, design: int, axis: int) -> str:
    if design == PAPER or not np.isfinite(tuning["c_T"][design]):
        return DASH
    low, high = tuning["tolerance"][design, axis]
    below = number(low) if np.isfinite(low) else "open"
    above = number(high) if np.isfinite(high) else "open"
    return f"{below} to {above}"


def _worst(tuning, design: int) -> str:
    excited = tuning["self_excited_cases"][design]
    if np.isfinite(excited) and excited > 0.0:
        return f"self-excited in {excited:.0f} of {tuning['counted'].sum()}"
    return percent(tuning["worst_factor"][design])


def _mass(tuning, design: int, share: float) -> str:
    mass = float(tuning["added_mass"][design])
    return f"{number(2.0 * mass)} ({percent(mass * share)})" if np.isfinite(mass) else DASH


def peak_table(tuning) -> Table:
    """Build the table of what is left of each peak, with the robust optimum over the sample too."""
    rows = [
        [
            "peak, wheel", "Hz", *(NAMES[k] for k in (PAPER, NOMINAL, ROBUST)),
            "median", "95 % of them",
        ]
    ]  # fmt: skip
    drawn = tuning["varied"] == "all"
    for p, peak in enumerate(map(str, tuning["peak"])):
        for w, wheel in enumerate(map(str, tuning["wheel"])):
            factor = tuning["peak_factor"][:, :, w, p]
            sample = factor[ROBUST, drawn]
            sample = sample[np.isfinite(sample)]
            middle, high = np.quantile(sample, [0.5, 0.95]) if sample.size else (np.nan, np.nan)
            rows.append(
                [
                    f"{peak.replace('_', ' ')}, {wheel.replace('_', ' ')}",
                    number(float(tuning["peak_frequency"][0, w, p])),
                    *(percent(float(factor[k, 0])) for k in (PAPER, NOMINAL, ROBUST)),
                    percent(float(middle)),
                    percent(float(high)),
                ]
            )
    title = "Growth left at each peak as configured, and of the robust optimum in the sample"
    return Table(title, rows)


def order_growth(
    frequency: np.ndarray, tendency: np.ndarray, speed: float, radius: float
) -> tuple[np.ndarray, np.ndarray]:
    """Whole orders within the frequencies, and the largest tendency of each on any wheel.

    Parameters
    ----------
    frequency : (f,) Hz; tendency : (wheels, f); speed : m/s; radius : m, of the wheels
    """
    per_order = speed / (2.0 * np.pi * radius)
    first, last = np.ceil(frequency[0] / per_order), np.floor(frequency[-1] / per_order)
    orders = np.arange(max(first, 1), last + 1)
    values = np.array([np.interp(orders * per_order, frequency, row) for row in tendency])
    return orders.astype(int), values.max(axis=0)


def in_ranges(orders: Sequence[int]) -> str:
    """Write whole numbers as ranges: 1 to 4, 7."""
    pieces: list[list[int]] = []
    for order in orders:
        if pieces and order == pieces[-1][1] + 1:
            pieces[-1][1] = order
        else:
            pieces.append([order, order])
    return ", ".join(str(a) if a == b else f"{a} to {b}" for a, b in pieces) or "none"


def order_table(cfg, maps) -> Table:
    """Build the table of the orders that grow over the speed."""
    absorbers = list(map(str, maps["absorber"]))
    radius, count = cfg["bogie"]["wheel"]["radius"], min(SPEEDS_SHOWN, maps["speed"].size)
    rows = [
        ["speed (km/h)", "orders that grow", "fast ones", "fastest", "fast with line's absorber"]
    ]
    for k in np.unique(np.linspace(0, maps["speed"].size - 1, count).round().astype(int)):
        speed = float(maps["speed"][k])
        growth = {}
        for a, name in enumerate(absorbers):
            if str(maps["speed_status"][a, k]) == "converged":
                tendency = maps["speed_tendency"][a, :, k]
                growth[name] = order_growth(maps["frequency"], tendency, speed, radius)
        rows.append([f"{KMH * speed:.1f}", *_order_cells(growth, speed / (2 * np.pi * radius))])
    low, high = maps["frequency"][[0, -1]]
    title = f"Orders that grow on any wheel, {low:.0f} to {high:.0f} Hz"
    return Table(f"{title}; fast: at least {percent(FAST)} of the fastest without absorbers", rows)


def _order_cells(growth: Mapping[str, tuple[np.ndarray, np.ndarray]], hertz: float) -> list[str]:
    """Cells of a speed: orders that grow, fast ones, the fastest, fast ones with absorbers."""
    if "none" not in growth:
        return ["no steady running", DASH, DASH, DASH]
    orders, values = growth["none"]
    if not (values > 0.0).any():
        return ["none", "none", DASH, "none"]
    limit, fastest = FAST * values.max(), orders[values.argmax()]
    cells = [in_ranges(orders[values > 0.0]), in_ranges(orders[values >= limit])]
    cells.append(f"{fastest} ({fastest * hertz:.0f} Hz)")
    if "paper" not in growth:
        return [*cells, DASH]
    orders, values = growth["paper"]
    return [*cells, in_ranges(orders[values >= limit])]


def range_table(cfg, tuning) -> Table:
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


def left(tuning, design: int, name: str, end: str) -> float:
    """Factor of a design when one range alone is at its `min` or `max`."""
    if name.startswith("absorber_"):
        ends = list(map(str, tuning["rubber_end"]))
        return float(tuning["rubber_factor"][design, ends.index(f"{name.partition('_')[2]}_{end}")])
    place = np.flatnonzero(tuning["varied"] == f"{name}_{end}")
    return float(tuning["factor"][design, place[0]]) if place.size else np.nan


def notes(cfg, tuning) -> list[str]:
    """Tell assumptions, statuses and limits."""
    status, counts = np.unique(tuning["case_status"], return_counts=True)
    pairs = zip(status, counts, strict=True)
    found = ", ".join(f"{n} {str(name).replace('_', ' ')}" for name, n in pairs)
    there = tuning["case_status"] == "converged"
    dropped = int((there & ~tuning["counted"]).sum())
    drawn = int((tuning["varied"] == "all").sum())
    band, study = cfg["study"]["design_band"], cfg["study"]
    turns = cfg["bogie"]["absorber"]["motion"] == "rotation"
    return [
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
        f"every absorber: {dropped} of {len(there)}. A self-excited condition has no factor and no "
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
