"""Arrays as a result file wants them, from the description of its variables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from tramdva.variables.kinds import Stage

TYPES = {"real": float, "flag": str, "text": str, "truth": bool}


def table(stage: Stage, dimension: str, rows: Iterable[Mapping[str, Any]]) -> dict[str, np.ndarray]:
    """Columns of a table, also of one without any row.

    Parameters
    ----------
    stage : Stage
        The file.
    dimension : str
        Name of the dimension along the rows.
    rows : iterable of mappings
        A value of each variable that has this dimension only; other entries are left out.

    Returns
    -------
    dict
        An array (rows,) per variable, SI units.
    """
    rows = list(rows)
    return {
        name: np.array([row[name] for row in rows], dtype=TYPES[variable.kind])
        for name, variable in stage.variables.items()
        if variable.dimensions == (dimension,)
    }


def without_numbers(stage: Stage, lengths: Mapping[str, int]) -> dict[str, np.ndarray]:
    """All variables but flags and texts where there is no result: NaN, and false.

    Parameters
    ----------
    stage : Stage
        The file.
    lengths : mapping
        Lengths of its dimensions by name.
    """
    nothing = {"real": np.nan, "truth": False}
    return {
        name: np.full([lengths[one] for one in variable.dimensions], nothing[variable.kind])
        for name, variable in stage.variables.items()
        if variable.kind in nothing
    }
