"""Examples in docstrings and in the documentation run and print what they say."""

import ast
import doctest
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

from tramdva.bogie import published as bogie
from tramdva.wheelset import published as wheelset

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src/tramdva"


def examples() -> Iterator[tuple[str, str]]:
    """Texts with examples, by the name of their function or page."""
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.Module):
                text = ast.get_docstring(node) or ""
                if ">>>" in text:
                    name = getattr(node, "name", "")
                    yield f"{path.relative_to(PACKAGE)}:{name}", text
    for path in sorted((ROOT / "docs").glob("*.md")):
        text = path.read_text(encoding="utf-8")
        if ">>>" in text:
            yield path.name, text


EXAMPLES = dict(examples())


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_print_what_they_say(name: str, monkeypatch, tmp_path) -> None:
    monkeypatch.chdir(tmp_path)  # they need nothing of the checkout
    test = doctest.DocTestParser().get_doctest(EXAMPLES[name], {}, name, None, None)
    said: list[str] = []
    failed, tried = doctest.DocTestRunner().run(test, out=said.append)
    assert tried
    assert not failed, "".join(said)


def test_published_values_are_those_of_the_configuration() -> None:
    line = yaml.safe_load((ROOT / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    sections = {name: line[name] for name in wheelset.SECTIONS}
    assert numbers(wheelset.SECTIONS) == numbers(sections)
    assert numbers(bogie.TRACK) == numbers(line["track"])
    assert numbers(bogie.BOGIE) == numbers(line["bogie"])
    assert numbers(bogie.CONTACT_GEOMETRY) == numbers(line["contact_geometry"])
    assert tuple(line["creep_force"][name] for name in ("mu_0", "A", "B")) == bogie.FRICTION


def numbers(values: object) -> object:
    """The same tree, numbers of any spelling as floats."""
    if isinstance(values, dict):
        return {name: numbers(value) for name, value in values.items()}
    try:
        return float(values)
    except ValueError:
        return values
