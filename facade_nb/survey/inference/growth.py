"""Where a pattern grows: which of its parts a counter repeats, so that a wider façade has more windows of its kind."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from .repeats import Chain, Expression, Leaf, Mirror, Run, Series

__all__ = ["Looks", "counted", "grown", "shares"]

_WALL = 0.3
"""Windows with less between them than this part of their size are one group, not a rhythm."""
_REPEATED, _USUAL, _NO_WALL, _ODD = 0.3, 0.3, 1.0, 2.0
"""What speaks for a part that repeats already, and for usual windows; against thin walls, and against doors."""


@dataclass(frozen=True, slots=True)
class Looks:
    """What is known of a line's symbols: sizes; those that are openings and how usual each is, 0 to 1; odd ones."""

    sizes: Sequence[float]
    usual: dict[int, float]
    odd: frozenset[int]
    canvas: float


def grown(expression: Expression, counter: str, looks: Looks, *, only_runs: bool = False) -> Expression:
    """The expression with a counter at the part that suits best; as it is where none does."""
    best = min(
        (
            (round(_score(part, step, looks), 6), n, changed)
            for n, (part, step, changed) in enumerate(_growths(expression, counter, 1))
            if not only_runs or (isinstance(part, Run | Chain) and part.times > 1)
        ),
        key=lambda entry: entry[:2],
        default=None,
    )
    return expression if best is None or best[0] >= _ODD else best[2]


def _growths(
    expression: Expression, counter: str, copies: int
) -> Iterator[tuple[Expression, int, Expression]]:
    """A part that may be repeated, how often it stands in the word, and the expression with a counter there."""
    match expression:
        case Run(body, times):
            if times > 1:
                yield expression, copies, replace(expression, counter=counter)
            for part, step, changed in _growths(body, counter, copies * times):
                yield part, step, replace(expression, body=changed)
        case Chain(_, times):
            yield expression, copies, replace(expression, counter=counter)
        case Mirror(body):
            for part, step, changed in _growths(body, counter, copies * 2):
                yield part, step, replace(expression, body=changed)
            yield from _alone(expression, counter, copies)
        case Series(parts):
            for i, own in enumerate(parts):
                for part, step, changed in _growths(own, counter, copies):
                    yield part, step, Series((*parts[:i], changed, *parts[i + 1 :]))
            for i in range(len(parts)):
                for j in range(i + 2, min(len(parts), i + 6) + 1):
                    unit: Expression = Series(parts[i:j])
                    run = Run(unit, 1, counter)
                    yield unit, copies, run if j - i == len(parts) else Series((*parts[:i], run, *parts[j:]))
        case _:
            yield from _alone(expression, counter, copies)


def _alone(expression: Expression, counter: str, copies: int) -> Iterator[tuple[Expression, int, Expression]]:
    yield expression, copies, Run(expression, 1, counter)


def _word(expression: Expression) -> list[int]:
    match expression:
        case Leaf(symbol):
            return [symbol]
        case Series(parts):
            return [symbol for part in parts for symbol in _word(part)]
        case Run(body, times):
            return _word(body) * times
        case Mirror(body, pivot):
            word = _word(body)
            return word + word[::-1][pivot:]
        case Chain(_, times):
            link = _link(expression)
            return link * times + link[:1]


def _link(chain: Chain) -> list[int]:
    """What a chain repeats."""
    word = _word(chain.body)
    return word + word[-1 - chain.total : 0 : -1]


def _score(part: Expression, copies: int, looks: Looks) -> float:
    """How badly a part suits; 2 and more: not at all."""
    match part:
        case Run(body):
            word = _word(body)
        case Chain():
            word = _link(part)
        case _:
            word = _word(part)
    openings = [symbol for symbol in word if symbol in looks.usual]
    ends = [symbol in looks.usual for symbol in (word[0], word[-1])]
    repeats = isinstance(part, Run | Chain) and part.times > 1
    if (
        not openings
        or any(symbol in looks.odd for symbol in openings)
        or (ends[0] == ends[1] and not repeats)
    ):
        return _ODD
    step = copies * sum(looks.sizes[symbol] for symbol in word) / looks.canvas
    if step > 0.75:
        return _ODD
    wall = 0.0 if all(ends) else looks.sizes[word[-1] if ends[0] else word[0]]
    score = step - _USUAL * sum(looks.usual[symbol] for symbol in openings) / len(openings)
    if wall < _WALL * min(looks.sizes[symbol] for symbol in openings):
        score += _NO_WALL
    if repeats:
        score -= _REPEATED
    return score


def shares(expression: Expression) -> list[float]:
    """For each letter of the word: which part of what a counter adds is added before it. Empty: there is no counter."""
    copies = _copies(expression)
    last = {copy: i for i, copy in enumerate(copies) if copy}
    if not last:
        return []
    return [sum(end < i for end in last.values()) / len(last) for i in range(len(copies))]


def counted(expression: Expression) -> list[bool]:
    """For each letter of the word whether it stands in what a counter repeats."""
    return list(map(bool, _copies(expression)))


def _copies(expression: Expression) -> list[tuple[int, ...]]:
    """For each letter of the word in which copy of a counted part it stands; empty: in none."""
    match expression:
        case Series(parts):
            return [copy and (n, *copy) for n, part in enumerate(parts) for copy in _copies(part)]
        case Run(body, times, counter):
            inner = [(0,)] * len(_word(body)) if counter else _copies(body)
            return [copy and (n, *copy) for n in range(times) for copy in inner]
        case Chain(_, times, _, counter):
            links = [(n,) if counter else () for n in range(times) for _ in _link(expression)]
            return [*links, ()]
        case Mirror(body, pivot):
            half = _copies(body)
            return [copy and (0, *copy) for copy in half] + [
                copy and (1, *copy) for copy in half[::-1][pivot:]
            ]
        case _:
            return [()]
