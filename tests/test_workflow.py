"""The pipeline reruns exactly what a change concerns, and says clearly what is wrong.

A completed run is imitated: every file is touched, and Snakemake records it as made. For the keys
of a line, the record is cloned to a line per key, so that a single dry run answers for all.
"""

import base64
import fcntl
import importlib
import inspect
import json
import os
import re
import shutil
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import figure_scripts
import pytest
import snakefile_tables
import yaml

from tramdva.configuration.numerics import Numerics
from tramdva.configuration.reading import load
from tramdva.configuration.uses import USES, used_values
from tramdva.running import job, supervision
from tramdva.running.code_hash import code_hash, reached_modules
from tramdva.variables.registry import STAGES

# Keys of measured files, and such a file.
MEASURED = {
    "contact_geometry.wheel.measured": "worn_wheel.csv",
    "contact_geometry.rail.measured": "worn_rail.csv",
    "out_of_roundness.measured": "out_of_round.csv",
    "route.file": "route.csv",
}
ROUTE = "name,length_m,radius_m,turn,speed_km_h\nroad,900,,straight,40\nbend,39,25,left,14\n"
TABLES = snakefile_tables.read()
UPSTREAM = TABLES.reads
# Inputs that the paper's line has none of.
IDLE = {("bogie_linearisation", "curving_equilibrium")} | {
    (rule, "basic_model")
    for rule, reads in UPSTREAM.items()
    if "basic_model" in reads and rule != "preflight"
}
RULES = set(UPSTREAM)
TABULAR = {figure for figure, kinds in TABLES.kinds.items() if "table" in kinds}
FIGURES = [figure for figure in TABLES.figures if figure not in TABULAR]
PER_JOB = ["bogie_linearisation", "bogie_simulation", "wear"]
ABSORBERS, ORDERS, PARTS = ("none", "paper"), (34, 35), range(2)
BOGIE = [
    "basic_model", "preflight", "curving_equilibrium", "bogie_modes", "growth_band", "curve_entry",
]  # fmt: skip
# They hold what a run computes, which nearly every key of ranges and numerics says.
GLANCE = {"preflight", "preflight_page", "preflight_chart"}
# Of the route; all of them run the bogie, without self-excitation.
OF_ROUTE = ["route_tuning", "route_response", "route_remedies", "polygon_simulation"]
ROUGH_BOGIE = [
    "bogie_linearisation", "tendency_maps", "bogie_designs", "robustness_sample", *OF_ROUTE,
]  # fmt: skip
WHEELS = [
    *ROUGH_BOGIE, "bogie_simulation", "wear", "evolution_tendency", "robust_tuning",
    "polygon_growth",
]  # fmt: skip
BASIC = [stage for stage in STAGES if stage not in {"contact_geometry", *BOGIE, *WHEELS}]
WORN = [
    "wear", "evolution_tendency", "tendency_maps", "bogie_designs", "robustness_sample", *OF_ROUTE,
]  # fmt: skip
WITH_VARIANTS = ["stability_map", "hopf_points", "limit_cycles"]
WITH_CRITICAL_CURVE = ["hopf_curves", "critical_hopf_curve", "cycle_amplitudes", "absorber_tuning"]

