"""Building documents: read with every fault told at once, written compactly and atomically (docs/buildings.md)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from ..design.document import read as read_design
from ..design.document import write as write_design
from ..design.errors import DesignError, Fault, cut
from ..design.fields import Faults, at
from ..design.files import write_atomically
from ..design.inputs import Members, read_json_text, read_text
from ..design.model import Design
from ..design.sections import DocumentReader
from .model import ROOFS, TREATMENTS, Building, Corner, Point, Roof

__all__ = ["FORMAT", "read", "read_json", "write", "write_json"]

FORMAT = "facade-nb/building/1"
"""What a document's `format` says."""

_FIELDS = ("format", *(field.name for field in fields(Building)))


def read(document: Mapping[str, Any]) -> Building:
    """The building that a document describes. Raises `DesignError` with every fault in it."""
    faults = Faults()
    if isinstance(document, Members):
        reader = DocumentReader()
        reader.repeated_keys(document)
        faults.found += reader.faults.found
    if not isinstance(document, Mapping):
        raise DesignError(Fault("", "expected a building document (an object)"))
    values = faults.record(document, "", _FIELDS, ("format", "height", "plan", "walls"))
    if "format" in values and values["format"] != FORMAT:
        faults.expected("format", repr(FORMAT), values["format"])
    given: dict[str, Any] = {
        "name": faults.text(values.get("name", "Untitled"), "name", "Untitled", empty=True),
        "height": faults.number(values.get("height", 3.0), "height", 3.0, positive=True),
        "plan": tuple(
            _point(corner, at("plan", k), faults)
            for k, corner in enumerate(faults.sequence(values.get("plan", ()), "plan"))
        ),
        "walls": tuple(
            None if wall is None else faults.text(wall, at("walls", k), "")
            for k, wall in enumerate(faults.sequence(values.get("walls", ()), "walls"))
        ),
        "designs": {
            name: design
            for name, own in faults.mapping(values.get("designs", {}), "designs").items()
            if (design := _design(own, at("designs", name), faults)) is not None
        },
        "corners": _corners(values.get("corners", {}), faults),
        "roof": _roof(values.get("roof", {}), faults),
        "material": faults.text(values.get("material", "plaster"), "material", "plaster"),
        "shared": tuple(
            faults.text(name, at("shared", k), "")
            for k, name in enumerate(faults.sequence(values.get("shared", ()), "shared"))
        ),
    }
    if faults.found:
        raise DesignError(faults.found)
    return Building(**given)


def _point(value: object, place: str, faults: Faults) -> Point:
    pair = faults.sequence(value, place, "a corner, [east, north] in metres")
    if len(pair) != 2:
        if isinstance(value, list | tuple):
            faults.expected(place, "a corner, [east, north] in metres", value)
        return (0.0, 0.0)
    return faults.number(pair[0], at(place, 0), 0.0), faults.number(pair[1], at(place, 1), 0.0)


def _design(value: object, place: str, faults: Faults) -> Design | None:
    if not isinstance(value, Mapping):
        faults.expected(place, "a design document (an object)", value)
        return None
    try:
        return read_design(value)
    except DesignError as error:
        for fault in error.faults:
            own = f"{place}.{fault.place}" if fault.place else place
            faults.found.append(Fault(own, fault.message, fault.line, fault.column, fault.excerpt))
        return None


def _corners(value: object, faults: Faults) -> dict[int, Corner]:
    found: dict[int, Corner] = {}
    for key, own in faults.mapping(value, "corners").items():
        place = at("corners", key)
        if not key.isdecimal():
            faults.expected(place, "the number of a corner as the key, from 0", key)
            continue
        record = faults.record(own, place, ("kind", "design", "width"), ("kind", "design"))
        kind = faults.choice(record.get("kind", TREATMENTS[0]), at(place, "kind"), TREATMENTS)
        design = faults.text(record.get("design", "-"), at(place, "design"), "-")
        width = None
        if record.get("width") is not None:
            width = faults.number(record["width"], at(place, "width"), 1.0, positive=True)
        found[int(key)] = Corner(kind, design, width)
    return found


def _roof(value: object, faults: Faults) -> Roof:
    record = faults.record(value, "roof", tuple(field.name for field in fields(Roof)))
    return Roof(
        faults.choice(record.get("kind", ROOFS[0]), "roof.kind", ROOFS),
        faults.optional(record, "rise", lambda v: faults.number(v, "roof.rise", 0.0, least=0)),
        faults.number(record.get("overhang", 0.0), "roof.overhang", 0.0, least=0),
        faults.text(record.get("material", "tiles"), "roof.material", "tiles"),
    )


def read_json(source: str | Path) -> Building:
    """The building in a JSON text or in the file of that path; see `facade_nb.design.document.read_json`."""
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n")[:1] in ("{", "["):
        return read(read_json_text(source.removeprefix("\ufeff"), ""))
    try:
        text = read_text(source, "a building")
    except DesignError as error:
        cause = error.__cause__
        if cause is None or isinstance(cause, UnicodeError):
            raise
        reason = getattr(cause, "strerror", None) or str(cause)
        expected = "expected a building as JSON text, or the path of a file with one"
        raise DesignError(
            f"{expected}; {cut(str(source), 200)!r} cannot be read as a file: {reason}"
        ) from error
    return read(read_json_text(text, str(source)))


def write(building: Building) -> dict[str, Any]:
    """The document of a building, without what has its default value. ``read(write(building)) == building``."""
    document: dict[str, Any] = {
        "format": FORMAT,
        "name": building.name,
        "height": building.height,
        "plan": [list(corner) for corner in building.plan],
        "walls": list(building.walls),
        "designs": {name: write_design(design) for name, design in building.designs.items()},
    }
    if building.corners:
        document["corners"] = {
            str(number): _changed(corner, None) for number, corner in building.corners.items()
        }
    roof = _changed(building.roof, Roof())
    if roof:
        document["roof"] = roof
    if building.material != "plaster":
        document["material"] = building.material
    if building.shared:
        document["shared"] = list(building.shared)
    return document


def _changed(value: Any, default: Any) -> dict[str, Any]:
    """The fields of a dataclass instance that differ from another's, or that are not None."""
    pairs = ((field.name, getattr(value, field.name)) for field in fields(value))
    return {name: own for name, own in pairs if own != getattr(default, name, None)}


def write_json(building: Building, path: str | Path | None = None, indent: int | None = 2) -> str:
    """The document as JSON text; with `path` also written there, whole or not at all.

    Raises
    ------
    DesignError
        If a design of it is not valid (then nothing is written), or the file cannot be written.
    """
    document = write(building)
    read(document)
    text = json.dumps(document, ensure_ascii=False, allow_nan=False, indent=indent)
    if path is not None:
        write_atomically(path, text + "\n")
    return text
