"""The laws of wear by name, and one set of parameters under another of them."""

from tramdva.wear.chart import METHODS, WearChart

LAWS = tuple(METHODS)

# What figures and tables call them.
LABELS = {
    "chart": "KTH chart",
    "smoothed": "KTH chart, smooth steps",
    "constant": "one coefficient (Archard)",
    "energy": "frictional work (T-gamma)",
}


def with_method(chart: WearChart, law: str) -> WearChart:
    """The same parameters under another law.

    Raises
    ------
    ValueError
        For a law that is none of `LAWS`.

    Examples
    --------
    >>> from tramdva.wear.laws import LAWS
    >>> ", ".join(LAWS)
    'chart, smoothed, constant, energy'
    """
    if law not in METHODS:
        raise ValueError(f"law of wear '{law}' is unknown; allowed: {', '.join(LAWS)}")
    return chart._replace(method=METHODS[law])


def law_of(chart: WearChart) -> str:
    """Name of the law of a set of parameters."""
    return LAWS[chart.method]
