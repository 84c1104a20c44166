"""A rule for each figure of the table FIGURES."""

STYLE = DRAWINGS / "tramdva.mplstyle"
# What a page is made of beside its script; drawings are made of the style, tables of nothing.
PARTS_OF = {"explorer": [DRAWINGS / f"explorer.{kind}" for kind in ("html", "css", "js")]}


def parts_of(figure, kinds):
    """Name the files that a figure is made of beside its script."""
    return PARTS_OF.get(figure, [STYLE] if "pdf" in kinds else [])


for figure, (reads, _, shows, kinds) in FIGURES.items():

    rule:
        name:
            figure
        input:
            **inputs(figure, reads),
        output:
            **outputs(figure),
        log:
            f"logs/{{line}}/{figure}.log",
        benchmark:
            f"logs/{{line}}/{figure}.tsv"
        threads: 1
        params:
            figure=figure,
            cfg=lambda w, figure=figure: values(w.line, figure),
            code=code_hash(DRAWINGS / f"{figure}.py", *parts_of(figure, kinds)),
            origin=lambda w, figure=figure: origins.of(w.line, figure),
            resolution=lambda w, figure=figure: origins.resolution(w.line, figure),
        message:
            f"{{wildcards.line}}: {shows}"
        script:
            "../../paper_figures/{params.figure}.py"
