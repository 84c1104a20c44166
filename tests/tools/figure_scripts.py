"""The scripts of the figures, for their tests."""

import importlib.util
from pathlib import Path
from types import ModuleType

from matplotlib.figure import Figure
from matplotlib.text import Text

FOLDER = Path(__file__).parents[2] / "paper_figures"
STYLE = FOLDER / "tramdva.mplstyle"


def script(name: str) -> ModuleType:
    """The script whose name begins so."""
    (path,) = FOLDER.glob(f"{name}*.py")
    module = importlib.util.module_from_spec(
        spec := importlib.util.spec_from_file_location(name, path)
    )
    spec.loader.exec_module(module)
    return module


def texts(figure: Figure) -> str:
    """All visible texts of a figure that was drawn."""
    return "\n".join(text.get_text() for text in figure.findobj(Text) if text.get_visible())
