"""The stage `route_tuning`: the absorber that buys the most kilometres on the route."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from tramdva.bogie.parameters import BogieAbsorber
from tramdva.route.any_absorber import class_ports
from tramdva.route.growth import initial_amplitudes
from tramdva.route.parameters import InitialSpectrum, Material, MeasuredWear
from tramdva.route.response import ClassRun, Middle, at_mean_speed, of_surfaces
from tramdva.route.scaling import PER_1000_KM, scales
from tramdva.route.search import (
    TEMPERATURES,
    Design,
    Fleet,
    at_temperatures,
    best_of_material,
)
from tramdva.route.speeds import SpeedPoints, intervals, speed_points
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.stages.route_sections import Lap, lap_of, route_orders
from tramdva.stages.route_wear import wearing_of_all
from tramdva.variables.arrays import without_numbers
from tramdva.variables.route_tuning import VARIABLES

__all__ = ["VARIABLES", "compute"]

MASS_SHARES = np.array([0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0])
DETUNED = np.geomspace(0.5, 2.0, 25)
TUNED = (12.0, 220.0)  # Hz, own frequencies of the absorbers that are tried


class _Known(NamedTuple):
    """What every search shares."""

    lap: Lap
    middles: list[Middle]
    points: list[SpeedPoints]
    orders: np.ndarray
    absorber: BogieAbsorber
    operating: float
    initial: np.ndarray
    limit: float
    horizon: float


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Search the absorber of each material, and for the best one over its mass.

    Parameters
    ----------
    cfg : sections of the bogie, ``creep_force.B``, ``wear``, ``route``, ``numerics``
    contact_geometry : variables of this file
    file_of : where a file lies that the configuration names: a table of sections

    Returns
    -------
    Variables of ``route_tuning``.
    """
    known = _known(cfg, contact_geometry, file_of)
    materials = [Material.model_validate(one) for one in cfg["route"]["materials"]]
    common = {
        "wear_law": np.array(cfg["route"]["wear_law"]),
        "material": np.array([one.name for one in materials]),
        "temperature": np.array(TEMPERATURES),
        "mass_share": MASS_SHARES,
        "stiffness_share": DETUNED,
        "I_T": np.float64(known.absorber.I_T),
    }
    if any(one.node.status["none"] != "converged" for one in known.middles):
        return _nothing(common, len(materials))
    fleet = _fleet(cfg, known, 1.0)
    found = [_of_material(cfg, known, fleet, one) for one in materials]
    distance = np.array(
        [_by_temperature(fleet, known, *pair) for pair in zip(found, materials, strict=True)]
    )
    worst = np.where(np.isfinite(distance), distance, -np.inf).min(axis=1)
    best = int(worst.argmax())
    design, material = found[best], materials[best]
    masses = _over_mass(cfg, known, design, material)
    return {
        **common,
        "bare_distance": np.float64(fleet.distance(known.absorber.I_T, np.nan, np.nan)),
        "material_c_T": np.array([one.c_T for one in found]),
        "material_d_T": np.array([one.d_T for one in found]),
        "material_distance": distance,
        "material_status": np.array([_status(one) for one in found]),
        "best_material": np.array(material.name if np.isfinite(worst[best]) else ""),
        "c_T": np.float64(design.c_T),
        "d_T": np.float64(design.d_T),
        "status": np.array(_status(design)),
        "quiet": design.quiet,
        "mass_c_T": np.array([one.c_T for one in masses]),
        "mass_d_T": np.array([one.d_T for one in masses]),
        "mass_distance": np.array([one.distance for one in masses]),
        "detuned_distance": np.array(
            [
                fleet.distance(known.absorber.I_T, share * design.c_T, design.d_T)
                if np.isfinite(design.c_T)
                else np.nan
                for share in DETUNED
            ]
        ),
    }


