"""Read XML of unknown origin: no document type, no entities, nothing but what is in the bytes.

Expat is told to refuse a document type before it can declare anything, so that no entity expands
and nothing else is opened; size, depth and numbers of elements and letters are limited. Only the
elements that are asked for are kept: surfaces and points of a land survey pass by.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import NamedTuple
from xml.parsers import expat

LARGEST = 100_000_000  # bytes
MOST_ELEMENTS = 5_000_000
MOST_KEPT = 400_000
DEEPEST = 60
LONGEST_TEXT = 10_000  # letters between two tags that are kept


class RouteFileError(ValueError):
    """A file of a route cannot be read; a line says where and why."""


class Element(NamedTuple):
    """An element that was kept.

    name : without its namespace; line : in the file
    children : elements; text : in one piece, as a list with a string
    """

    name: str
    attributes: Mapping[str, str]
    line: int
    children: list[Element]
    text: list[str]

    def all(self, *names: str) -> list[Element]:
        """Children of some names, in their order."""
        return [child for child in self.children if child.name in names]

    def first(self, name: str) -> Element | None:
        """The first child of a name."""
        return next((child for child in self.children if child.name == name), None)

    def words(self) -> str:
        """Its text without blanks around it."""
        return "".join(self.text).strip()


def kept_elements(data: bytes, origin: str, root: str, kept: Collection[str]) -> list[Element]:
    """Elements of some names, with all that is in them.

    Parameters
    ----------
    data : of the file; origin : its name, for messages
    root : name of the root element, to be told from other files
    kept : names

    Raises
    ------
    RouteFileError
        With file, line and what is wrong.
    """
    if len(data) > LARGEST:
        raise RouteFileError(f"{origin}: is larger than {LARGEST} bytes")
    reader = _Reader(origin, root, kept)
    try:
        reader.parser.Parse(data, True)
    except expat.ExpatError as error:
        words = expat.errors.messages.get(error.code, "is no XML")
        raise RouteFileError(f"{origin}, line {error.lineno}: is no whole XML: {words}") from None
    except (LookupError, UnicodeError, ValueError) as error:
        if isinstance(error, RouteFileError):
            raise
        raise RouteFileError(f"{origin}: its encoding cannot be read; UTF-8 can") from None
    return reader.found


class _Reader:
    """Handlers of expat and what they found."""

    def __init__(self, origin: str, root: str, kept: Collection[str]) -> None:
        self.origin, self.root, self.kept = origin, root, frozenset(kept)
        self.found: list[Element] = []
        self.open: list[Element] = []
        self.depth = self.elements = self.count = 0
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.buffer_text = True
        self.parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)
        self.parser.StartDoctypeDeclHandler = self._refuse_document_type
        self.parser.EntityDeclHandler = self._refuse_document_type
        self.parser.ExternalEntityRefHandler = self._refuse_document_type
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text

    def _error(self, words: str) -> RouteFileError:
        return RouteFileError(f"{self.origin}, line {self.parser.CurrentLineNumber}: {words}")

    def _refuse_document_type(self, *_: object) -> None:
        raise self._error("has a document type (<!DOCTYPE ...>); none is allowed, nor entities")

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        name = name.rpartition(" ")[2]
        self.elements += 1
        self.depth += 1
        if self.elements == 1 and name != self.root:
            raise self._error(f"the file is <{name[:40]}>; a file of <{self.root}> is needed")
        if self.elements > MOST_ELEMENTS:
            raise self._error(f"has more than {MOST_ELEMENTS} elements")
        if self.depth > DEEPEST:
            raise self._error(f"has elements in elements more than {DEEPEST} deep")
        if not self.open and name not in self.kept:
            return
        self.count += 1
        if self.count > MOST_KEPT:
            raise self._error(f"has more than {MOST_KEPT} elements of a route")
        own = {key.rpartition(" ")[2]: value for key, value in attributes.items()}
        element = Element(name, own, self.parser.CurrentLineNumber, [], [])
        (self.open[-1].children if self.open else self.found).append(element)
        self.open.append(element)

    def _end(self, name: str) -> None:
        self.depth -= 1
        if self.open:
            self.open.pop()

    def _text(self, text: str) -> None:
        if not self.open or not text.strip():
            return
        pieces = self.open[-1].text
        if sum(map(len, pieces)) + len(text) > LONGEST_TEXT:
            raise self._error(f"<{self.open[-1].name}> holds more than {LONGEST_TEXT} letters")
        pieces.append(text)
