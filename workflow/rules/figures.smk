"""A rule for each figure of the table FIGURES."""

STYLE = DRAWINGS / "tramdva.mplstyle"
# What a drawing is made of beside its script.
PARTS_OF = {
    "explorer": [DRAWINGS / f"explorer.{kind}" for kind in ("html", "css", "js")]
}

for figure, (reads, _, shows, _) in FIGURES.items():

    rule:
        name:
            figure
        input:
            **inputs(reads),
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
            code=code_hash(DRAWINGS / f"{figure}.py", *PARTS_OF.get(figure, [STYLE])),
        message:
            f"{{wildcards.line}}: {shows}"
        script:
            "../../paper_figures/{params.figure}.py"
