"""The design sheet as a page that needs no other file. For `paper_figures/`."""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence

from tramdva.report import stamp
from tramdva.report.design_sheet import Sheet, Table

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ font: 14px/1.45 sans-serif; background: white; color: black; max-width: 68em;
  margin: 1em auto; padding: 0 1em; }}
h1 {{ font-size: 1.5em; }} h2 {{ font-size: 1.15em; margin-top: 1.6em; }}
table {{ border-collapse: collapse; border-top: 2px solid; border-bottom: 2px solid; }}
th, td {{ padding: 0.2em 0.8em; text-align: right; white-space: pre; }}
th:first-child, td:first-child {{ text-align: left; }}
thead th {{ border-bottom: 1px solid; vertical-align: bottom; }}
img {{ width: 100%; }}
.notes {{ font-size: 0.9em; color: #333; }}
footer {{ color: #666; font-size: 0.75em; margin-top: 1.5em; }}
</style>
</head>
<body>
<h1>{title}</h1>
<ul>
{verdicts}
</ul>
{tables}
<h2>What is left under the ranges</h2>
<img alt="Distributions, map of the worst case and single ranges"
  src="data:image/svg+xml;base64,{picture}">
{more}
<h2>Assumptions, status and limits</h2>
<ul class="notes">
{notes}
</ul>
<footer>{made}</footer>
</body>
</html>
"""


def page(content: Sheet, picture: bytes) -> str:
    """Return the sheet as a page that needs no other file; the picture is SVG."""

    def items(lines: Sequence[str]) -> str:
        return "\n".join(f"<li>{html.escape(line)}</li>" for line in lines)

    def tables(*wanted: Table) -> str:
        return "\n".join(f"<h2>{html.escape(t.title)}</h2>\n{_table(t.rows)}" for t in wanted)

    return PAGE.format(
        title=html.escape(content.title),
        verdicts=items(content.verdicts),
        tables=tables(
            content.kilometres, content.running, content.absorber, content.peaks, content.orders
        ),
        more=tables(content.ranges),
        notes=items(content.notes),
        picture=base64.b64encode(picture).decode(),
        made=html.escape(stamp.words()),
    )


def _table(rows: Sequence[Sequence[str]]) -> str:
    head, *body = (
        "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row) + "</tr>"
        for tag, row in [("th", rows[0]), *(("td", row) for row in rows[1:])]
    )
    lines = "\n".join(body)
    return f"<table>\n<thead>\n{head}\n</thead>\n<tbody>\n{lines}\n</tbody>\n</table>"
