"""The absorber that buys the most kilometres on a route, under the limits of its material.

Ranked by the distance at which the wheel that is first has the energy of one wave of the limit's
height: without the chance of phases that makes the peak to peak value jump. The distances that are
told of a design come from `growth`.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from tramdva.route.any_absorber import ClassPorts
from tramdva.route.parameters import Material

ROUNDS = (0.5, 0.1)  # of the grid's step: first simplex of each search
EVALUATIONS = 40  # of each search
LOSS_FACTORS = 5  # among which a search starts
TEMPERATURES = ("cold", "nominal", "hot")


class Fleet(NamedTuple):
    """Classes of a route with the wheels that meet them.

    classes : ClassPorts; cases : (class, places of the own wheels, share of the class's distance)
    scale : of the wear
    initial : (o,) m, amplitudes of a turned wheel
    limit : m, peak to peak; horizon : km
    """

    classes: Sequence[ClassPorts]
    cases: Sequence[tuple[int, list[int], float]]
    scale: float
    initial: np.ndarray
    limit: float
    horizon: float

    def growth(self, inertia: float, c_T: float, d_T: float) -> np.ndarray:
        """Growth (wheels, orders) in 1000 km of the wheels of the vehicle, SI design."""
        of_class = [one.growth(inertia, c_T, d_T) for one in self.classes]
        return self.scale * sum(
            share * of_class[running][places] for running, places, share in self.cases
        )

    def distance(self, inertia: float, c_T: float, d_T: float) -> float:
        """Kilometres until the first wheel has the energy of the limit, `energy_distance`."""
        return min(
            energy_distance(np.abs(self.initial), one, self.limit, self.horizon)
            for one in self.growth(inertia, c_T, d_T)
        )

    def quiet(self, inertia: float, c_T: float, d_T: float, friction: int) -> bool:
        """Whether no class vibrates by itself at the forced (0) or the operating (1) friction."""
        return all(one.rate(inertia, c_T, d_T, friction) < 0.0 for one in self.classes)


def energy_distance(initial: np.ndarray, growth: np.ndarray, limit: float, horizon: float) -> float:
    """Distance in km at which waves together have the energy of one of a given height.

    Parameters
    ----------
    initial : (o,) amplitudes in m; growth : (o,) per 1000 km
    limit : m, peak to peak of the one wave
    horizon : km; a wheel that gets further is told by how little it grows: beyond ten horizons at
        most
    """
    wanted = 2.0 * np.log(0.5 * limit)
    start = 2.0 * np.log(initial)
    rate = 2.0 * growth / 1000.0

    def excess(km: float) -> float:
        return float(np.logaddexp.reduce(start + rate * km)) - wanted

    if excess(0.0) >= 0.0:
        return 0.0
    far = 10.0 * horizon
    if excess(far) < 0.0:
        return far
    from scipy.optimize import brentq  # slow to load

    return float(brentq(excess, 0.0, far, rtol=1e-6))


class Design(NamedTuple):
    """A design and how it was found.

    distance : km, of its worst temperature; quiet : whether it is quiet in operation
    """

    c_T: float
    d_T: float
    distance: float
    quiet: bool


def damping(inertia: float, c_T: float, loss_factor: float) -> float:
    """Damping of a rubber of a loss factor at the own frequency of its absorber, SI."""
    return loss_factor * np.sqrt(c_T * inertia)


def at_temperatures(
    inertia: float, c_T: float, loss_factor: float, material: Material
) -> np.ndarray:
    """Stiffness and damping (3, 2) of an absorber of a material at `TEMPERATURES`."""
    shares = (
        (material.stiffness_cold, material.loss_cold), (1.0, 1.0),
        (material.stiffness_hot, material.loss_hot),
    )  # fmt: skip
    return np.array(
        [(c_T * k, damping(inertia, c_T * k, loss_factor * loss)) for k, loss in shares]
    )


def best_of_material(
    fleet: Fleet,
    inertia: float,
    stiffness: np.ndarray,
    material: Material,
    near: Design | None = None,
) -> Design:
    """Design of a material with the longest distance at its worst temperature.

    Parameters
    ----------
    fleet : Fleet
    inertia : kg m^2 or kg
    stiffness : (k,) rising, in equal ratios; its ends bound the design
    material : Material
    near : a design among those with which the search may begin, beside a grid

    Notes
    -----
    Designs that vibrate by themselves in operation are passed over; where all do, those that do so
    at the friction of forced excitation, and the design tells that it is not quiet.
    """
    loss = np.geomspace(material.loss_factor_min, material.loss_factor_max, LOSS_FACTORS)

    def aim(place: np.ndarray) -> float:
        c_T, eta = np.exp(place)
        return min(fleet.distance(inertia, *one) for one in at_temperatures(inertia, c_T, eta,
                                                                           material))  # fmt: skip

    def quiet(place: np.ndarray, friction: int) -> bool:
        c_T, eta = np.exp(place)
        designs = at_temperatures(inertia, c_T, eta, material)
        return all(fleet.quiet(inertia, *one, friction) for one in designs)

    places = [np.array([c, eta]) for c in np.log(stiffness) for eta in np.log(loss)]
    if near is not None and np.isfinite(near.c_T):
        places.append(np.log([near.c_T, near.d_T / np.sqrt(near.c_T * inertia)]))
    ranked = sorted(places, key=aim, reverse=True)
    for friction in (1, 0):
        start = next((place for place in ranked if quiet(place, friction)), None)
        if start is not None:
            break
    else:
        return Design(np.nan, np.nan, np.nan, quiet=False)
    step = np.array([np.log(stiffness[1] / stiffness[0]), max(np.log(loss[1] / loss[0]), 1e-3)])
    bounds = [np.log(stiffness[[0, -1]]), np.log(loss[[0, -1]])]
    found = _climbed(aim, lambda place: quiet(place, friction), start, step, bounds)
    c_T, eta = np.exp(found)
    return Design(float(c_T), float(damping(inertia, c_T, eta)), aim(found), quiet=friction == 1)


def _climbed(
    aim: Callable[[np.ndarray], float],
    allowed: Callable[[np.ndarray], bool],
    start: np.ndarray,
    step: np.ndarray,
    bounds: Sequence[np.ndarray],
) -> np.ndarray:
    """Nelder and Mead's way up from an allowed place; a new simplex frees one that is flat."""
    from scipy.optimize import minimize  # slow to load

    best, place = aim(start), start

    def cost(x: np.ndarray) -> float:
        nonlocal best, place
        value = aim(x)
        if value > best and allowed(x):
            best, place = value, x.copy()
        return -value if value <= best else np.inf

    for size in ROUNDS:
        inward = np.where(place + size * step > [b[1] for b in bounds], -size, size) * step
        minimize(
            cost,
            place,
            method="Nelder-Mead",
            bounds=[tuple(b) for b in bounds],
            options={
                "initial_simplex": place + np.vstack([np.zeros(2), np.diag(inward)]),
                "xatol": 1e-4,
                "fatol": 1e-3,
                "maxfev": EVALUATIONS,
            },
        )
    return place