# The rules that use a key themselves; the longest prefix counts.
USERS = {
    "label": FIGURES,
    "curve": [*BASIC, "basic_model"],
    "creep_force": BASIC,
    **{f"creep_force.{name}": [*BASIC, "basic_model"] for name in ("F_N", "a", "b", "c_22")},
    "creep_force.A": [*BASIC, *BOGIE, *ROUGH_BOGIE],
    "creep_force.mu_0": [*BASIC, *BOGIE, *ROUGH_BOGIE, "design_sheet"],
    "creep_force.B": [
        *BASIC,
        *BOGIE,
        "bogie_designs",
        "bogie_stability",
        "explorer",
        "robustness_sample",
        "route_tuning",
        "polygon_simulation",
        "design_sheet",
    ],
    "wheelset": [*BASIC, "basic_model"],
    "wheelset.L": BASIC,
    "track": [*BOGIE, *ROUGH_BOGIE],
    "track.gravity": [*BOGIE, *ROUGH_BOGIE, "robust_tuning"],
    # How far a wheel can yaw, and where it is.
    "track.radius": ["contact_geometry", *BOGIE, *ROUGH_BOGIE, "design_sheet"],
    **{
        f"bogie.{name}": ["contact_geometry", *BOGIE, *ROUGH_BOGIE, "fig08_bogie"]
        for name in ("half_wheelbase", "wheel.half_distance")
    },
    "track.speed": [*BOGIE, *ROUGH_BOGIE, "campbell_chart", "design_sheet"],
    "bogie": [*BOGIE, *ROUGH_BOGIE, "fig08_bogie"],
    "bogie.absorber.motion": [
        *BOGIE,
        *ROUGH_BOGIE,
        "fig08_bogie",
        "bogie_stability",
        "tendency_design_chart",
        "explorer",
        "robust_tuning",
        "design_sheet",
    ],
    "bogie.car_body.mass": [*BOGIE, *ROUGH_BOGIE, "fig08_bogie", "design_sheet"],
    "bogie.absorber": [*BOGIE, *ROUGH_BOGIE, "fig08_bogie", "robust_tuning", "design_sheet"],
    **{
        f"bogie.absorber.{name}": [
            *BOGIE,
            *OF_ROUTE,
            "bogie_linearisation",
            "tendency_maps",
            "bogie_designs",
            "fig08_bogie",
            "robust_tuning",
            "design_sheet",
        ]
        for name in ("c_T", "d_T")
    },
    "bogie.wheel.radius": [
        "contact_geometry",
        *BOGIE,
        *ROUGH_BOGIE,
        "fig08_bogie",
        "bogie_mode_shapes",
        "campbell_chart",
        "order_speed_chart",
        "robust_tuning",
    ],
    "contact_geometry": ["contact_geometry", *BOGIE, *ROUGH_BOGIE],
    # Tables are of the profiles alone.
    "contact_geometry.material": [*BOGIE, *ROUGH_BOGIE],
    "contact_geometry.creep_law": [*BOGIE, *ROUGH_BOGIE],
    "out_of_roundness": ["bogie_simulation"],
    "out_of_roundness.wheels": [
        "bogie_simulation",
        "evolution_tendency",
        "tendency_maps",
        "bogie_designs",
        "robustness_sample",
        "route_remedies",
    ],
    "wear": WORN,
    "route": [*OF_ROUTE, "polygon_growth"],
    "study.evolution_tendency": ["evolution_tendency", "tendency_maps"],
    "study.evolution_tendency.frequency": [
        "basic_model",
        "evolution_tendency",
        "tendency_maps",
        "bogie_designs",
    ],
    "study.evolution_tendency.peaks": [
        "evolution_tendency",
        "tendency_maps",
        "robustness_sample",
        "robust_tuning",
    ],
    "study.tendency_maps": ["tendency_maps"],
    "study.tendency_maps.radius.min": ["contact_geometry", "tendency_maps"],
    "study.tendency_maps.c_T": ["tendency_maps", "robust_tuning"],
    "study.tendency_maps.d_T": ["tendency_maps", "robust_tuning"],
    "study.design_sheet": ["robust_tuning", "design_sheet"],
    "study.design_sheet.conditions": ["robustness_sample", "robust_tuning", "design_sheet"],
    "study.design_sheet.conditions.radius.min": [
        "contact_geometry",
        "robustness_sample",
        "robust_tuning",
        "design_sheet",
    ],
    "study.design_sheet.rubber": ["robustness_sample", "robust_tuning", "design_sheet"],
    "study.tendency_maps.design_band": [
        "evolution_tendency",
        "tendency_maps",
        "tendency_design_chart",
        "bogie_designs",
        "explorer",
        "robustness_sample",
        "robust_tuning",
        "route_remedies",
        "design_sheet",
    ],
    "study.bogie_modes": ["bogie_modes", "growth_band"],
    "study.bogie_modes.B_max": ["bogie_modes", "growth_band", "design_sheet"],
    "study.bogie_modes.frequency": [
        "basic_model",
        "curving_equilibrium",
        "bogie_modes",
        "growth_band",
        "robustness_sample",
        "robust_tuning",
        "design_sheet",
    ],
    "study.curve_entry": ["curve_entry"],
    "study.curve_entry.entry": ["curve_entry", "fig09_curve_entry"],
    "numerics.orders_per_job": [],  # a way to compute, as long as the orders of a job stay together
    "numerics.bogie": [*BOGIE, *ROUGH_BOGIE],
    "numerics.wear": WORN,
    "wheelset.c_A": [
        "basic_model",
        "stability_map",
        "cycle_amplitudes",
        "absorber_tuning",
        "frequency_response",
        "wheelset_designs",
    ],
    "absorber": [
        "basic_model",
        "absorber_tuning",
        "wheelset_designs",
        "fig02_stability_map",
        "fig05_critical_hopf_curve",
    ],
    "absorber.m_T": ["basic_model", *WITH_VARIANTS, *WITH_CRITICAL_CURVE, "wheelset_designs"],
    "forced_excitation": [
        "absorber_tuning",
        "frequency_response",
        "wheelset_designs",
        *ROUGH_BOGIE,
        "explorer",
        "design_sheet",
    ],
    "absorber_variants": WITH_VARIANTS,
    "absorber_variants.name": [
        *WITH_VARIANTS,
        "fig02_stability_map",
        "fig03_bifurcation_diagram",
    ],
    "absorber_variants.label": ["fig02_stability_map", "fig03_bifurcation_diagram"],
    "study.stability_map": ["stability_map"],
    "study.stability_map.c_A": ["stability_map", "wheelset_designs"],
    "study.stability_map.c_R": ["stability_map", "wheelset_designs"],
    "study.wheelset_designs": ["wheelset_designs"],
    "study.bogie_designs": ["bogie_designs"],
    "study.limit_cycles": ["limit_cycles"],
    "study.hopf_curves": ["hopf_curves"],
    "study.critical_hopf_curve": ["critical_hopf_curve"],
    "study.cycle_amplitudes": ["cycle_amplitudes"],
    "study.frequency_response": ["absorber_tuning", "frequency_response", "wheelset_designs"],
} | {
    f"numerics.{stage}": [stage] for stage in STAGES if stage not in ("curving_equilibrium", "wear")
}
USERS["numerics.route_response"] = ["route_tuning", "route_response", "route_remedies"]
for own in ("contact_geometry", "bogie_modes"):  # the band asks for finer ones, and for no other
    USERS[f"numerics.{own}"] = [own, "growth_band"]


