"""A wheel with a whole profile in steady running: what a revolution wears off, all orders at once.

The vehicle is simulated with its contacts as they are, the wheel at its own rate of turning, the
others round, until one revolution is like the last; then every passage of the contact wears at
the material point at which it is. For small waves this is the response of `own_response`.

The lead of the contact by which its wear is brought to the wheel is that of the moment; the waves
meet the contact at the lead of the equilibrium, from which that of the moment differs by a
fraction of a millimetre.
"""

from typing import NamedTuple

import numpy as np

from tramdva.bogie import integration, wheel_forces
from tramdva.bogie.revolutions import Settings, run_steadily
from tramdva.bogie.rough_wheels import RoughBogie, waves
from tramdva.contact import patch
from tramdva.contact.fastsim import PatchGrid
from tramdva.evolution.tendency import WEAR_INPUTS, patch_width
from tramdva.route.own_response import patch_filter
from tramdva.wear.chart import WearChart
from tramdva.wear.passages import ContactHistory, passages, wear_orders

_COLUMN = {column: place for place, column in enumerate(integration.RECORDED)}
_HISTORY = [_COLUMN[column] for column in WEAR_INPUTS]
_LEAD = _COLUMN[patch.WHEEL_LEAD]


class WearingWheel(NamedTuple):
    """A wheel that runs and wears in one condition.

    contacts : wheel_forces.Contacts; bogie : RoughBogie
    wheel : place in `names.WHEELS`; spin : rad/s, its own
    chart : WearChart; grid : PatchGrid of the worn patch
    zone_share : (zones,) by which the zones wear more than the chart says
    settings : of the simulation
    """

    contacts: wheel_forces.Contacts
    bogie: RoughBogie
    wheel: int
    spin: float
    chart: WearChart
    grid: PatchGrid
    zone_share: np.ndarray
    settings: Settings

    @property
    def turn(self) -> float:
        """Time of a revolution in s."""
        return 2.0 * np.pi / self.spin

    @property
    def per_metre(self) -> float:
        """Angle in rad of the wheel per metre along its rail."""
        return self.spin / self.bogie.rolling_speed[self.wheel]

    def equilibrium(self, column: int) -> np.ndarray:
        """A result (zones,) of its contacts in equilibrium, zero where they do not touch."""
        touching = self.bogie.touching[self.wheel]
        return np.where(touching, self.bogie.results[self.wheel, :, column], 0.0)

    def filter(self, orders: np.ndarray) -> np.ndarray:
        """Share (o, zones) of waves that patches leave."""
        half_length = self.equilibrium(patch.SEMI_AXIS_LONGITUDINAL) * self.per_metre
        return patch_filter(np.outer(orders, half_length))


class Revolution(NamedTuple):
    """Wear of a revolution in steady running; NaN where there is none.

    depth : (o,) complex, W_n in m, removed material positive; mean : m
    difference : of the revolution from its limit, share of the response
    status : one of `revolutions.STATUS`
    """

    depth: np.ndarray
    mean: float
    difference: float
    status: str


def source_of(wheel: WearingWheel, orders: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    """Complex deviations (o, 4, zones) in m that the contacts feel of waves on a wheel."""
    lead = wheel.equilibrium(patch.WHEEL_LEAD) * wheel.per_metre
    source = np.zeros((orders.size, 4, lead.size), complex)
    felt = wheel.filter(orders) * np.exp(1j * np.outer(orders, lead))
    source[:, wheel.wheel] = amplitudes[:, None] * felt
    return source


def revolution(
    wheel: WearingWheel,
    orders: np.ndarray,
    amplitudes: np.ndarray,
    start: np.ndarray | None = None,
) -> Revolution:
    """Wear off a wheel with a profile in a revolution.

    Parameters
    ----------
    wheel : WearingWheel
    orders : (o,) whole numbers; amplitudes : (o,) complex, R_n in m
    start : (2 m,) state from which steady running is sought, as in `revolutions.run_steadily`
    """
    there = amplitudes != 0.0
    frequency = orders[there] * wheel.spin
    source = source_of(wheel, orders[there], amplitudes[there])
    velocity = float(np.linalg.norm(frequency * np.abs(amplitudes[there])))
    run = run_steadily(
        wheel.contacts, wheel.bogie, waves(wheel.bogie, frequency, source), wheel.turn, velocity,
        wheel.settings, start,
    )  # fmt: skip
    if run.status not in ("periodic", "contact_lost"):
        return Revolution(np.full(orders.size, np.nan + 0j), np.nan, run.difference, run.status)
    depth, mean = _worn(wheel, orders, run.time, run.results[:, wheel.wheel])
    return Revolution(depth, mean, run.difference, run.status)


def _worn(
    wheel: WearingWheel, orders: np.ndarray, time: np.ndarray, results: np.ndarray
) -> tuple[np.ndarray, float]:
    """Orders (o,) of the depth in m and its mean from results (k, zones, columns)."""
    law, width = wheel.contacts.law, patch_width(wheel.bogie)[wheel.wheel]
    depth, mean = np.zeros(orders.size, complex), 0.0
    for zone, left in enumerate(wheel.filter(orders).T):
        history = ContactHistory(*results[:, zone, _HISTORY].T)
        if not (history.normal_force > 0.0).any():
            continue
        area = passages(
            history, law.kalker_table, law.shear_modulus, wheel.grid,
            wheel.bogie.rolling_speed[wheel.wheel], wheel.chart,
        ).area  # fmt: skip
        angle = wheel.spin * time + wheel.per_metre * results[:, zone, _LEAD]
        found = wear_orders(area, angle, int(orders.max()) + 1) * (wheel.zone_share[zone] / width)
        depth += left * found[orders.astype(int)]
        mean += found[0].real
    return depth, mean
