"""Numbers of the design sheet in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

DASH = "–"


def number(value: float, digits: int = 3) -> str:
    """Write a number with a few digits, or a dash where there is none."""
    if not np.isfinite(value):
        return DASH
    if value == 0.0:
        return "0"
    if not 1e-3 <= abs(value) < 1e5:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        return f"{mantissa.replace('-', '−')}·10{_raised(int(exponent))}"
    size = int(np.floor(np.log10(abs(float(f"{value:.{digits - 1}e}")))))
    return f"{value:.{max(digits - 1 - size, 0)}f}".replace("-", "−")


def _raised(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def percent(share: float) -> str:
    """Write a share in per cent, or a dash."""
    if not np.isfinite(share):
        return DASH
    return f"{100.0 * share:.0f} %" if share == 0.0 or share >= 0.0095 else f"{100 * share:.1f} %"


def in_ranges(orders: Sequence[int]) -> str:
    """Write whole numbers as ranges: 1 to 4, 7."""
    pieces: list[list[int]] = []
    for order in orders:
        if pieces and order == pieces[-1][1] + 1:
            pieces[-1][1] = order
        else:
            pieces.append([order, order])
    return ", ".join(str(a) if a == b else f"{a} to {b}" for a, b in pieces) or "none"


def place_of(coordinate: np.ndarray, value: float) -> int:
    """Place of a value along a coordinate (k,) that holds it."""
    return int(np.flatnonzero(coordinate == value)[0])
