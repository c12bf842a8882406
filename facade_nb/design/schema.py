"""The JSON Schema of design documents: what `DocumentReader` asks of their structure, for editors and other programs.

What patterns say, and which names refer to which, a schema cannot tell: the reader does.
"""

from __future__ import annotations

from typing import Any

from .limits import LEAST_LENGTH, MOST_COUNT, MOST_LENGTH
from .model import Canvas, Counter, LayerAxis, Symbol
from .sections import DESIGN_FIELDS, FLAGS, FORMAT, PLACEMENTS, SHAPE_FIELDS, SYMBOL_FIELDS, VARIANT_FIELDS
from .text import CONTROLS

__all__ = ["design_schema"]

Schema = dict[str, Any]

_CANVAS = Canvas()
_ANY = Counter("")


def design_schema() -> Schema:
    """The schema of ``facade-nb/design/1``, by draft 2020-12.

    A document that the reader accepts is valid by it, and one that is not valid is refused by the reader.
    What the reader may refuse beyond that: texts that are no patterns, names that nothing has, bounds that cross, and a
    list of variants without weight.
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A façade design of facade_nb",
        "description": "Canvas, symbols, counters, patterns, layers and shapes. Lengths are metres.",
        **_record(
            DESIGN_FIELDS,
            {
                "format": {"const": FORMAT, "description": "Which documents these are, and their version."},
                "name": _told(_text(empty=True), "A title."),
                "canvas": _told(_canvas(), "The rectangle to fill."),
                "seed": _told(_integer(), "Chooses among variants.", 0),
                "grammar": _told(
                    {"type": "string"}, "A texture grammar, whose rules may be materials: rule:Name."
                ),
                "symbols": _told(_named(_ref("symbol")), "The letters of patterns, by name."),
                "counters": _told(_named(_ref("counter")), "The counts of patterns, by name."),
                "patterns": _told(_named(_ref("pattern"), texts=True), "Patterns, by name."),
                "layers": _told({"type": "array", "items": _ref("layer")}, "The layers, bottom first."),
                "shapes": _told(_named(_ref("shape")), 'What pairs of symbols look like, by "X Y".'),
            },
            "format",
        ),
        "$defs": {
            "symbol": _symbol(),
            "counter": _counter(),
            "pattern": _pattern(),
            "layer": _layer(),
            "axis": _axis(),
            "shape": _shape(SHAPE_FIELDS, "What a pair of symbols looks like; null is inherited."),
            "variant": _shape(VARIANT_FIELDS, "One of several looks of a shape."),
        },
    }


def _canvas() -> Schema:
    return _record(
        ("width", "height"),
        {
            "width": _told(_length(), "From left to right.", _CANVAS.width),
            "height": _told(_length(), "From the ground up.", _CANVAS.height),
        },
    )


def _symbol() -> Schema:
    flags = {
        "opaque": "Whether it hides what lies below it.",
        "attached": "Whether it keeps its place beside its neighbours.",
        "unoccludable": "Whether nothing may cover a part of it.",
        "transparent": "Whether it is a gap, through which the layers below are seen.",
    }
    members = {
        "size": _told(_or_null(_length()), "Preferred size; without one it stands in control patterns only."),
        "placement": {
            "enum": list(PLACEMENTS),
            "default": PLACEMENTS[0],
            "description": "Where in its column it stands, if it is not opaque.",
        },
        "min": _told(_or_null(_length()), "Least solved size."),
        "max": _told(_or_null(_length()), "Largest solved size."),
    }
    members |= {name: _told({"type": "boolean"}, flags[name], default) for name, default in FLAGS.items()}
    return _told(_record(SYMBOL_FIELDS, members), f"{(Symbol.__doc__ or '').partition('.')[0]}.")


def _counter() -> Schema:
    members = {
        "min": _told(_or_null(_integer()), "Least value.", _ANY.min),
        "max": _told(_or_null(_integer()), "Largest value; null: there is none."),
        "value": _told(_or_null(_integer()), "The value itself; null: the solver finds it."),
    }
    return _told(_record(("min", "max", "value"), members), "How often something repeats.")


def _pattern() -> Schema:
    members = {
        "text": _told({"type": "string"}, "The pattern as it is written."),
        "hidden": _told(_or_null(_symbols()), "Symbols of it that are not drawn."),
        "shapes": _told(_named(_ref("shape")), "Its own shapes."),
    }
    whole = _record(("text", "hidden", "shapes"), members, "text")
    return {"anyOf": [{"type": "string"}, whole], "description": "A pattern: its text alone, or with more."}


def _layer() -> Schema:
    members = {
        "name": _told(_text(), "A name of its own."),
        "x": _told(_ref("axis"), "From left to right."),
        "y": _told(_ref("axis"), "From the ground up."),
        "depth": _told(_number(-MOST_LENGTH), "Where in the stack it lies; equal ones keep their order.", 0),
        "visible": _told({"type": "boolean"}, "Whether it takes part.", True),
        "shapes": _told(_named(_ref("shape")), "Its own shapes."),
    }
    return _told(_record(tuple(members), members, "name", "x", "y"), "The outer product of two patterns.")


def _axis() -> Schema:
    members = {
        "pattern": _told(_text(), "The name of a pattern."),
        "group": _told(_text(), "Patterns of one group are aligned.", LayerAxis("").group),
        "mask": _told(_or_null(_symbols()), "Symbols that stay visible; null: all."),
    }
    return _told(_record(tuple(members), members, "pattern"), "One axis of a layer.")


def _shape(names: tuple[str, ...], what: str) -> Schema:
    members = {
        "weight": _told(_number(0), "Its chance, in proportion to those of the others.", 1),
        "kind": _told(_text(), "A free word, such as window."),
        "geometry": _told(_text(), "The name of a geometry, with parameters or without, or file:NAME."),
        "material": _told(_text(), "The name of a material, a colour, or rule:Name."),
        "offset": _told(_number(-MOST_LENGTH), "Along the normal."),
        "thickness": _told(_number(0), "Along the normal."),
        "visible": _told({"type": "boolean"}, "Whether it is drawn."),
        "variants": _told(
            {"type": "array", "items": _ref("variant")}, "Looks of which each instance has one."
        ),
    }
    return _told(_record(names, {name: _or_null(members[name]) for name in names}), what)


def _record(names: tuple[str, ...], members: Schema, *required: str) -> Schema:
    """An object with known fields only, in the reader's order."""
    found: Schema = {"type": "object", "additionalProperties": False}
    if required:
        found["required"] = list(required)
    return found | {"properties": {name: members[name] for name in names}}