def concerned(key: str) -> set[str]:
    """The rules that a change of a key concerns, directly or through the files of others."""
    prefixes = [p for p in USERS if key == p or key.startswith(f"{p}.")]
    return with_downstream(set(USERS[max(prefixes, key=len)]))


def changed(tree: object) -> Iterator[tuple[str, object]]:
    """Each value changed in turn: its key and the smallest tree that holds the new value."""
    if isinstance(tree, dict):
        for name, value in tree.items():
            # The absorbers sit at the end of the axle, the stubs between the wheels: both may
            # only become longer.
            longer = name in ("half_length", "half_distance")
            bent = [("", 1.01 * value)] if longer else changed(value)
            for key, new in bent:
                yield f"{name}.{key}".rstrip("."), {name: new}
    elif isinstance(tree, list) and isinstance(tree[0], dict):
        for key, new in changed(tree[0]):
            yield key, [tree[0] | new, *tree[1:]]
    elif isinstance(tree, list) and isinstance(tree[0], str):
        yield "", tree[:-1]
    elif isinstance(tree, list | tuple):
        yield "", [tree[0] * 1.01, *tree[1:]]
    elif isinstance(tree, str):
        words = {
            "rotation": "translation", "chart": "smoothed", "half_space": "fastsim",
            "there_and_back": "lap", "reverse": "loop", "smoothed": "constant",
        }  # fmt: skip
        yield "", words.get(tree, f"{tree}x")
    elif isinstance(tree, int):
        yield "", tree + 1
    else:
        yield "", tree * 0.99 or 1e-3


def files_of(rule: str, line: str) -> list[str]:
    if rule in TABLES.figures:
        return [f"paper_figures/{line}/{rule}.{end}" for end in TABLES.kinds[rule].values()]
    if rule in TABLES.stages:
        return [f"results/{line}/{rule}.nc"]
    if rule == "bogie_linearisation":
        names = list(ABSORBERS)
    elif rule == "robustness_sample":
        names = [f"part_{part}" for part in PARTS]
    else:
        names = [f"{absorber}/order_{order}" for absorber in ABSORBERS for order in ORDERS]
    return [f"results/{line}/{rule}/{name}.nc" for name in names]


def table_entry(rule: str) -> str:
    """The stage of a rule: rules for some of the orders bear its name and these."""
    return re.sub(r"_orders_\d+_\d+$", "", rule)


def make_files(folder: Path, line: str) -> None:
    for rule in RULES:
        for name in files_of(rule, line):
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(rule)


def planned(summary: str) -> dict[str, set[str]]:
    """Rules that are to be run, by line, as `snakemake --summary` tells."""
    plan: dict[str, set[str]] = {}
    for row in summary.splitlines()[1:]:
        name, _, rule, *_, action = row.split("\t")
        rules = plan.setdefault(Path(name).parts[1], set())
        if action == "update pending":
            rules.add(table_entry(rule))
    return plan


def summary(snakemake, folder: Path, *arguments: str, **where) -> dict[str, set[str]]:
    ended = snakemake(folder, "--summary", *arguments, **where)
    assert ended.returncode == 0, ended.stderr
    return planned(ended.stdout)


