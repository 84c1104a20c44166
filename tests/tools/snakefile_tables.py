"""The tables of the Snakefile: what each rule reads and makes, for tests of the pipeline.

`python tests/tools/snakefile_tables.py` prints the names of all stages and figures.
"""

import ast
import re
from pathlib import Path
from typing import NamedTuple

SNAKEFILE = Path(__file__).resolve().parents[2] / "Snakefile"
# The first line that is no Python any more.
KEYWORD = re.compile(r"^(report|onstart|onsuccess|onerror|include|rule\b.*):", re.MULTILINE)


class Tables(NamedTuple):
    """What stands in the three tables."""

    stages: dict[str, list[str]]  # a file each: what they read
    jobs: dict[str, list[str]]  # many files each: what they read
    figures: dict[str, list[str]]  # what they read
    kinds: dict[str, dict[str, str]]  # files of a figure: the ends of their names, by kind

    @property
    def reads(self) -> dict[str, list[str]]:
        """What each stage and each figure reads."""
        return {**self.stages, **self.jobs, **self.figures}


def read(path: Path = SNAKEFILE) -> Tables:
    """Read the tables of a Snakefile, which are literals but for names given before."""
    text = path.read_text(encoding="utf-8")
    known: dict[str, object] = {}
    for node in ast.parse(text[: KEYWORD.search(text).start()]).body:
        if isinstance(node, ast.Assign):
            _assign(node, known)
    stages, jobs, reads = (
        {name: entry[0] for name, entry in known[table].items()}
        for table in ("STAGES", "JOBS", "FIGURES")
    )
    kinds = {name: entry[-1] for name, entry in known["FIGURES"].items()}
    return Tables(stages, jobs, reads, kinds)


def _assign(node: ast.Assign, known: dict[str, object]) -> None:
    try:
        value = ast.literal_eval(_Replaced(known).visit(node.value))
    except ValueError:  # the configuration and what follows from it
        return
    (target,) = node.targets
    names = target.elts if isinstance(target, ast.Tuple) else [target]
    values = value if isinstance(target, ast.Tuple) else [value]
    known |= {name.id: each for name, each in zip(names, values, strict=True)}


class _Replaced(ast.NodeTransformer):
    """Names replaced by the literals that they stand for."""

    def __init__(self, known: dict[str, object]) -> None:
        self.known = known

    def visit_Name(self, node: ast.Name) -> ast.AST:
        if node.id not in self.known:
            return node
        return ast.parse(repr(self.known[node.id]), mode="eval").body


if __name__ == "__main__":
    print(*read().reads, sep="\n")
