"""The stage `polygon_simulation`: a wheel that wears on, all orders at once."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from tramdva.bogie.names import WHEELS
from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.revolutions import Settings, hindrance
from tramdva.bogie.rough_vehicle import rough_bogie
from tramdva.bogie.tram import BogieLine
from tramdva.contact import patch
from tramdva.evolution.out_of_roundness import level, radius_deviation
from tramdva.evolution.tendency import Wearing, wear_sensitivity
from tramdva.route.classes import OWN_WHEELS, RunningClass
from tramdva.route.growth import (
    distance_to_limit,
    grown,
    initial_amplitudes,
    peak_to_peak,
)
from tramdva.route.nonlinear import WearingWheel, revolution
from tramdva.route.own_response import own_response, spins
from tramdva.route.parameters import InitialSpectrum
from tramdva.route.response import FLANGE_ANGLE, at_speed, steady, with_absorbers
from tramdva.route.saturation import describing, saturating, saturation_amplitude
from tramdva.route.scaling import Case
from tramdva.route.wearing_on import Bounds, WornOn, own_rates, step_at, wear_on
from tramdva.stages.bogie_sections import bogie_line, quiet_bogie_line
from tramdva.stages.route_sections import Lap, lap_of, route_orders
from tramdva.stages.wear_sections import chart_of, wear_grid
from tramdva.variables.polygon_simulation import ORDER_KINDS, VARIABLES
from tramdva.wear.laws import with_method

__all__ = ["VARIABLES", "compute"]

SIMULATED = ("none", "paper")  # absorbers
ANGLES = 1440  # points of a told profile
EXAMINED = 8  # largest orders that are told apart
LARGE = 0.05  # of the largest: smaller ones are not
SMALL = 0.1  # of the first amplitude of the describing function: waves that count as small


class Place(NamedTuple):
    """Where the fastest order grows most.

    case : place among the classes of the file; wheel : of `OWN_WHEELS`; speed : m/s
    """

    case: int
    wheel: int
    speed: float


class Wheel(NamedTuple):
    """A wheel in its condition with an absorber.

    running : WearingWheel, None without steady running
    small : (o,) complex, response of small waves
    status : converged, or why it does not run
    """

    running: WearingWheel | None
    small: np.ndarray
    status: str


def compute(
    cfg: Mapping[str, Any],
    contact_geometry: Mapping[str, np.ndarray],
    route_response: Mapping[str, np.ndarray],
    file_of: Callable[[str], Any] = str,
) -> dict[str, np.ndarray]:
    """Wear a wheel on in the condition and at the speed that let the fastest order grow most.

    Parameters
    ----------
    cfg : sections of the bogie, ``creep_force.B``, ``wear``, ``route``, ``numerics``
    contact_geometry, route_response : variables of these files
    file_of : where a file lies that the configuration names: a table of sections

    Returns
    -------
    Variables of ``polygon_simulation``.
    """
    given, lap = route_response, lap_of(cfg, file_of)
    law = list(given["wear_law"]).index(cfg["route"]["wear_law"])
    place = fastest_place(given, law)
    line, excited = quiet_bogie_line(cfg, contact_geometry), bogie_line(cfg, contact_geometry)
    chosen = [
        list(given["absorber"]).index(name) for name in SIMULATED if name in given["absorber"]
    ]
    designs = [_design(line, given, k) for k in chosen]
    rows = []
    for design in designs:
        wheel = _wheel(cfg, line, lap, place, design, float(given["flange_wear_ratio"][law]))
        scale = float(given["wear_scale"][law])
        rows.append(_row(cfg, wheel, place, scale))
    case = lap.cases()[place.case]
    operating = [_in_operation(excited, lap, case, place, design) for design in designs]
    return {
        **{name: given[name][chosen] for name in ("absorber", "m_T", "c_T", "d_T")},
        **_condition(given, lap, place),
        **{name: np.array([row[name] for row in rows]) for name in rows[0]},
        "wear_law": np.array(cfg["route"]["wear_law"]),
        "wear_scale": np.float64(given["wear_scale"][law]),
        "order": route_orders(cfg).astype(float),
        "limit": np.float64(_limit(cfg)),
        "angle": _angles(),
        "wave_amplitude": np.array(cfg["numerics"]["wave_amplitudes"]),
        "friction_decrease": np.float64(line.friction[2]),
        "self_excited_in_operation": np.array(operating),
    }


def fastest_place(given: Mapping[str, np.ndarray], law: int) -> Place:
    """Class, speed and wheel that let the fastest order grow most, without absorbers.

    Parameters
    ----------
    given : variables of ``route_response``; law : place among its laws of wear

    Notes
    -----
    Speeds count by their share of the passages. A class without steady running counts as none.
    """
    bare = list(given["absorber"]).index("none")
    response = given["wear_response_real"][law, :, bare]  # class, wheel, order, speed
    rate = -np.einsum("cpw,cwop->wocp", given["revolutions_per_1000_km"], response)
    rate = np.where(np.isfinite(rate), rate, 0.0)
    growth = rate.sum(axis=(2, 3))
    wheel, order = np.unravel_index(growth.argmax(), growth.shape)
    case, point = np.unravel_index(rate[wheel, order].argmax(), rate.shape[2:])
    return Place(int(case), int(wheel), float(given["speed"][case, point]))


def _limit(cfg: Mapping[str, Any]) -> float:
    return 1e-3 * cfg["route"]["turning"]["peak_to_peak_mm"]


def _angles() -> np.ndarray:
    return 2.0 * np.pi * np.arange(ANGLES) / ANGLES


def _condition(given: Mapping[str, np.ndarray], lap: Lap, place: Place) -> dict[str, Any]:
    case = lap.cases()[place.case]
    there = case.places[place.wheel]
    return {
        "condition": np.array(str(given["class"][place.case])),
        "radius": np.float64(given["radius"][place.case]),
        "speed": np.float64(place.speed),
        "wheel": np.array(OWN_WHEELS[place.wheel]),
        "place": np.array(WHEELS[there]),
        "distance_share": np.float64(given["distance_share"][place.case]),
    }


def _design(line: BogieLine, given: Mapping[str, np.ndarray], k: int) -> BogieAbsorber | None:
    if not np.isfinite(given["c_T"][k]):
        return None
    of_file = {"I_T": "m_T", "c_T": "c_T", "d_T": "d_T"}
    values = {name: float(given[column][k]) for name, column in of_file.items()}
    return line.bogie.absorber.model_copy(update=values)


def _steady(line: BogieLine, running: RunningClass, speed: float, design: BogieAbsorber | None):
    """Steady running in a class at a speed with an absorber."""
    known = steady(line, running)
    if speed != running.speed and known.equilibrium.status == "converged":
        known = at_speed(known, running, speed)
    if design is None or known.equilibrium.status != "converged":
        return known
    return with_absorbers(known, running, design)


def _wheel(
    cfg: Mapping[str, Any],
    line: BogieLine,
    lap: Lap,
    place: Place,
    design: BogieAbsorber | None,
    flange_ratio: float,
) -> Wheel:
    """The wheel in its condition, and what it answers to small waves."""
    case, orders = lap.cases()[place.case], route_orders(cfg)
    running = lap.classes[case.running]
    unknown = np.full(orders.size, np.nan + 0j)
    run = _steady(line, running, place.speed, design)
    if run.equilibrium.status != "converged":
        return Wheel(None, unknown, "no_equilibrium")
    bogie = rough_bogie(run.system, run.equilibrium)
    if why := hindrance(bogie, converged=True):
        return Wheel(None, unknown, why)
    at = case.places[place.wheel]
    chart = with_method(chart_of(cfg), cfg["route"]["wear_law"])
    share = _zone_share(bogie, at, flange_ratio * running.flange_wear_share)
    contacts, grid = run.system.contacts, wear_grid(cfg)
    wear = wear_sensitivity(bogie, contacts.law, Wearing(chart, grid, (WHEELS[at],)))
    of_zone = np.ones_like(wear.area)
    of_zone[at] = share
    wear = wear._replace(area=wear.area * of_zone, gradient=wear.gradient * of_zone[..., None])
    spin = float(spins(run.system, run.equilibrium.state)[at])
    small = own_response(bogie, [wear], at, spin).at(orders, orders * spin)[0]
    numerics = cfg["numerics"]
    settings = Settings(
        numerics["samples"], 1, numerics["longest_transient"], numerics["tolerance"],
        numerics["step_tolerance"],
    )  # fmt: skip
    wheel = WearingWheel(contacts, bogie, at, spin, chart, grid, share, settings)
    return Wheel(wheel, small, "converged")


def _zone_share(bogie, wheel: int, flange_share: float) -> np.ndarray:
    """By which the zones of a wheel wear more than the law says; the last one is a flange's."""
    angle = np.abs(bogie.results[wheel, :, patch.CONTACT_ANGLE])
    is_flange = np.where(bogie.touching[wheel], angle > FLANGE_ANGLE, np.arange(angle.size) > 0)
    return np.where(is_flange, flange_share, 1.0)