@pytest.fixture(scope="session")
def completed_once(frozen_code: Path, snakemake, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("completed")
    shutil.copytree(frozen_code / "config", folder / "config")
    path = folder / "config/config.yaml"
    few, count = re.subn(
        r"(evolution_tendency:\n +)orders: .*",
        rf"\1orders: {{first: {ORDERS[0]}, last: {ORDERS[-1]}, step: 1}}",
        path.read_text(encoding="utf-8"),
    )
    assert count == 1
    for key, value in (("lines", "[paper]"), ("on_demand", "[]")):
        few, count = re.subn(rf"(?m)^{key}: .*", f"{key}: {value}", few)
        assert count == 1
    path.write_text(few, encoding="utf-8")
    (folder / "config/profiles/route.csv").write_text(ROUTE)
    make_files(folder, "paper")
    (folder / supervision.FOLDER).mkdir()
    with (folder / supervision.ALIVE).open("w") as alive:
        fcntl.flock(alive, fcntl.LOCK_SH)  # nobody sets files aside while others are at work
        ended = snakemake(folder, "--touch", "--forceall", "--quiet", "all")
    assert ended.returncode == 0, ended.stderr
    return folder


@pytest.fixture
def completed(completed_once: Path, tmp_path: Path) -> Path:
    """A folder in which everything is made, for a test to change."""
    return shutil.copytree(completed_once, tmp_path / "run")


def clone_line(folder: Path, line: str) -> None:
    """Let a line be completed that has the same values as the paper's."""
    for rule in RULES:
        for old, new in zip(files_of(rule, "paper"), files_of(rule, line), strict=True):
            (folder / new).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(folder / old, folder / new)
            record = (folder / ".snakemake/metadata" / encoded(old)).read_text()
            for root in ("results", "paper_figures", "logs"):
                record = record.replace(f"{root}/paper/", f"{root}/{line}/")
            (folder / ".snakemake/metadata" / encoded(new)).write_text(record)


def measured_as(key: str, name: str) -> dict:
    """A line's content that gives a measured file."""
    for part in reversed(key.split(".")):
        name = {part: name}
    return name


def encoded(name: str) -> str:
    return base64.b64encode(name.encode()).decode()


def merged(below: object, above: object) -> object:
    if not (isinstance(below, dict) and isinstance(above, dict)):
        return above
    return below | {key: merged(below.get(key), value) for key, value in above.items()}


def write_line(folder: Path, name: str, content: dict) -> None:
    """A line that gives all values, so that nothing follows from its bogie."""
    paper = yaml.safe_load((folder / "config/lines/paper.yaml").read_text(encoding="utf-8"))
    text = yaml.safe_dump(merged(paper, content), allow_unicode=True)
    (folder / f"config/lines/{name}.yaml").write_text(text, encoding="utf-8")


def test_nothing_to_do_when_complete(completed: Path, snakemake) -> None:
    assert summary(snakemake, completed) == {"paper": set()}


def test_each_key_of_a_line_reruns_its_dependants(completed: Path, snakemake) -> None:
    paper = load(completed / "config").lines["paper"]
    every = changed(paper.model_dump(mode="json", exclude_none=True))
    changes = [(key, new) for key, new in every if not key.endswith(".turn")]  # needs a radius
    for number, (key, _) in enumerate(changes):
        if key in MEASURED:
            changes[number] = key, measured_as(key, f"profiles/{MEASURED[key]}")
    keys = {f"key{number}": key for number, (key, _) in enumerate(changes)}
    for line, (_, content) in zip(keys, changes, strict=True):
        clone_line(completed, line)
        write_line(completed, line, content)
    clone_line(completed, "same")
    write_line(completed, "same", {})

    plan = summary(snakemake, completed, "--config", f"lines=[same,{','.join(keys)}]")

    assert plan.pop("same") == set()
    assert len(plan) > 50
    for line, rules in plan.items():
        assert rules - GLANCE == concerned(keys[line]) - GLANCE, keys[line]
        if keys[line].startswith(("track.", "bogie.")):
            assert rules >= GLANCE, keys[line]


@pytest.mark.parametrize("key", MEASURED)
def test_content_of_a_measured_file_counts_not_its_date(
    completed: Path, snakemake, key: str
) -> None:
    path = completed / "config/profiles" / MEASURED[key]
    write_line(completed, "x", measured_as(key, f"profiles/{path.name}"))
    only_x = ("--config", "lines=[x]")
    make_files(completed, "x")
    with (completed / supervision.ALIVE).open("w") as alive:
        fcntl.flock(alive, fcntl.LOCK_SH)
        ended = snakemake(completed, "--touch", "--forceall", "--quiet", "all", *only_x)
    assert ended.returncode == 0, ended.stderr
    assert summary(snakemake, completed, *only_x) == {"x": set()}

    *points, last = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join(points) + "\n", encoding="utf-8")
    os.utime(path, (1e9, 1e9))  # older than all that was made from its predecessor

    users = {"out_of_roundness.measured": ["bogie_simulation"], "route.file": USERS["route"]}
    concerns = with_downstream(set(users.get(key, ["contact_geometry"])))
    assert summary(snakemake, completed, *only_x) == {"x": concerns}
    append(path, f"{last}\n")
    assert summary(snakemake, completed, *only_x) == {"x": set()}


