"""Smooth arrays as short texts for pages that hold their own data.

Numbers are rounded to steps, differences along chosen axes make them small, and deflate makes
them short. `paper_figures/explorer.js` unpacks them.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np

MISSING = 0xFFFF  # stands for NaN


def pack(
    values: np.ndarray,
    step: float,
    differences: Sequence[int],
    kind: str = "linear",
    scale: float = 1.0,
) -> dict[str, Any]:
    """Round an array and write it as a text.

    Parameters
    ----------
    values : array
        Real numbers; NaN stays NaN.
    step : float
        Steps of `values / scale`, of its logarithm or of its inverse hyperbolic sine: the error is
        at most half of it.
    differences : sequence of int
        Axes along which differences are formed, one after the other; an axis may come twice.
    kind : {'linear', 'log', 'asinh'}
        What is rounded.
    scale : float
        Unit of the values.

    Returns
    -------
    dict
        Plain numbers and texts for JSON.

    Raises
    ------
    ValueError
        Where the values span more steps than 16 bits hold.
    """
    known = np.isfinite(values)
    with np.errstate(invalid="ignore", divide="ignore"):
        plain = {"linear": np.asarray, "log": np.log, "asinh": np.arcsinh}[kind](values / scale)
    steps = np.round(np.where(known, plain, 0.0) / step)
    lowest = float(steps[known].min()) if known.any() else 0.0
    if not np.isfinite(steps).all() or (known.any() and steps[known].max() - lowest >= MISSING):
        raise ValueError(f"values span more than {MISSING} steps of {step:g}")
    whole = np.where(known, steps - lowest, MISSING).astype(np.uint16)
    for axis in differences:
        whole = np.diff(whole, axis=axis, prepend=np.uint16(0))  # modulo 2^16
    signed = whole.view(np.int16).astype(np.int32)
    folded = ((signed << 1) ^ (signed >> 31)).astype("<u2")  # 0, -1, 1, -2, ... to 0, 1, 2, 3, ...
    planes = folded.reshape(-1).view(np.uint8).reshape(-1, 2).T.tobytes()
    return {
        "shape": list(values.shape),
        "kind": kind,
        "scale": scale,
        "step": step,
        "lowest": lowest,
        "differences": list(differences),
        "data": deflated(planes),
    }


def deflated(content: bytes) -> str:
    """Deflate bytes and write them in base 64."""
    return base64.b64encode(zlib.compress(content, 9)).decode("ascii")
