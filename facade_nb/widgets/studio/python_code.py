"""The Python that makes a design."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any

from ...design import Design

__all__ = ["python_of"]

_WIDTH = 100


def python_of(design: Design) -> str:
    """Python code that makes a design and solves it: what is as it would be anyway is left out."""
    made = _spell(design, 0)
    names = sorted({type(value).__name__ for value in _walk(design)})
    return (
        "from facade_nb import solve\n"
        f"from facade_nb.design.model import {', '.join(names)}\n\n"
        f"design = {made}\n"
        "layout = solve(design)\n"
    )


def _walk(value: Any) -> Iterator[Any]:
    """The dataclasses that a value is made of."""
    if is_dataclass(value):
        yield value
        for _, member in _said(value):
            yield from _walk(member)
    elif isinstance(value, Mapping):
        for member in value.values():
            yield from _walk(member)
    elif isinstance(value, tuple):
        for member in value:
            yield from _walk(member)


def _said(value: Any) -> list[tuple[str, Any]]:
    """The fields of a dataclass that say something."""
    told = []
    for field in fields(value):
        if not field.init or field.name.startswith("_"):
            continue
        member = getattr(value, field.name)
        default = field.default_factory() if field.default_factory is not MISSING else field.default
        if default is MISSING or member != default:
            told.append((field.name, member))
    return told


def _spell(value: Any, indent: int) -> str:
    """A value as Python writes it, on one line where there is room."""
    if is_dataclass(value):
        parts = [(f"{name}=", member) for name, member in _said(value)]
        return _bracket(f"{type(value).__name__}(", parts, ")", indent)
    if isinstance(value, Mapping):
        return _bracket("{", [(f"{key!r}: ", member) for key, member in value.items()], "}", indent)
    if isinstance(value, tuple):
        return _bracket("(", [("", member) for member in value], ",)" if len(value) == 1 else ")", indent)
    return repr(value)


def _bracket(head: str, parts: list[tuple[str, Any]], tail: str, indent: int) -> str:
    flat = head + ", ".join(name + _spell(member, 10**6) for name, member in parts) + tail
    if indent + len(flat) <= _WIDTH or indent >= 10**6 or not parts:
        return flat
    pad = " " * (indent + 4)
    # The name of a member stands before it on its line.
    inner = [pad + name + _spell(member, indent + 4) + "," for name, member in parts]
    return head + "\n" + "\n".join(inner) + "\n" + " " * indent + tail.removeprefix(",")