def _in_operation(
    line: BogieLine, lap: Lap, case: Case, place: Place, design: BogieAbsorber | None
) -> str:
    """Whether the vehicle vibrates by itself there at the friction of operation."""
    run = _steady(line, lap.classes[case.running], place.speed, design)
    if run.equilibrium.status != "converged":
        return "no_equilibrium"
    return hindrance(rough_bogie(run.system, run.equilibrium), converged=True) or "stable"


def _row(cfg: Mapping[str, Any], wheel: Wheel, place: Place, scale: float) -> dict[str, Any]:
    """Variables of an absorber."""
    if wheel.running is None or not np.isfinite(scale):
        return _nothing(cfg, wheel)
    orders, running = route_orders(cfg), wheel.running
    initial = initial_amplitudes(
        orders.astype(float), InitialSpectrum.model_validate(cfg["route"]["initial"])
    )
    per_km = 1e3 * running.spin / (2.0 * np.pi * place.speed)
    numerics, horizon = cfg["numerics"], cfg["route"]["horizon_km"]
    bounds = Bounds(
        horizon * per_km * scale, _limit(cfg), numerics["growth_tolerance"], numerics["most_steps"]
    )
    run = wear_on(running, orders, initial, wheel.small, bounds)
    u = np.linspace(0.0, run.end, numerics["points"])
    distance, waves = u / (per_km * scale), run.at(u)
    growth = -1e3 * per_km * scale * wheel.small
    straight = distance_to_limit(orders.astype(float), initial, growth, _limit(cfg), horizon)
    return {
        "spin": running.spin,
        "revolutions_per_km": per_km,
        "small_response_real": wheel.small.real,
        "small_response_imag": wheel.small.imag,
        "distance": distance,
        "amplitude_real": waves.real,
        "amplitude_imag": waves.imag,
        "level": level(waves),
        "small_wave_level": level(grown(initial, growth, distance)),
        "peak_to_peak": peak_to_peak(orders, waves),
        "mean_wear": run.mean_depth(u),
        "distance_to_limit": run.reaches(_limit(cfg)) / (per_km * scale),
        "small_wave_distance_to_limit": straight.km,
        "distance_to_lifting": run.lifts_from() / (per_km * scale),
        "last_profile": radius_deviation(orders, run.steps[-1].amplitude, _angles()),
        **_told_apart(wheel, orders, run, per_km * scale),
        **_described(cfg, wheel, initial, distance, per_km * scale),
        "status": run.status,
        "evaluations": float(run.evaluations),
    }


