"""The directive `result-tables`: every variable of every result file, from the registry."""

from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from tramdva.variables.kinds import Stage, Variable
from tramdva.variables.registry import STAGES


class ResultTables(SphinxDirective):
    """Write a section per result file with a table of its variables."""

    def run(self) -> list:
        """Return the sections."""
        lines = [line for name, stage in STAGES.items() for line in section(name, stage)]
        return self.parse_text_to_nodes(
            StringList(lines, source="registry"), allow_section_headings=True
        )


def section(name: str, stage: Stage) -> list[str]:
    """Return the Markdown of one file."""
    rows = [row(key, variable) for key, variable in stage.variables.items()]
    head = ["| variable | dimensions | unit | meaning |", "|---|---|---|---|"]
    return [f"## {name}", "", f"{stage.title}.", "", *head, *rows, ""]


def row(name: str, variable: Variable) -> str:
    """Return the Markdown of one variable."""
    meanings = f" ({', '.join(variable.meanings)})" if variable.meanings else ""
    dimensions = ", ".join(variable.dimensions)
    return f"| `{name}` | {dimensions} | {variable.unit} | {variable.long_name}{meanings} |"


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("result-tables", ResultTables)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
