"""What an absorber leaves of the growth of wheel orders, and the absorber that leaves least.

In a case, the factor of an absorber in the band of design is

    factor = largest tendency with it on any wheel / reference,

the reference being the largest tendency without absorbers on any wheel, of this case or of the
line as configured, whichever is larger: a case in which little grows anyway cannot decide, nor a
wheel that hardly wears. The nominal optimum minimises the factor of the line as configured, the
robust one the largest factor of all cases and of the absorber's own ranges.
"""

import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from tramdva.bogie import absorber_ports
from tramdva.bogie.absorber_ports import PortModes
from tramdva.robustness.sample import stored_ports

Design = tuple[float, float]
Shares = tuple[Any, Any]

_ROUNDS = 8  # of the search, each with the cases in which the design before was self-excited
_COARSE = 5  # designs per axis among which one without self-excitation is sought
_SCAN = 41  # designs of a line on which the end of a tolerance is sought
_NEAREST = 20  # cases in which self-excitation is looked for there


class Fleet(NamedTuple):
    """The cases that have an equilibrium, as the absorbers see them.

    case : (s,) rows in the sample, the line as configured first
    bare : (s, f, wheels) complex wear response without absorbers; bare_place : (s, f, 4), of theirs
    modes : PortModes (s, f, ...); frequency : (s, f) Hz; inertia : kg m^2 or kg
    steady : (s,) whether the bogie without absorbers is not self-excited at the forced friction
    """

    case: np.ndarray
    bare: np.ndarray
    bare_place: np.ndarray
    modes: PortModes
    frequency: np.ndarray
    inertia: float
    steady: np.ndarray

    def tendency(self, design: Design | None, shares: Shares = (1.0, 1.0)) -> np.ndarray:
        """Evolution tendency (s, f, wheels): -Re H; shares of c_T and d_T are (s,) or numbers."""
        if design is None:
            return -self.bare.real
        c_T, d_T = (
            value * np.reshape(share, (-1, 1)) for value, share in zip(design, shares, strict=True)
        )
        return -self.modes.response(self.inertia, c_T, d_T).real

    def largest(self, design: Design | None, shares: Shares = (1.0, 1.0)) -> np.ndarray:
        """Largest tendency (s, wheels) over the frequencies."""
        return self.tendency(design, shares).max(axis=1)

    def within(self, low: np.ndarray, high: np.ndarray) -> "Fleet":
        """Only the frequencies of each case between limits (s,) in Hz; the last is repeated."""
        inside = (self.frequency >= low[:, None]) & (self.frequency <= high[:, None])
        count = inside.sum(axis=1)
        last = np.maximum(count - 1, 0)[:, None]
        place = inside.argmax(axis=1)[:, None] + np.minimum(np.arange(max(count.max(), 1)), last)
        rows = np.arange(len(place))[:, None]
        at = (rows, place)
        return self._replace(
            bare=self.bare[at],
            bare_place=self.bare_place[at],
            modes=self.modes.at(at),
            frequency=self.frequency[at],
        )

    def only(self, rows: ArrayLike) -> "Fleet":
        """Some of the cases."""
        return Fleet(
            self.case[rows],
            self.bare[rows],
            self.bare_place[rows],
            self.modes.at(rows),
            self.frequency[rows],
            self.inertia,
            self.steady[rows],
        )


def fleet(sample: Mapping[str, np.ndarray], inertia: float) -> Fleet:
    """All cases of a sample that have an equilibrium."""
    case = np.flatnonzero(sample["status"] == "converged")
    found = stored_ports(sample)
    ports = found.ports
    modes = absorber_ports.port_modes(type(ports)(*(values[case] for values in ports)))
    steady = sample["bare_growth_rate"][case, 0] < 0.0
    alone = found.without_absorbers[case], found.place_without[case]
    return Fleet(case, *alone, modes, sample["frequency"][case], inertia, steady)


