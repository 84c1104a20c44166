"""Where caches of the code may be: compiled kernels, parsed files."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path


def cache_roots() -> Iterator[Path]:
    """Yield folders in the order of preference; some may be read-only."""
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        path = Path(given)
        yield path.parent if path.name.startswith("sources-") else path
    home = os.environ.get("XDG_CACHE_HOME") or Path("~").expanduser() / ".cache"
    yield Path(home) / "tramdva"
    yield Path.cwd() / ".snakemake" / "tramdva"
