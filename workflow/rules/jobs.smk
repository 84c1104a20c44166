"""The rules of many jobs: per absorber, per order of the wheels, per part of the sample."""


rule bogie_linearisation:
    input:
        **inputs("bogie_linearisation", JOBS["bogie_linearisation"][0]),
    output:
        PATTERNS["bogie_linearisation"],
    log:
        "logs/{line}/bogie_linearisation/{absorber}.log",
    benchmark:
        "logs/{line}/bogie_linearisation/{absorber}.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, f"bogie_linearisation_{w.absorber}"),
        code=code_hash(SCRIPTS / "bogie_linearisation.py"),
    message:
        "{wildcards.line}: bogie on wheels out of round, absorber {wildcards.absorber}"
    script:
        "../scripts/bogie_linearisation.py"


# Orders are made in batches: the start of a job takes longer than an order. An order that is none of
# the run's is still made alone when it is asked for by the name of its file.
for batch in BATCHES:

    rule:
        name:
            f"bogie_simulation_{span(batch)}"
        input:
            contact_geometry="results/{line}/contact_geometry.nc",
            bogie_linearisation=PATTERNS["bogie_linearisation"],
        output:
            orders_of("bogie_simulation", batch),
        log:
            f"logs/{{line}}/bogie_simulation/{{absorber}}/{span(batch)}.log",
        benchmark:
            f"logs/{{line}}/bogie_simulation/{{absorber}}/{span(batch)}.tsv"
        threads: 1
        params:
            orders=batch,
            cfg=lambda w: values(w.line, "bogie_simulation"),
            code=code_hash(SCRIPTS / "bogie_simulation.py"),
        message:
            f"{{wildcards.line}}: {span(batch)}, absorber {{wildcards.absorber}}"
        script:
            "../scripts/bogie_simulation.py"

    rule:
        name:
            f"wear_{span(batch)}"
        input:
            bogie_simulation=orders_of("bogie_simulation", batch),
        output:
            orders_of("wear", batch),
        log:
            f"logs/{{line}}/wear/{{absorber}}/{span(batch)}.log",
        benchmark:
            f"logs/{{line}}/wear/{{absorber}}/{span(batch)}.tsv"
        threads: 1
        params:
            orders=batch,
            cfg=lambda w: values(w.line, "wear"),
            code=code_hash(SCRIPTS / "wear.py"),
        message:
            f"{{wildcards.line}}: wear by {span(batch)}, absorber {{wildcards.absorber}}"
        script:
            "../scripts/wear.py"


rule bogie_simulation:
    input:
        contact_geometry="results/{line}/contact_geometry.nc",
        bogie_linearisation=PATTERNS["bogie_linearisation"],
    output:
        PATTERNS["bogie_simulation"],
    log:
        "logs/{line}/bogie_simulation/{absorber}/order_{order}.log",
    benchmark:
        "logs/{line}/bogie_simulation/{absorber}/order_{order}.tsv"
    wildcard_constraints:
        order=OTHER_ORDERS,
    threads: 1
    params:
        cfg=lambda w: values(w.line, "bogie_simulation"),
        code=code_hash(SCRIPTS / "bogie_simulation.py"),
    message:
        "{wildcards.line}: order {wildcards.order}, absorber {wildcards.absorber}"
    script:
        "../scripts/bogie_simulation.py"


rule wear:
    input:
        bogie_simulation=PATTERNS["bogie_simulation"],
    output:
        PATTERNS["wear"],
    log:
        "logs/{line}/wear/{absorber}/order_{order}.log",
    benchmark:
        "logs/{line}/wear/{absorber}/order_{order}.tsv"
    wildcard_constraints:
        order=OTHER_ORDERS,
    threads: 1
    params:
        cfg=lambda w: values(w.line, "wear"),
        code=code_hash(SCRIPTS / "wear.py"),
    message:
        "{wildcards.line}: wear by order {wildcards.order}, absorber {wildcards.absorber}"
    script:
        "../scripts/wear.py"


rule robustness_sample:
    input:
        **inputs("robustness_sample", JOBS["robustness_sample"][0]),
    output:
        PATTERNS["robustness_sample"],
    log:
        "logs/{line}/robustness_sample/part_{part}.log",
    benchmark:
        "logs/{line}/robustness_sample/part_{part}.tsv"
    threads: 1
    params:
        cfg=lambda w: values(w.line, "robustness_sample"),
        code=code_hash(SCRIPTS / "robustness_sample.py"),
    message:
        "{wildcards.line}: bogie under varied conditions, part {wildcards.part}"
    script:
        "../scripts/robustness_sample.py"
