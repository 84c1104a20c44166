"""Who knows whom: packages, not modules; and how much of the model each stage reaches."""

import ast
import re
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from tramdva.running.code_hash import reached_modules
from tramdva.variables.registry import STAGES

PACKAGE = Path(__file__).resolve().parents[1] / "src/tramdva"
MODULES = {
    ".".join(path.relative_to(PACKAGE).with_suffix("").parts).removesuffix(".__init__"): path
    for path in sorted(PACKAGE.rglob("*.py"))
}

# What each package may know. Those of the model first, lower ones before higher ones.
MODEL = {
    "bifurcation": set(),
    "track": set(),
    "contact": set(),
    "wheelset": {"contact", "bifurcation"},
    "bogie": {"contact", "track", "bifurcation"},
    "wear": {"contact"},
    "evolution": {"bogie", "wear", "contact"},
    "robustness": {"bogie", "evolution"},
    "route": {"evolution", "bogie", "wear", "contact"},
    "identification": {"wheelset", "bogie"},
}
AROUND = {
    "quantities": set(),
    "running": set(),
    "variables": set(),
    "stages": {*MODEL, "variables"},
    "configuration": {"quantities"},
    "results": {"variables", "running"},
    "report": {"results", "running", "variables"},
    "record": {"configuration", "results", "running"},
    "importing": {"route", "report", "results"},
}
KNOWS = MODEL | AROUND
AT_THE_ROOT = {"__init__", "quantities", "results"}
PARAMETERS = {module for module in MODULES if module.endswith(".parameters")}
READ_MEASUREMENTS = {
    "contact.two_columns",
    "contact.measured_profile",
    "evolution.out_of_roundness",
    "route.sections",
}
CHECK_MEASUREMENTS = READ_MEASUREMENTS | {"contact.tables"}  # with profiles of the parameters
READ_TABLES = {"contact.creep_table"}  # a file beside the code, whose digest the code holds
TOUCH_THE_DISK = {
    *READ_MEASUREMENTS,
    *READ_TABLES,
    *(
        m
        for m in MODULES
        if m.split(".")[0] in ("configuration", "running", "record", "results", "importing")
    ),
    "report.figures",
    "report.tables",
    "report.explorer_page",
    "report.preflight",
}
# Modules of the model that a stage reaches; each one more is one more whose edit reruns it.
BUDGET = {
    "stability_map": 6,
    "hopf_points": 11,
    "limit_cycles": 16,
    "hopf_curves": 13,
    "critical_hopf_curve": 13,
    "cycle_amplitudes": 18,
    "absorber_tuning": 15,
    "frequency_response": 7,
    "contact_geometry": 8,
    "basic_model": 27,
    "preflight": 27,
    "growth_band": 28,
    "curving_equilibrium": 25,
    "bogie_modes": 29,
    "curve_entry": 26,
    "bogie_linearisation": 28,
    "bogie_simulation": 21,
    "wear": 11,
    "evolution_tendency": 28,
    "tendency_maps": 40,
    "wheelset_designs": 7,
    "bogie_designs": 42,
    "robustness_sample": 40,
    "robust_tuning": 39,
    "route_tuning": 50,
    "route_response": 44,
    "route_remedies": 53,
    "polygon_growth": 8,
    "polygon_simulation": 50,
}
LONGEST_MODULE, LONGEST_FUNCTION, LONGEST_SCRIPT = 450, 100, 10  # lines


def package_of(module: str) -> str:
    return module.split(".")[0]


def tree(module: str) -> ast.Module:
    return ast.parse(MODULES[module].read_text(encoding="utf-8"))


def imported(module: str) -> set[str]:
    """Absolute names of what a module imports, wherever in it."""
    names = set()
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: relative import in line {node.lineno}"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def own_imports(module: str) -> set[str]:
    """Modules of tramdva that a module imports."""
    names = {n.removeprefix("tramdva.") for n in imported(module) if n.startswith("tramdva.")}
    return {n if n in MODULES else n.rpartition(".")[0] for n in names}


def of_packages(packages) -> list[str]:
    return [module for module in MODULES if package_of(module) in packages]


def test_every_module_is_in_a_known_package() -> None:
    top = {path.stem for path in PACKAGE.glob("*.py")}

    assert top == AT_THE_ROOT
    assert {package_of(module) for module in MODULES} - {"__init__"} <= set(KNOWS)


def test_packages_make_no_circle() -> None:
    assert list(TopologicalSorter(KNOWS).static_order())


@pytest.mark.parametrize("module", MODULES)
def test_packages_know_those_below_them_only(module: str) -> None:
    own = package_of(module)
    known = KNOWS.get(own, set()) | {own}
    for other in own_imports(module):
        to_parameters = other in PARAMETERS and own == "configuration"
        from_parameters = other == "quantities" and module in PARAMETERS
        measured = module == "configuration.measured_files" and other in CHECK_MEASUREMENTS
        allowed = package_of(other) in known or to_parameters or from_parameters or measured
        assert allowed, f"{module} must not know {other}"


def test_modules_make_no_circle() -> None:
    try:
        TopologicalSorter({module: own_imports(module) for module in MODULES}).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(error.args[1]))


