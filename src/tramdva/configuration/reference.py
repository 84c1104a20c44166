"""The parameters as one table: for messages, for editors and for `config/README.md`.

`python -m tramdva.configuration.reference config` rewrites `schema.json` and the table in the
`README.md` of that folder.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tramdva.configuration.everyday import Tram
from tramdva.configuration.line import Line
from tramdva.configuration.run import Run

TABLE_BEGIN = "<!-- table of parameters: begin -->"
TABLE_END = "<!-- table of parameters: end -->"


@dataclass(frozen=True)
class Entry:
    """What is known of one key of the configuration."""

    kind: str  # section, list, number, whole number, text
    meaning: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    origin: str = ""

    @property
    def allowed(self) -> str:
        """The allowed values in words."""
        if self.low is None:
            kinds = {"section": "a map of keys", "list": "a list", "text": self.meaning}
            return kinds[self.kind]
        number = "a whole number " if self.kind == "whole number" else ""
        unit = "" if self.unit in ("", "-") else f" {self.unit}"
        return f"{number}between {short(self.low)} and {short(self.high)}{unit}"


def short(value: float) -> str:
    """Write a number without superfluous digits: 1e10, not 10000000000.0."""
    mantissa, exponent = f"{value:.11e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".")
    if -4 <= int(exponent) < 5 or len(mantissa) > 4:
        return f"{value:.12g}"
    return f"{mantissa}e{int(exponent)}"


def entries(model: type[BaseModel], prefix: str = "") -> dict[str, Entry]:
    """Table of all keys of a model by dotted path; the items of a list are `key[]`."""
    return dict(_walk_model(model, prefix))


def _walk_model(model: type[BaseModel], prefix: str) -> Iterator[tuple[str, Entry]]:
    for name, field in model.model_fields.items():
        yield from _walk(f"{prefix}{name}", field)


def _walk(path: str, field: FieldInfo) -> Iterator[tuple[str, Entry]]:
    annotation = field.annotation
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield path, Entry("section", _first_line(annotation))
        yield from _walk_model(annotation, f"{path}.")
    elif get_origin(annotation) is tuple:
        item = get_args(annotation)[0]
        yield path, Entry("list", field.description or "")
        yield from _walk(f"{path}[]", FieldInfo.from_annotation(item))
    else:
        yield path, _leaf(field)


def _leaf(field: FieldInfo) -> Entry:
    kind = {float: "number", int: "whole number", str: "text"}[_bare(field.annotation)]
    bounds = {
        name: getattr(item, bound)
        for item in field.metadata
        for name, bound in (("low", "ge"), ("high", "le"))
        if hasattr(item, bound)
    }
    return Entry(kind, field.description or "", **bounds, **(field.json_schema_extra or {}))


def _bare(annotation: Any) -> type:
    """Return the type without what describes it; of a value that may be missing, its type."""
    if get_origin(annotation) in (Annotated, UnionType, Union):
        return _bare(get_args(annotation)[0])
    return annotation


def _first_line(model: type[BaseModel]) -> str:
    return (model.__doc__ or "").strip().splitlines()[0].rstrip(".")


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of all files in `config/`; none has to be complete.

    A line holds only what differs from the paper's and another run only what differs from
    `config.yaml`; only the items of lists are always complete.
    """
    line = Line.model_json_schema(ref_template="#/$defs/{model}")
    run = Run.model_json_schema(ref_template="#/$defs/{model}")
    tram = Tram.model_json_schema()
    line["properties"]["tram"] = {"$ref": "#/$defs/Tram"}
    parts = {"Line": line, "Run": run, "Tram": tram}
    definitions = line.pop("$defs") | run.pop("$defs") | parts
    for name, definition in definitions.items():
        if name != "AbsorberVariant":
            definition.pop("required", None)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Configuration of tramdva",
        "anyOf": [{"$ref": "#/$defs/Line"}, {"$ref": "#/$defs/Run"}],
        "$defs": dict(sorted(definitions.items())),
    }


def table() -> str:
    """Return the parameters as a table in Markdown."""
    rows = ["| key | meaning | unit | allowed | origin |", "|---|---|---|---|---|"]
    for model, prefix in ((Tram, "tram."), (Line, ""), (Run, "")):
        for path, entry in entries(model, prefix).items():
            if entry.kind == "section":
                continue
            allowed = "" if entry.low is None else f"{short(entry.low)} ... {short(entry.high)}"
            rows.append(
                f"| `{path}` | {entry.meaning} | {entry.unit} | {allowed} | {entry.origin} |"
            )
    return "\n".join(rows)


def with_table(text: str) -> str:
    """Return a README with the current table between its two marks."""
    before, _, rest = text.partition(TABLE_BEGIN)
    _, _, after = rest.partition(TABLE_END)
    return f"{before}{TABLE_BEGIN}\n\n{table()}\n\n{TABLE_END}{after}"


def main(folder: Path) -> None:
    """Rewrite the generated files in the folder of the configuration."""
    schema = json.dumps(json_schema(), indent=2, ensure_ascii=False)
    (folder / "schema.json").write_text(schema + "\n", encoding="utf-8")
    readme = folder / "README.md"
    readme.write_text(with_table(readme.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
