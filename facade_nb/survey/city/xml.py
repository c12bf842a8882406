"""XML as a tree whose elements know their line. Document types and entities are refused: nothing is fetched."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.sax import SAXParseException
from xml.sax.handler import ContentHandler, feature_namespaces
from xml.sax.xmlreader import Locator

import defusedxml.sax
from defusedxml.common import DefusedXmlException

from ..openings import SurveyError

__all__ = ["Element", "parse"]

_MOST = 5_000_000
"""Elements of a file."""
_DEEPEST = 200


@dataclass(slots=True, eq=False)
class Element:
    """An element: its name without the namespace, its attributes likewise, its text, and the line it begins on."""

    name: str
    attributes: dict[str, str]
    line: int
    parent: Element | None
    children: list[Element] = field(default_factory=list)
    text: str = ""

    @property
    def id(self) -> str:
        """Its ``gml:id``; empty where it has none."""
        return self.attributes.get("id", "")

    @property
    def place(self) -> str:
        """Where it is, for a message."""
        return f"line {self.line}: {self.name}{f' {self.id!r}' if self.id else ''}"

    def walk(self, *stop: str) -> Iterator[Element]:
        """All elements in it, in the order of the file; not into those of some names."""
        waiting = list(reversed(self.children))
        while waiting:
            own = waiting.pop()
            yield own
            if own.name not in stop:
                waiting.extend(reversed(own.children))

    def within(self, *names: str) -> Element | None:
        """The nearest element around it of one of some names."""
        own = self.parent
        while own is not None and own.name not in names:
            own = own.parent
        return own


class _Handler(ContentHandler):
    def __init__(self, locator: Locator) -> None:
        super().__init__()
        self._where = locator
        self.root: Element | None = None
        self._open: list[Element] = []
        self._text: list[str] = []
        self._count = 0

    def startElementNS(self, name: tuple[str | None, str], qname: str | None, attrs: object) -> None:
        self._count += 1
        line = self._where.getLineNumber() or 0
        if self._count > _MOST or len(self._open) > _DEEPEST:
            what = f"{_MOST:,} elements" if self._count > _MOST else f"{_DEEPEST} elements within each other"
            raise SurveyError(f"line {line}: expected at most {what}")
        attributes = {key[1]: value for key, value in dict(attrs).items()}  # type: ignore[call-overload]
        parent = self._open[-1] if self._open else None
        own = Element(name[1], attributes, line, parent)
        if parent is None:
            self.root = own
        else:
            parent.children.append(own)
        self._open.append(own)
        self._text.clear()

    def endElementNS(self, name: tuple[str | None, str], qname: str | None) -> None:
        own = self._open.pop()
        if not own.children:
            own.text = "".join(self._text)
        self._text.clear()

    def characters(self, content: str) -> None:
        self._text.append(content)


def parse(text: str) -> Element:
    """The root of a document.

    Raises
    ------
    SurveyError
        For what is no XML, with line and column; for a document type or an entity.
    """
    parser = defusedxml.sax.make_parser()
    handler = _Handler(parser)
    parser.forbid_dtd = True
    parser.setFeature(feature_namespaces, True)
    parser.setContentHandler(handler)
    try:
        parser.feed(text)
        parser.close()
    except SAXParseException as error:
        where = f"line {error.getLineNumber()}, column {(error.getColumnNumber() or 0) + 1}"
        raise SurveyError(f"{where}: this is not XML: {error.getMessage()}") from None
    except DefusedXmlException:
        line = parser.getLineNumber() or 1
        raise SurveyError(
            f"line {line}: a city model has no document type and no entities, and none is read"
        ) from None
    assert handler.root is not None
    return handler.root
