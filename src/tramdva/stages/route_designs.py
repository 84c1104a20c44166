"""The absorbers that a route is computed with, from the files of the searches."""

from collections.abc import Mapping

import numpy as np

from tramdva.bogie.parameters import BogieAbsorber
from tramdva.bogie.tram import BogieLine
from tramdva.bogie.tram import absorber as absorber_of


def designs_of(
    line: BogieLine,
    robust_tuning: Mapping[str, np.ndarray],
    route_tuning: Mapping[str, np.ndarray],
) -> dict[str, BogieAbsorber | None]:
    """Absorbers by name: none, the line's and those that the searches found."""
    columns = (robust_tuning[name] for name in ("design", "I_T", "c_T", "d_T"))
    of_route = ("route", *(float(route_tuning[name]) for name in ("I_T", "c_T", "d_T")))
    found: dict[str, BogieAbsorber | None] = {"none": None}
    for name, inertia, c_T, d_T in [*zip(*columns, strict=True), of_route]:
        if np.isfinite(c_T):
            design = absorber_of(line, c_T, d_T)
            found[str(name)] = design.model_copy(update={"I_T": float(inertia)})
    return found
