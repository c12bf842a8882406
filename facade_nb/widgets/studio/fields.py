"""What a field of the front end edits: from a path in the design and a typed value to a new design.

A path names things by their names, not by positions: ``("layers", "columns", "x", "pattern")``. Everything here is
pure; what cannot be read raises `DesignError` with a fault whose place is the field.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...design import Design, DesignError, Fault, Layer, LayerAxis
from ...design.edit import with_canvas, with_counter, with_layer, with_pattern, with_shape, with_symbol
from ...design.errors import nearest

__all__ = ["Path", "apply", "find_layer"]

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
        case ("layers", name, "shapes", key, attribute) if attribute in _LOOKS:
            read = _LOOKS[attribute]
            return with_shape(design, key, layer=name, **{attribute: _optional(read, path, value)})
        case _:
            raise DesignError(Fault(".".join(path), "expected a field of the design; there is none"))


def find_layer(design: Design, name: str) -> Layer:
    """The layer of that name. Raises `DesignError` if there is none."""
    for layer in design.layers:
        if layer.name == name:
            return layer
    names = [layer.name for layer in design.layers]
    raise DesignError(Fault("layers", f"expected the name of a layer, found {name!r}{nearest(name, names)}"))


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


_LOOKS: dict[str, Callable[[Path, Any], Any]] = {
    "kind": _name,
    "geometry": _name,
    "material": _name,
    "offset": _number,
    "thickness": _number,
}
"""How each attribute of a shape is read."""
