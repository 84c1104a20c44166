"""The paper's bogie on coarse tables, without self-excitation, and how its wheels wear."""

import numpy as np
import pytest

from tramdva.bogie.names import WHEELS
from tramdva.bogie.published import paper_bogie
from tramdva.bogie.tram import BogieLine
from tramdva.contact.fastsim import patch_grid
from tramdva.evolution.tendency import Wearing
from tramdva.route.classes import RunningClass
from tramdva.route.response import Middle, at_mean_speed
from tramdva.wear.chart import CHART, CONSTANT, wear_chart
from tramdva.wear.parameters import Wear


@pytest.fixture(scope="session")
def line() -> BogieLine:
    """Bogie of the paper at the friction of forced excitation."""
    coarse = paper_bogie(shift_step=1e-4, yaw_nodes=10, grid=(6, 6), cutoff_frequency=300.0)
    return coarse._replace(friction=(*coarse.friction[:2], 0.4))


@pytest.fixture(scope="session")
def laws(paper_wear) -> list[Wearing]:
    """The chart, and one coefficient."""
    chart, grid = wear_chart(paper_wear), patch_grid(10, 10)
    return [Wearing(chart._replace(method=one), grid, WHEELS) for one in (CHART, CONSTANT)]


@pytest.fixture(scope="session")
def paper_wear(root) -> Wear:
    """Wear of the paper's line."""
    from tramdva.configuration.reading import load

    return load(root / "config").lines["paper"].wear


@pytest.fixture(scope="session")
def curve(line) -> RunningClass:
    """The paper's curve."""
    return RunningClass(1.0 / line.track.radius, 0.0, line.track.speed, 0.05, np.nan, 1.0)


@pytest.fixture(scope="session")
def absorber(line):
    """The paper's absorber."""
    return line.bogie.absorber


@pytest.fixture(scope="session")
def middle(line, curve, laws, absorber) -> Middle:
    """The vehicle in its curve at its mean speed, without and with absorbers."""
    return at_mean_speed(line, curve, {"none": None, "paper": absorber}, laws)
