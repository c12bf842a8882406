"""Patterns: read from text, printed, and spelled out as words (the paper's 3.2 to 3.4, supplement 1.1).

>>> pattern = parse("yBmAm^-1By; m := (AB)^k")
>>> [" ".join(map(str, word)) for word in pattern.words({"k": 1})]
["y B A B A B' A' B y"]
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import product
from math import prod
from typing import Literal, NamedTuple

from .modes import Spelling
from .text import locate, spell
from .tree import (
    Alt,
    Concat,
    Count,
    Empty,
    Mirror,
    Node,
    Sym,
    alternation,
    check_room,
    choices,
    concatenation,
    letters_at,
    spellings,
    unparse,
    walk,
    ways_at_most,
)

__all__ = [
    "Alt",
    "Concat",
    "Count",
    "Empty",
    "Glyph",
    "GlyphFields",
    "Mirror",
    "Node",
    "Pattern",
    "Site",
    "Sym",
    "parse",
]


@dataclass(frozen=True, slots=True)
class Glyph:
    """One letter of a word as a pattern makes it.

    Attributes
    ----------
    symbol
        The symbol's name.
    mirrored
        Whether it is a mirrored instance.
    transparent
        Whether it is an unsubstituted letter of a control pattern (paper 3.4).
    origin
        ``(symbol, n)``: content of the n-th instance (from 0) of that substituted symbol in the word; None for
        letters of the control pattern. Takes no part in equality.
    """

    symbol: str
    mirrored: bool = False
    transparent: bool = False
    origin: tuple[str, int] | None = field(default=None, compare=False)

    def __str__(self) -> str:
        return spell(self.symbol) + ("'" if self.mirrored else "")


GlyphFields = tuple[str, bool, bool, tuple[str, int] | None]
"""The fields of a `Glyph`, in order."""


class Site(NamedTuple):
    """A place in a pattern's text where a name stands; `offset` counts characters from 0."""

    name: str
    role: Literal["placeholder", "solid", "substituted", "counter"]
    offset: int


