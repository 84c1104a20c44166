"""Where the files of stages and figures are, and what the rules of all of them have in common."""

import itertools
from functools import partial

from tramdva.configuration.uses import stages_read, used_values
from tramdva.record.origin import Origins
from tramdva.running.code_hash import code_hash

SCRIPTS, DRAWINGS = ROOT / "workflow/scripts", ROOT / "paper_figures"
values = partial(used_values, configuration)
origins = Origins(configuration, {"STAGES": STAGES, "JOBS": JOBS, "FIGURES": FIGURES}, ROOT)

ABSORBERS = {
    name: line.study.evolution_tendency.absorbers for name, line in configuration.lines.items()
}
ORDERS = configuration.run.numerics.evolution_tendency.orders.listed()
# Orders of a job stay together whatever the first and the last order of the run.
GROUP = (
    configuration.run.numerics.orders_per_job
    * configuration.run.numerics.evolution_tendency.orders.step
)
BATCHES = [list(batch) for _, batch in itertools.groupby(ORDERS, key=lambda order: order // GROUP)]
OTHER_ORDERS = rf"(?!({'|'.join(map(str, ORDERS))})\b)[0-9]+"
PARTS = range(configuration.run.numerics.robustness_sample.parts)
# Stages whose files are made only when they are asked for.
ON_DEMAND = set(configuration.run.on_demand)
# Files of the stages of JOBS.
PATTERNS = {
    "bogie_linearisation": "results/{line}/bogie_linearisation/{absorber}.nc",
    "bogie_simulation": "results/{line}/bogie_simulation/{absorber}/order_{order}.nc",
    "wear": "results/{line}/wear/{absorber}/order_{order}.nc",
    "robustness_sample": "results/{line}/robustness_sample/part_{part}.nc",
}


wildcard_constraints:
    line="|".join(LINES),
    absorber="none|paper|tuned",
    order="[0-9]+",
    part="[0-9]+",


def files_of(stage, line):
    """Name the file of a stage; all of its files, as a list, where it is made by many jobs."""
    if stage in STAGES:
        return f"results/{line}/{stage}.nc"
    return expand(PATTERNS[stage], line=line, absorber=ABSORBERS[line], order=ORDERS, part=PARTS)


def orders_of(stage, batch):
    """Name the files of some orders of a stage."""
    return [PATTERNS[stage].replace("{order}", str(order)) for order in batch]


def span(batch):
    """Name a batch of orders by its first and last one."""
    return f"orders_{batch[0]}_{batch[-1]}"


def read_by(rule_name, stage, wildcards):
    """Name the files of a stage that a rule reads; none where its line or job needs none."""
    absorber = wildcards.get("absorber")
    is_read = stages_read(configuration, wildcards.line, rule_name, [stage], absorber)
    return files_of(stage, wildcards.line) if is_read else []


def inputs(rule_name, stages):
    """Name the files that a rule reads by the stages that make them."""
    return {
        stage: partial(lambda w, stage: read_by(rule_name, stage, w), stage=stage)
        for stage in stages
    }


def pictures_of(figure, line):
    """Name the files of a figure."""
    return [f"paper_figures/{line}/{figure}.{kind}" for kind in FIGURES[figure][-1].values()]


def outputs(figure):
    """Name the files of a figure by their kinds; the last one is shown in the report."""
    _, chapter, name, kinds = FIGURES[figure]
    files = {kind: f"paper_figures/{{line}}/{figure}.{suffix}" for kind, suffix in kinds.items()}
    shown = list(files)[-1]
    caption = ROOT / f"workflow/report/{figure}.rst"
    labels = {"line": "{line}", "shows": name}
    return files | {shown: report(files[shown], category=chapter, caption=caption, labels=labels)}
