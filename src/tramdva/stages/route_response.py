"""The stage `route_response`: wear of the wheels by their own waves on the route."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from tramdva.bogie.names import WHEELS
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.tram import BogieLine
from tramdva.bogie.tram import absorber as absorber_of
from tramdva.evolution.tendency import Wearing
from tramdva.route.classes import OWN_WHEELS, places_of_wheels
from tramdva.route.response import SURFACES, ClassRun, mean_depth, own_wear, run_classes
from tramdva.route.speeds import halved
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.stages.route_sections import Case, Lap, case_name, lap_of
from tramdva.stages.wear_sections import chart_of, wear_grid
from tramdva.variables.route_response import VARIABLES
from tramdva.wear.chart import METHODS

__all__ = ["VARIABLES", "compute"]

PER_1000_KM = 1e6  # m


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    robust_tuning: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Wear response of every wheel of the vehicle to its own waves in each condition of the route.

    Parameters
    ----------
    cfg : sections of the bogie, ``wear``, ``route``, ``numerics``
    contact_geometry, robust_tuning : variables of these files; the latter names the designs
    file_of : where a file lies that the configuration names: a table of sections

    Returns
    -------
    Variables of ``route_response``.
    """
    line, lap = quiet_bogie_line(cfg, contact_geometry), lap_of(cfg, file_of)
    designs, laws = designs_of(line, robust_tuning), laws_of(cfg)
    numerics = cfg["numerics"]
    wanted = numerics["orders"]
    orders = np.arange(wanted["first"], wanted["last"] + 1, wanted["step"])
    runs = run_classes(
        line, lap.classes, designs, list(laws.values()), numerics["most_speed_points"]
    )
    cases = lap.cases()
    frame = {
        "speed": np.array([runs[case.running].speed for case in cases]),
        "speed_weight": np.array([runs[case.running].points.weight for case in cases]),
        "coarse_speed_weight": np.array([halved(runs[case.running].points) for case in cases]),
        "revolutions_per_1000_km": np.array([_revolutions(lap, case, runs) for case in cases]),
        "mean_wear_depth": np.stack(
            [
                [_of_wheels(mean_depth(runs[case.running], law), case, axis=1) for case in cases]
                for law in range(len(laws))
            ]
        ),
    }
    scale, ratio = _scales(cfg, frame)
    answers = [np.array([own_wear(run, name, orders, ratio) for name in designs]) for run in runs]
    response = np.stack(
        [_of_wheels(answers[case.running], case, axis=2) for case in cases], axis=2
    )
    response = np.moveaxis(response, 0, 2)  # law, class, absorber, wheel, order, speed
    return {
        "wear_law": np.array(list(laws)),
        **_cases(line, lap),
        **_designs(designs),
        "wheel": np.array(OWN_WHEELS),
        "order": orders.astype(float),
        **frame,
        "wear_response_real": response.real,
        "wear_response_imag": response.imag,
        "surface": np.array(SURFACES),
        "status": np.array(
            [[runs[case.running].status(name) for name in designs] for case in cases]
        ),
        "wear_scale": scale,
        "flange_wear_ratio": ratio,
    }


def designs_of(
    line: BogieLine, robust_tuning: Mapping[str, np.ndarray]
) -> dict[str, BogieAbsorber | None]:
    """Absorbers by name: none, the line's and those that the searches found."""
    columns = (robust_tuning[name] for name in ("design", "I_T", "c_T", "d_T"))
    found: dict[str, BogieAbsorber | None] = {"none": None}
    for name, inertia, c_T, d_T in zip(*columns, strict=True):
        if np.isfinite(c_T):
            design = absorber_of(line, c_T, d_T)
            found[str(name)] = design.model_copy(update={"I_T": float(inertia)})
    return found


def laws_of(cfg: Mapping[str, Any]) -> dict[str, Wearing]:
    """Laws of wear by name, for all wheels."""
    chart, grid = chart_of(cfg), wear_grid(cfg)
    return {
        name: Wearing(chart._replace(method=number), grid, WHEELS)
        for name, number in METHODS.items()
    }


def _of_wheels(values: np.ndarray, case: Case, axis: int) -> np.ndarray:
    """Values of the places of the bogie, for the wheels that run there in a case."""
    return np.take(values, places_of_wheels(case.turn, case.leading), axis=axis)


def _revolutions(lap: Lap, case: Case, runs: Sequence[ClassRun]) -> np.ndarray:
    """Revolutions (speeds, wheels) in 1000 km of the route."""
    run = runs[case.running]
    per_metre = run.spin() / (2.0 * np.pi * run.speed[:, None])
    share = sum(lap.shares(case)) * run.points.weight[:, None]
    return PER_1000_KM * share * _of_wheels(per_metre, case, axis=1)


def _scales(
    cfg: Mapping[str, Any], frame: Mapping[str, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Measured wear over that of each law: scale of the tread, and flange over tread.

    The mean of the wheels counts: over the life of a tram they change places. NaN where a class
    of the route has no steady running.
    """
    revolutions, depth = frame["revolutions_per_1000_km"], frame["mean_wear_depth"]
    of_law = np.einsum("cpw,lcswp->ls", revolutions, depth) / len(OWN_WHEELS)
    measured = cfg["route"]["measured_wear"]
    tread = 1e-4 * measured["tread_mm_per_10000_km"]  # m per 1000 km
    scale = tread / of_law[:, 0]
    if measured["flange_mm_per_10000_km"] is None:
        return scale, np.ones_like(scale)
    flange = 1e-4 * measured["flange_mm_per_10000_km"] / of_law[:, 1]
    return scale, flange / scale


def _cases(line: BogieLine, lap: Lap) -> dict[str, np.ndarray]:
    """Conditions and shares of the distance of the cases."""
    cases = lap.cases()
    classes = [lap.classes[case.running] for case in cases]
    shares = np.array([lap.shares(case) for case in cases])
    curvature = np.array([one.curvature for one in classes])
    friction = np.array([one.friction for one in classes])
    return {
        "class": np.array([case_name(case, lap.classes[case.running]) for case in cases]),
        "radius": 1.0 / np.where(curvature > 0.0, curvature, np.nan),
        "turn": np.array([case.turn for case in cases]),
        "leading": np.array([case.leading for case in cases]),
        "cant": np.array([one.cant for one in classes]),
        "mean_speed": np.array([one.speed for one in classes]),
        "speed_scatter": np.array([one.scatter for one in classes]),
        "mean_friction": np.where(np.isfinite(friction), friction, line.friction[0]),
        "flange_wear_share": np.array([one.flange_wear_share for one in classes]),
        "distance_share": shares.sum(axis=1),
        "section": np.array([section.name for section in lap.sections]),
        "section_share": shares.T,
    }


def _designs(designs: Mapping[str, BogieAbsorber | None]) -> dict[str, np.ndarray]:
    return {
        "absorber": np.array(list(designs)),
        **{
            name: np.array([getattr(design, own, np.nan) for design in designs.values()])
            for name, own in (("m_T", "I_T"), ("c_T", "c_T"), ("d_T", "d_T"))
        },
    }
