"""The tree of a pattern, its printed form and the words it makes (the paper's 3.2, supplement 1.1)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, product
from math import prod

from .errors import DesignError
from .modes import Spelling, mirrored, repeated, shared
from .text import spell, spell_counter

__all__ = [
    "MAX_LETTERS",
    "MAX_WORDS",
    "Alt",
    "Concat",
    "Count",
    "Empty",
    "Mirror",
    "Node",
    "Sym",
    "alternation",
    "check_room",
    "choices",
    "concatenation",
    "letters_at",
    "longest",
    "spellings",
    "too_long",
    "unparse",
    "walk",
    "ways_at_most",
]

MAX_LETTERS = 20_000
"""Most letters in one word: far beyond any façade, and a bound on what a mistyped count can cost."""

MAX_WORDS = 20_000
"""Most words of one pattern for one choice of counter values."""

_MAX_TOTAL = 2_000_000
"""Most letters in all words of one pattern together, for one choice of counter values."""


@dataclass(frozen=True, slots=True)
class Sym:
    """An instance of a symbol."""

    name: str


@dataclass(frozen=True, slots=True)
class Empty:
    """The empty word, ε."""


@dataclass(frozen=True, slots=True)
class Concat:
    """Two or more parts one after the other; none of them is itself a `Concat` (see `concatenation`)."""

    parts: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Alt:
    """Two or more options to choose from; none of them is itself an `Alt` (see `alternation`)."""

    options: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Mirror:
    """The body reversed, every letter of it mirrored."""

    body: Node


@dataclass(frozen=True, slots=True)
class Count:
    """One word of the body, repeated.

    Attributes
    ----------
    mode
        A key of `modes.MODES`.
    negative
        Whether a minus sign stands before the value.
    value
        A number from 0, or the name of a counter.
    """

    body: Node
    mode: str
    negative: bool
    value: int | str


Node = Sym | Empty | Concat | Alt | Mirror | Count


def concatenation(parts: Iterable[Node]) -> Node:
    """The parts one after the other, nested concatenations made flat."""
    flat = [node for part in parts for node in (part.parts if isinstance(part, Concat) else (part,))]
    return Concat(tuple(flat)) if len(flat) > 1 else flat[0] if flat else Empty()


def alternation(options: Sequence[Node]) -> Node:
    """A choice of the options (at least one), nested choices made flat."""
    flat = [node for option in options for node in (option.options if isinstance(option, Alt) else (option,))]
    return Alt(tuple(flat)) if len(flat) > 1 else flat[0]


def walk(node: Node) -> Iterator[Node]:
    """Every node of the tree, in the order of the text; a count comes after its body."""
    match node:
        case Concat(parts=nodes) | Alt(options=nodes):
            for part in nodes:
                yield from walk(part)
        case Mirror(body=body) | Count(body=body):
            yield from walk(body)
        case Sym() | Empty():
            pass
    yield node


def unparse(node: Node) -> str:
    """The tree as text that reads as the same tree."""
    match node:
        case Sym(name=name):
            return spell(name)
        case Empty():
            return "ε"
        case Concat(parts=parts):
            return "".join(_group(part) if isinstance(part, Alt) else unparse(part) for part in parts)
        case Alt(options=options):
            return "|".join(map(unparse, options))
        case Mirror(body=body):
            return _group(body) + "'"
        case Count(body=body, mode=mode, negative=negative, value=value):
            sign = "-" if negative else ""
            number = str(value) if isinstance(value, int) else spell_counter(value)
            return f"{_group(body)}^{mode}{sign}{number}"


def _group(node: Node) -> str:
    """The node as an operand of a postfix operator."""
    return f"({unparse(node)})" if isinstance(node, Concat | Alt) else unparse(node)


def choices(node: Node) -> list[Node]:
    """The trees without alternatives that a tree is a choice of, in lexicographic order, equal ones once.

    A count repeats one word of its base, so that a choice inside it is a choice outside it as well.

    Raises
    ------
    DesignError
        If there are more than `MAX_WORDS`.
    """
    match node:
        case Alt(options=options):
            found: dict[Node, None] = {}
            for option in options:
                found.update(dict.fromkeys(choices(option)))
                check_room(words=len(found))
            return list(found)
        case Concat(parts=parts):
            ways = [choices(part) for part in parts]
            check_room(words=prod(map(len, ways)))
            return [concatenation(choice) for choice in product(*ways)]
        case Mirror(body=body):
            return [Mirror(own) for own in choices(body)]
        case Count(body=body):
            return [replace(node, body=own) for own in choices(body)]
        case _:
            return [node]


def longest(node: Node, contents: Mapping[str, int], counters: Mapping[str, int] | None = None) -> int:
    """Letters of the longest word, counted without spelling it; never fewer than it has.

    Parameters
    ----------
    contents
        Letters of what is substituted, by symbol.
    counters
        Values of counters; those without one are 0.
    """
    return letters_at(node, contents, counters or {}, max)


def letters_at(
    node: Node, contents: Mapping[str, int], counters: Mapping[str, int], of: Callable[[Iterable[int]], int]
) -> int:
    """Letters of the longest or of the shortest word (`of`: max or min).

    Letters that a reflection shares are counted twice, as where a word is spelled.
    """
    match node:
        case Sym(name=name):
            return contents.get(name, 1)
        case Concat(parts=parts):
            return sum(letters_at(part, contents, counters, of) for part in parts)
        case Alt(options=options):
            return of([letters_at(option, contents, counters, of) for option in options])
        case Mirror(body=body):
            return letters_at(body, contents, counters, of)
        case Count(body=body, mode=mode, value=value):
            times = counters.get(value, 0) if isinstance(value, str) else value
            if times == 0:
                return 0
            return abs(times) * (2 if mode else 1) * letters_at(body, contents, counters, of)
        case _:
            return 0


def ways_at_most(node: Node) -> int:
    """How many choices of alternatives a tree has; equal ones are counted as often as they stand in it."""
    match node:
        case Concat(parts=parts):
            return prod(map(ways_at_most, parts))
        case Alt(options=options):
            return sum(map(ways_at_most, options))
        case Mirror(body=body) | Count(body=body):
            return ways_at_most(body)
        case _:
            return 1


def spellings(node: Node, counters: Mapping[str, int]) -> list[Spelling]:
    """Every word of a tree for these counter values, in lexicographic order of choices, equal ones once.

    Raises
    ------
    DesignError
        If a counter has no value, or the words are longer or more than `MAX_LETTERS` and `MAX_WORDS` allow.
    """
    match node:
        case Sym(name=name):
            return [((name, False),)]
        case Empty():
            return [()]
        case Concat(parts=parts):
            return _sequences([spellings(part, counters) for part in parts])
        case Alt(options=options):
            found: dict[Spelling, None] = {}
            for option in options:
                found.update(dict.fromkeys(spellings(option, counters)))
                check_room(words=len(found))
            return list(found)
        case Mirror(body=body):
            return [mirrored(word) for word in spellings(body, counters)]
        case Count(body=body, mode=mode, negative=negative, value=value):
            if isinstance(value, str):
                if value not in counters:
                    raise DesignError(f"counter {value!r} has no value")
                value = counters[value]
            count = -value if negative else value
            if count == 0:
                return [()]
            bases = spellings(body, counters)
            return list(dict.fromkeys(_repeat(base, mode, count) for base in bases))


def _sequences(parts: list[list[Spelling]]) -> list[Spelling]:
    """Every choice of one word of each part, joined."""
    check_room(words=prod(map(len, parts)))
    words: dict[Spelling, None] = {}
    total = 0
    for choice in product(*parts):
        length = sum(map(len, choice))
        total += length
        check_room(length, total)
        words[tuple(chain.from_iterable(choice))] = None
    return list(words)


def _repeat(base: Spelling, mode: str, count: int) -> Spelling:
    """`count` copies of the base in a reflection mode; a negative count mirrors the base."""
    w = mirrored(base) if count < 0 else base
    k = abs(count) if w else 1  # ε repeated is ε: a huge count of it costs nothing
    check_room(len(base) * k * (2 if mode else 1) - shared(mode, k))
    return repeated(w, mode, k)


def check_room(length: int = 0, total: int = 0, words: int = 0) -> None:
    """Refuse a word of too many letters, too many letters in all, or too many words (`DesignError`)."""
    if length > MAX_LETTERS:
        raise DesignError(too_long(length))
    if total > _MAX_TOTAL:
        raise DesignError(
            f"the words would have over {_MAX_TOTAL:,} letters together; use fewer alternatives"
        )
    if words > MAX_WORDS:
        raise DesignError(
            f"there would be over {MAX_WORDS:,} words for one choice of counters; use fewer alternatives"
        )


def too_long(letters: int) -> str:
    """What is said of a word of too many letters."""
    shown = f"{letters:,}" if letters < 10**12 else "over 1,000,000,000,000"
    return f"a word would have {shown} letters; at most {MAX_LETTERS:,} are possible"
