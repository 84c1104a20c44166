"""The stage `route_remedies`: what changes of the route buy, and what scatter of speed leaves."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from tramdva.bogie.names import WHEELS
from tramdva.bogie.tram import BogieLine
from tramdva.evolution.tendency import Wearing, excitation_frequency
from tramdva.route.classes import RunningClass, cases_of, classes_of
from tramdva.route.growth import initial_amplitudes, wheel_life
from tramdva.route.parameters import InitialSpectrum, MeasuredWear
from tramdva.route.remedies import Conditioned, growth, remedies, worst_sections
from tramdva.route.response import ClassRun, run_classes
from tramdva.route.scaling import METRES, Scales, scales
from tramdva.route.scatter import in_phase_growth, own_growth
from tramdva.route.search import energy_distance
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.stages.route_designs import designs_of
from tramdva.stages.route_sections import Lap, lap_of, route_orders
from tramdva.stages.route_wear import wearing_of_all
from tramdva.variables.route_remedies import VARIABLES

__all__ = ["VARIABLES", "compute"]

SECTIONS = 3  # in which single remedies are tried
EARLIER = 0.5  # of the limit
SCATTERS = np.array([0.0, 0.01, 0.02, 0.05, 0.10])
EXCITATIONS = ("in_phase", "own")


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    robust_tuning: Mapping[str, np.ndarray],
    route_tuning: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Kilometres that remedies buy, and effects of absorbers over the scatter of the speed.

    Parameters
    ----------
    cfg : sections of the bogie, ``wear``, ``route``, ``out_of_roundness.wheels``, ``study``,
        ``numerics``
    contact_geometry, robust_tuning, route_tuning : variables of these files
    file_of : where a file lies that the configuration names: a table of sections

    Returns
    -------
    Variables of ``route_remedies``.
    """
    line, lap = quiet_bogie_line(cfg, contact_geometry), lap_of(cfg, file_of)
    orders = route_orders(cfg)
    law = wearing_of_all(cfg, cfg["route"]["wear_law"])
    designs = designs_of(line, robust_tuning, route_tuning)
    return {
        "wear_law": np.array(cfg["route"]["wear_law"]),
        **_remedies(cfg, line, lap, law, orders),
        **_scatter(cfg, line, designs, orders),
    }


def _remedies(
    cfg: Mapping[str, Any], line: BogieLine, lap: Lap, law: Wearing, orders: np.ndarray
) -> dict[str, Any]:
    """Distances between turnings and lives of wheels with every remedy."""
    route = cfg["route"]
    known = Conditioned(line, law, cfg["numerics"]["most_speed_points"])
    runs, cases = known.runs(lap.classes, 1.0), lap.cases()
    scale = scales(runs, cases, 1, MeasuredWear.model_validate(route["measured_wear"]))
    bare = growth(runs, cases, orders, scale)
    steady = bool(np.isfinite(bare).all())
    tried = []
    if steady:
        worst = worst_sections(lap.sections, _by_section(lap, runs, orders, scale), SECTIONS)
        tried = remedies(lap.sections, worst)
    distances = []
    for remedy in tried:
        classes, passages = classes_of(remedy.sections, route["way"], route["ends"])
        changed = known.runs(classes, remedy.wheel_stiffness)
        found = growth(changed, cases_of(passages), orders, scale)
        distances.append(_distance(cfg, orders, found, 1.0))
    bare_distance, earlier = (_distance(cfg, orders, bare, share) for share in (1.0, EARLIER))
    names = [
        *(lap.sections[one.section].name if one.section >= 0 else "" for one in tried),
        *([""] if steady else []),
    ]
    if steady:
        distances.append(earlier)
    lives = [_life(cfg, km, 1.0) for km in distances]
    if steady:
        lives[-1] = _life(cfg, earlier, EARLIER)
    distance, life = np.array(distances, float), np.array(lives, float)
    ranked = np.argsort(-np.where(np.isfinite(life), life, -np.inf), kind="stable")
    kinds = np.array([*(one.kind for one in tried), *(["turned_earlier"] * steady)], str)
    return {
        "remedy": kinds[ranked],
        "remedy_section": np.array(names, str)[ranked],
        "remedy_distance": distance[ranked],
        "remedy_gain": distance[ranked] / bare_distance,
        "remedy_wheel_life": life[ranked],
        "remedy_status": np.where(np.isfinite(distance[ranked]), "computed", "no_steady_answer"),
        "bare_distance": np.float64(bare_distance),
        "bare_wheel_life": np.float64(_life(cfg, bare_distance, 1.0)),
        "bare_status": np.array("computed" if steady else "no_steady_answer"),
    }