def _told_apart(wheel: Wheel, orders: np.ndarray, run: WornOn, per_km: float) -> dict[str, Any]:
    """Orders that grow by themselves, and those that others drive.

    It is told where the order that gained most has half of its last amplitude.
    """
    u = np.linspace(0.0, run.end, 201)
    size = np.abs(run.at(u))
    most = int((size[-1] - size[0]).argmax())
    u = float(u[np.argmax(size[:, most] >= 0.5 * size[-1, most])])
    state = np.zeros(2 * wheel.running.bogie.eigenvalue.size)

    def worn(amplitude: np.ndarray):
        return revolution(wheel.running, orders, amplitude, state)

    now = step_at(worn, run, u, wheel.small)
    size = np.abs(now.amplitude)
    largest = np.argsort(-size)[:EXAMINED]
    total, own = own_rates(worn, now, largest[size[largest] >= LARGE * size.max()])
    kind = np.full(orders.size, ORDER_KINDS[3], dtype="<U20")
    known = np.isfinite(total.real) & np.isfinite(own.real)
    kind[known] = ORDER_KINDS[2]
    kind[known & (total.real > 0.0)] = ORDER_KINDS[1]
    kind[known & (total.real > 0.0) & (own.real >= 0.5 * total.real)] = ORDER_KINDS[0]
    return {
        "examined_distance": now.u / per_km,
        "growth_per_1000_km": 1e3 * per_km * total.real,
        "own_growth_per_1000_km": 1e3 * per_km * own.real,
        "order_kind": kind,
    }


