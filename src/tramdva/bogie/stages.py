"""The stages of the bogie: from configuration and earlier results to the variables of a file."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tramdva.bogie import curve_entry as entry
from tramdva.bogie import modes as modal
from tramdva.bogie.curving import angle_of_attack, wheel_loads
from tramdva.bogie.line import (
    BogieLine,
    Running,
    absorber,
    bogie_line,
    changed,
    quiet_bogie_line,
    run_through,
    track_line,
)
from tramdva.bogie.modes import Modes
from tramdva.bogie.rough_wheel_files import variables, zone_names
from tramdva.bogie.rough_wheels import rough_bogie
from tramdva.bogie.vehicle import AXLES, ENERGY_CLASSES, WHEELS
from tramdva.contact import patch

DESIGNS = ("none", "paper", "tuned")
SHAPES = ("first_bending", "second_bending", "third_bending", "resilient_wheel")  # shown
CONTACT_VARIABLES = {
    "normal_force": patch.NORMAL_FORCE,
    "contact_angle": patch.CONTACT_ANGLE,
    "longitudinal_creepage": patch.LONGITUDINAL_CREEPAGE,
    "lateral_creepage": patch.LATERAL_CREEPAGE,
    "spin_creepage": patch.SPIN_CREEPAGE,
    "slip_velocity": patch.SLIP_VELOCITY,
    "semi_axis_longitudinal": patch.SEMI_AXIS_LONGITUDINAL,
    "semi_axis_lateral": patch.SEMI_AXIS_LATERAL,
    "wheel_position": patch.WHEEL_POSITION,
    "forward_shift": patch.FORWARD_SHIFT,
}


def curving_equilibrium(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    absorber_tuning: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """Steady curving without absorber, with the paper's and with a tuned one.

    Parameters
    ----------
    cfg : sections of the bogie, ``creep_force`` and ``numerics``
    contact_geometry, absorber_tuning : variables of these files

    Returns
    -------
    Variables of ``curving_equilibrium.nc``.
    """
    line = bogie_line(cfg, contact_geometry)
    none = run_through(line, cfg["numerics"]["curvature_steps"])
    designs = _designs(line, none, cfg, absorber_tuning)
    runs = [changed(line, absorber(line, *design), none) for design in designs]
    results = np.array([run.equilibrium.results for run in runs])
    touching = results[..., patch.STATUS] != patch.NO_CONTACT
    zones = zone_names(results.shape[2])
    contacts = len(WHEELS) * len(zones)
    stiffness, damping = np.array(designs).T
    inertia = np.where(np.isnan(stiffness), np.nan, line.bogie.absorber.I_T)
    return {
        "absorber": np.array(DESIGNS),
        "m_T": inertia,
        "c_T": stiffness,
        "d_T": damping,
        "contact": np.array([f"{wheel}_{zone}" for wheel in WHEELS for zone in zones]),
        "wheel": np.array(WHEELS),
        "axle": np.array(AXLES),
        **{
            name: np.where(touching, results[..., column], np.nan).reshape(len(runs), contacts)
            for name, column in CONTACT_VARIABLES.items()
        },
        "wheel_load": np.array([list(wheel_loads(run.equilibrium).values()) for run in runs]),
        "straight_wheel_load": np.array(
            [list(wheel_loads(run.straight_equilibrium).values()) for run in runs]
        ),
        "angle_of_attack": np.array([angle_of_attack(run.curve, run.equilibrium) for run in runs]),
        "residual": np.array([run.equilibrium.residual for run in runs]),
        "status": np.array([run.equilibrium.status for run in runs]),
    }


def _designs(line: BogieLine, none: Running, cfg, tuning) -> list[tuple[float, float]]:
    """Stiffness and damping per design of `DESIGNS`.

    The tuned one starts from the design of least receptance of the basic model or, where there is
    none, from the paper's absorber.
    """
    own = line.bogie.absorber
    usable = (tuning["design"] == "h_infinity") & (tuning["status"] == "converged")
    start = (own.c_T, own.d_T)
    if usable.any():
        k = int(np.argmax(usable))
        start = modal.carried_over(own.I_T, tuning["m_T"][k], tuning["c_T"][k], tuning["d_T"][k])
    # Without an equilibrium there is nothing to tune, and each trial would fail slowly.
    if none.equilibrium.status == "converged":
        family = modal.absorber_family(line, none)
        start = modal.tuned_absorber(family, _limits(cfg), start)
    return [(np.nan, np.nan), (own.c_T, own.d_T), start]


def _limits(cfg: Mapping[str, Any]) -> tuple[float, float]:
    return cfg["study"]["frequency"]["min"], cfg["study"]["frequency"]["max"]


def _known_runs(cfg, line: BogieLine, designs: Mapping[str, np.ndarray]) -> list[Running]:
    """Equilibria of the designs in ``curving_equilibrium.nc``."""
    none = run_through(line, cfg["numerics"]["curvature_steps"])
    return [
        changed(line, absorber(line, c_T, d_T), none)
        for c_T, d_T in zip(designs["c_T"], designs["d_T"], strict=True)
    ]


def bogie_modes(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    curving_equilibrium: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """Modes over the friction decrease, critical friction decrease, absorber map, mode shapes.

    Returns
    -------
    Variables of ``bogie_modes.nc``; NaN where there is no equilibrium to linearise about.
    """
    line = bogie_line(cfg, contact_geometry)
    runs = _known_runs(cfg, line, curving_equilibrium)
    limits, shown = _limits(cfg), (1.0, cfg["study"]["frequency"]["max"])
    decrease = np.linspace(0.0, cfg["study"]["B_max"], cfg["numerics"]["friction_points"])
    table = {}
    critical, operating = np.full(len(runs), np.nan), np.full((len(runs), 2), np.nan)
    for i, run in enumerate(runs):
        if run.equilibrium.status != "converged":
            continue
        system, state = run.curve, run.equilibrium.state
        operating[i] = modal.critical_oscillation(system, state, limits)
        sweep = [modal.at_friction(system, state, B) for B in decrease]
        table |= {(i, j): modal.modes_of(system, step, shown) for j, step in enumerate(sweep)}
        growth = np.array([modal.critical_of(step, limits).growth_rate for step in sweep])
        critical[i] = modal.critical_friction_decrease(system, state, limits, decrease, growth)
    return {
        **{name: curving_equilibrium[name] for name in ("absorber", "m_T", "c_T", "d_T")},
        "status": curving_equilibrium["status"],
        "friction_decrease": decrease,
        **_mode_table(table, len(runs), len(decrease)),
        "operating_growth_rate": operating[:, 0],
        "operating_frequency": operating[:, 1],
        "critical_friction_decrease": critical,
        **_absorber_map(cfg, line, runs[0], limits),
        **_shapes(runs[0], shown),
        **_straight(runs[0], shown),
    }


def _mode_table(table: Mapping[tuple[int, int], Modes], designs: int, points: int) -> dict:
    """Modes of all designs and friction decreases, NaN and empty names beyond the last."""
    count = max((entry.eigenvalue.size for entry in table.values()), default=1)
    numbers = {
        name: np.full((designs, points, count), np.nan)
        for name in ("frequency", "damping_ratio", "growth_rate")
    }
    names = np.full((designs, points, count), "", dtype="U40")
    for place, found in table.items():
        k = found.eigenvalue.size
        numbers["frequency"][place][:k] = found.frequency
        numbers["damping_ratio"][place][:k] = found.damping_ratio
        numbers["growth_rate"][place][:k] = found.eigenvalue.real
        names[place][:k] = found.name
    return {**numbers, "mode_name": names}


def _absorber_map(cfg, line: BogieLine, none: Running, limits) -> dict[str, np.ndarray]:
    study, points = cfg["study"], cfg["numerics"]["map_points"]
    d_T = np.linspace(study["d_T"]["min"], study["d_T"]["max"], points)
    c_T = np.linspace(study["c_T"]["min"], study["c_T"]["max"], points)
    growth = np.full((points, points), np.nan)
    if none.equilibrium.status == "converged":
        family = modal.absorber_family(line, none)
        for i, j in np.ndindex(points, points):
            linear = family.member(c_T[j], d_T[i])[1]
            growth[i, j] = modal.critical_of(linear, limits).growth_rate
    return {
        "map_d_T": d_T,
        "map_c_T": c_T,
        "map_growth_rate": growth,
        "map_status": np.array(none.equilibrium.status),
    }


def _shapes(none: Running, shown) -> dict[str, np.ndarray]:
    """Motion of the front axle in the modes of `SHAPES` at the operating friction.

    A mode that is not there keeps its word as name, and NaN.
    """
    found = None
    if none.equilibrium.status == "converged":
        found = modal.modes(none.curve, none.equilibrium.state, shown)
    positions, motion = modal.axle_points(none.curve, "front")
    k, count = none.curve.size, len(SHAPES)
    names, numbers = list(SHAPES), np.full((2, count), np.nan)
    shape = np.full((count, *motion.shape[:2]), np.nan, dtype=complex)
    energy = np.full((count, len(ENERGY_CLASSES)), np.nan)
    for row, word in enumerate(SHAPES):
        mode = None if found is None else modal.of_front_axle(found, word)
        if mode is None:
            continue
        moved = motion[..., :k] @ found.shape[:, mode]
        names[row] = found.name[mode]
        numbers[:, row] = found.frequency[mode], found.damping_ratio[mode]
        shape[row] = moved / np.abs(moved[:, :3]).max()
        energy[row] = found.share[mode].sum(axis=1)
    return {
        "shape_mode": np.array(names),
        "shape_frequency": numbers[0],
        "shape_damping_ratio": numbers[1],
        "point_position": positions,
        "shape_real": shape.real,
        "shape_imag": shape.imag,
        "energy_class": np.array(ENERGY_CLASSES),
        "strain_energy_share": energy,
    }


def _straight(none: Running, shown) -> dict[str, np.ndarray]:
    names, numbers = [""], np.full((2, 1), np.nan)
    if none.straight_equilibrium.status == "converged":
        found = modal.modes(none.straight, none.straight_equilibrium.state, shown)
        names, numbers = found.name, np.array([found.frequency, found.damping_ratio])
    return {
        "straight_frequency": numbers[0],
        "straight_damping_ratio": numbers[1],
        "straight_mode_name": np.array(names),
    }


def curve_entry(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    curving_equilibrium: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """Ride into the curve per absorber (figure 9).

    Returns
    -------
    Variables of ``curve_entry.nc``.
    """
    line, study, numerics = bogie_line(cfg, contact_geometry), cfg["study"], cfg["numerics"]
    known = dict(zip(curving_equilibrium["absorber"], range(len(DESIGNS)), strict=True))
    chosen = [known[name] for name in study["absorbers"]]
    designs = {name: curving_equilibrium[name][chosen] for name in ("m_T", "c_T", "d_T")}
    start = track_line(line, study["entry"] * line.track.speed)
    rides = []
    for run in _known_runs(cfg, line, designs):
        route = entry.Route(
            start,
            line.track.speed,
            line.bogie.half_wheelbase,
            line.track.gravity,
            (run.straight, run.curve),
            (run.straight_equilibrium, run.equilibrium),
        )
        rides.append(
            entry.ride(
                route, study["duration"], numerics["interval"], numerics["every"],
                numerics["tolerance"],
            )
        )  # fmt: skip
    radius = line.bogie.wheel.radius
    normal = np.array([ride.results[..., 0].sum(axis=2).T for ride in rides])
    return {
        "absorber": np.array(study["absorbers"]),
        **designs,
        "wheel": np.array(WHEELS),
        "time": rides[0].time,
        "contact_point_lateral_velocity": np.array(
            [entry.contact_point_velocity(radius, ride.local) for ride in rides]
        ),
        "normal_force": normal,
        "evaluations": np.array([float(ride.evaluations) for ride in rides]),
        "status": np.array([ride.status for ride in rides]),
    }


def bogie_linearisation(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    tuned: tuple[float, float] | None = None,
) -> dict[str, np.ndarray]:
    """The bogie in its curve without self-excitation, linearised with its wheels out of round.

    Parameters
    ----------
    cfg : sections of the bogie, without ``bogie.absorber`` for the bogie without absorbers
    contact_geometry : variables of this file
    tuned : stiffness and damping of the absorber instead of those in the configuration

    Returns
    -------
    Variables of ``bogie_linearisation``.
    """
    bogie = dict(cfg["bogie"])
    if tuned is not None:
        bogie["absorber"] = bogie["absorber"] | {"c_T": tuned[0], "d_T": tuned[1]}
    line = quiet_bogie_line({**cfg, "bogie": bogie}, contact_geometry)
    run = run_through(line, cfg["numerics"]["curvature_steps"])
    design = getattr(line.bogie, "absorber", None)
    if design is not None:
        run = changed(line, design, run)
    return {
        **{
            name: np.float64(getattr(design, own, np.nan))
            for name, own in (("m_T", "I_T"), ("c_T", "c_T"), ("d_T", "d_T"))
        },
        **variables(
            rough_bogie(run.curve, run.equilibrium),
            run.curve.contacts,
            line.bogie.wheel.radius,
            line.grid,
        ),
        "residual": np.float64(run.equilibrium.residual),
        "status": np.array(run.equilibrium.status),
    }
