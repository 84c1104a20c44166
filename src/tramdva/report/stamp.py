"""What a picture or page says of its making: line, resolution, version, origin."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import version
from typing import NamedTuple


class Stamp(NamedTuple):
    """Where a figure is from.

    line : name of the line
    resolution : ``full`` or ``coarse``
    origin : hash of all code and values behind the figure
    """

    line: str
    resolution: str
    origin: str

    def words(self) -> str:
        """Return the line for the corner of a picture."""
        coarse = "" if self.resolution == "full" else f"{self.resolution.upper()} NUMERICS · "
        return f"{coarse}{self.line} · tramdva {version('tramdva')} · {self.origin}"


_shown: list[Stamp] = []


@contextmanager
def shown(stamp: Stamp) -> Iterator[None]:
    """Let all pictures and pages that are written within the block bear a stamp."""
    _shown.append(stamp)
    try:
        yield
    finally:
        _shown.pop()


def current() -> Stamp | None:
    """Return the stamp of what is written now; none where a script is tried by hand."""
    return _shown[-1] if _shown else None


def words() -> str:
    """Return the words of the current stamp, or nothing."""
    stamp = current()
    return stamp.words() if stamp else ""
