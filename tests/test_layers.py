"""Who knows whom, and what a module may do."""

import ast
import re
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "src/tramdva"
MODULES = {
    ".".join(path.relative_to(PACKAGE).with_suffix("").parts).removesuffix(".__init__"): path
    for path in sorted(PACKAGE.rglob("*.py"))
}

# Lower layers first: a module imports only from layers below its own, or from its own.
LAYERS = [
    {
        "bifurcation.system",
        "creep_force",
        "quantities",
        "bogie_parameters",
        "out_of_roundness",
        "design_grid",
    },
    {"bifurcation"},
    {"wheelset"},
    {"stability"},
    {"self_excitation"},
    {"critical_absorber"},
    {"sustained_vibration", "absorber"},
    {"wheelset_designs"},
    {"contact"},
    {"wear"},
    {"wear_derivative", "wear_history"},
    {"bogie"},
    {"evolution"},
    {"evolution_stages"},
    {"attached_tendency"},
    {"tendency_maps", "bogie_designs", "robustness_sample"},
    {"robust_criterion"},
    {"robust_tuning"},
    {"warm_up"},
]
# What the pipeline uses around the model, and what each may know.
AROUND = {
    "__init__": set(),
    "parameters": {
        "bogie_parameters",
        "bogie_study",
        "design_sheet_study",
        "evolution_study",
        "quantities",
    },
    "bogie_study": {"quantities"},
    "evolution_study": {"bogie_study", "quantities"},
    "design_sheet_study": {"quantities"},
    "result_variables": set(),
    "wheelset_variables": {"result_variables"},
    "bogie_variables": {"result_variables"},
    "evolution_variables": {"bogie_variables", "result_variables"},
    "design_variables": {
        "bogie_variables",
        "evolution_variables",
        "result_variables",
        "wheelset_variables",
    },
    "design_sheet_variables": {"bogie_variables", "result_variables"},
    "registry": {
        "bogie_variables",
        "design_sheet_variables",
        "design_variables",
        "evolution_variables",
        "result_variables",
        "wheelset_variables",
    },
    "strict_yaml": set(),
    "provenance": set(),
    "supervision": set(),
    "job": {"supervision"},
    "schema": {"parameters"},
    "slips": {"parameters", "schema"},
    "measured_files": {"contact.measured_profile", "out_of_roundness", "parameters"},
    "config": {
        "bogie_parameters",
        "measured_files",
        "parameters",
        "schema",
        "slips",
        "strict_yaml",
    },
    "results": {"registry", "result_variables", "supervision"},
    "inventory": {"config", "provenance", "results", "supervision"},
    "figures": {"results"},
    "tables": {"results"},
    "packing": set(),
    "web_plots": set(),
    "web_page": {"packing"},
    "sheet": set(),
    "sheet_page": {"sheet"},
    "run_record": set(),
    "crate": {"results", "run_record"},
    "archive": {"crate", "results", "run_record"},
}
READ_MEASUREMENTS = {"contact.measured_profile", "out_of_roundness"}
READ_OWN_DATA = {"contact.creep_table"}  # a file of the package, known by its digest
TOUCH_THE_DISK = {
    *READ_MEASUREMENTS,
    *READ_OWN_DATA,
    "figures",
    "tables",
    "web_page",
    "config",
    "measured_files",
    "strict_yaml",
    "schema",
    "results",
    "provenance",
    "job",
    "supervision",
    "inventory",
    "run_record",
    "crate",
    "archive",
}


def layer_of(module: str) -> int | None:
    """Number of the layer that names the module or, most closely, its package."""
    parts = module.split(".")
    for end in range(len(parts), 0, -1):
        for number, layer in enumerate(LAYERS):
            if ".".join(parts[:end]) in layer:
                return number
    return None


def imported(path: Path) -> set[str]:
    """Absolute names of what a file imports; the modules of tramdva without the prefix."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import in line {node.lineno}"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def own_imports(path: Path) -> set[str]:
    names = {n.removeprefix("tramdva.") for n in imported(path) if n.startswith("tramdva.")}
    return {n if n in MODULES else n.rpartition(".")[0] for n in names}


MODEL = {module: path for module, path in MODULES.items() if module not in AROUND}


@pytest.mark.parametrize("module", MODEL)
def test_model_knows_lower_layers_only(module: str) -> None:
    number = layer_of(module)
    assert number is not None, f"{module} belongs to no layer"
    for other in own_imports(MODEL[module]):
        below = layer_of(other)
        assert below is not None, f"{module} must not know {other}"
        assert below <= number, f"{module} must not know {other}"


@pytest.mark.parametrize("module", AROUND)
def test_what_is_around_the_model_does_not_know_it(module: str) -> None:
    assert own_imports(MODULES[module]) <= AROUND[module]


def test_bifurcation_knows_nothing_about_trams() -> None:
    words = re.compile(r"wheel|absorber|rail|creep|c_A|c_T|d_T", re.IGNORECASE)
    for module, path in MODULES.items():
        if module.startswith("bifurcation"):
            nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
            names = {
                getattr(n, field, "") for n in nodes for field in ("id", "attr", "arg", "name")
            }
            assert not [name for name in names if words.search(str(name))], module


@pytest.mark.parametrize("module", MODULES)
def test_library_does_not_know_snakemake(module: str) -> None:
    assert not {n for n in imported(MODULES[module]) if n.partition(".")[0] == "snakemake"}


@pytest.mark.parametrize("module", sorted(set(MODEL) - READ_MEASUREMENTS - READ_OWN_DATA))
def test_model_touches_no_files_and_draws_nothing(module: str) -> None:
    tops = {name.partition(".")[0] for name in imported(MODEL[module])}
    assert not tops & {"pathlib", "os", "io", "netCDF4", "xarray", "yaml", "matplotlib", "pandas"}
    calls = {
        node.func.id
        for node in ast.walk(ast.parse(MODEL[module].read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    assert not calls & {"open", "print", "input", "exec", "eval"}


def test_only_a_few_modules_touch_the_disk() -> None:
    touching = {m for m, p in MODULES.items() if imported(p) & {"pathlib.Path", "os"}}
    assert touching <= TOUCH_THE_DISK


@pytest.mark.parametrize("module", [m for m, p in MODULES.items() if p.name == "__init__.py"])
def test_packages_hold_a_docstring_only(module: str) -> None:
    body = ast.parse(MODULES[module].read_text(encoding="utf-8")).body
    assert len(body) == 1
    assert isinstance(body[0], ast.Expr)
    assert isinstance(body[0].value, ast.Constant)


@pytest.mark.parametrize("module", MODULES)
def test_modules_and_functions_are_short(module: str) -> None:
    text = MODULES[module].read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 500
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno < 100, f"{module}.{node.name}"


def test_scripts_are_short_and_know_snakemake_at_their_end_only(root: Path) -> None:
    for path in [*root.glob("workflow/scripts/*.py"), *root.glob("paper_figures/*.py")]:
        text = path.read_text(encoding="utf-8")
        before, main, _ = text.partition('if __name__ == "__main__":')
        assert main, path
        assert "snakemake" not in before, path
        if path.parent.name == "scripts":
            assert len(text.splitlines()) <= 40, path
