"""Edits of a design: each makes a new design and checks it like a document that is read.

Fields are given as in documents (docs/documents.md); None takes a field back to its default. Every function raises
`DesignError`, with places as in the document, if the outcome would not be valid; the design given stays as it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from .document import FORMAT, read, write
from .errors import DesignError, Fault, Suggestion, listed, nearest, quoted
from .model import Design
from .names import nfc
from .renaming import rename_counter, rename_group, rename_symbol
from .text import clean_name

__all__ = [
    "add_layer",
    "move_layer",
    "remove_layer",
    "rename_counter",
    "rename_group",
    "rename_pattern",
    "rename_symbol",
    "take",
    "with_canvas",
    "with_counter",
    "with_layer",
    "with_pattern",
    "with_shape",
    "with_symbol",
]


def with_canvas(design: Design, width: float | None = None, height: float | None = None) -> Design:
    """The design on a canvas of another width or height (metres); None leaves it. All else is the very same."""
    sides = (("width", design.canvas.width, width), ("height", design.canvas.height, height))
    canvas = read(
        {"format": FORMAT, "canvas": {name: old if new is None else new for name, old, new in sides}}
    ).canvas
    return replace(design, canvas=canvas)


def with_symbol(design: Design, name: str, /, **fields: Any) -> Design:
    """The design with fields of a symbol changed; the symbol is declared if it was not."""
    document = write(design)
    _update(_member(document, "symbols", name), fields)
    return read(document)


def with_counter(design: Design, name: str, /, **fields: Any) -> Design:
    """The design with `min`, `max` or `value` of a counter changed; the counter is declared if it was not."""
    document = write(design)
    _update(_member(document, "counters", name), fields)
    return read(document)


def take(design: Design, suggestion: Suggestion) -> Design:
    """The design with what a `NoLayout` suggests. Raises ValueError for what is no part of a design: `tolerances`."""
    match suggestion.path:
        case ("canvas", field):
            return with_canvas(design, **{field: suggestion.value})
        case ("counters", name, field):
            return with_counter(design, name, **{field: suggestion.value})
        case ("symbols", name, field):
            return with_symbol(design, name, **{field: suggestion.value})
    raise ValueError(f"expected a field of a design, found {'.'.join(suggestion.path)!r}")


def with_pattern(design: Design, name: str, text: str | None = None, /, **fields: Any) -> Design:
    """The design with the text, `hidden` or `shapes` of a pattern changed; a new name makes a new pattern."""
    document, name = write(design), nfc(name)
    patterns = document.setdefault("patterns", {})
    before = patterns.get(name, {})
    pattern = dict(before) if isinstance(before, dict) else {"text": before}
    _update(pattern, fields if text is None else {"text": text, **fields})
    patterns[name] = pattern["text"] if set(pattern) == {"text"} else pattern
    return read(document)


def rename_pattern(design: Design, name: str, new: str) -> Design:
    """The design with a pattern under another name, in layers too."""
    document, name, new = write(design), nfc(name), nfc(new)
    patterns = document.get("patterns", {})
    _known(name, patterns, "patterns", "pattern")
    if new != name and new in patterns:
        raise DesignError(
            Fault("patterns", f"expected a new name for pattern {quoted(name)}; {quoted(new)} is taken")
        )
    document["patterns"] = {new if key == name else key: pattern for key, pattern in patterns.items()}
    for layer in document.get("layers", ()):
        for axis in (layer["x"], layer["y"]):
            if axis["pattern"] == name:
                axis["pattern"] = new
    return read(document)


def with_layer(design: Design, name: str, /, **fields: Any) -> Design:
    """The design with fields of a layer changed.

    `x` and `y` take an object with the fields to change (``x={"mask": ["P"]}``) or just a pattern's name; ``name=``
    renames the layer.
    """
    index, document = _layer(design, name), write(design)
    layer = document["layers"][index]
    for key in ("x", "y"):
        if key in fields:
            change = fields.pop(key)
            _update(layer[key], change if isinstance(change, Mapping) else {"pattern": change})
    _update(layer, fields)
    return read(document)


def add_layer(
    design: Design,
    name: str,
    x: str | Mapping[str, Any],
    y: str | Mapping[str, Any],
    index: int | None = None,
    **fields: Any,
) -> Design:
    """The design with a new layer on top, or at an index of the list (bottom first)."""
    document = write(design)
    axes = ({"pattern": axis} if isinstance(axis, str) else axis for axis in (x, y))
    layer = dict(zip(("name", "x", "y"), (name, *axes), strict=True)) | fields
    layers = document.setdefault("layers", [])
    layers.insert(len(layers) if index is None else index, layer)
    return read(document)


def remove_layer(design: Design, name: str) -> Design:
    """The design without a layer."""
    index, document = _layer(design, name), write(design)
    del document["layers"][index]
    return read(document)


def move_layer(design: Design, name: str, index: int) -> Design:
    """The design with a layer at another index of the list (bottom first; -1 is the top)."""
    known, document = _layer(design, name), write(design)
    layers = document["layers"]
    layer = layers.pop(known)
    layers.insert(index if index >= 0 else len(layers) + 1 + index, layer)
    return read(document)


def with_shape(
    design: Design, key: str, /, *, layer: str | None = None, pattern: str | None = None, **fields: Any
) -> Design:
    """The design with fields of the shape ``"X Y"`` changed: of a layer, of a pattern, or else of the design."""
    document = write(design)
    owner: Any = document
    if layer is not None:
        known = _layer(design, layer)
        owner = document["layers"][known]
    elif pattern is not None:
        patterns, pattern = document.get("patterns", {}), nfc(pattern)
        _known(pattern, patterns, "patterns", "pattern")
        owner = patterns[pattern]
        if isinstance(owner, str):
            owner = patterns[pattern] = {"text": owner}
    shapes = owner.setdefault("shapes", {})
    _update(shapes.setdefault(key := clean_name(key), {}), fields)
    if not shapes[key]:
        del shapes[key]
    return read(document)


def _update(target: dict[str, Any], fields: Mapping[str, Any]) -> None:
    for key, value in fields.items():
        if value is None:
            target.pop(key, None)
        else:
            target[key] = value


def _member(document: dict[str, Any], section: str, name: str) -> dict[str, Any]:
    member: dict[str, Any] = document.setdefault(section, {}).setdefault(clean_name(name), {})
    return member


def _layer(design: Design, name: str) -> int:
    name, names = nfc(name), [layer.name for layer in design.layers]
    _known(name, names, "layers", "layer")
    return names.index(name)


def _known(name: str, names: Any, place: str, what: str) -> None:
    if name not in names:
        known = listed(names) or "there is none"
        raise DesignError(
            Fault(
                place, f"expected the name of a {what} ({known}); found {quoted(name)}{nearest(name, names)}"
            )
        )
