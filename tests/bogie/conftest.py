"""The paper's bogie with the numerics of the full run."""

from pathlib import Path

import numpy as np
import pytest

from tramdva import config
from tramdva.bogie import line as bogie_line_module
from tramdva.bogie.line import BogieLine, Running

CONFIG = Path(__file__).resolve().parents[2] / "config"


@pytest.fixture(scope="session")
def configuration():
    """The configuration."""
    return config.load(CONFIG)


@pytest.fixture(scope="session")
def bogie(configuration):
    """Parameters of the paper's bogie."""
    return configuration.lines["paper"].bogie


@pytest.fixture(scope="session")
def tables(configuration) -> dict[str, np.ndarray]:
    """Contact tables."""
    return bogie_line_module.contact_geometry(
        config.stage(configuration, "paper", "contact_geometry")
    )


@pytest.fixture(scope="session")
def line(configuration, tables) -> BogieLine:
    """The paper's line."""
    return bogie_line_module.bogie_line(
        config.stage(configuration, "paper", "curving_equilibrium"), tables
    )


@pytest.fixture(scope="session")
def running(line) -> Running:
    """Equilibria without absorbers."""
    return bogie_line_module.run_through(line, 4)
