"""From the section ``wear`` to the wear of all wheels of the vehicle by a law."""

from collections.abc import Mapping
from typing import Any

from tramdva.bogie.names import WHEELS
from tramdva.evolution.tendency import Wearing
from tramdva.stages.wear_sections import chart_of, wear_grid
from tramdva.wear.laws import with_method


def wearing_of_all(cfg: Mapping[str, Any], law: str) -> Wearing:
    """Wear of all wheels by a law, with the values and cells as configured."""
    return Wearing(with_method(chart_of(cfg), law), wear_grid(cfg), WHEELS)
