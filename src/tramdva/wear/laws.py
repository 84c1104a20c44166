"""The laws of wear by name, and one set of parameters under another of them."""

from tramdva.wear.chart import METHODS, WearChart

LAWS = tuple(METHODS)


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