@dataclass(frozen=True)
class Pattern:
    """A control pattern and what is substituted in it.

    Attributes
    ----------
    control
        Tree of the control pattern; where nothing is substituted, of the whole pattern.
    substitutions
        Substituted symbols with the trees of their contents, in the order written.
    text
        The text that was read, or the printed form. Takes no part in equality.
    sites
        Every place in `text` where a symbol or a counter stands, in order; empty for a pattern not read from text.
    """

    control: Node
    substitutions: tuple[tuple[str, Node], ...] = ()
    text: str = field(default="", compare=False)
    sites: tuple[Site, ...] = field(default=(), compare=False, repr=False)

    def __hash__(self) -> int:
        """Found once: patterns are part of most keys under which the solver keeps answers."""
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.control, self.substitutions))

    def __str__(self) -> str:
        """Canonical text: ``parse(str(pattern)) == pattern``."""
        contents = (f"{spell(name)} := {unparse(content)}" for name, content in self.substitutions)
        return "; ".join((unparse(self.control), *contents))

    @cached_property
    def counters(self) -> tuple[str, ...]:
        """Named counters, in order of appearance."""
        counts = (node.value for node in self._nodes() if isinstance(node, Count))
        return tuple(dict.fromkeys(value for value in counts if isinstance(value, str)))

    @cached_property
    def substituted(self) -> tuple[str, ...]:
        """Substituted symbols, in the order written."""
        return tuple(name for name, _ in self.substitutions)

    @cached_property
    def symbols(self) -> tuple[str, ...]:
        """Every symbol that can stand in a word, in order of appearance."""
        names = dict.fromkeys(node.name for node in self._nodes() if isinstance(node, Sym))
        return tuple(name for name in names if name not in self.substituted)

    @cached_property
    def placeholders(self) -> frozenset[str]:
        """Symbols of the control pattern that are left standing, where there is a substitution."""
        return (
            frozenset(_symbols(self.control) - set(self.substituted)) if self.substitutions else frozenset()
        )

    @cached_property
    def solids(self) -> frozenset[str]:
        """Symbols with letters that are not transparent: those of contents, or all where nothing is substituted."""
        if not self.substitutions:
            return frozenset(_symbols(self.control))
        return frozenset(name for _, content in self.substitutions for name in _symbols(content))

    @cached_property
    def spans(self) -> Mapping[str, tuple[tuple[int, int], ...]]:
        """Line and column (from 1) of every place in `text` where each symbol stands."""
        return self._places("placeholder", "solid", "substituted")

    @cached_property
    def counter_spans(self) -> Mapping[str, tuple[tuple[int, int], ...]]:
        """Line and column (from 1) of every place in `text` where each counter stands."""
        return self._places("counter")

    def words(self, counters: Mapping[str, int]) -> tuple[tuple[Glyph, ...], ...]:
        """Every word for these counter values, one for each choice of alternatives.

        Parameters
        ----------
        counters
            A value for each name in `self.counters`, of either sign; others are ignored.

        Returns
        -------
        tuple of words
            In lexicographic order of choices as they stand in the text, equal words once.

        Raises
        ------
        DesignError
            If a counter has no value, or a word would be longer than `MAX_LETTERS` letters, or there are too many.
        """
        controls = spellings(self.control, counters)
        if not self.substitutions:
            return tuple(tuple(Glyph(symbol, flag) for symbol, flag in word) for word in controls)
        contents = {name: spellings(content, counters) for name, content in self.substitutions}
        words: dict[tuple[Glyph, ...], None] = {}
        total = 0
        for control in controls:
            standing = {symbol for symbol, _ in control}
            names = [name for name in self.substituted if name in standing]
            check_room(words=len(words) + prod(len(contents[name]) for name in names))
            for choice in product(*(contents[name] for name in names)):
                chosen = dict(zip(names, choice, strict=True))
                length = sum(len(chosen.get(symbol, "1")) for symbol, _ in control)
                total += length
                check_room(length, total)
                words[tuple(Glyph(*own) for own in _substitute(control, chosen))] = None
        return tuple(words)

    def without(self, symbol: str) -> Pattern:
        """The pattern with ε for every letter of a symbol."""
        contents = ((name, _without(content, symbol)) for name, content in self.substitutions)
        return Pattern(_without(self.control, symbol), tuple(contents))

    def ways(self) -> tuple[Pattern, ...]:
        """The patterns without alternatives that this one is a choice of, in lexicographic order of choices.

        Raises
        ------
        DesignError
            If there are more than `MAX_WORDS`.
        """
        contents = {name: choices(content) for name, content in self.substitutions}
        found: list[Pattern] = []
        for control in choices(self.control):
            standing = _symbols(control)
            names = [name for name in self.substituted if name in standing]
            check_room(words=len(found) + prod(len(contents[name]) for name in names))
            for choice in product(*(contents[name] for name in names)):
                own = dict(zip(names, choice, strict=True))
                rest = ((name, own.get(name, contents[name][0])) for name in self.substituted)
                found.append(Pattern(control, tuple(rest)))
        return tuple(found)

    def most_ways(self) -> int:
        """How many `ways` there are at most: choices that come to the same are counted each."""
        return ways_at_most(self.control) * prod(ways_at_most(content) for _, content in self.substitutions)

    def fewest_letters(self, counters: Mapping[str, int]) -> int:
        """Letters of the shortest word for these counter values, shared letters of reflections counted twice."""
        contents = {name: letters_at(content, {}, counters, min) for name, content in self.substitutions}
        return letters_at(self.control, contents, counters, min)

    def spell(self, counters: Mapping[str, int]) -> Iterator[GlyphFields]:
        """The fields of each `Glyph` of the first word for these counter values: quicker than `words`.

        For patterns without alternatives, which have no other word. Raises as `words` does.
        """
        control = spellings(self.control, counters)[0]
        if not self.substitutions:
            return ((symbol, flag, False, None) for symbol, flag in control)
        standing = {symbol for symbol, _ in control}
        chosen = {
            name: spellings(content, counters)[0] for name, content in self.substitutions if name in standing
        }
        check_room(sum(len(chosen.get(symbol, "1")) for symbol, _ in control))
        return _substitute(control, chosen)

    def _nodes(self) -> Iterator[Node]:
        yield from walk(self.control)
        for _, content in self.substitutions:
            yield from walk(content)

    def _places(self, *roles: str) -> dict[str, tuple[tuple[int, int], ...]]:
        found: defaultdict[str, list[tuple[int, int]]] = defaultdict(list)
        for site in self.sites:
            if site.role in roles:
                found[site.name].append(locate(self.text, site.offset))
        return {name: tuple(places) for name, places in found.items()}


def _symbols(node: Node) -> set[str]:
    return {part.name for part in walk(node) if isinstance(part, Sym)}


def _without(node: Node, symbol: str) -> Node:
    match node:
        case Sym(name=name):
            return Empty() if name == symbol else node
        case Concat(parts=parts):
            return concatenation([_without(part, symbol) for part in parts])
        case Alt(options=options):
            return alternation([_without(option, symbol) for option in options])
        case Mirror(body=body) | Count(body=body):
            return replace(node, body=_without(body, symbol))
    return node


def _substitute(control: Spelling, chosen: Mapping[str, Spelling]) -> Iterator[GlyphFields]:
    """The letters of a control word, substituted symbols replaced; a mirrored instance mirrors its content."""
    instances = dict.fromkeys(chosen, 0)
    for symbol, flag in control:
        content = chosen.get(symbol)
        if content is None:
            yield symbol, flag, True, None
            continue
        origin = (symbol, instances[symbol])
        instances[symbol] += 1
        for inner, inner_flag in reversed(content) if flag else content:
            yield inner, inner_flag != flag, False, origin


@lru_cache(maxsize=1024)
def parse(text: str) -> Pattern:
    """Read a pattern text (docs/patterns.md). Cached by text.

    Raises
    ------
    PatternError
        With line, column and a caret, if the text is not a pattern.
    """
    # Imported here: it brings lark, which takes longer to import than all of facade_nb.design.
    from .reading import read_pattern

    return read_pattern(text)
