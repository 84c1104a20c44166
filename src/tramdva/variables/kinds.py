"""What describes a variable of a result file."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Variable:
    """One variable of a result file."""

    kind: str  # real, flag, truth, text
    dimensions: tuple[str, ...]
    unit: str
    long_name: str
    meanings: tuple[str, ...] = ()  # of the values 0, 1, 2, ... of a flag


@dataclass(frozen=True)
class Stage:
    """One result file: the name of its stage, its title, its variables."""

    name: str
    title: str
    variables: dict[str, Variable]
    # Large arrays that many short jobs read: packed quickly, a plane of two of the last dimensions
    # but one after the other, since what differs in kind along the last one packs badly.
    by_plane: tuple[str, ...] = ()


def real(dimensions: str, unit: str, long_name: str) -> Variable:
    """Describe a variable of float64."""
    return Variable("real", tuple(dimensions.split()), unit, long_name)


def flag(dimensions: str, meanings: tuple[str, ...], long_name: str) -> Variable:
    """Describe a variable that takes one of a few named values."""
    return Variable("flag", tuple(dimensions.split()), "1", long_name, meanings)


def truth(dimensions: str, long_name: str) -> Variable:
    """Describe a variable that is true or false."""
    return Variable("truth", tuple(dimensions.split()), "1", long_name, ("false", "true"))


def text(dimensions: str, long_name: str) -> Variable:
    """Describe a variable of texts."""
    return Variable("text", tuple(dimensions.split()), "1", long_name)
