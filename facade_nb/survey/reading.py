"""Files of surveyed openings, read."""

from __future__ import annotations

import codecs
import os
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, TypeAlias

from ..design.errors import DesignError, cut, listed, nearest, quoted
from ..design.fields import Faults, at
from ..design.inputs import read_json_text, read_text
from ..design.sections import DocumentReader
from ..solver.model.layout import Rect
from .city import City, city_of, looks_like_city
from .openings import SurveyError, rect_fault, rect_of

__all__ = ["Survey", "buildings", "load_survey", "survey_text"]

_VARIABLE = "FACADE_NB_DATA"
_FILE = "ingolstadt.json"
_DECLARED = re.compile(rb"<\?xml\s[^>]{0,200}?encoding\s*=\s*[\"']([A-Za-z][\w.\-]{0,40})[\"']")


@dataclass(frozen=True, slots=True)
class Survey:
    """The surveyed openings of one façade.

    Attributes
    ----------
    building
        Its number in the data.
    width, height
        Width and height of all openings together, in metres; the wall is larger.
    openings
        ``{"kind": "window", "rect": [left, bottom, right, top]}``, metres.
    source, licence
        Where the data come from, and under what terms.
    """

    building: str
    width: float
    height: float
    openings: tuple[Mapping[str, Any], ...]
    source: str = ""
    licence: str = ""


def buildings(path: str | Path | None = None) -> tuple[str, ...]:
    """The buildings that a data file has, in its order; of a city model the façades with openings.

    `path`, and what it raises, are as for `load_survey`.
    """
    read = _read_file(path)
    return tuple(read.facades) if isinstance(read, City) else tuple(read[2])


def load_survey(building: str, path: str | Path | None = None) -> Survey:
    """Read the surveyed openings of a building.

    Parameters
    ----------
    building
        Its number, such as ``"4018215"``. In a city model that of a building with one façade, else of a wall.
    path
        The data file: a survey, or a city model at LoD 3 in CityGML or CityJSON; or the folder that `ingolstadt.json`
        lies in. None: what the environment variable ``FACADE_NB_DATA`` names, else
        ``shared/data`` beside the checkout.

    Raises
    ------
    SurveyError
        If the file does not exist, is no survey, or lacks the building. The message has the place of every
        fault, what was expected and what was found.
    """
    return _survey(_read_file(path), str(building), _data_file(path))


def _survey(read: _Found, name: str, file: Path) -> Survey:
    if isinstance(read, City):
        return _of_city(read, name, file)
    reader, file, found = read
    if name not in found:
        raise _unknown(name, found, file)
    survey = reader.survey(name, found[name][1])
    if reader.faults.found:
        raise SurveyError(f"{file}: building {cut(name)}: {DesignError(reader.faults.found)}")
    return survey


def survey_text(text: str, place: str = "survey") -> Survey:
    """The survey in the text of a file that has one façade: JSON, or a city model. `SurveyError` for what is none."""
    read = _read(text, Path(place))
    names = list(read.facades) if isinstance(read, City) else list(read[2])
    if len(names) != 1:
        raise SurveyError(f"{place}: expected one façade, found {len(names)}: {listed(names) or 'none'}")
    return _survey(read, names[0], Path(place))


def _unknown(name: str, found: Collection[str], file: Path) -> SurveyError:
    known = ", ".join(map(cut, islice(found, 8))) + (", …" if len(found) > 8 else "") or "there is none"
    return SurveyError(
        f"{file}: expected a building of the survey ({known}); found {quoted(name)}{nearest(name, found)}"
    )


def _of_city(city: City, name: str, file: Path) -> Survey:
    facade = city.named(name)
    if facade is None:
        raise _unknown(name, city.facades, file)
    if facade.faults:
        told = "\n".join(facade.faults[:20])
        raise SurveyError(f"{file}: façade {cut(facade.name)}: {told}")
    return Survey(name, facade.width, facade.height, facade.openings)


def _read_file(path: str | Path | None) -> _Found:
    """Read a data file: its reader, the file, and place and members of each building; or a city model."""
    file = _data_file(path)
    try:
        text = _as_declared(file) or read_text(file, "a survey")
    except DesignError as error:
        raise SurveyError(f"expected a survey; {error}") from None
    return _read(text, file)


def _as_declared(file: Path) -> str:
    """The text of an XML file that declares to be in something else than UTF-8, as CityGML may; else nothing."""
    try:
        data = file.read_bytes()
    except (OSError, ValueError):
        return ""  # reading it as text tells what is wrong
    found = _DECLARED.match(data)
    name = found[1].decode("ascii") if found else "utf-8"
    try:
        if codecs.lookup(name).name == "utf-8":
            return ""
        return data.decode(name)
    except (LookupError, ValueError):
        raise SurveyError(
            f"expected a survey; {file}: it cannot be read as {cut(name)}, which it declares to be in"
        ) from None


