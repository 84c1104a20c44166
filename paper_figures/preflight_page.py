"""The line at a glance: a page of the report."""

import html

from tramdva import results
from tramdva.report import preflight as glance
from tramdva.report.script import run

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ font: 14px sans-serif; background: white; color: black; max-width: 60em; margin: 1em; }}
table {{ border-collapse: collapse; width: 100%; }}
td {{ padding: 0.25em 0.8em 0.25em 0; vertical-align: top; border-bottom: 1px solid #ddd; }}
td:first-child {{ width: 38%; }}
</style>
</head>
<body>
<h1>{title}</h1>
{body}
</body>
</html>
"""


def main(*, page: str, code: str, cfg: dict, preflight: str) -> None:
    """Write the page.

    Parameters
    ----------
    page : str
        The page.
    code : str
        Hash of the code.
    cfg : dict
        Label of the line.
    preflight : str
        Result file.
    """
    parts = []
    for heading, rows in glance.sections(results.read(preflight)):
        cells = "\n".join(
            f"<tr><td>{html.escape(what)}</td><td>{html.escape(value)}</td></tr>"
            for what, value in rows
        )
        parts.append(f"<h2>{html.escape(heading)}</h2>\n<table>\n{cells}\n</table>")
    text = PAGE.format(title=html.escape(cfg["label"]), body="\n".join(parts))
    with results.atomically(page) as part:
        part.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    run(main, snakemake)
