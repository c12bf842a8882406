"""What comes by itself while a pattern is typed, and goes again: symbols with a size, counters, what masks have lost.

Whoever types ``A`` and then ``A2`` means one symbol, not two. So what has come by itself is remembered, and goes when
no pattern writes it any more; it stays once somebody has touched it. Everything here is pure.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from statistics import median
from typing import Any

from ...design import Design, DesignError, parse
from ...design.instances import meanings
from ...design.model import AXES, PatternDef, Symbol
from .fields import Path, apply

__all__ = ["Newcomers", "begun", "enter", "tidy"]

_EMPTY = "ε"
_SIZE = 1.0
"""Metres of a new symbol where nothing stands beside it that tells how large it might be."""


@dataclass(frozen=True, slots=True)
class Newcomers:
    """What has come by itself and was not touched since.

    Attributes
    ----------
    symbols
        The symbols that were given a size: as they came, and as they were before (None: not declared).
    counters
        The counters that are new in a text.
    lists
        What a mask or a list of hidden symbols was before letters of it were typed away, by its place.
    """

    symbols: Mapping[str, tuple[Symbol, Symbol | None]] = field(default_factory=dict)
    counters: frozenset[str] = frozenset()
    lists: Mapping[Path, tuple[str, ...]] = field(default_factory=dict)


def enter(design: Design, path: Path, value: Any, known: Newcomers) -> tuple[Design, Newcomers]:
    """The design with the field at `path` set, as `fields.apply` does, and what has come by itself.

    A pattern's text brings the symbols that it needs, each with a size. An empty text is the empty word.

    Raises
    ------
    DesignError
        As `apply` does.
    """
    match path:
        case ("patterns", name, "text") if name in design.patterns and isinstance(value, str):
            return _write(design, name, value if value.strip() else _EMPTY, known)
        case ("symbols", name, _):
            symbols = {symbol: own for symbol, own in known.symbols.items() if symbol != name}
            return tidy(apply(design, path, value), replace(known, symbols=symbols))
        case ("layers" | "patterns", *_):
            # A mask that somebody sets is what it is; so is that of an axis which takes another pattern.
            lists = {place: own for place, own in known.lists.items() if place[:-1] != path[:-1]}
            return tidy(apply(design, path, value), replace(known, lists=lists))
    return tidy(apply(design, path, value), known)


def tidy(design: Design, known: Newcomers) -> tuple[Design, Newcomers]:
    """The design without newcomers that no pattern writes any more, after an edit of anything else."""
    symbols = dict(design.symbols)
    fresh = _leave(design, symbols, known)
    _keep_named(design, design.symbols, symbols)
    written = {counter for pattern in design.patterns.values() for counter in pattern.parsed.counters}
    counters = known.counters & written - set(design.counters)
    if symbols != design.symbols:
        design = replace(design, symbols=symbols)
    names = {("layers", layer.name) for layer in design.layers} | {
        ("patterns", name) for name in design.patterns
    }
    lists = {place: own for place, own in known.lists.items() if place[:2] in names}
    return design, Newcomers(fresh, counters, lists)


def begun(design: Design) -> Design:
    """The design without layers of which a pattern has no letters yet: they take no part until something is typed."""
    blank = {name for name, pattern in design.patterns.items() if not pattern.parsed.symbols}
    layers = tuple(layer for layer in design.layers if not blank & {layer.x.pattern, layer.y.pattern})
    return design if len(layers) == len(design.layers) else replace(design, layers=layers)


def _write(design: Design, name: str, text: str, known: Newcomers) -> tuple[Design, Newcomers]:
    try:
        parsed = parse(text)
    except DesignError:
        apply(design, ("patterns", name, "text"), text)  # which says where the fault is
        raise
    lists = dict(known.lists)

    def kept(place: Path, own: tuple[str, ...]) -> tuple[str, ...]:
        """What the list has of the symbols that the text writes now, those included that were typed away before."""
        whole = lists.pop(place, own)
        left = tuple(symbol for symbol in whole if symbol in parsed.symbols)
        if left != whole:
            lists[place] = whole
        return left

    before = design.patterns[name]
    hidden = kept(("patterns", name, "hidden"), before.hidden)
    layers = []
    for layer in design.layers:
        for axis in AXES:
            side = layer.along(axis)
            place = ("layers", layer.name, axis, "mask")
            if side.pattern == name and (side.mask is not None or place in lists):
                mask = kept(place, side.mask or ())
                # Where all that was to be seen is typed away, what is typed instead is seen.
                shown = mask if mask or not lists.get(place) else None
                side = replace(side, mask=shown)
                layer = replace(layer, x=side) if axis == "x" else replace(layer, y=side)
        layers.append(layer)
    pattern = PatternDef(name, text, hidden, before.shapes)
    changed = replace(design, patterns={**design.patterns, name: pattern}, layers=tuple(layers))
    symbols = dict(design.symbols)
    fresh = _leave(changed, symbols, known)
    size = _usual_size(design, name, set(known.symbols))
    for symbol in parsed.symbols:
        own = symbols.get(symbol)
        if symbol in parsed.solids and (own is None or own.size is None):
            base = own or Symbol(symbol)
            fitting = min(max(size, base.min or size), base.max or size)
            symbols[symbol] = replace(base, size=fitting)
            fresh[symbol] = (symbols[symbol], own)
    _keep_named(changed, {**design.symbols, **dict.fromkeys(before.parsed.symbols)}, symbols)
    was = {counter for own in design.patterns.values() for counter in own.parsed.counters}
    written = {counter for own in changed.patterns.values() for counter in own.parsed.counters}
    counters = (known.counters | (written - was)) & written - set(design.counters)
    changed = Design.from_dict(replace(changed, symbols=symbols).to_dict())
    return changed, Newcomers(fresh, counters, lists)


def _leave(
    design: Design, symbols: dict[str, Symbol], known: Newcomers
) -> dict[str, tuple[Symbol, Symbol | None]]:
    """Take those newcomers out of `symbols` that no pattern writes solid; return the others."""
    solid = {symbol for pattern in design.patterns.values() for symbol in pattern.parsed.solids}
    stay = {}
    for name, (given, before) in known.symbols.items():
        if symbols.get(name) != given:
            continue  # it was touched
        if name in solid:
            stay[name] = (given, before)
        elif before is None:
            del symbols[name]
        else:
            symbols[name] = before
    return stay


def _keep_named(design: Design, known: Iterable[str], symbols: dict[str, Symbol]) -> None:
    """Keep in `symbols` what keys of shapes name: it would else be a fault that a letter was typed away."""
    written = {symbol for pattern in design.patterns.values() for symbol in pattern.parsed.symbols}
    gone = set(known) - written - set(symbols)
    if not gone:
        return
    known = gone | written | set(symbols)
    patterns = (own.shapes for own in design.patterns.values())
    owners = [design.shapes, *patterns, *(layer.shapes for layer in design.layers)]
    for key in (key for shapes in owners for key in shapes):
        for pair in meanings(key, known):
            for name, _ in pair:
                if name in gone:
                    symbols.setdefault(name, Symbol(name))


def _usual_size(design: Design, name: str, new: set[str]) -> float:
    """A size that goes with what stands on the pattern's axis: the median preferred size there, in centimetres."""
    axes = [axis for axis in AXES if any(layer.along(axis).pattern == name for layer in design.layers)]
    beside = {layer.along(axis).pattern for layer in design.layers for axis in axes} | {name}
    letters = {symbol for own in beside for symbol in design.patterns[own].parsed.solids} - new
    sizes = [size for symbol in letters if (size := design.symbol(symbol).size) is not None]
    return round(median(sizes), 2) or _SIZE if sizes else _SIZE
