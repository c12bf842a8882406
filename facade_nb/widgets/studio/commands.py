"""What the front end can ask for: one function per operation, each taking the model and the message."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable
from dataclasses import replace
from itertools import chain, count
from string import ascii_uppercase
from typing import Any

from ... import gallery
from ...design import Design, DesignError, Fault
from ...design.edit import (
    add_layer,
    remove_layer,
    rename_pattern,
    take,
    with_layer,
    with_pattern,
    with_symbol,
)
from ...design.text import spell
from ..shared.bundled import Message
from .fields import find_layer
from .model import FacadeModel
from .wire import describe_faults, layers_from_top

__all__ = ["COMMANDS", "Reply", "file_name"]

Reply = dict[str, Any] | None
"""What is sent back besides the changed state: a file to save, or the faults of a document."""


def _set(model: FacadeModel, message: Message) -> Reply:
    model.enter(tuple(message["path"]), message["value"])
    return None


def _take(model: FacadeModel, message: Message) -> Reply:
    """Make a change that was suggested, if it still is."""
    suggested = model.blame.suggestions if model.blame is not None else ()
    for suggestion in suggested:
        if suggestion.text == message["text"]:
            model.edit(take(model.design, suggestion))
            break
    return None


def _discard(model: FacadeModel, message: Message) -> Reply:
    model.discard(tuple(message["path"]))
    return None


def _undo(model: FacadeModel, _: Message) -> Reply:
    model.undo()
    return None


def _redo(model: FacadeModel, _: Message) -> Reply:
    model.redo()
    return None


def _select(model: FacadeModel, message: Message) -> Reply:
    model.select(
        message.get("shape"), layer=message.get("layer", ""), x=message.get("x", ""), y=message.get("y", "")
    )
    return None


def _save(model: FacadeModel, _: Message) -> Reply:
    return {"kind": "file", "name": f"{file_name(model.design.name)}.json", "text": model.save()}


def _open(model: FacadeModel, message: Message) -> Reply:
    name, text = str(message["name"]), str(message["text"])
    try:
        if not text.lstrip().startswith("{"):  # other text would be taken for the path of a file
            raise DesignError(Fault("", "expected a design as a JSON object"))
        model.load(text)
    except DesignError as error:
        return {"kind": "faults", "name": name, "faults": describe_faults(error.faults)}
    return {"kind": "opened", "name": name}


def _gallery(model: FacadeModel, message: Message) -> Reply:
    model.load(gallery.load(message["name"]))
    return {"kind": "opened", "name": str(message["name"]).replace("-", " ")}


def _declare(model: FacadeModel, message: Message) -> Reply:
    """Give symbols that a draft needs a size of one metre."""
    design = model.design
    for name in message["symbols"]:
        design = with_symbol(design, name, size=1.0)
    model.edit(design)
    return None


def _add(model: FacadeModel, message: Message) -> Reply:
    """Add a symbol, a pattern or a layer under the first name that is free."""
    adders = {"symbol": _add_symbol, "pattern": _add_pattern, "layer": _add_layer}
    model.edit(adders[message["kind"]](model.design))
    return None


def _add_symbol(design: Design) -> Design:
    return with_symbol(design, _free(ascii_uppercase, design.symbols, "A"), size=1.0)


def _add_pattern(design: Design) -> Design:
    sized = next((symbol.name for symbol in design.symbols.values() if symbol.size is not None), None)
    text = "ε" if sized is None else spell(sized)
    return with_pattern(design, _free((), design.patterns, "P"), text)


def _add_layer(design: Design) -> Design:
    if not design.patterns:
        raise DesignError(Fault("layers", "expected a pattern for the new layer; there is none yet"))
    top = layers_from_top(design)[:1]
    name = _free((), [layer.name for layer in design.layers], "layer ")
    if not top:
        return add_layer(design, name, next(iter(design.patterns)), list(design.patterns)[-1])
    return add_layer(design, name, top[0].x.pattern, top[0].y.pattern, depth=top[0].depth)


def _remove(model: FacadeModel, message: Message) -> Reply:
    """Remove a layer, a pattern that no layer uses, or what is declared of a symbol or a counter."""
    kind, name = message["kind"], message["name"]
    if kind == "layer":
        model.edit(remove_layer(model.design, name))
    else:
        document = model.design.to_dict()
        section = {"symbol": "symbols", "counter": "counters", "pattern": "patterns"}[kind]
        document.get(section, {}).pop(name, None)
        model.edit(Design.from_dict(document))
    return None


def _move(model: FacadeModel, message: Message) -> Reply:
    """Move a layer to a position in the stack, 0 being the top."""
    order = layers_from_top(model.design)
    layer = find_layer(model.design, message["name"])
    order.remove(layer)
    to = max(0, min(int(message["to"]), len(order)))
    # Depth orders before the list does, so the layer takes the depth of its new neighbour below (or above, at the end).
    neighbour = next(iter(order[to:] or order[-1:]), layer)
    order.insert(to, replace(layer, depth=neighbour.depth))
    model.edit(replace(model.design, layers=tuple(reversed(order))))
    return None


def _rename(model: FacadeModel, message: Message) -> Reply:
    """Rename a pattern or a layer, wherever it is named."""
    name, to = message["name"], str(message["to"]).strip()
    if message["kind"] == "pattern":
        model.edit(rename_pattern(model.design, name, to))
    else:
        model.edit(with_layer(model.design, name, name=to))
    return None


def _free(candidates: Iterable[str], taken: Container[str], stem: str) -> str:
    """The first candidate that is not taken; else the stem with the first number that makes it free."""
    numbered = (f"{stem}{number}" for number in count(1))
    return next(name for name in chain(candidates, numbered) if name not in taken)


def file_name(name: str) -> str:
    """A name that every file system takes."""
    return "".join(c if c.isalnum() or c in "-_" else "-" for c in name.lower()).strip("-") or "design"


COMMANDS: dict[str, Callable[[FacadeModel, Message], Reply]] = {
    "set": _set,
    "take": _take,
    "discard": _discard,
    "undo": _undo,
    "redo": _redo,
    "select": _select,
    "save": _save,
    "open": _open,
    "gallery": _gallery,
    "declare": _declare,
    "add": _add,
    "remove": _remove,
    "move": _move,
    "rename": _rename,
}
