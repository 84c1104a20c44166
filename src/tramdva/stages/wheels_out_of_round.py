"""From sections of the configuration to the wheels that are out of round, and how they wear."""

from collections.abc import Mapping
from typing import Any

from tramdva.evolution.tendency import Wearing
from tramdva.stages.wear_sections import chart_of, wear_grid


def wearing(cfg: Mapping[str, Any]) -> Wearing:
    """Chart and cells as configured, and the wheels out of round."""
    return Wearing(chart_of(cfg), wear_grid(cfg), tuple(cfg["out_of_roundness"]["wheels"]))