def _known(cfg, contact_geometry, file_of) -> _Known:
    """Classes at their mean speeds, without absorbers, with the wear of the law that is told."""
    line, lap, route = quiet_bogie_line(cfg, contact_geometry), lap_of(cfg, file_of), cfg["route"]
    law = wearing_of_all(cfg, route["wear_law"])
    orders = route_orders(cfg)
    middles = [at_mean_speed(line, one, {"none": None}, [law]) for one in lap.classes]
    most = cfg["numerics"]["most_speed_points"]
    steps = max(intervals(one.running.scatter, one.width, most) for one in middles)
    return _Known(
        lap,
        middles,
        [speed_points(one.running.scatter, steps) for one in middles],
        orders,
        line.bogie.absorber,
        cfg["creep_force"]["B"],
        initial_amplitudes(orders, InitialSpectrum.model_validate(route["initial"])),
        1e-3 * route["turning"]["peak_to_peak_mm"],
        route["horizon_km"],
    )


def _fleet(cfg: Mapping[str, Any], known: _Known, share: float) -> Fleet:
    """Classes as an absorber of a share of the line's inertia sees them."""
    absorber = known.absorber.model_copy(update={"I_T": share * known.absorber.I_T})
    cases = known.lap.cases()
    alone = [ClassRun(one.running, speed_points(0.0, 0), [one.node]) for one in known.middles]
    measured = MeasuredWear.model_validate(cfg["route"]["measured_wear"])
    scale, ratio = scales(alone, cases, 1, measured)
    classes = []
    for middle, points in zip(known.middles, known.points, strict=True):
        (wear,) = of_surfaces(middle.running, middle.node, middle.node.wear["none"], ratio)
        per_metre = middle.node.spin / (2.0 * np.pi * middle.running.speed)
        classes.append(
            class_ports(
                middle.known.system,
                middle.known.equilibrium,
                middle.node.bogie["none"],
                wear,
                points.share[:, None] * middle.node.spin,
                known.orders,
                PER_1000_KM * per_metre[:, None] * points.weight,
                absorber,
                known.operating,
            )
        )
    placed = [(case.running, case.places, case.share) for case in cases]
    return Fleet(classes, placed, float(scale[0]), known.initial, known.limit, known.horizon)


def _of_material(
    cfg: Mapping[str, Any],
    known: _Known,
    fleet: Fleet,
    material: Material,
    share: float = 1.0,
    near: Design | None = None,
) -> Design:
    """Best design of a material for a share of the line's inertia."""
    inertia = share * known.absorber.I_T
    own = 2.0 * np.pi * np.geomspace(*TUNED, cfg["numerics"]["c_T_points"])
    return best_of_material(fleet, inertia, inertia * own**2, material, near)


def _over_mass(
    cfg: Mapping[str, Any], known: _Known, design: Design, material: Material
) -> list[Design]:
    """Best designs of a material over the inertia, each from its neighbour's own frequency."""
    found: dict[float, Design] = {}
    for way in (MASS_SHARES[MASS_SHARES >= 1.0], MASS_SHARES[MASS_SHARES < 1.0][::-1]):
        before, known_share = design, 1.0
        for share in map(float, way):
            ratio = share / known_share
            near = before._replace(c_T=before.c_T * ratio, d_T=before.d_T * ratio)
            fleet = _fleet(cfg, known, share)
            before = _of_material(cfg, known, fleet, material, share, near)
            found[share], known_share = before, share
    return [found[float(share)] for share in MASS_SHARES]


def _by_temperature(fleet: Fleet, known: _Known, design: Design, material: Material) -> list[float]:
    """Distances (3,) in km of a design at `TEMPERATURES`; NaN without one."""
    if not np.isfinite(design.c_T):
        return [np.nan] * len(TEMPERATURES)
    inertia = known.absorber.I_T
    loss = design.d_T / np.sqrt(design.c_T * inertia)
    designs = at_temperatures(inertia, design.c_T, loss, material)
    return [fleet.distance(inertia, *one) for one in designs]


def _status(design: Design) -> str:
    if not np.isfinite(design.c_T):
        return "no_design"
    return "found" if design.quiet else "not_quiet"


def _nothing(common: Mapping[str, np.ndarray], materials: int) -> dict[str, Any]:
    """Variables where a condition of the route has no steady answer."""
    lengths = {
        "material": materials,
        "temperature": len(TEMPERATURES),
        "mass_share": MASS_SHARES.size,
        "stiffness_share": DETUNED.size,
    }
    return {
        **without_numbers(VARIABLES, lengths),
        **common,
        "material_status": np.full(materials, "no_steady_answer"),
        "best_material": np.array(""),
        "status": np.array("no_steady_answer"),
    }