def _by_section(
    lap: Lap, runs: Sequence[ClassRun], orders: np.ndarray, scale: Scales
) -> Callable[[int], np.ndarray]:
    """Growth (wheels, orders) by a section of the lap."""

    def of_section(place: int) -> np.ndarray:
        own = [
            case._replace(share=lap.shares(case)[place])
            for case in lap.cases()
            if lap.shares(case)[place] > 0.0
        ]
        return growth(runs, own, orders, scale)

    return of_section


def _distance(cfg: Mapping[str, Any], orders: np.ndarray, found: np.ndarray, share: float) -> float:
    """Distance in km until the first wheel has the energy of a share of the limit."""
    if not np.isfinite(found).all():
        return np.nan
    route = cfg["route"]
    initial = np.abs(initial_amplitudes(orders, InitialSpectrum.model_validate(route["initial"])))
    limit = 1e-3 * share * route["turning"]["peak_to_peak_mm"]
    return min(energy_distance(initial, one, limit, route["horizon_km"]) for one in found)


def _life(cfg: Mapping[str, Any], distance: float, share: float) -> float:
    """Life of the wheels in km; a cut takes the height of the polygon at least.

    What is left of the configured cut, which belongs to the whole limit, is independent of it.
    """
    if not distance > 0.0:
        return np.nan
    turning = cfg["route"]["turning"]
    cut = turning["cut_mm"] - (1.0 - share) * min(turning["peak_to_peak_mm"], turning["cut_mm"])
    wear = METRES * 1e-3 * cfg["route"]["measured_wear"]["tread_mm_per_10000_km"]
    return wheel_life(distance, 1e-3 * cut, wear, 1e-3 * turning["usable_radius_mm"])


def _scatter(
    cfg: Mapping[str, Any], line: BogieLine, designs: Mapping[str, Any], orders: np.ndarray
) -> dict[str, Any]:
    """Growth in the line's own curve over the scatter of the speed, by the law of figure 10."""
    wheels = tuple(cfg["out_of_roundness"]["wheels"])
    places, radius = [WHEELS.index(name) for name in wheels], line.bogie.wheel.radius
    width = 2.0 * line.bogie.wheel.half_distance
    classes = [
        RunningClass(
            1.0 / line.track.radius, line.track.cant * width, line.track.speed, scatter, np.nan, 1.0
        )
        for scatter in SCATTERS
    ]
    law = wearing_of_all(cfg, cfg["wear"]["method"])
    runs = run_classes(line, classes, designs, [law], cfg["numerics"]["most_speed_points"])
    found = np.array(
        [
            [
                [in_phase_growth(run, name, orders, wheels, radius)[places] for name in designs]
                for run in runs
            ],
            [[own_growth(run, name, orders)[places] for name in designs] for run in runs],
        ]
    )  # excitation, scatter, absorber, wheel, order
    frequency = excitation_frequency(orders, line.track.speed, radius)
    band = cfg["study"]["design_band"]
    inside = (frequency >= band["min"]) & (frequency <= band["max"])
    near = np.where(inside, found, -np.inf)
    top, known = near.max(axis=-1), np.isfinite(found).all(axis=-1)
    grows = known & (top > 0.0)
    bare = np.where(grows, top, np.nan)[:, :, :1]
    return {
        "speed_scatter": SCATTERS,
        "excitation": np.array(EXCITATIONS),
        "absorber": np.array(list(designs)),
        "wheel": np.array(wheels),
        "scatter_growth": np.where(known & np.isfinite(top), top, np.nan),
        "scatter_order": np.where(grows, orders[near.argmax(axis=-1)], np.nan),
        "scatter_factor": np.where(known, top, np.nan) / bare,
        "scatter_all_growth": np.where(known, found.max(axis=-1), np.nan),
        "scatter_status": np.where(known.all(axis=(0, 3)), "computed", "no_steady_answer"),
    }
