"""Every public function says what it does, what it takes and what it returns."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "src/tramdva"
MODULES = [path for path in sorted(PACKAGE.rglob("*.py")) if path.name != "__init__.py"]
Function = ast.FunctionDef | ast.AsyncFunctionDef


def public(body: list[ast.stmt], owner: str = "") -> Iterator[tuple[str, Function]]:
    """Public functions and methods with their names; those within functions are no one's."""
    for node in body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from public(node.body, f"{node.name}.")
        elif isinstance(node, Function) and not node.name.startswith("_"):
            yield f"{owner}{node.name}", node


def compiled(function: Function) -> bool:
    """Whether Numba compiles it: it takes its types from the call."""
    return any("jit" in ast.unparse(decorator) for decorator in function.decorator_list)


def without_annotation(function: Function, method: bool) -> list[str]:
    """Names of the arguments, and ``return``, that bear no annotation."""
    of = function.args
    arguments = [*of.posonlyargs, *of.args, *of.kwonlyargs, of.vararg, of.kwarg]
    static = any(ast.unparse(one) == "staticmethod" for one in function.decorator_list)
    given = [argument for argument in arguments if argument is not None]
    given = given[1:] if method and not static else given
    missing = [argument.arg for argument in given if argument.annotation is None]
    return missing if function.returns is not None else [*missing, "return"]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_public_functions_are_annotated_and_described(path: Path) -> None:
    for name, function in public(ast.parse(path.read_text(encoding="utf-8")).body):
        assert ast.get_docstring(function), f"{name} has no docstring"
        if not compiled(function):
            assert without_annotation(function, "." in name) == [], name
