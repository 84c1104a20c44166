"""The paper's bogie with the numerics of the full run."""

from pathlib import Path

import numpy as np
import pytest

from tramdva.bogie import tram as bogie_line_module
from tramdva.bogie.tram import BogieLine, Running
from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.stages import contact_geometry
from tramdva.stages.bogie_sections import bogie_line

CONFIG = Path(__file__).resolve().parents[2] / "config"


@pytest.fixture(scope="session")
def configuration():
    """The configuration."""
    return load(CONFIG)


@pytest.fixture(scope="session")
def bogie(configuration):
    """Parameters of the paper's bogie."""
    return configuration.lines["paper"].bogie


@pytest.fixture(scope="session")
def tables(configuration) -> dict[str, np.ndarray]:
    """Contact tables."""
    return contact_geometry.compute(used_values(configuration, "paper", "contact_geometry"))


@pytest.fixture(scope="session")
def line(configuration, tables) -> BogieLine:
    """The paper's line."""
    return bogie_line(used_values(configuration, "paper", "curving_equilibrium"), tables)


@pytest.fixture(scope="session")
def running(line) -> Running:
    """Equilibria without absorbers."""
    return bogie_line_module.run_through(line)
