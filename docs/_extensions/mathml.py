"""Equations as MathML, which browsers draw themselves: pages ask nothing of the network."""

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number
from sphinx.writers.html5 import HTML5Translator

logger = logging.getLogger(__name__)


def inline(translator: HTML5Translator, node: nodes.math) -> None:
    """Write a formula in a line of text."""
    translator.body.append(converted(node, "inline"))
    raise nodes.SkipNode


def block(translator: HTML5Translator, node: nodes.math_block) -> None:
    """Write a formula of its own, with its number at the right."""
    translator.body.append(translator.starttag(node, "div", CLASS="math"))
    if node["number"]:
        number = get_node_equation_number(translator, node)
        translator.body.append(f'<span class="eqno">({number})</span>')
    translator.body.append(converted(node, "block") + "</div>\n")
    raise nodes.SkipNode


def converted(node: nodes.Element, display: str) -> str:
    """Return a formula as MathML; the converter leaves unknown commands as they are."""
    mathml = convert(node.astext().strip(), display=display)
    if "\\" in mathml or ">&<" in mathml:
        logger.warning("formula with an unknown command: %s", node.astext(), location=node)
    return mathml


def setup(app: Sphinx) -> dict[str, bool]:
    """Make this the way in which Sphinx writes formulas."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