def references(bare: np.ndarray, steady: np.ndarray) -> np.ndarray:
    """Growth (s,) to which that with absorbers is compared; NaN where none grows at all.

    Parameters
    ----------
    bare : (s, wheels) largest tendency without absorbers, the line as configured first
    steady : (s,) whether it has a meaning: a self-excited bogie answers no wave steadily

    Notes
    -----
    Where nothing grows on the line as configured, the largest of the cases takes its place.
    """
    usable = np.where(steady, bare.max(axis=1), -np.inf)
    own = usable[0] if usable[0] > 0.0 else usable.max()
    return np.maximum(usable, own) if own > 0.0 else np.full(len(usable), np.nan)


class Criterion(NamedTuple):
    """The factor of designs in some cases.

    fleet : Fleet in the band of design; reference : (s,)
    counted : (s,) whether a case counts: some absorber can keep it from vibrating by itself
    corners : shares of stiffness and damping that are tried, the absorber's own first
    growth : growth rate (1/s) of a case with a design at the operating friction
    """

    fleet: Fleet
    reference: np.ndarray
    counted: np.ndarray
    corners: tuple[Shares, ...]
    growth: Callable[[int, Design], float]

    @property
    def grows(self) -> bool:
        """Whether anything grows without absorbers in any case."""
        return bool(np.isfinite(self.reference).any())

    def factors(self, design: Design | None, shares: Shares = (1.0, 1.0)) -> np.ndarray:
        """Factor (s,) of a design."""
        return self.fleet.largest(design, shares).max(axis=1) / self.reference

    def by_case(self, design: Design) -> np.ndarray:
        """Largest factor (s,) over the corners."""
        return np.max([self.factors(design, corner) for corner in self.corners], axis=0)

    def worst(self, design: Design) -> float:
        """Largest factor over the cases that count and the corners."""
        return float(self.by_case(design)[self.counted].max())

    def self_excited(self, row: int, design: Design, corners: Sequence[Shares]) -> bool:
        """Whether a case vibrates by itself with a design at any corner."""
        case = int(self.fleet.case[row])
        return any(self.growth(case, (design[0] * c, design[1] * d)) >= 0.0 for c, d in corners)

    def violated(self, design: Design, suspects: Sequence[int]) -> list[int]:
        """Cases that vibrate by themselves; suspects are looked at in all corners."""
        return [
            row
            for row in np.flatnonzero(self.counted)
            if self.self_excited(row, design, self.corners if row in suspects else self.corners[:1])
        ]


class Optimum(NamedTuple):
    """Best design with its factor, and how the search ended; counted as in `Criterion`."""

    design: Design
    factor: float
    status: str
    counted: np.ndarray


def optimum(
    criterion: Criterion, c_T: np.ndarray, d_T: np.ndarray, suspects: Sequence[int]
) -> tuple[Optimum, np.ndarray]:
    """Design of the smallest worst factor that leaves no case self-excited; and the grid's factors.

    Parameters
    ----------
    criterion : Criterion
    c_T, d_T : (m,) grid, rising; its ends bound the design
    suspects : rows that are self-excited without absorbers

    Notes
    -----
    Stability is asked by cutting planes: a case in which the design found vibrates by itself joins
    those that are watched in the next search. One in which every design of a coarse grid does so
    counts no longer: no absorber helps there, and the response to waves has no meaning.
    """
    missing = (np.nan, np.nan)
    if not criterion.grows:
        nothing = Optimum(missing, np.nan, "nothing_grows", criterion.counted)
        return nothing, np.full((d_T.size, c_T.size), np.nan)
    coarse = [
        (float(c), float(d))
        for c in np.linspace(c_T[0], c_T[-1], _COARSE)
        for d in np.linspace(d_T[0], d_T[-1], _COARSE)
    ]
    by_case = np.array([[criterion.by_case((c, d)) for c in c_T] for d in d_T])
    watched: list[int] = []
    best = None
    for _ in range(_ROUNDS):
        grid = by_case[..., criterion.counted].max(axis=-1, initial=-np.inf)
        if not criterion.counted.any():
            break
        best = _searched(criterion, grid, c_T, d_T, watched)
        found = criterion.violated(best.design, suspects) if best else []
        if best and not found:
            return best, grid
        lost = [
            row
            for row in (found or watched)
            if all(criterion.self_excited(row, design, criterion.corners) for design in coarse)
        ]
        watched += [row for row in found if row not in lost and row not in watched]
        if not best and not lost:
            break
        if lost:
            watched = [row for row in watched if row not in lost]
            counted = criterion.counted.copy()
            counted[lost] = False
            criterion = criterion._replace(counted=counted)
    grid = np.where(np.isfinite(grid), grid, np.nan)
    if best is None:
        best = Optimum(missing, np.nan, "self_excited", criterion.counted)
    return best._replace(status="self_excited"), grid


