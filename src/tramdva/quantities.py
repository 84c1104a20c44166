"""What a parameter is: a number with unit, range, meaning and origin, in a frozen section."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, model_validator


def refuse_bool(value: Any) -> Any:
    """Let true and false not pass for 1 and 0."""
    if isinstance(value, bool):
        raise ValueError("a truth value is no number")
    return value


def unique(values: tuple) -> tuple:
    """Refuse a list that holds a value twice."""
    twice = {value for value in values if values.count(value) > 1}
    if twice:
        raise ValueError(f"{', '.join(map(str, sorted(twice)))} is given twice")
    return values


def printable(text: str) -> str:
    """Refuse line breaks, escape sequences and other letters without a picture."""
    if not text.isprintable():
        raise ValueError("must be one line of printable letters")
    return text


Real = Annotated[float, BeforeValidator(refuse_bool)]
Whole = Annotated[int, BeforeValidator(refuse_bool)]


def quantity(meaning: str, unit: str, low: float, high: float, origin: str = "") -> Any:
    """Describe a number: what it is, its unit, its allowed range and where its value is from."""
    return Field(
        ge=low,
        le=high,
        description=meaning,
        json_schema_extra={"unit": unit, "origin": origin},
    )


def measured_file(what: str) -> Any:
    """Describe the name of a measured file: relative to the configuration's folder, or empty."""
    return Field(
        max_length=200,
        pattern=r"^[A-Za-z0-9_./ -]*$",
        description=f"file of {what}, beside `lines`; empty: none",
    )


class Section(BaseModel):
    """A map of the configuration: frozen, complete, without unknown keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Interval(Section):
    """Both ends of a range."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if not self.min < self.max:
            raise ValueError("min must be less than max")
        return self


Label = Annotated[str, AfterValidator(printable)]

GREATEST_LATERAL_ACCELERATION = 4.0  # m/s^2; trams in service stay near 1