@pytest.mark.refuses
@pytest.mark.parametrize("key", MEASURED)
@pytest.mark.parametrize(
    ("content", "said"),
    [(None, "there is no file config/profiles/x.csv"), ("1 2 3\n", "config/profiles/x.csv")],
)
def test_wrong_measured_file_stops_the_run_before_it_starts(
    completed: Path, snakemake, key: str, content: str | None, said: str
) -> None:
    write_line(completed, "x", measured_as(key, "profiles/x.csv"))
    if content:
        (completed / "config/profiles/x.csv").write_text(content)

    ended = snakemake(completed, "-n", "--config", "lines=[x]")

    lines = [line for line in ended.stderr.splitlines() if "workflow specific profile" not in line]
    assert ended.returncode == 1
    assert len(lines) == 1
    assert said in lines[0]
    assert content or lines[0].startswith(f"config/lines/x.yaml: {key} = profiles/x.csv: ")


def test_each_key_of_the_numerics_belongs_to_its_stage(completed: Path) -> None:
    loaded = load(completed / "config")
    before = {rule: used_values(loaded, "paper", rule) for rule in USES}
    numerics = loaded.run.numerics.model_dump()
    changes = list(changed({"numerics": numerics}))
    assert len(changes) > 15
    for key, content in changes:
        other = load(completed / "config", overrides=content)
        differing = {r for r in before if used_values(other, "paper", r) != before[r]}
        differing = {re.sub("_(none|paper|tuned)$", "", name) for name in differing} - GLANCE
        prefixes = [p for p in USERS if key == p or key.startswith(f"{p}.")]
        assert differing == set(USERS[max(prefixes, key=len)]) - GLANCE, key


@pytest.mark.parametrize("stage", Numerics.model_fields)
def test_numerics_of_a_stage_rerun_its_dependants(completed: Path, snakemake, stage: str) -> None:
    numerics = load(completed / "config").run.numerics.model_dump()[stage]
    if stage == "evolution_tendency":
        del numerics["orders"]  # they concern jobs of simulation as well
    _, content = next(changed({"numerics": {stage: numerics}}))
    (completed / "other.yaml").write_text(yaml.safe_dump(content))

    plan = summary(snakemake, completed, "--configfile", str(completed / "other.yaml"))

    assert plan["paper"] - GLANCE == concerned(f"numerics.{stage}") - GLANCE


def test_swapped_values_rerun(completed: Path, snakemake) -> None:
    clone_line(completed, "x")
    write_line(completed, "x", {"wheelset": {"c_R": 5.2e7, "c_A": 4.9e7}})

    plan = summary(snakemake, completed, "--config", "lines=[x]")

    assert plan == {"x": concerned("wheelset.c_R")}


def test_notation_order_and_comments_rerun_nothing(completed: Path, snakemake) -> None:
    path = completed / "config/lines/paper.yaml"
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    backwards = {key: content[key] for key in reversed(content)}
    backwards["curve"] = {"outer_speed": "4.150", "gamma": -4e-2, "r_C": 25.750}
    text = yaml.safe_dump(backwards, allow_unicode=True, sort_keys=False)
    path.write_text(f"# another comment\n{text}", encoding="utf-8")

    assert summary(snakemake, completed) == {"paper": set()}


def test_second_line_runs_alone(completed: Path, snakemake) -> None:
    write_line(completed, "dresden", {"label": "Dresden", "wheelset": {"c_A": 6.0e7}})

    plan = summary(snakemake, completed, "--config", "lines=[paper,dresden]")

    assert plan == {"paper": set(), "dresden": RULES}


def test_lost_intermediate_is_made_again(completed: Path, snakemake) -> None:
    (completed / "results/paper/hopf_curves.nc").unlink()

    assert summary(snakemake, completed)["paper"] >= {"hopf_curves"}


def append(path: Path, text: str) -> None:
    path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")


def script_of(code: Path, rule: str) -> Path:
    folder = "workflow/scripts" if rule in STAGES else "paper_figures"
    return code / folder / f"{rule}.py"


def with_downstream(rules: set[str]) -> set[str]:
    def reached(rule: str, upstream: list[str]) -> bool:
        return any(other in rules and (rule, other) not in IDLE for other in upstream)

    while more := {rule for rule, up in UPSTREAM.items() if reached(rule, up)} - rules:
        rules = rules | more
    return rules


def pending(snakemake, folder: Path, *arguments: str) -> set[str]:
    """Files that are to be made."""
    ended = snakemake(folder, "--summary", *arguments)
    assert ended.returncode == 0, ended.stderr
    rows = [row.split("\t") for row in ended.stdout.splitlines()[1:]]
    return {row[0] for row in rows if row[-1] == "update pending"}