def _searched(
    criterion: Criterion, grid: np.ndarray, c_T, d_T, watched: Sequence[int]
) -> Optimum | None:
    """Nelder and Mead's method from the best design of the grid that keeps the watched quiet."""
    from scipy.optimize import minimize  # slow to load

    def quiet(design: Design) -> bool:
        return not any(criterion.self_excited(row, design, criterion.corners) for row in watched)

    order = np.argsort(grid, axis=None, kind="stable")
    listed = zip(*np.unravel_index(order, grid.shape), strict=True)
    start = next((p for p in listed if quiet((c_T[p[1]], d_T[p[0]]))), None)
    if start is None:
        return None
    scale = np.array([c_T[-1], d_T[-1]])
    best = [np.inf]

    def aim(x: np.ndarray) -> float:
        design = float(x[0] * scale[0]), float(x[1] * scale[1])
        factor = criterion.worst(design)
        if factor >= best[0]:
            return factor  # no better, quiet or not
        if not quiet(design):
            return np.inf
        best[0] = factor
        return factor

    bounds = [(c_T[0] / scale[0], 1.0), (d_T[0] / scale[1], 1.0)]
    step = np.array([c_T[1] - c_T[0], d_T[1] - d_T[0]]) / scale
    place = np.array([c_T[start[1]], d_T[start[0]]]) / scale
    for size in (0.5, 0.1, 0.02):  # a new start frees a simplex that has become flat
        inward = np.where(place + size * step > 1.0, -size, size) * step
        best[0] = np.inf
        found = minimize(
            aim,
            place,
            method="Nelder-Mead",
            bounds=bounds,
            options={
                "initial_simplex": place + np.vstack([np.zeros(2), np.diag(inward)]),
                "xatol": 1e-5,
                "fatol": 1e-6,
                "maxfev": 150,
            },
        )
        place = found.x
    design = (float(place[0] * scale[0]), float(place[1] * scale[1]))
    return Optimum(design, float(found.fun), "converged", criterion.counted)


def tolerance(
    criterion: Criterion,
    best: Optimum,
    share: float,
    c_T: np.ndarray,
    d_T: np.ndarray,
    suspects: Sequence[int],
) -> np.ndarray:
    """Interval (2, 2) of c_T and of d_T alone in which the factor is at most 1 + share of the best.

    And in which no case that counts becomes self-excited, the absorber's own ranges left out: of
    the suspects, the `_NEAREST` with the largest growth rates are looked at. NaN where the
    interval does not end within the grid.
    """
    out = np.full((2, 2), np.nan)
    if not np.isfinite(best.factor):
        return out
    allowed = best.factor + share * abs(best.factor)
    own = criterion.corners[:1]
    rates = {
        row: criterion.growth(int(criterion.fleet.case[row]), best.design)
        for row in suspects
        if criterion.counted[row]
    }
    # A case that is self-excited at the best design itself tells nothing of its surroundings.
    nearest = [row for row in sorted(rates, key=rates.get) if rates[row] < 0.0][-_NEAREST:]
    for k, axis in enumerate((c_T, d_T)):

        def excess(value: float, k: int = k) -> float:
            design = (value, best.design[1]) if k == 0 else (best.design[0], value)
            over = criterion.worst(design) - allowed
            if over <= 0.0 and any(criterion.self_excited(row, design, own) for row in nearest):
                return allowed
            return over

        for end, limit in enumerate((axis[0], axis[-1])):
            out[k, end] = _crossing(excess, best.design[k], float(limit))
    return out


def _crossing(excess: Callable[[float], float], start: float, end: float) -> float:
    """First root on the way from a place where the excess is negative; NaN if there is none."""
    from scipy.optimize import brentq

    way = np.linspace(start, end, _SCAN)
    for before, after in itertools.pairwise(way):
        if excess(after) > 0.0:
            return float(brentq(excess, before, after, rtol=1e-4))
    return np.nan
