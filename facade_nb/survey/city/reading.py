"""A file that may be a city model, read as one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ...design.errors import DesignError, cut
from ...design.fields import Faults
from ..openings import SurveyError
from . import citygml, cityjson
from .model import City, Facade, Object, facades
from .xml import parse

__all__ = ["city_of", "looks_like_city"]


def looks_like_city(document: object) -> bool:
    """Whether a text is XML, or a JSON document says that it is CityJSON."""
    if isinstance(document, str):
        return document.lstrip().startswith("<")
    return isinstance(document, Mapping) and document.get("type") == "CityJSON"


def city_of(document: str | Mapping[str, object], place: str) -> City:
    """The façades of a city model: a text in XML, or a JSON document.

    Raises
    ------
    SurveyError
        With each fault of the file and its place: the line, or the path of members.
    """
    faults = Faults()
    if isinstance(document, str):
        try:
            root = parse(document)
        except SurveyError as error:
            raise SurveyError(f"{place}: {error}") from None
        objects: Iterable[Object] = citygml.objects_of(root, faults)
    else:
        objects = cityjson.objects_of(document, faults)
    found: dict[str, Facade] = {}
    for own in objects:
        for facade in facades(own):
            if facade.name in found:
                faults.add("", f"two façades are called {cut(facade.name)}")
            found[facade.name] = facade
    if faults.found:
        raise SurveyError(
            f"{place}: expected a city model with openings at LoD 3\n{DesignError(faults.found)}"
        )
    return City(found)
