"""Names on every page: designs of an absorber (what has none there is a step), laws of wear."""

from __future__ import annotations

# Of the bogie: what a reader may build or compare.
NAMED = {
    "none": "no absorber",
    "paper": "line's absorber",
    "nominal": "nominal optimum",
    "robust": "robust optimum",
    "route": "route's optimum",
}
# On the way: of the wheelset alone, of Table 2, or of a grid. Nobody should build them unasked.
STEPS = {
    "tuned": "step: tuned as the wheelset's",
    "den_hartog": "Den Hartog",
    "den_hartog_sqrt2": "Den Hartog, damping × √2",
    "abscissa_damping": "Den Hartog, damping of largest decay",
    "spectral_abscissa": "largest decay",
    "h_infinity": "lowest peak (H∞)",
}

WEAR_LAWS = {
    "chart": "KTH chart",
    "smoothed": "smoothed chart",
    "constant": "constant coefficient",
    "energy": "frictional work",
}


def design_name(design: str) -> str:
    """Name a design of the absorber for readers."""
    return (NAMED | STEPS).get(design, design.replace("_", " "))
