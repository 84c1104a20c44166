"""From sections of the configuration to the law of wear and the cells of the worn patch."""

from collections.abc import Mapping
from typing import Any

from tramdva.contact import fastsim
from tramdva.wear.chart import WearChart, wear_chart
from tramdva.wear.parameters import Wear


def chart_of(cfg: Mapping[str, Any]) -> WearChart:
    """Wear chart of the section ``wear``."""
    return wear_chart(Wear.model_validate(cfg["wear"]))


def wear_grid(cfg: Mapping[str, Any]) -> fastsim.PatchGrid:
    """Cells of the worn patch."""
    return fastsim.patch_grid(cfg["numerics"]["wear_cells_along"], cfg["numerics"]["wear_strips"])
