"""What a field of the front end edits: from a path in the design and a typed value to a new design.

A path names things by their names, not by positions: ``("layers", "columns", "x", "pattern")``. In place of a key of
shapes it may have several, each on a line of its own: they are set together. Everything here is pure; what cannot be
read raises `DesignError` with a fault whose place is the field.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...design import Design, DesignError, Fault, Layer, LayerAxis, Shape
from ...design.edit import with_canvas, with_counter, with_layer, with_pattern, with_shape, with_symbol
from ...design.errors import nearest

__all__ = ["UNSHAPED", "Path", "apply", "find_layer"]

Path = tuple[str, ...]
"""Where a field's value stands: ``("patterns", "Bx", "text")``."""


def apply(design: Design, path: Path, value: Any) -> Design:
    """Return `design` with the field at `path` set to what was typed or chosen.

    Raises
    ------
    DesignError
        If the value cannot be read, the outcome would not be valid, or the path names nothing that there is.
    """
    match path:
        case ("name",):
            return Design.from_dict({**design.to_dict(), "name": _name(path, value)})
        case ("canvas", "width" | "height" as side):
            return with_canvas(design, **{side: _number(path, value)})
        case ("symbols", name, "size" | "min" | "max" as key):
            return with_symbol(design, name, **{key: _optional(_number, path, value)})
        case ("symbols", name, "opaque" | "attached" | "unoccludable" | "transparent" | "placement" as key):
            return with_symbol(design, name, **{key: value})
        case ("counters", name, "min" | "max" | "value" as key):
            return with_counter(design, name, **{key: _optional(_whole, path, value)})
        case ("patterns", name, "text" | "hidden" as key) if name in design.patterns:
            return with_pattern(design, name, **{key: value})
        case ("layers", name, "visible"):
            return with_layer(design, name, visible=value)
        case ("layers", name, "x" | "y" as axis, "pattern"):
            layer = find_layer(design, name)
            mask = _kept_mask(design, layer.x if axis == "x" else layer.y, value)
            return with_layer(design, name, **{axis: {"pattern": value, "mask": mask}})
        case ("layers", name, "x" | "y" as axis, "group"):
            return with_layer(design, name, **{axis: {"group": _optional(_name, path, value)}})
        case ("layers", name, "x" | "y" as axis, "mask"):
            return with_layer(design, name, **{axis: {"mask": value}})
        case ("layers", name, "shapes", keys, attribute) if attribute in _LOOKS:
            read = _LOOKS[attribute](path, value)
            return _with_looks(design, keys.split("\n"), attribute, read, layer=name)
        case ("patterns", name, "shapes", keys, attribute) if attribute in _LOOKS:
            read = _LOOKS[attribute](path, value)
            return _with_looks(design, keys.split("\n"), attribute, read, pattern=name)
        case ("shapes", keys, attribute) if attribute in _LOOKS:
            return _with_looks(design, keys.split("\n"), attribute, _LOOKS[attribute](path, value))
        case ("seed",):
            return Design.from_dict({**design.to_dict(), "seed": _whole(path, value)})
        case ("grammar",):
            return Design.from_dict({**design.to_dict(), "grammar": value})
        case _:
            raise DesignError(Fault(".".join(path), "expected a field of the design; there is none"))


def find_layer(design: Design, name: str) -> Layer:
    """The layer of that name. Raises `DesignError` if there is none."""
    for layer in design.layers:
        if layer.name == name:
            return layer
    names = [layer.name for layer in design.layers]
    raise DesignError(Fault("layers", f"expected the name of a layer, found {name!r}{nearest(name, names)}"))


UNSHAPED = {"* *": Shape(visible=False)}
"""The shapes of a layer that draws nothing until it has shapes of its own."""


def _with_looks(
    design: Design,
    keys: list[str],
    attribute: str,
    value: Any,
    *,
    layer: str | None = None,
    pattern: str | None = None,
) -> Design:
    """The design with one attribute of shapes under some keys; a layer that draws nothing yet draws them then."""
    blank = layer is not None and find_layer(design, layer).shapes.get("* *", Shape()).visible is False
    for key in keys:
        fields = {attribute: value}
        if blank and value is not None and attribute != "visible":
            fields["visible"] = None if key == "* *" else True
        design = with_shape(design, key, layer=layer, pattern=pattern, **fields)
    return design


def _kept_mask(design: Design, side: LayerAxis, pattern: Any) -> list[str] | None:
    """What is left of a mask when the axis takes another pattern: the symbols that this one has too."""
    definition = design.patterns.get(pattern)
    if side.mask is None or definition is None:
        return None
    return [symbol for symbol in side.mask if symbol in definition.parsed.symbols] or None


def _fail(path: Path, expected: str, value: object) -> DesignError:
    found = "nothing" if value is None or value == "" else repr(value)
    return DesignError(Fault(".".join(path), f"expected {expected}; found {found}"))


def _optional(read: Callable[[Path, Any], Any], path: Path, value: Any) -> Any:
    blank = value is None or (isinstance(value, str) and not value.strip())
    return None if blank else read(path, value)


def _number(path: Path, value: Any) -> float:
    if isinstance(value, str):
        try:
            value = float(value.strip().replace(",", "."))
        except ValueError:
            raise _fail(path, "a number of metres, such as 1.2", value) from None
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise _fail(path, "a number of metres, such as 1.2", value)
    return value


def _whole(path: Path, value: Any) -> int:
    try:
        return int(str(value).strip())
    except ValueError:
        raise _fail(path, "a whole number", value) from None


def _name(path: Path, value: Any) -> str:
    if not isinstance(value, str) or not value.strip():
        raise _fail(path, "a name", value)
    return value.strip()


def _flag(path: Path, value: Any) -> bool:
    if not isinstance(value, bool):
        raise _fail(path, "true or false", value)
    return value


def _variants(path: Path, value: Any) -> Any:
    """Variants as documents have them; their texts are read as the fields of shapes are."""
    if not isinstance(value, list) or not all(isinstance(variant, dict) for variant in value):
        raise _fail(path, "a list of variants", value)
    read = {**_LOOKS, "weight": _maybe(_number)}
    told = ({key: read[key](path, own) for key, own in variant.items() if key in read} for variant in value)
    return [{key: own for key, own in variant.items() if own is not None} for variant in told] or None


def _maybe(read: Callable[[Path, Any], Any]) -> Callable[[Path, Any], Any]:
    return lambda path, value: _optional(read, path, value)


_LOOKS: dict[str, Callable[[Path, Any], Any]] = {
    "kind": _maybe(_name),
    "geometry": _maybe(_name),
    "material": _maybe(_name),
    "offset": _maybe(_number),
    "thickness": _maybe(_number),
    "visible": _maybe(_flag),
    "variants": _maybe(_variants),
}
"""How each attribute of a shape is read; nothing is None, which takes it back."""
