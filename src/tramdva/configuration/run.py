"""A run: which lines are computed, and how finely."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field

from tramdva.configuration.numerics import Numerics
from tramdva.quantities import Section, unique

LINE_NAME = r"[a-z0-9][a-z0-9_-]{0,40}"

DEVICES = {
    "con",
    "prn",
    "aux",
    "nul",
    *(f"{port}{n}" for port in ("com", "lpt") for n in range(10)),
}


def no_device(name: str) -> str:
    """Refuse names that cannot be a folder on every system, so that results can be handed on."""
    if name in DEVICES:
        raise ValueError("is the name of a device on Windows: choose another name")
    return name


LineName = Annotated[
    str,
    Field(
        pattern=f"^{LINE_NAME}$",
        description="a name of lower-case letters, digits, - and _, at most 41 of them",
    ),
    AfterValidator(no_device),
]


SlowStage = Annotated[
    str,
    Field(pattern="^polygon_simulation$", description="polygon_simulation, five minutes a line"),
]


class Run(Section):
    """Which lines are computed, and how finely."""

    lines: Annotated[
        tuple[LineName, ...], Field(min_length=1, max_length=1000), AfterValidator(unique)
    ] = Field(description="names of files in config/lines, without .yaml")
    on_demand: Annotated[tuple[SlowStage, ...], Field(max_length=1), AfterValidator(unique)] = (
        Field(description="stages that are made only when their file is asked for")
    )
    numerics: Numerics
