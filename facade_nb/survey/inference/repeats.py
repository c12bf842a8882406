"""The shortest pattern of a word: what repeats is counted, what is symmetric is reflected.

A word is a row of numbers, one for each symbol. The shortest expression has the fewest letters; where two have as many,
the one with fewer counts and reflections is taken, for it is easier to read.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np

__all__ = ["Chain", "Expression", "Leaf", "Mirror", "Run", "Series", "leaves", "letters", "shortest"]

_RUN, _MIRROR, _CHAIN = 0.1, 0.15, 0.2
"""What a count, a reflection and both at once weigh, in letters: they decide where there are as many letters."""
_FAR = 1_000_000
"""More letters than any word has."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """One letter."""

    symbol: int


@dataclass(frozen=True, slots=True)
class Series:
    """Parts side by side."""

    parts: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Run:
    """The body, so many times. `counter` names the counter that says how often; empty: always `times`."""

    body: Expression
    times: int
    counter: str = ""


@dataclass(frozen=True, slots=True)
class Mirror:
    """The body and its mirror image. At a pivot both share the last letter of the body."""

    body: Expression
    pivot: bool


@dataclass(frozen=True, slots=True)
class Chain:
    """The body and its mirror image, so many times, and its first letter again: `aBaBa` is a chain of `aB`.

    Each shares its first letter with the one before. In a `total` one the body and its image share the last letter too.
    """

    body: Expression
    times: int
    total: bool
    counter: str = ""


Expression: TypeAlias = "Leaf | Series | Run | Mirror | Chain"


def leaves(expression: Expression) -> Iterator[int]:
    """The symbols of an expression, as it is written."""
    match expression:
        case Leaf(symbol):
            yield symbol
        case Series(parts):
            for part in parts:
                yield from leaves(part)
        case Run(body) | Mirror(body) | Chain(body):
            yield from leaves(body)


def letters(word: Sequence[int], upright: Collection[int] = ()) -> int:
    """How many letters the shortest expression of a word has. No letter that is `upright` is mirrored."""
    return _solved(_canonical(word), _FAR, _places(word, upright))[1] if word else 0


def shortest(word: Sequence[int], upright: Collection[int] = (), reach: int | None = None) -> Expression:
    """The shortest expression of a word of at least one letter, without reflections that make more than `reach`.

    No letter that is `upright` is mirrored.
    """
    names = list(dict.fromkeys(word))
    far = _FAR if reach is None else reach
    return _renamed(_solved(_canonical(word), far, _places(word, upright))[0], names)


def _places(word: Sequence[int], upright: Collection[int]) -> tuple[bool, ...]:
    """For each place of a word whether its letter may be mirrored; empty: all may."""
    return tuple(symbol not in upright for symbol in word) if upright else ()


def _canonical(word: Sequence[int]) -> tuple[int, ...]:
    """The word with its symbols numbered as they appear, so that words that repeat alike are solved once."""
    numbers: dict[int, int] = {}
    return tuple(numbers.setdefault(symbol, len(numbers)) for symbol in word)


def _renamed(expression: Expression, names: Sequence[int]) -> Expression:
    match expression:
        case Leaf(symbol):
            return Leaf(names[symbol])
        case Series(parts):
            return Series(tuple(_renamed(part, names) for part in parts))
        case Run(body, times):
            return Run(_renamed(body, names), times)
        case Mirror(body, pivot):
            return Mirror(_renamed(body, names), pivot)
        case Chain(body, times, total):
            return Chain(_renamed(body, names), times, total)


@lru_cache(maxsize=20_000)
def _solved(word: tuple[int, ...], reach: int, turns: tuple[bool, ...]) -> tuple[Expression, int]:
    """The shortest expression of a word, and its letters: the best of each part of it, the short ones first."""
    n = len(word)
    turns = turns or (True,) * n
    text = "".join(map(chr, word))
    cost = np.full((n + 1, n + 1), np.inf)
    how: dict[tuple[int, int], tuple[str, int]] = {}
    for i in range(n):
        cost[i, i + 1] = 1.0
    for length in range(2, n + 1):
        divisors = [d for d in range(1, length // 2 + 1) if length % d == 0]
        for i in range(n - length + 1):
            j = i + length
            splits = cost[i, i + 1 : j] + cost[i + 1 : j, j]
            k = int(splits.argmin())
            best, way = float(splits[k]), ("series", i + 1 + k)
            part = text[i:j]
            for d in divisors:
                if cost[i, i + d] + _RUN < best and part == part[:d] * (length // d):
                    best, way = float(cost[i, i + d]) + _RUN, ("run", d)
            half = (length + 1) // 2
            if 2 < length <= reach and part[0] == part[-1] and turns[j - 1]:
                if cost[i, i + half] + _MIRROR < best and part == part[::-1] and all(turns[i + half : j]):
                    best, way = float(cost[i, i + half]) + _MIRROR, ("mirror", half)
                for d in range(2, (length - 1) // 2 + 1):
                    if (
                        (length - 1) % d
                        or part[:-1] != part[:d] * (length // d)
                        or part[1:d] != part[d - 1 : 0 : -1]
                    ):
                        continue
                    half = d // 2 + 1
                    if cost[i, i + half] + _CHAIN < best and all(turns[i + half : i + d]):
                        best, way = float(cost[i, i + half]) + _CHAIN, ("chain", d)
            cost[i, j] = best
            how[i, j] = way

    def made(i: int, j: int) -> Expression:
        if j == i + 1:
            return Leaf(word[i])
        kind, at = how[i, j]
        if kind == "run":
            return Run(made(i, i + at), (j - i) // at)
        if kind == "mirror":
            return Mirror(made(i, i + at), (j - i) % 2 == 1)
        if kind == "chain":
            return Chain(made(i, i + at // 2 + 1), (j - i) // at, at % 2 == 0)
        parts = [made(i, at), made(at, j)]
        flat = (inner for part in parts for inner in (part.parts if isinstance(part, Series) else (part,)))
        return Series(tuple(flat))

    expression = made(0, n)
    return expression, sum(1 for _ in leaves(expression))
