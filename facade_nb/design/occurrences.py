"""From the letters of a word back to the text: which place of a pattern each of them comes from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from .errors import DesignError
from .pattern import Pattern
from .tree import Alt, Concat, Count, Mirror, Node, Sym

__all__ = ["Written", "occurrences"]

Written = tuple[str, bool, bool]
"""A letter by its symbol, whether it is mirrored, and whether a substitution put it there."""

MOST_WAYS = 500
"""Patterns with more ways to choose their alternatives are not spelled again for the sake of places."""


def occurrences(
    pattern: Pattern, counters: Mapping[str, int], letters: Sequence[Written]
) -> tuple[int, ...] | None:
    """The offset in the pattern's text of the place that each letter of a word comes from.

    Parameters
    ----------
    pattern
        A pattern that was read from text.
    counters
        The values with which the word was made.
    letters
        The word.

    Returns
    -------
    One offset for each letter. None where the word is not one of the pattern's, the pattern was not read from text, or
    it has too many alternatives.
    """
    # Texts are equal where patterns are not: two of them may write the same in other places.
    values = tuple(sorted((name, counters[name]) for name in pattern.counters if name in counters))
    return _found(pattern.text, pattern, values, tuple(letters))


@lru_cache(maxsize=512)
def _found(
    _: str, pattern: Pattern, values: tuple[tuple[str, int], ...], letters: tuple[Written, ...]
) -> tuple[int, ...] | None:
    if not pattern.sites or pattern.most_ways() > MOST_WAYS:
        return None
    marked = _marked(pattern)
    try:
        words = marked.words(dict(values))
    except DesignError:  # a counter without a value, or too many letters
        return None
    for word in words:
        own = [glyph.symbol.rpartition("@") for glyph in word]
        spelled = tuple(
            (name, glyph.mirrored, glyph.origin is not None)
            for (name, _, _), glyph in zip(own, word, strict=True)
        )
        if spelled == letters:
            return tuple(int(offset) for _, _, offset in own)
    return None


def _marked(pattern: Pattern) -> Pattern:
    """The pattern with each symbol's name followed by ``@`` and its place; substituted ones keep their names."""
    sites = iter([site for site in pattern.sites if site.role != "counter"])
    kept = frozenset(pattern.substituted)

    def marked(node: Node) -> Node:
        match node:
            case Sym(name=name):
                offset = next(sites).offset
                return node if name in kept else Sym(f"{name}@{offset}")
            case Concat(parts=parts):
                return Concat(tuple(_each(parts)))
            case Alt(options=options):
                return Alt(tuple(_each(options)))
            case Mirror(body=body) | Count(body=body):
                return replace(node, body=marked(body))
        return node

    def _each(nodes: Sequence[Node]) -> Iterator[Node]:
        for node in nodes:
            yield marked(node)

    control = marked(pattern.control)
    contents = []
    for name, content in pattern.substitutions:
        next(sites)  # the symbol before ':='
        contents.append((name, marked(content)))
    return Pattern(control, tuple(contents))
