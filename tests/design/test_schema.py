"""The JSON Schema of designs is what the reader asks of their structure."""

from __future__ import annotations

import copy
import json
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from facade_nb import Design, DesignError, gallery
from facade_nb.design import design_schema
from scripts.docs.schema import refresh

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = Draft202012Validator(design_schema())
WHOLE = json.loads((Path(__file__).parent / "every-field.json").read_text("utf-8"))
STRUCTURE = re.compile(
    r"unknown field|this field is missing|expected (an object|a list|a design document|a number|a whole number"
    r"|true or false|a text|the text of|a pattern's text|one of (center|left|right)|'facade-nb/design/1')"
)
"""What the reader says of structure; the rest is about names, patterns and bounds, which a schema cannot tell."""


def faults(document: Any) -> list[str]:
    """What the reader has against a document's structure."""
    try:
        Design.from_dict(document)
    except DesignError as error:
        return [fault.message for fault in error.faults if STRUCTURE.match(fault.message)]
    return []


def places(value: Any, at: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Every place in a document."""
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [at, *(place for key, member in inside for place in places(member, (*at, key)))]


def changed(document: Any, place: tuple[Any, ...], value: Any) -> Any:
    """A document with another value in a place."""
    if not place:
        return value
    made = copy.deepcopy(document)
    inside = made
    for key in place[:-1]:
        inside = inside[key]
    inside[place[-1]] = value
    return made


VALUES: tuple[Any, ...] = (
    *(None, True, -1, 2.0, 2.5, 1e-7, 1e7, 10**9 + 1, 10**400),
    *("", " ", "left", "A", "x\n", "\u00a0"),
    *([], {}, [None], [{}], {"text": 1}, {"pattern": "walls"}, {"weight": 1}),
)


def neighbours() -> Iterator[Any]:
    """All documents in which one thing is changed, added or dropped."""
    for place in places(WHOLE):
        yield from (changed(WHOLE, place, value) for value in VALUES)
        if isinstance(inside := found(place), dict):
            yield changed(WHOLE, place, {**inside, "hue": None})
            for name in inside:
                yield changed(WHOLE, place, {key: own for key, own in inside.items() if key != name})


def found(place: tuple[Any, ...]) -> Any:
    """What stands in a place."""
    inside = WHOLE
    for key in place:
        inside = inside[key]
    return inside


def test_the_document_of_every_field_has_every_field() -> None:
    assert faults(WHOLE) == []
    assert Design.from_dict(WHOLE)
    named = {key for place in places(WHOLE) for key in place if isinstance(key, str)}
    for part in [design_schema(), *design_schema()["$defs"].values()]:
        for whole in [part, *part.get("anyOf", [])]:
            assert set(whole.get("properties", {})) <= named


@pytest.mark.parametrize("name", gallery.names())
def test_every_design_that_ships_is_valid(name: str) -> None:
    assert SCHEMA.is_valid(gallery.load(name).to_dict())


def test_reader_and_schema_refuse_the_same() -> None:
    documents = list(neighbours())
    apart = [document for document in documents if SCHEMA.is_valid(document) != (faults(document) == [])]
    assert apart == []
    refused = sum(not SCHEMA.is_valid(document) for document in documents)
    assert 200 < refused < len(documents) - 200


def test_numbers_that_json_has_not_are_no_lengths() -> None:
    for value in (math.inf, -math.inf):
        document = changed(WHOLE, ("canvas", "width"), value)
        assert faults(document) and not SCHEMA.is_valid(document)


def test_the_page_and_the_file_are_of_today() -> None:
    page = ROOT / "docs" / "design-schema.md"
    assert refresh(page.read_text("utf-8")) == page.read_text("utf-8"), "run: python -m scripts.docs.schema"
    published = json.loads((ROOT / "docs" / "design.schema.json").read_text("utf-8"))
    assert published == design_schema(), "run: python -m scripts.docs.schema"
