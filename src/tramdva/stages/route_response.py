"""The stage `route_response`: wear of the wheels by their own waves on the route."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.tram import BogieLine
from tramdva.route.classes import OWN_WHEELS
from tramdva.route.parameters import MeasuredWear
from tramdva.route.response import SURFACES, own_wear, run_classes
from tramdva.route.scaling import depths, revolutions, scales
from tramdva.route.speeds import halved
from tramdva.stages.bogie_sections import quiet_bogie_line
from tramdva.stages.route_designs import designs_of
from tramdva.stages.route_sections import Lap, case_name, lap_of, route_orders
from tramdva.stages.route_wear import wearing_of_all
from tramdva.variables.route_response import VARIABLES
from tramdva.wear.laws import LAWS

__all__ = ["VARIABLES", "compute"]


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    robust_tuning: Mapping[str, np.ndarray],
    route_tuning: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Wear response of every wheel of the vehicle to its own waves in each condition of the route.

    Parameters
    ----------
    cfg : sections of the bogie, ``wear``, ``route``, ``numerics``
    contact_geometry, robust_tuning, route_tuning : variables of these files; the last two name
        the designs
    file_of : where a file lies that the configuration names: a table of sections

    Returns
    -------
    Variables of ``route_response``.
    """
    line, lap = quiet_bogie_line(cfg, contact_geometry), lap_of(cfg, file_of)
    designs, laws = (
        designs_of(line, robust_tuning, route_tuning),
        {name: wearing_of_all(cfg, name) for name in LAWS},
    )
    numerics = cfg["numerics"]
    orders = route_orders(cfg)
    runs = run_classes(
        line, lap.classes, designs, list(laws.values()), numerics["most_speed_points"]
    )
    cases = lap.cases()
    of_case = [runs[case.running] for case in cases]
    pairs = list(zip(of_case, cases, strict=True))
    frame = {
        "speed": np.array([run.speed for run in of_case]),
        "speed_weight": np.array([run.points.weight for run in of_case]),
        "coarse_speed_weight": np.array([halved(run.points) for run in of_case]),
        "revolutions_per_1000_km": np.array([revolutions(*pair) for pair in pairs]),
        "mean_wear_depth": np.stack([depths(*pair, len(laws)) for pair in pairs], axis=1),
    }
    measured = MeasuredWear.model_validate(cfg["route"]["measured_wear"])
    scale, ratio = scales(runs, cases, len(laws), measured)
    answers = [np.array([own_wear(run, name, orders, ratio) for name in designs]) for run in runs]
    response = np.stack(
        [answers[case.running][:, :, case.places] for case in cases], axis=2
    )  # absorber, law, class, wheel, order, speed
    response = np.moveaxis(response, 0, 2)
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
