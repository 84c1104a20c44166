"""What the values of a file are and which packages made them: for stamps that can be checked."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Iterable
from importlib.metadata import version
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

COMPUTING = ("numpy", "scipy", "numba", "llvmlite")  # another version may give other numbers
WRITING = ("netCDF4",)


@functools.cache
def package_versions() -> str:
    """Name the packages that compute and write, with their versions, in one line."""
    return ", ".join(f"{name} {version(name)}" for name in (*COMPUTING, *WRITING))


@functools.cache
def computing_versions() -> str:
    """Name the packages whose version can change a result, with their versions, in one line."""
    return ", ".join(f"{name} {version(name)}" for name in COMPUTING)


def content_hash(arrays: Iterable[tuple[str, np.ndarray]], words: str) -> str:
    """Hash names and values of arrays.

    Parameters
    ----------
    arrays : iterable of (name, array)
        As they stand in the file, texts as bytes of fixed length.
    words : str
        What else must not change.

    Returns
    -------
    str
        64 hexadecimal digits.
    """
    digest = hashlib.sha256(words.encode())
    for name, array in arrays:
        digest.update(f"{name} {array.dtype.str} {array.size}".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()