def test_absorber_of_the_bogie_reruns_its_own_variant(completed: Path, snakemake) -> None:
    clone_line(completed, "x")
    write_line(completed, "x", {"bogie": {"absorber": {"d_T": 400}}})

    files = pending(snakemake, completed, "--config", "lines=[x]")

    assert {name for name in files if "/paper" in name} == {
        "results/x/bogie_linearisation/paper.nc",
        *(f"results/x/{rule}/paper/order_{n}.nc" for rule in PER_JOB[1:] for n in ORDERS),
    }
    assert not {name for name in files if "/none" in name}
    assert "results/x/evolution_tendency.nc" in files


def test_wear_hardness_reruns_no_simulation(completed: Path, snakemake) -> None:
    clone_line(completed, "x")
    write_line(completed, "x", {"wear": {"hardness": 2.9e9}})

    plan = summary(snakemake, completed, "--config", "lines=[x]")

    assert plan["x"] == with_downstream(set(WORN))
    assert not plan["x"] & {"bogie_simulation", "bogie_linearisation", "curving_equilibrium"}


@pytest.mark.parametrize(
    ("change", "made"),
    [
        ("{last: 36}", {36}),  # 36 to 47 are those of one job of twelve orders
        ("{first: 33}", {33, *ORDERS}),
        ("{first: 35}", {35}),
    ],
)
def test_another_range_of_orders_runs_the_jobs_at_its_ends(
    completed: Path, snakemake, change: str, made: set[int]
) -> None:
    more = completed / "more.yaml"
    more.write_text(f"numerics: {{orders_per_job: 12, evolution_tendency: {{orders: {change}}}}}")

    files = pending(snakemake, completed, "--configfile", str(more))

    assert {name for name in files if "order_" in name} == {
        f"results/paper/{rule}/{absorber}/order_{order}.nc"
        for rule in PER_JOB[1:]
        for absorber in ABSORBERS
        for order in made
    }


def test_order_that_the_run_has_not_is_made_alone(completed: Path, snakemake) -> None:
    ended = snakemake(completed, "-n", "--cores", "1", "results/paper/wear/none/order_7.nc")

    assert ended.returncode == 0, ended.stderr
    jobs = dict(re.findall(r"^(\w+) +(\d+)$", ended.stdout, re.MULTILINE))
    assert jobs == {"bogie_simulation": "1", "wear": "1", "total": "2"}


