"""What the front end can ask for: one function per operation, each taking the model and the message."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from dataclasses import replace
from itertools import chain, count
from string import ascii_uppercase
from typing import Any

from ... import gallery
from ...design import Design, DesignError, Fault, Shape
from ...design.edit import (
    add_layer,
    remove_layer,
    rename_counter,
    rename_group,
    rename_pattern,
    rename_symbol,
    take,
    with_layer,
    with_pattern,
    with_symbol,
)
from ...design.instances import meanings
from ...design.model import AXES, Axis
from ...design.text import clean_name
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
        message.get("shape"),
        layer=message.get("layer", ""),
        x=message.get("x", ""),
        y=message.get("y", ""),
        more=message.get("more", ()),
    )
    return None


def _wall(model: FacadeModel, message: Message) -> Reply:
    if model.whole is not None:
        model.whole.choose(int(message["wall"]))
    return None


def _toggle(model: FacadeModel, message: Message) -> Reply:
    # What is picked is known here alone: to a second click that comes before the answer to the first, too.
    model.toggle(
        layer=message.get("layer", ""),
        x=message.get("x", ""),
        y=message.get("y", ""),
        add=message.get("add", False),
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


def _add(model: FacadeModel, message: Message) -> Reply:
    """Add a symbol, a pattern or a layer under the first name that is free; the answer tells the name."""
    kind = message["kind"]
    adders = {"symbol": _add_symbol, "pattern": _add_pattern, "layer": _add_layer}
    design, name = adders[kind](model.design)
    model.edit(design)
    if kind == "layer":
        model.select(layer=name)
    return {"kind": "added", "what": kind, "name": name}


def _add_symbol(design: Design) -> tuple[Design, str]:
    name = _free(ascii_uppercase, design.symbols, "A")
    return with_symbol(design, name, size=1.0), name


def _add_pattern(design: Design) -> tuple[Design, str]:
    """A pattern without letters."""
    name = _free((), design.patterns, "P")
    return with_pattern(design, name, "ε"), name


def _add_layer(design: Design) -> tuple[Design, str]:
    """A layer of the newest patterns on top, which draws nothing until it has shapes."""
    x, y = _newest(design)
    for own in (x, y):
        if own not in design.patterns:
            design = with_pattern(design, own, "ε")
    top = layers_from_top(design)[:1]
    name = _free((), [layer.name for layer in design.layers], "layer ")
    depth = top[0].depth if top else 0
    shapes = {"* *": {"visible": False}}
    return add_layer(design, name, x, y, depth=depth, shapes=shapes), name


def _newest(design: Design) -> tuple[str, str]:
    """Patterns for the two axes of a new layer: those that no layer uses yet, the newest first, else the top layer's.

    Where there are none for an axis, the name is that of a new one.
    """
    used = {layer.along(axis).pattern for layer in design.layers for axis in AXES}
    waiting = [name for name in design.patterns if name not in used][-2:]
    top = layers_from_top(design)[:1]
    if len(waiting) == 2:
        first, second = waiting
        swap = _leaning(design, first) == "y" or _leaning(design, second) == "x"
        return (second, first) if swap else (first, second)
    if not top:
        across, up = waiting[0] if waiting else "", ""
        if across and _leaning(design, across) == "y":
            across, up = "", across
        across = across or _free((), [*design.patterns, up], "P")
        return across, up or _free((), [*design.patterns, across], "P")
    across, up = top[0].x.pattern, top[0].y.pattern
    if not waiting:
        return across, up
    return (across, waiting[0]) if _leaning(design, waiting[0]) == "y" else (waiting[0], up)


def _leaning(design: Design, name: str) -> Axis | None:
    """The axis that a pattern is probably for: where its symbols stand already, else by the end of its name."""
    own = set(design.patterns[name].parsed.symbols)
    common = dict.fromkeys(AXES, 0)
    for layer in design.layers:
        for axis in AXES:
            common[axis] += len(own & set(design.patterns[layer.along(axis).pattern].parsed.symbols))
    if common["x"] != common["y"]:
        return "x" if common["x"] > common["y"] else "y"
    return next((axis for axis in AXES if len(name) > 1 and name.endswith(axis)), None)


def _duplicate(model: FacadeModel, message: Message) -> Reply:
    """Put a copy of a layer above it; the answer tells its name."""
    design, layer = model.design, find_layer(model.design, message["name"])
    name = _free((f"{layer.name} copy",), [own.name for own in design.layers], f"{layer.name} copy ")
    order = list(design.layers)
    order.insert(order.index(layer) + 1, replace(layer, name=name))
    model.edit(replace(design, layers=tuple(order)))
    return {"kind": "added", "what": "layer", "name": name}


def _solo(model: FacadeModel, message: Message) -> Reply:
    """Show a layer alone; where it is alone already, those that were shown before, or else all."""
    design, name = model.design, find_layer(model.design, message["name"]).name
    shown = [layer.name for layer in design.layers if layer.visible]
    alone, before = model.alone
    if shown == [name]:
        kept = before if alone == name and {layer.name for layer in design.layers} & before - {name} else None
        layers = [replace(own, visible=kept is None or own.name in kept) for own in design.layers]
    else:
        # From one that is alone to the next: what was shown before the first comes back.
        model.alone = (name, before if shown == [alone] else frozenset(shown))
        layers = [replace(own, visible=own.name == name) for own in design.layers]
    model.edit(replace(design, layers=tuple(layers)))
    return None


def _sweep(model: FacadeModel, _: Message) -> Reply:
    """Remove the symbols and the counters that no pattern writes, with the shapes that only they could have."""
    design = model.design
    parsed = [pattern.parsed for pattern in design.patterns.values()]
    written = {symbol for own in parsed for symbol in own.symbols}
    counted = {counter for own in parsed for counter in own.counters}
    gone = set(design.symbols) - written
    counters = {name: own for name, own in design.counters.items() if name in counted}
    model.edit(replace(_without_symbols(design, gone), counters=counters))
    return None


def _without_symbols(design: Design, gone: Container[str]) -> Design:
    """The design without symbols, and without keys of shapes that mean nothing else."""
    written = {symbol for pattern in design.patterns.values() for symbol in pattern.parsed.symbols}
    known = {*design.symbols, *written}

    def kept(shapes: Mapping[str, Shape]) -> dict[str, Shape]:
        return {
            key: shape
            for key, shape in shapes.items()
            if any(x not in gone and y not in gone for (x, _), (y, _) in meanings(key, known))
        }

    return replace(
        design,
        symbols={name: symbol for name, symbol in design.symbols.items() if name not in gone},
        shapes=kept(design.shapes),
        patterns={name: replace(own, shapes=kept(own.shapes)) for name, own in design.patterns.items()},
        layers=tuple(replace(layer, shapes=kept(layer.shapes)) for layer in design.layers),
    )


def _remove(model: FacadeModel, message: Message) -> Reply:
    """Remove a layer, a pattern that no layer uses, or what is declared of a symbol or a counter."""
    kind, name = message["kind"], message["name"]
    if kind == "layer":
        model.edit(remove_layer(model.design, name))
    elif kind == "symbol" and not any(name in own.parsed.symbols for own in model.design.patterns.values()):
        model.edit(_without_symbols(model.design, {name}))
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
    """Rename a symbol, a counter, a pattern, a layer or a group, wherever it is named; what is picked stays picked."""
    kind, name, to = message["kind"], message["name"], str(message["to"]).strip()
    picked = model.selection
    if kind == "layer":
        renamed = with_layer(model.design, name, name=to)
        now = renamed.layers[_index(model.design, name)].name
        alone, before = model.alone
        model.alone = (
            now if alone == name else alone,
            frozenset(now if own == name else own for own in before),
        )
        if picked.layer == name:
            model.selection = replace(picked, layer=now)
    else:
        renamed = _RENAMERS[kind](model.design, name, to)
        if kind == "symbol":
            to = clean_name(to)
            x, y = (to if own == name else own for own in (picked.x, picked.y))
            more = tuple((to if a == name else a, to if b == name else b) for a, b in picked.more)
            model.selection = replace(picked, x=x, y=y, more=more)
    model.edit(renamed)
    return {"kind": "renamed", "what": kind, "name": name, "to": to}


def _index(design: Design, name: str) -> int:
    return [layer.name for layer in design.layers].index(name)


_RENAMERS = {
    "pattern": rename_pattern,
    "symbol": rename_symbol,
    "counter": rename_counter,
    "group": rename_group,
}


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
    "toggle": _toggle,
    "wall": _wall,
    "save": _save,
    "open": _open,
    "gallery": _gallery,
    "add": _add,
    "duplicate": _duplicate,
    "solo": _solo,
    "sweep": _sweep,
    "remove": _remove,
    "move": _move,
    "rename": _rename,
}
