"""A line that is written for a test, through some stages without the pipeline."""

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from tramdva.configuration.reading import load
from tramdva.configuration.uses import used_values
from tramdva.running.derived_values import completed, lacking
from tramdva.stages import (
    basic_model,
    bogie_designs,
    bogie_linearisation,
    contact_geometry,
    evolution_tendency,
    robust_tuning,
    robustness_sample,
)

ROOT = Path(__file__).resolve().parents[2]
LEAST = {"samples": 2, "parts": 20}  # the first part is the line as configured, and one more
Values = Mapping[str, np.ndarray]


class WrittenLine:
    """A line with its values by stage; numerics as of a quick run."""

    def __init__(self, folder: Path, description: Mapping[str, Any]) -> None:
        self._config = shutil.copytree(ROOT / "config", folder / "config")
        self._name = "written"
        text = yaml.safe_dump({"label": self._name, **description})
        (self._config / f"lines/{self._name}.yaml").write_text(text, encoding="utf-8")
        few = {"numerics": {"robustness_sample": LEAST}, "lines": [self._name]}
        self._loaded = load(self._config, [self._config / "quick.yaml"], few)
        self.contact_geometry = contact_geometry.compute(
            self._given("contact_geometry"), lambda name: self._config / name
        )
        self.basic_model = basic_model.compute(self._given("basic_model"), self.contact_geometry)

    def _given(self, stage: str) -> dict[str, Any]:
        return used_values(self._loaded, self._name, stage)

    def values(self, stage: str) -> dict[str, Any]:
        """Values that a stage uses, with what the line leaves to its bogie."""
        assert not lacking(self._given(stage), self.basic_model)
        return dict(completed(self._given(stage), self.basic_model))

    def sheet(self) -> Values:
        """Variables of `robust_tuning`, from the line as configured and a case beside it."""
        sample = robustness_sample.compute(
            self.values("robustness_sample"), self.contact_geometry, 0
        )
        return robust_tuning.compute(self.values("robust_tuning"), [sample])

    def explorer(self) -> Values:
        """Variables of `bogie_designs`."""
        return bogie_designs.compute(self.values("bogie_designs"), self.contact_geometry)

    def linearisations(self) -> list[Values]:
        """Variables of `bogie_linearisation` without absorbers and with the line's."""
        return [
            bogie_linearisation.compute(
                self.values(f"bogie_linearisation_{name}"), name, self.contact_geometry
            )
            for name in ("none", "paper")
        ]

    def figure_10(self, linearisations: list[Values]) -> Values:
        """Growth in the band of design that figure 10 and its table tell."""
        cfg = self.values("evolution_tendency")
        return evolution_tendency.finely(cfg, linearisations).in_band()