@pytest.mark.parametrize("module", sorted(PARAMETERS))
def test_parameters_know_what_a_parameter_is_and_no_numbers_of_arrays(module: str) -> None:
    tops = {name.partition(".")[0] for name in imported(module)}

    assert own_imports(module) == {"quantities"}
    assert not tops & {"numpy", "scipy", "numba"}


@pytest.mark.parametrize("module", of_packages(["variables"]))
def test_descriptions_of_a_file_concern_no_other(module: str) -> None:
    if module != "variables.registry":
        assert not own_imports(module) & {f"variables.{stage}" for stage in STAGES}


@pytest.mark.parametrize("stage", STAGES)
def test_stages_do_not_call_each_other(stage: str) -> None:
    others = own_imports(f"stages.{stage}")

    assert not others & {f"stages.{other}" for other in STAGES}
    assert {o for o in others if package_of(o) == "variables"} <= {
        f"variables.{stage}",
        "variables.arrays",
        "variables.shared",
    }


@pytest.mark.parametrize("module", of_packages(MODEL))
def test_only_stages_know_the_configuration(module: str) -> None:
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.arguments):
            names = [a.arg for a in (*node.posonlyargs, *node.args, *node.kwonlyargs)]
            assert "cfg" not in names, f"{module}: line {node.args[0].lineno}"


def test_bifurcation_knows_nothing_about_trams() -> None:
    words = re.compile(r"wheel|absorber|rail|creep|c_A|c_T|d_T", re.IGNORECASE)
    for module in of_packages(["bifurcation"]):
        nodes = list(ast.walk(tree(module)))
        names = {getattr(n, field, "") for n in nodes for field in ("id", "attr", "arg", "name")}
        assert not [name for name in names if words.search(str(name))], module


@pytest.mark.parametrize("module", MODULES)
def test_library_does_not_know_snakemake(module: str) -> None:
    assert not {n for n in imported(module) if n.partition(".")[0] == "snakemake"}


@pytest.mark.parametrize(
    "module",
    sorted(set(of_packages([*MODEL, "stages", "variables"])) - READ_MEASUREMENTS - READ_TABLES),
)
def test_model_touches_no_files_and_draws_nothing(module: str) -> None:
    tops = {name.partition(".")[0] for name in imported(module)}
    assert not tops & {"pathlib", "os", "io", "netCDF4", "xarray", "yaml", "matplotlib", "pandas"}
    calls = {
        node.func.id
        for node in ast.walk(tree(module))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    assert not calls & {"open", "print", "input", "exec", "eval"}


def test_only_a_few_modules_touch_the_disk() -> None:
    touching = {module for module in MODULES if imported(module) & {"pathlib.Path", "os"}}
    assert touching <= TOUCH_THE_DISK


@pytest.mark.parametrize("module", [m for m, p in MODULES.items() if p.name == "__init__.py"])
def test_packages_hold_a_docstring_only(module: str) -> None:
    body = tree(module).body
    assert len(body) == 1
    assert isinstance(body[0], ast.Expr)
    assert isinstance(body[0].value, ast.Constant)


@pytest.mark.parametrize("module", MODULES)
def test_modules_and_functions_are_short(module: str) -> None:
    text = MODULES[module].read_text(encoding="utf-8")
    assert len(text.splitlines()) <= LONGEST_MODULE
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno < LONGEST_FUNCTION, f"{module}.{node.name}"


def reached_of_the_model(script: Path) -> set[str]:
    """Modules of the model that a script reaches, without their packages."""
    reached = {name.removeprefix("tramdva.") for name in reached_modules(script)}
    return {module for module in reached if "." in module and package_of(module) in MODEL}


@pytest.mark.parametrize("stage", STAGES)
def test_stages_reach_no_more_of_the_model_than_they_use(root: Path, stage: str) -> None:
    reached = reached_of_the_model(root / f"workflow/scripts/{stage}.py")

    assert len(reached) <= BUDGET[stage], sorted(reached)


def test_no_stage_is_without_a_budget() -> None:
    assert set(BUDGET) == set(STAGES)


def test_figures_reach_nothing_of_the_model(root: Path) -> None:
    for script in root.glob("paper_figures/*.py"):
        assert not reached_of_the_model(script), script.name


@pytest.mark.parametrize("stage", STAGES)
def test_scripts_of_stages_are_all_alike(root: Path, stage: str) -> None:
    text = (root / f"workflow/scripts/{stage}.py").read_text(encoding="utf-8")

    assert len(text.splitlines()) <= LONGEST_SCRIPT
    assert text.endswith(
        "\n\nfrom tramdva.results import make\n"
        f"from tramdva.stages import {stage}\n\n"
        f'if __name__ == "__main__":\n    make(snakemake, {stage})\n'
    )


def test_figures_know_snakemake_at_their_end_only(root: Path) -> None:
    for path in root.glob("paper_figures/*.py"):
        before, main, after = path.read_text(encoding="utf-8").partition(
            'if __name__ == "__main__":'
        )
        assert "snakemake" not in before, path.name
        assert main, path.name
        assert after == "\n    run(main, snakemake)\n", path.name
