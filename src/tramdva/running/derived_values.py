"""Values that a line leaves to its bogie, from the file of the stage that derives them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def completed(cfg: Mapping[str, Any], basic_model: Mapping[str, Any] | None) -> Mapping[str, Any]:
    """Return the values of a stage with what its line leaves to the bogie.

    Parameters
    ----------
    cfg : mapping
        Values of a stage; those that the line does not give are None.
    basic_model : mapping or None
        Variables of ``basic_model.nc``, whose names are the keys; None where nothing is left.
    """
    if basic_model is None:
        return cfg
    return {
        section: {
            key: _derived(key, basic_model) if value is None else value
            for key, value in values.items()
        }
        if isinstance(values, Mapping)
        else values
        for section, values in cfg.items()
    }


def _derived(key: str, basic_model: Mapping[str, Any]) -> Any:
    """Value of a key as ``basic_model.nc`` says: a number, a band, or the bands of peaks."""
    if key == "design_band":
        low, high = float(basic_model["band_min"]), float(basic_model["band_max"])
        return {"min": low, "max": high, "mode": str(basic_model["critical_mode"])}
    if key == "peaks":
        columns = (basic_model[name] for name in ("peak", "peak_min", "peak_max"))
        return [
            {"name": str(name), "min": float(low), "max": float(high)}
            for name, low, high in zip(*columns, strict=True)
        ]
    return float(basic_model[key])


def lacking(cfg: Mapping[str, Any], basic_model: Mapping[str, Any] | None) -> str:
    """Say why the bogie does not give what a stage leaves to it; nothing where it does."""
    if basic_model is None:
        return ""
    left = {
        key
        for values in cfg.values()
        if isinstance(values, Mapping)
        for key, value in values.items()
        if value is None
    }
    of_bands = left & {"design_band", "peaks"}
    reasons = [str(basic_model["band_reason"])] if of_bands else []
    reasons += [str(basic_model["reason"])] if left - of_bands else []
    return next(filter(None, reasons), "")