def test_tuned_absorber_waits_for_its_tuning(completed: Path, snakemake) -> None:
    write_line(completed, "x", {"study": {"evolution_tendency": {"absorbers": ["none", "tuned"]}}})
    ended = snakemake(
        completed, "-n", "--cores", "1", "results/x/bogie_linearisation/tuned.nc", "--config",
        "lines=[x]",
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    assert "curving_equilibrium" in ended.stdout


@pytest.mark.parametrize(
    "module",
    [
        "wheelset/model",
        "wheelset/tuning",
        "bifurcation/critical_hopf",
        "stages/hopf_points",
        "variables/shared",
        "results",
        "running/job",
        "configuration/reading",
    ],
)
def test_edited_module_reruns_its_users(
    completed: Path, code: Path, snakemake, module: str
) -> None:
    append(code / f"src/tramdva/{module}.py", "\n_edited = True\n")
    users = {
        rule
        for rule in RULES
        if f"tramdva.{module.replace('/', '.')}" in reached_modules(script_of(code, rule))
    }

    plan = summary(snakemake, completed, code=code)

    assert plan == {"paper": with_downstream(users)}


def test_each_edited_module_changes_the_hash_of_its_users_alone(code: Path) -> None:
    """Which scripts reach a module is compared with what Python loads in test_provenance."""
    package = code / "src/tramdva"
    scripts = {rule: script_of(code, rule) for rule in RULES}
    before = {rule: code_hash(script, package=package) for rule, script in scripts.items()}
    reached = {rule: reached_modules(script, package) for rule, script in scripts.items()}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        module = ".".join(part for part in parts if part != "__init__")
        text = path.read_text(encoding="utf-8")
        append(path, "\n_edited = True\n")
        after = {rule: code_hash(script, package=package) for rule, script in scripts.items()}
        path.write_text(text, encoding="utf-8")
        assert {r for r in RULES if after[r] != before[r]} == {
            rule for rule in RULES if module in reached[rule]
        }, module


def test_edited_figure_redraws_itself(completed: Path, code: Path, snakemake) -> None:
    append(code / "paper_figures/fig05_critical_hopf_curve.py", "\n_edited = True\n")

    plan = summary(snakemake, completed, code=code)

    assert plan == {"paper": {"fig05_critical_hopf_curve"}}


def test_edited_style_redraws_all_figures(completed: Path, code: Path, snakemake) -> None:
    append(code / "paper_figures/tramdva.mplstyle", "\nlines.linewidth: 3\n")

    plan = summary(snakemake, completed, code=code)

    assert plan == {"paper": set(FIGURES) - {"explorer", "preflight_page"}}


def test_edited_script_of_the_page_makes_it_anew(completed: Path, code: Path, snakemake) -> None:
    append(code / "paper_figures/explorer.js", "\n// another word\n")

    assert summary(snakemake, completed, code=code) == {"paper": {"explorer"}}


def test_touch_comments_and_docstrings_rerun_nothing(
    completed: Path, code: Path, snakemake
) -> None:
    others = (*code.rglob("*.mplstyle"), *code.rglob("*.smk"), code / "Snakefile")
    for path in [*code.rglob("*.py"), *others]:
        if path.suffix == ".py":
            append(path, "\n# a comment\n")
        path.touch()
    model = code / "src/tramdva/wheelset/model.py"
    model.write_text(re.sub(r'^"""', '"""Changed. ', model.read_text(encoding="utf-8")))

    assert summary(snakemake, completed, code=code) == {"paper": set()}


@pytest.mark.parametrize("arguments", [["-n"], ["-j2"], ["--summary"]])
def test_wrong_configuration_shows_the_problems_alone(
    completed: Path, snakemake, arguments: list[str]
) -> None:
    write_line(completed, "x", {"wheelset": {"c_A": 5.2e4}})

    ended = snakemake(completed, *arguments, "--config", "lines=[x,../y,papr]")

    assert ended.returncode == 1
    assert ended.stdout == ""
    lines = [line for line in ended.stderr.splitlines() if "workflow specific profile" not in line]
    assert lines == [
        '--config: lines[1] = "../y": must be a name of lower-case letters, digits, - and _, '
        "at most 41 of them",
        "config/lines/x.yaml: wheelset.c_A = 52000.0: must be between 1e6 and 1e10 N/m "
        "(effective stiffness of axle and primary suspension)",
        "--config: lines[2] = papr: there is no config/lines/papr.yaml; did you mean paper?",
    ]


def test_catalog_finds_the_same_jobs(root: Path, tmp_path: Path, snakemake) -> None:
    tables = []
    for snakefile in ("Snakefile", "workflow/Snakefile"):
        asked = ("-n", "--cores", "1", "--config", "on_demand=[]")
        ended = snakemake(tmp_path, *asked, snakefile=snakefile)
        assert ended.returncode == 0, ended.stderr
        jobs: Counter[str] = Counter()
        told = dict(re.findall(r"^(\w+) +(\d+)$", ended.stdout, re.MULTILINE))  # twice the same
        for rule, number in told.items():
            jobs[table_entry(rule)] += int(number)
        tables.append({rule: number for rule, number in jobs.items() if rule in RULES})

    loaded = load(root / "config")
    orders = loaded.run.numerics.evolution_tendency.orders.listed()
    batches = len({order // loaded.run.numerics.orders_per_job for order in orders})
    assert batches == 3
    many = {
        "bogie_linearisation": 2,
        "bogie_simulation": 2 * batches,
        "wear": 2 * batches,
        "robustness_sample": len(PARTS),
    }
    expected = {rule: len(loaded.lines) * many.get(rule, 1) for rule in RULES}
    assert tables[0] == tables[1] == expected


def test_own_configuration_of_the_working_directory_counts(
    frozen_code: Path, tmp_path: Path, snakemake
) -> None:
    shutil.copytree(frozen_code / "config", tmp_path / "config")
    write_line(tmp_path, "dresden", {"label": "Dresden"})
    append(tmp_path / "config/config.yaml", "\n")
    path = tmp_path / "config/config.yaml"
    own = re.sub(r"(?m)^lines: .*", "lines: [dresden]", path.read_text())
    path.write_text(re.sub(r"(?m)^on_demand: .*", "on_demand: []", own))

    assert summary(snakemake, tmp_path) == {"dresden": RULES}


BROKEN = """
rule all:
    input: "made"

rule broken:
    output: "made"
    log: "logs/broken.log"
    script: "broken.py"
"""


@pytest.mark.parametrize(
    ("raised", "said"),
    [
        ("ValueError('no Hopf point\\n at all')", "ValueError: no Hopf point at all"),
        ("FloatingPointError()", "FloatingPointError: no reason given"),
    ],
)
def test_failing_job_says_one_line_and_logs_the_traceback(
    tmp_path: Path, snakemake, raised: str, said: str
) -> None:
    (tmp_path / "Snakefile").write_text(BROKEN)
    (tmp_path / "broken.py").write_text(
        "import logging, sys, os, warnings\nfrom tramdva.running import job\n"
        "with job.logging_to(snakemake.log[0]):\n"
        "    print('printed'); logging.info('logged'); warnings.warn('warned')\n"
        "    os.system('echo child'); print('error', file=sys.stderr)\n"
        f"    raise {raised}\n"
    )

    ended = snakemake(tmp_path, "-c1", snakefile=str(tmp_path / "Snakefile"))

    log = (tmp_path / "logs/broken.log").read_text()
    assert ended.returncode == 1
    assert f"{said} (see logs/broken.log)\n" in ended.stderr
    assert "Traceback" not in ended.stdout + ended.stderr
    for text in ("printed", "logged", "warned", "child", "error", "Traceback"):
        assert text in log, text


def test_times_of_jobs_are_told(tmp_path: Path) -> None:
    for stage, seconds in (("hopf_points", "2.25"), ("stability_map", "1.5")):
        path = tmp_path / f"paper/{stage}.tsv"
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"s\th:m:s\tmax_rss\n{seconds}\t0:00:02\t100\n")
        time.sleep(0.01)

    assert job.summary(["paper"], tmp_path).splitlines() == [
        "tramdva: results/ and paper_figures/ are complete.",
        "      2.2 s  paper/hopf_points",
        "      1.5 s  paper/stability_map",
    ]


def rules_of(root: Path) -> Iterator[tuple[str, str]]:
    """Where each rule of the tables is made and its text, unindented."""
    for path in sorted((root / "workflow/rules").glob("*.smk")):
        rule = re.compile(r"^( *)rule(?: \w+)?:\n((?:\1    .*\n|\n)*)", re.MULTILINE)
        for indent, body in rule.findall(path.read_text(encoding="utf-8")):
            yield path.name, re.sub(f"^{indent}    ", "", body, flags=re.MULTILINE)


def test_rules_declare_the_same_directives(root: Path) -> None:
    """Order of directives in every rule; a deviation is then visible."""
    order = ["input", "output", "log", "benchmark", "threads", "params", "message", "script"]
    for name, body in rules_of(root):
        directives = re.findall(r"^(\w+):", body, re.MULTILINE)
        own = [d for d in directives if d not in ("name", "wildcard_constraints", "priority")]
        assert own == order, f"{name}:\n{body}"
        assert "name" not in directives[1:]
    assert {name for name, _ in rules_of(root)} == {"figures.smk", "jobs.smk", "stages.smk"}


def test_jobs_read_what_the_table_says(root: Path) -> None:
    seen = set()
    for name, body in rules_of(root):
        if name == "jobs.smk":
            (script,) = re.findall(r"^script:\n    \"\.\./scripts/(\w+)\.py\"", body, re.MULTILINE)
            block = re.search(r"^input:\n((?:    .*\n)*)", body, re.MULTILINE)[1]
            told = re.findall(r"^    (\w+)=", block, re.MULTILINE)
            of_the_table = f'    **inputs("{script}", JOBS["{script}"][0]),\n'
            assert block == of_the_table or told == TABLES.jobs[script]
            seen.add(script)
    assert seen == set(TABLES.jobs)


@pytest.mark.parametrize("stage", STAGES)
def test_stages_use_the_inputs_of_their_rules(stage: str) -> None:
    module = importlib.import_module(f"tramdva.stages.{stage}")
    offered = {"cfg", "file_of", "absorber", "order", "part"}

    assert next(iter(inspect.signature(module.compute).parameters)) == "cfg"
    # What a line leaves to its bogie is filled in before the stage is called.
    filled = {"basic_model"} if (stage, "basic_model") in IDLE else set()
    asked = set(inspect.signature(module.compute).parameters) - offered
    assert asked | filled == set(UPSTREAM[stage]) | filled
    assert module.VARIABLES is STAGES[stage]


@pytest.mark.parametrize("figure", TABLES.figures)
def test_figures_use_the_inputs_of_their_rules(figure: str) -> None:
    parameters = set(inspect.signature(figure_scripts.script(figure).main).parameters)
    kinds = set(TABLES.kinds[figure])

    assert parameters >= kinds
    assert parameters - kinds - {"cfg", "code", "line"} == set(TABLES.figures[figure])


def test_tables_name_what_there_is(root: Path) -> None:
    scripts = {path.stem for path in (root / "workflow/scripts").glob("*.py")}
    drawings = {path.stem for path in (root / "paper_figures").glob("*.py")}

    assert scripts == set(STAGES) == {*TABLES.stages, *TABLES.jobs}
    assert drawings == set(TABLES.figures)


def test_parameters_of_jobs_are_plain_json(root: Path) -> None:
    loaded = load(root / "config")
    for rule in USES:
        values = used_values(loaded, "paper", rule)
        assert json.loads(json.dumps(values)) == values
