"""Whether the numerics of a run resolve what its lines ask for."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from tramdva.configuration.line import Line
from tramdva.configuration.numerics import Numerics

FEWEST_IN_BAND = 3  # points; a peak needs both sides
BAND = "study.tendency_maps.design_band"
OF_THE_BAND = ("evolution_tendency", "tendency_maps", "bogie_designs")  # where it is looked for


def problems(
    numerics: Numerics, lines: Mapping[str, Line], derived: Mapping[str, Collection[str]]
) -> Iterator[str]:
    """Say, a line each, where the design band falls between the frequencies that are computed.

    Parameters
    ----------
    numerics : Numerics
        Of the run.
    lines : mapping
        The lines by name.
    derived : mapping
        Keys by line that are left to the bogie; where the band is among them it is no one's fault.
    """
    for name, line in lines.items():
        if BAND in derived[name]:
            continue
        axis, band = line.study.evolution_tendency.frequency, line.study.tendency_maps.design_band
        for stage in OF_THE_BAND:
            points = getattr(numerics, stage).frequency_points
            step = (axis.max - axis.min) / (points - 1)
            if band.max - band.min < FEWEST_IN_BAND * step:
                yield (
                    f"config/lines/{name}.yaml: study.tendency_maps.design_band = {band.min:g} to "
                    f"{band.max:g} Hz must be at least {FEWEST_IN_BAND * step:.3g} Hz wide: "
                    f"{points} numerics.{stage}.frequency_points lie {step:.3g} Hz apart"
                )