def _described(
    cfg: Mapping[str, Any], wheel: Wheel, initial: np.ndarray, distance: np.ndarray, per_km: float
) -> dict[str, Any]:
    """Describing function of the orders that grow fastest, and their levels by it."""
    orders, sizes = route_orders(cfg), np.array(cfg["numerics"]["wave_amplitudes"])
    place = np.sort(np.argsort(wheel.small.real)[: cfg["numerics"]["described_orders"]])
    table = describing(wheel.running, orders[place], sizes)
    small = wheel.small[place]
    rate = -per_km * np.column_stack([small, table.response])
    by_itself = saturating(initial[place], distance, np.append(SMALL * sizes[0], sizes), rate)
    return {
        "described_order": orders[place].astype(float),
        "described_level": level(by_itself),
        "described_response_real": table.response.real,
        "described_response_imag": table.response.imag,
        "harmonics": table.harmonics,
        "described_status": table.status,
        "saturation_amplitude": saturation_amplitude(table, small),
    }


def _nothing(cfg: Mapping[str, Any], wheel: Wheel) -> dict[str, Any]:
    """Variables of an absorber with which the wheel does not run steadily."""
    numerics, orders = cfg["numerics"], route_orders(cfg).size
    points, sizes = numerics["points"], len(numerics["wave_amplitudes"])
    described = min(numerics["described_orders"], orders)
    status = "no_equilibrium" if wheel.status == "converged" else wheel.status
    shapes: dict[str, tuple[int, ...]] = {
        **dict.fromkeys(
            ("spin", "revolutions_per_km", "distance_to_limit", "small_wave_distance_to_limit",
             "distance_to_lifting", "examined_distance", "evaluations"), ()
        ),
        **dict.fromkeys(
            ("small_response_real", "small_response_imag", "growth_per_1000_km",
             "own_growth_per_1000_km"), (orders,)
        ),
        **dict.fromkeys(("distance", "peak_to_peak", "mean_wear"), (points,)),
        **dict.fromkeys(
            ("amplitude_real", "amplitude_imag", "level", "small_wave_level"), (points, orders)
        ),
        "last_profile": (ANGLES,),
        **dict.fromkeys(("described_order", "saturation_amplitude"), (described,)),
        "described_level": (points, described),
        **dict.fromkeys(
            ("described_response_real", "described_response_imag", "harmonics"),
            (described, sizes),
        ),
    }  # fmt: skip
    return {
        **{name: np.full(shape, np.nan) for name, shape in shapes.items()},
        "order_kind": np.full(orders, ORDER_KINDS[3]),
        "described_status": np.full((described, sizes), status),
        "status": status,
    }
