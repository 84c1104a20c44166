"""A rule for each stage of the table STAGES."""

for stage, (reads, makes) in STAGES.items():

    rule:
        name:
            stage
        input:
            **inputs(stage, reads),
        output:
            f"results/{{line}}/{stage}.nc",
        log:
            f"logs/{{line}}/{stage}.log",
        benchmark:
            f"logs/{{line}}/{stage}.tsv"
        # What tells at once whether the line can run comes first.
        priority: stage in ("contact_geometry", "basic_model", "preflight")
        threads: 1
        params:
            stage=stage,
            cfg=lambda w, stage=stage: values(w.line, stage),
            code=code_hash(SCRIPTS / f"{stage}.py"),
        message:
            f"{{wildcards.line}}: {makes}"
        script:
            "../scripts/{params.stage}.py"
