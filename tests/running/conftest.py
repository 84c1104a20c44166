"""A small package in place of the real one."""

from pathlib import Path

import pytest

SOURCES = {
    "__init__.py": '"""Nomenclature."""\n',
    "results.py": (
        "import importlib\nfrom tramdva.variables import kinds\n"
        "def read():\n    return importlib.import_module('tramdva.variables.registry')\n"
    ),
    "variables/__init__.py": '"""Variables."""\n',
    "variables/kinds.py": "KINDS = 1\n",
    "variables/registry.py": "from tramdva.variables import force, wear\nSTAGES = [force, wear]\n",
    "variables/wear.py": "from tramdva.variables import kinds\nVARIABLES = 1\n",
    "variables/force.py": "VARIABLES = 2\n",
    "running/__init__.py": '"""Running."""\n',
    "running/job.py": "import logging\n",
    "force.py": '"""Force."""\n\n\ndef force(w):\n    """Return it."""\n    return 2 * w  # N\n',
    "wear.py": (
        "import tramdva.contact.hertz as hertz\nfrom tramdva import force\n"
        "from tramdva.variables.wear import VARIABLES\n"
    ),
    "alone.py": "x = 1\n",
    "contact/__init__.py": '"""Contact."""\n',
    "contact/hertz.py": (
        "@njit(cache=True)\ndef late():\n    from tramdva.contact.kalker import c\n    return c\n"
    ),
    "contact/kalker.py": "c = 1\n",
    "contact/fastsim.py": "c = 1\n",
}


@pytest.fixture
def package(tmp_path: Path) -> Path:
    for name, text in SOURCES.items():
        path = tmp_path / "tramdva" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (tmp_path / "wear.py").write_text(
        "from tramdva import results, wear\nfrom tramdva.running import job\n"
    )
    return tmp_path / "tramdva"
