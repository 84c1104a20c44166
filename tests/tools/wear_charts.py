"""Wear charts for tests: the middle of the ranges of the KTH chart, or with some values changed."""

from tramdva.wear.chart import WearChart, wear_chart
from tramdva.wear.parameters import Wear

MIDDLE = {
    "method": "chart",
    "hardness": 2.7e9,
    "coefficient_mild": 5e-4,
    "coefficient_severe": 35e-4,
    "coefficient_mild_fast": 5e-4,
    "coefficient_seizure": 350e-4,
    "velocity_low": 0.2,
    "velocity_high": 0.7,
    "pressure_share": 0.8,
    "velocity_width": 0.05,
    "pressure_width_share": 0.05,
    "coefficient_constant": 5e-4,
    "energy_mild": 5.3e-9,
    "energy_severe": 0.055,
    "energy_limit": 77.2e6,
    "energy_catastrophic": 61.9e-9,
    "density": 7800.0,
}


def chart_with(**changes: object) -> WearChart:
    """Chart with some parameters changed."""
    return wear_chart(Wear.model_validate(MIDDLE | changes))
