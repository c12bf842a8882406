"""Design documents: read with every fault told at once, written compactly and atomically (docs/documents.md)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from .errors import DesignError, cut
from .files import write_atomically
from .inputs import Members, read_json_text, read_text
from .model import Counter, Design, Layer, LayerAxis, PatternDef, Shape, Symbol, Variant
from .sections import FORMAT, DocumentReader

__all__ = ["FORMAT", "read", "read_json", "spelled", "write", "write_json"]


def read(document: Mapping[str, Any]) -> Design:
    """The design that a document describes.

    Raises
    ------
    DesignError
        With every fault in the document, each with its place, what was expected and what was found.
    """
    reader = DocumentReader()
    if isinstance(document, Members):
        reader.repeated_keys(document)
    design = reader.design(document)
    if reader.faults.found:
        raise DesignError(reader.faults.found)
    return design


def read_json(source: str | Path) -> Design:
    """The design in a JSON text or in the file of that path.

    A `Path` is always a path; a `str` is JSON if its first character other than blanks opens an object or a list.

    Raises
    ------
    DesignError
        For a file that cannot be read, text that is not JSON (with line and column), and every fault of `read`.
    """
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n")[:1] in ("{", "["):
        place, text = "", source.removeprefix("\ufeff")
    else:
        place, text = str(source), _file_text(source)
    return read(read_json_text(text, place))


def _file_text(source: str | Path) -> str:
    try:
        return read_text(source, "a design")
    except DesignError as error:
        cause = error.__cause__
        if cause is None or isinstance(cause, UnicodeError):
            raise
        expected = "expected a design as JSON text, or the path of a file with one"
        reason = getattr(cause, "strerror", None) or str(cause)
        raise DesignError(
            f"{expected}; {cut(str(source), 200)!r} cannot be read as a file: {reason}"
        ) from error


def write(design: Design) -> dict[str, Any]:
    """The document of a design, without what has its default value. ``read(write(design)) == design``."""
    document: dict[str, Any] = {
        "format": FORMAT,
        "name": design.name,
        "canvas": {"width": design.canvas.width, "height": design.canvas.height},
    }
    if design.seed:
        document["seed"] = design.seed
    if design.grammar:
        document["grammar"] = design.grammar
    sections = {
        "symbols": {name: _changed(symbol, Symbol(name)) for name, symbol in design.symbols.items()},
        "counters": {name: _changed(counter, Counter(name)) for name, counter in design.counters.items()},
        "patterns": {name: _write_pattern(pattern) for name, pattern in design.patterns.items()},
        "layers": [_write_layer(layer) for layer in design.layers],
        "shapes": _write_shapes(design.shapes),
    }
    return document | {name: section for name, section in sections.items() if section}


def write_json(design: Design, path: str | Path | None = None, indent: int | None = 2) -> str:
    """The document as JSON text; with `path` also written there, whole or not at all.

    Raises
    ------
    DesignError
        If the design is not valid (then nothing is written), or the file cannot be written.
    """
    read(write(design))
    text = spelled(design, indent)
    if path is not None:
        write_atomically(path, text + "\n")
    return text


def spelled(design: Design, indent: int | None = 2) -> str:
    """The document of a valid design as JSON text."""
    return json.dumps(write(design), ensure_ascii=False, allow_nan=False, indent=indent)


def _changed(value: Any, default: Any) -> dict[str, Any]:
    """The fields in which a dataclass instance differs from a default one."""
    pairs = ((field.name, getattr(value, field.name)) for field in fields(value))
    return {name: member for name, member in pairs if member != getattr(default, name)}


def _write_shapes(shapes: Mapping[str, Shape]) -> dict[str, Any]:
    return {key: _write_shape(shape) for key, shape in shapes.items()}


def _write_shape(shape: Shape) -> dict[str, Any]:
    document = _changed(shape, Shape())
    if shape.variants is not None:
        document["variants"] = [_write_variant(variant) for variant in shape.variants]
    return document


def _write_variant(variant: Variant) -> dict[str, Any]:
    weight = {"weight": variant.weight} if variant.weight != 1 else {}
    return weight | _write_shape(variant.shape)


def _write_pattern(pattern: PatternDef) -> str | dict[str, Any]:
    document: dict[str, Any] = {"text": pattern.text}
    if pattern.hidden:
        document["hidden"] = list(pattern.hidden)
    if pattern.shapes:
        document["shapes"] = _write_shapes(pattern.shapes)
    return document if len(document) > 1 else pattern.text


def _write_layer(layer: Layer) -> dict[str, Any]:
    document: dict[str, Any] = {"name": layer.name, "x": _write_axis(layer.x), "y": _write_axis(layer.y)}
    if layer.depth != 0:
        document["depth"] = (
            int(layer.depth) if isinstance(layer.depth, float) and layer.depth.is_integer() else layer.depth
        )
    if not layer.visible:
        document["visible"] = layer.visible
    if layer.shapes:
        document["shapes"] = _write_shapes(layer.shapes)
    return document


def _write_axis(axis: LayerAxis) -> dict[str, Any]:
    document = _changed(axis, LayerAxis(axis.pattern))
    if axis.mask is not None:
        document["mask"] = list(axis.mask)
    return {"pattern": axis.pattern} | document
