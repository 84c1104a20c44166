"""Tables of the report: as CSV for spreadsheets and as a page. For scripts in `paper_figures/`."""

from __future__ import annotations

import csv
import html
from collections.abc import Sequence
from pathlib import Path

from tramdva.report import stamp
from tramdva.results import atomically

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ font: 14px sans-serif; background: white; color: black; }}
table {{ border-collapse: collapse; border-top: 2px solid; border-bottom: 2px solid; }}
th, td {{ padding: 0.3em 0.8em; text-align: right; }}
th:first-child, td:first-child {{ text-align: left; }}
thead th {{ border-bottom: 1px solid; vertical-align: bottom; font-weight: bold; }}
footer {{ color: #666; font-size: 0.75em; margin-top: 1.5em; }}
</style>
</head>
<body>
<table>
<thead>
{head}
</thead>
<tbody>
{body}
</tbody>
</table>
<footer>{made}</footer>
</body>
</html>
"""


def save(table: str | Path, page: str | Path, title: str, rows: Sequence[Sequence[str]]) -> None:
    """Write a table of texts, its headings first.

    Parameters
    ----------
    table, page : path
        The table as CSV and as HTML.
    title : str
        Title of the page.
    rows : sequence of sequences of str
        The cells; empty ones are dashes on the page.
    """
    with atomically(table) as part, part.open("w", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    head, *body = (
        "<tr>" + "".join(f"<{tag}>{html.escape(cell) or '–'}</{tag}>" for cell in row) + "</tr>"
        for tag, row in [("th", rows[0]), *(("td", row) for row in rows[1:])]
    )
    text = PAGE.format(
        title=html.escape(title), head=head, body="\n".join(body), made=html.escape(stamp.words())
    )
    with atomically(page) as part:
        part.write_text(text, encoding="utf-8")