def _named(member: Schema, *, texts: bool = False) -> Schema:
    names = {"propertyNames": _text()} if texts else {}
    return {"type": "object", **names, "additionalProperties": member}


def _symbols() -> Schema:
    return {"type": "array", "items": _text()}


def _text(*, empty: bool = False) -> Schema:
    readable = rf"^(?![\s\S]*{CONTROLS})"
    return {"type": "string", "pattern": readable if empty else rf"{readable}[\s\S]*\S"}


def _number(least: float) -> Schema:
    return {"type": "number", "minimum": least, "maximum": MOST_LENGTH}


def _length() -> Schema:
    return _number(LEAST_LENGTH)


def _integer() -> Schema:
    return {"type": "integer", "minimum": -MOST_COUNT, "maximum": MOST_COUNT}


def _or_null(schema: Schema) -> Schema:
    told: Schema = {key: schema[key] for key in ("description", "default") if key in schema}
    bare = {key: value for key, value in schema.items() if key not in told}
    return {"anyOf": [bare, {"type": "null"}]} | told


def _ref(name: str) -> Schema:
    return {"$ref": f"#/$defs/{name}"}


def _told(schema: Schema, description: str, default: Any = None) -> Schema:
    return {**schema, "description": description} | ({} if default is None else {"default": default})
