"""A wheel of the paper's bogie in its curve that wears, for tests of the nonlinear loop."""

import numpy as np

from tramdva.bogie.revolutions import Settings
from tramdva.evolution.tendency import Wearing, wear_sensitivity
from tramdva.route.nonlinear import WearingWheel
from tramdva.route.own_response import own_response
from tramdva.route.response import Middle

SETTINGS = Settings(256, 1, 40, 1e-3, 0.05)
ORDERS = np.arange(1.0, 69.0)


def wheel_of(
    middle: Middle, law: Wearing, wheel: int, method: int, design: str = "none", **parameters
) -> tuple[WearingWheel, np.ndarray]:
    """Return a wheel, by its place in `names.WHEELS`, and its response (o,) to small waves."""
    bogie, spin = middle.node.bogie[design], float(middle.node.spin[wheel])
    contacts = middle.known.system.contacts
    chart = law.chart._replace(method=method, **parameters)
    wear = wear_sensitivity(bogie, contacts.law, law._replace(chart=chart))
    own = own_response(bogie, [wear], wheel, spin)
    zones = np.ones(bogie.touching.shape[1])
    running = WearingWheel(contacts, bogie, wheel, spin, chart, law.grid, zones, SETTINGS)
    return running, own.at(ORDERS, ORDERS * spin)[0]