def _read(text: str, file: Path) -> _Found:
    if looks_like_city(text):
        return city_of(text, str(file))
    try:
        document = read_json_text(text, str(file))
    except DesignError as error:
        raise SurveyError(f"expected a survey; {error}") from None
    if looks_like_city(document):
        return city_of(document, str(file))
    reader = _Reader(document)
    found = reader.facades()
    if reader.faults.found:
        raise reader.error(file)
    return reader, file, found


_Found: TypeAlias = "City | tuple[_Reader, Path, dict[str, tuple[str, Mapping[str, Any]]]]"


def _named(name: str | int) -> bool:
    """Whether a building has a name, or a number of fewer digits than Python minds."""
    return bool(name.strip()) if isinstance(name, str) else abs(name) < 10**100


class _Reader:
    """Reads a document of surveys; what is wrong with it is noted with its place."""

    def __init__(self, document: object) -> None:
        self.document = document
        self.faults = Faults()

    def error(self, place: object) -> SurveyError:
        """What is wrong, all of it."""
        what = "expected a survey, an object with facades that each have building and openings"
        return SurveyError(f"{place}: {what}\n{DesignError(self.faults.found)}")

    def facades(self) -> dict[str, tuple[str, Mapping[str, Any]]]:
        """Place and members of each building; none may stand twice."""
        faults = self.faults
        keys = DocumentReader()
        keys.repeated_keys(self.document)
        faults.found += keys.faults.found
        values = faults.mapping(self.document, "", "a survey (an object)")
        if isinstance(self.document, Mapping) and "facades" not in values:
            faults.add("facades", "this field is missing")
        found: dict[str, tuple[str, Mapping[str, Any]]] = {}
        for index, item in enumerate(
            faults.sequence(values.get("facades", ()), "facades", "a list of facades")
        ):
            place = at("facades", index)
            facade = faults.mapping(item, place)
            name = facade.get("building")
            if isinstance(name, bool) or not isinstance(name, str | int) or not _named(name):
                if isinstance(item, Mapping):
                    faults.expected(at(place, "building"), "the number of a building", name)
                continue
            if str(name) in found:
                first = found[str(name)][0]
                faults.add(
                    at(place, "building"), f"expected a building of its own; {quoted(name)} is {first}"
                )
                continue
            found[str(name)] = place, facade
        return found

    def survey(self, name: str, facade: Mapping[str, Any]) -> Survey:
        """The survey of one building."""
        faults = self.faults
        openings: list[Mapping[str, Any]] = []
        rects: list[Rect] = []
        for index, opening in enumerate(
            faults.sequence(facade.get("openings"), "openings", "a list of openings")
        ):
            own = at("openings", index)
            if not isinstance(opening, Mapping):
                faults.expected(own, "an opening (an object with kind and rect)", opening)
                continue
            fault = rect_fault(opening)
            if fault:
                faults.add(f"{own}.rect", fault)
                continue
            if "kind" in opening:
                faults.text(opening["kind"], at(own, "kind"), "")
            openings.append(opening)
            rects.append(rect_of(opening, own))
        extent = [max((rect[side] for rect in rects), default=0.0) for side in (2, 3)]
        given = (facade.get(field) for field in ("width", "height"))
        width, height = (
            default if value is None else faults.number(value, field, default, least=0)
            for value, field, default in zip(given, ("width", "height"), extent, strict=True)
        )
        values = self.document if isinstance(self.document, Mapping) else {}
        texts = [
            "" if values.get(key) is None else faults.text(values[key], key, "", empty=True)
            for key in ("source", "licence")
        ]
        return Survey(name, width, height, tuple(openings), *texts)


def _data_file(path: str | Path | None) -> Path:
    given = path if path is not None else os.environ.get(_VARIABLE)
    place = Path(given) if given else Path(__file__).resolve().parents[3] / "shared" / "data"
    file = place / _FILE if place.is_dir() or not given else place
    if file.is_file():
        return file
    raise SurveyError(
        f"The survey is not at {file}. It is not part of this package, for its licence is CC BY-SA 4.0: openings of "
        "buildings in Ingolstadt, taken from the CityGML models of savenow/lod3-road-space-models. Name the file, "
        f"or the folder that {_FILE} lies in, with load_survey(..., path=...) or in the environment variable "
        f"{_VARIABLE}."
    )
