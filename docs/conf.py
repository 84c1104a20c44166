"""How the documentation is built: `python3 run.py docs`, pages in `docs/_build/html`.

The pages are complete in themselves: no fonts, scripts or formulas from the network.
"""

import os
import sys
from pathlib import Path

import yaml

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "_extensions"), str(HERE.parent / "src")]
os.environ["NUMBA_DISABLE_JIT"] = "1"  # compiled functions hide their docstrings

citation = yaml.safe_load((HERE.parent / "CITATION.cff").read_text(encoding="utf-8"))
project = "tramdva"
author = ", ".join(entry["name"] for entry in citation["authors"])
release = version = citation["version"]
project_copyright = author

extensions = [
    "mathml",
    "myst_parser",
    "result_tables",
    "sphinx.ext.apidoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
exclude_patterns = ["_build"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
default_role = "code"
napoleon_use_ivar = True  # fields of named tuples are described once, by their annotations
# Short names of types that several packages have are each their own.
# Short names of types that several packages have are each their own.
suppress_warnings = ["config.cache", "ref.python"]

apidoc_modules = [
    {
        "path": "../src/tramdva",
        "destination": "reference/modules",
        "separate_modules": True,
        "module_first": True,
        "include_private": False,
        "no_headings": False,
        "automodule_options": {"members", "show-inheritance"},
    }
]
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
napoleon_google_docstring = False
napoleon_use_param = False
napoleon_use_rtype = False

html_math_renderer = "mathml"
html_theme = "alabaster"
html_theme_options = {"fixed_sidebar": True, "page_width": "1100px", "sidebar_width": "250px"}
html_static_path = ["_static"]
html_css_files = ["equations.css"]
html_copy_source = False
html_show_sphinx = False
