"""The mode that matters on a bogie, and bands of frequencies about its modes.

Absorbers are for the mode that vibrates by itself; where none does, for the second bending of an
axle, found by its shape (`tracking`): it is the next that would.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tramdva.bogie.curving import System
from tramdva.bogie.modes import Modes, of_front_axle
from tramdva.bogie.tracking import second_bending

# Ends of a band over the frequency of its mode; about the paper's 54.7 Hz these are 45 and 65 Hz.
BAND = (0.823, 1.188)
# Families of modes whose peaks figure 10 tells apart, each by its lowest mode of the front axle.
FAMILIES = ("first_bending", "second_bending", "third_bending", "resilient_wheel")


class CriticalMode(NamedTuple):
    """A mode that absorbers are for.

    name : its family and axle; frequency : Hz; growth_rate : 1/s
    likeness : 0 to 1, of its shape and the paper's second bending; NaN for another mode
    """

    name: str
    frequency: float
    growth_rate: float
    likeness: float


class Band(NamedTuple):
    """Frequencies in Hz about a mode, by its name."""

    name: str
    low: float
    high: float


def critical_mode(system: System, found: Modes, limits: tuple[float, float]) -> CriticalMode | None:
    """Mode that grows most with a frequency (Hz) within limits; if none grows, second bending.

    Where no mode is like second bending either, it is that of least damping; None without modes.
    """
    inside = np.flatnonzero((found.frequency > limits[0]) & (found.frequency < limits[1]))
    if not inside.size:
        return None
    rate = found.eigenvalue.real
    most = int(inside[np.argmax(rate[inside])])
    bending = {mode.index: mode for mode in second_bending(system, found) if mode.index in inside}
    if rate[most] < 0.0 and bending:
        most = max(bending, key=lambda index: rate[index])
    name, likeness = found.name[most], np.nan
    if most in bending:
        name, likeness = f"second_bending_{bending[most].axle}", bending[most].likeness
    return CriticalMode(name, float(found.frequency[most]), float(rate[most]), likeness)


def band_about(mode: CriticalMode, limits: tuple[float, float]) -> Band:
    """Band of a mode within limits (Hz)."""
    low, high = np.clip(np.multiply(BAND, mode.frequency), *limits)
    return Band(mode.name, round(float(low), 1), round(float(high), 1))


def peak_bands(
    system: System, found: Modes, mode: CriticalMode, limits: tuple[float, float]
) -> list[Band]:
    """Bands (Hz) of the families of modes within limits, and of the critical one; none overlap.

    Two that would overlap end between their modes.
    """
    centres = _families(system, found)
    family = next((name for name in FAMILIES if mode.name.startswith(name)), mode.name)
    centres[family] = mode.frequency
    names = sorted(
        (name for name in centres if limits[0] < centres[name] < limits[1]), key=centres.get
    )
    between = np.sqrt(np.multiply(*(
        [centres[name] for name in part] for part in (names[:-1], names[1:])
    )))  # fmt: skip
    lowest, highest = (limits[0], *between), (*between, limits[1])
    return [
        Band(
            name,
            round(max(BAND[0] * centres[name], low), 1),
            round(min(BAND[1] * centres[name], high), 1),
        )
        for name, low, high in zip(names, lowest, highest, strict=True)
    ]


def _families(system: System, found: Modes) -> dict[str, float]:
    """Frequencies (Hz) of the families that the bogie has; second bending by its shape."""
    index: dict[str, int | None] = {word: of_front_axle(found, word) for word in FAMILIES}
    bending: Sequence = second_bending(system, found)
    index["second_bending"] = bending[0].index if bending else index["second_bending"]
    return {word: float(found.frequency[k]) for word, k in index.items() if k is not None}
