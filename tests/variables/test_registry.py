"""The descriptions of all variables belong together, and arrays follow them."""

import importlib
import pkgutil

import numpy as np

from tramdva import variables
from tramdva.variables import arrays, shared
from tramdva.variables.kinds import Stage, flag, real, text, truth
from tramdva.variables.registry import STAGES


def test_registry_names_all_it_needs() -> None:
    for stage, description in STAGES.items():
        for name, variable in description.variables.items():
            assert variable.kind in ("real", "flag", "truth", "text"), (stage, name)
            assert variable.long_name, (stage, name)
            assert variable.unit, (stage, name)
            assert bool(variable.meanings) == (variable.kind in ("flag", "truth")), (stage, name)
        coordinates = {name for v in description.variables.values() for name in v.dimensions}
        for name in coordinates & set(description.variables):
            assert description.variables[name].dimensions == (name,), (stage, name)


def test_registry_holds_the_variables_of_every_module() -> None:
    modules = {
        found.name: importlib.import_module(f"tramdva.variables.{found.name}")
        for found in pkgutil.iter_modules(variables.__path__)
    }
    described = {name: m.VARIABLES for name, m in modules.items() if hasattr(m, "VARIABLES")}

    assert described == STAGES
    assert all(stage.name == name for name, stage in described.items())
    assert set(modules) - set(STAGES) == {"arrays", "kinds", "registry", "shared"}


def test_statuses_keep_their_numbers() -> None:
    assert shared.STATUS[:3] == ("converged", "not_converged", "no_hopf_point")


EXAMPLE = Stage(
    "example",
    "Example",
    {
        "name": text("wheel", "name"),
        "load": real("wheel", "N", "load"),
        "lifted": truth("wheel", "no contact"),
        "status": flag("wheel", ("converged", "not_converged"), "end"),
        "history": real("wheel time", "N", "load over time"),
    },
)


def test_table_has_a_column_per_variable_along_its_rows_alone() -> None:
    row = {"name": "front", "load": 2, "lifted": False, "status": "converged", "other": object()}

    found = arrays.table(EXAMPLE, "wheel", [row, row | {"name": "rear", "load": 3.5}])

    assert list(found) == ["name", "load", "lifted", "status"]
    assert found["load"].tolist() == [2.0, 3.5]
    assert found["name"].tolist() == ["front", "rear"]


def test_empty_table_keeps_its_types() -> None:
    found = arrays.table(EXAMPLE, "wheel", [])

    assert {name: (column.shape, column.dtype.kind) for name, column in found.items()} == {
        "name": ((0,), "U"),
        "load": ((0,), "f"),
        "lifted": ((0,), "b"),
        "status": ((0,), "U"),
    }


def test_without_numbers_leaves_flags_and_texts_to_the_caller() -> None:
    found = arrays.without_numbers(EXAMPLE, {"wheel": 2, "time": 3})

    assert set(found) == {"load", "lifted", "history"}
    assert found["history"].shape == (2, 3)
    assert np.isnan(found["history"]).all()
    assert not found["lifted"].any()
