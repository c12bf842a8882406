"""What each cell of a layer looks like: the more exact key wins; instances and variants (docs/documents.md)."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from hashlib import blake2b
from itertools import accumulate
from typing import Any

from ...design.instances import spell_instance, split_instance
from ...design.model import Design, Layer, Shape, Variant
from ..model.layout import AxisLayout, PlacedLetter

__all__ = ["DEFAULT_SHAPE", "Instance", "Looks", "Told", "instances", "written"]

DEFAULT_SHAPE = Shape("wall", "box", "card", 0.0, 0.2, True)
"""What a shape is where nothing is said: a plain box, as in the paper."""

_FIELDS = tuple(f.name for f in fields(Shape) if f.name != "variants")

Instance = tuple[str, int, int]
"""A symbol, a solid letter's number from 1 among those of it in the layer's word, and how many they are."""


@dataclass(frozen=True, slots=True)
class Told:
    """What one key says of a cell.

    Attributes
    ----------
    level
        Who says it: ``design``, ``x`` or ``y`` (the layer's pattern of that axis), or ``layer``.
    key
        The key of shapes.
    fields
        The fields that it sets, those of the variant that this instance takes included.
    varied
        Those of them that the variant sets.
    """

    level: str
    key: str
    fields: Mapping[str, Any]
    varied: frozenset[str] = frozenset()


def instances(solved: AxisLayout, layer: Layer) -> Iterator[tuple[PlacedLetter, Instance]]:
    """The solid letters of a layer's word in order, each with which instance of its symbol it is."""
    solid = [letter for letter in solved.row(layer.name).letters if not letter.transparent]
    many: dict[str, int] = {}
    for letter in solid:
        many[letter.symbol] = many.get(letter.symbol, 0) + 1
    seen: dict[str, int] = {}
    for letter in solid:
        number = seen[letter.symbol] = seen.get(letter.symbol, 0) + 1
        yield letter, (letter.symbol, number, many[letter.symbol])


def written(design: Design) -> set[str]:
    """All symbols of a design, those included that only its patterns write."""
    return {*design.symbols, *(s for p in design.patterns.values() for s in p.parsed.symbols)}


class Looks:
    """The looks of a layer's cells, every field filled in.

    A layer's shapes override its patterns', which override the design's. Within each, keys take effect from the least
    exact to the most exact: ``*``, then the symbol, then an instance of it, x before y. Each key sets its fields, and
    then those of the variant that this instance takes.
    """

    def __init__(self, design: Design, layer: Layer, known: Collection[str] | None = None) -> None:
        x, y = (design.patterns[side.pattern].shapes for side in (layer.x, layer.y))
        every = (("design", design.shapes), ("x", x), ("y", y), ("layer", layer.shapes))
        self._sources = [(level, source) for level, source in every if source]
        self._choice = (design.seed, layer.name)
        known = written(design) if known is None else known
        # Numbers by which a symbol's instances are named, from the left or from below and from the other end.
        self._named: dict[str, set[int]] = {}
        varied = False
        for key, shape in ((key, shape) for _, source in self._sources for key, shape in source.items()):
            varied = varied or shape.variants is not None
            for name in _halves(key) if "[" in key else ():
                symbol, number = split_instance(name, known)
                if number is not None:
                    self._named.setdefault(symbol, set()).add(number)
        self._varied = varied
        self._sorts: dict[tuple[tuple[str, ...], Instance | None], int] = {}
        self._members: list[tuple[tuple[str, ...], Instance]] = []
        self._cells: dict[tuple[int, int], Shape] = {}

    def sort(self, own: Instance) -> int:
        """A number for all instances of a symbol that no key tells apart."""
        names = self._names(own)
        found = self._sorts.setdefault((names, own if self._varied else None), len(self._members))
        if found == len(self._members):
            self._members.append((names, own))
        return found

    def of(self, x: int, y: int) -> Shape:
        """The looks of a cell, given by what `sort` says of its two letters."""
        look = self._cells.get((x, y))
        if look is None:
            look = self._cells[x, y] = self._made(*self._members[x], *self._members[y])
        return look

    def told(self, x: Instance, y: Instance) -> list[Told]:
        """What every key says of a cell, the least exact first: each goes over those before it.

        A number of 0 means no instance in particular: then no key of an instance applies, and no variant is chosen.
        """
        return list(self._told(self._names(x), x, self._names(y), y))

    def _names(self, own: Instance) -> tuple[str, ...]:
        """The names in keys by which an instance is meant, the least exact first."""
        symbol, number, count = own
        if not number:
            return ("*", symbol)
        named: Collection[int] = self._named.get(symbol, ())
        numbers = [n for n in (number - count - 1, number) if n in named]
        return ("*", symbol, *(spell_instance(symbol, n) for n in numbers))

    def _made(self, across: Sequence[str], x: Instance, up: Sequence[str], y: Instance) -> Shape:
        told: dict[str, Any] = {}
        for one in self._told(across, x, up, y):
            told.update(one.fields)
        return replace(DEFAULT_SHAPE, **told) if told else DEFAULT_SHAPE

    def _told(self, across: Sequence[str], x: Instance, up: Sequence[str], y: Instance) -> Iterator[Told]:
        keys = [f"{a} {b}" for a in across for b in up]  # the least exact first
        for level, source in self._sources:
            for key in keys:
                given = source.get(key)
                if given is None:
                    continue
                fields = _set(given)
                if given.variants is None or not (x[1] and y[1]):
                    yield Told(level, key, fields)
                else:
                    chosen = _set(self._variant(given.variants, x, y).shape)
                    yield Told(level, key, {**fields, **chosen}, frozenset(chosen))

    def _variant(self, variants: Sequence[Variant], x: Instance, y: Instance) -> Variant:
        """The variant of an instance: by the design's seed, the layer, the symbols and their numbers alone."""
        seed, layer = self._choice
        text = "\0".join(map(str, (seed, layer, *x[:2], *y[:2])))
        share = int.from_bytes(blake2b(text.encode(), digest_size=6).digest()) / 2**48
        sums = list(accumulate(variant.weight for variant in variants))
        return next(v for v, reached in zip(variants, sums, strict=True) if share * sums[-1] < reached)


def _halves(key: str) -> set[str]:
    """Every name that a key may be made of: names may have blanks themselves."""
    words = key.split(" ")
    return {" ".join(part) for cut in range(1, len(words)) for part in (words[:cut], words[cut:])}


def _set(shape: Shape) -> Mapping[str, Any]:
    return {name: value for name in _FIELDS if (value := getattr(shape, name)) is not None}
