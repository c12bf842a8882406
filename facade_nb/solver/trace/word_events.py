"""Words and candidates, told: also those that were dropped, next to those that were kept (Eq. 7)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, product
from math import inf

from ...design.errors import DesignError
from ...design.model import Counter
from ...design.pattern import Alt, Concat, Count, Mirror, Node, Pattern
from ...design.tree import unparse
from ..candidates.stream import CandidateStream
from ..events import CandidateJudged, Event, LeftOut, WordJudged
from ..model.letters import Word
from ..model.precision import EPS
from ..model.problem import AxisProblem
from ..words.instances import Instances
from ..words.neighbours import pushes, spelled, steps
from .network_events import letter_note
from .recorder import Recorder

__all__ = ["untried", "words_judged"]

WORDS = 2_000
"""So many words of a pattern are told,"""
DROPPED = 100
"""and so many dropped ones beside them."""
UNTRIED = 500
"""So many candidates that were never taken up are told."""
_WAYS = 2_000


def words_judged(problem: AxisProblem, found: Mapping[str, Instances], tolerance: float) -> Iterator[Event]:
    """The words of every pattern, in the order of their counters, with the bounds of Eq. 7."""
    high = problem.canvas + tolerance
    pushed = pushes(problem, found)
    for name, pattern in problem.patterns:
        own = found[name]
        low = problem.canvas - tolerance - pushed[name]
        ways = _Ways(pattern)
        kept = list(own.words)
        dropped, more = _beside(problem, pattern, own, high)
        names = pattern.counters
        told = [*((w, True) for w in kept[:WORDS]), *((w, False) for w in dropped)]
        told.sort(key=lambda item: [item[0].counters.get(c, 0) for c in names])
        for word, listed in told:
            unsized = any(letter.size is None for letter in word.letters)
            if word.size > high + EPS:
                reason = "too long"
            elif not unsized and word.size < low - EPS:
                reason = "too short"
            else:
                reason = "fits" if listed else "left out" if own.left < inf else "no partner"
            yield WordJudged(
                problem.axis,
                name,
                str(word),
                word.size,
                dict(word.counters),
                reason == "fits",
                reason,
                tolerance,
                None if unsized else low,
                high,
                ways.of(word),
                tuple(map(letter_note, word.letters)),
            )
        if more + max(0, len(kept) - WORDS):
            yield LeftOut(problem.axis, f"words of {name}", more + max(0, len(kept) - WORDS))


def _beside(problem: AxisProblem, pattern: Pattern, own: Instances, high: float) -> tuple[list[Word], int]:
    """Words that are not listed: of the same counters, and of those one step away; and how many more there are."""
    counters = dict(problem.counters)
    bounds = {name: counters.get(name) or Counter(name) for name in pattern.counters}
    kept = {(tuple(sorted(word.counters.items())), word.letters) for word in own.words}
    values = list(dict.fromkeys(tuple(sorted(word.counters.items())) for word in own.words[:WORDS]))
    values = values or [tuple(sorted(own.shortest.counters.items()))]
    out: list[Word] = []
    more = 0
    symbols = problem.symbol
    for each, bound in steps(values, bounds):
        if bound:
            continue
        if len(out) >= DROPPED:
            more += 1
            continue
        try:
            words = spelled(pattern, dict(each), symbols)
        except DesignError:  # more letters than a word may have
            more += 1
            continue
        out += [word for word in words if (each, word.letters) not in kept]
    return out[:DROPPED], more + max(0, len(out) - DROPPED)


class _Ways:
    """Which alternatives a word took. Worked out per value of the counters, as words of that value come."""

    def __init__(self, pattern: Pattern) -> None:
        self._made = list(islice(_ways(pattern), _WAYS + 1))
        self._known: dict[object, dict[object, tuple[str, ...]]] = {}

    def of(self, word: Word) -> tuple[str, ...]:
        if len(self._made) == 1 or len(self._made) > _WAYS:
            return ()
        key = tuple(word.counters.items())
        if key not in self._known:
            own = self._known[key] = {}
            for pattern, options in self._made:
                for glyphs in pattern.words(word.counters):
                    own.setdefault(tuple((g.symbol, g.mirrored, g.origin is None) for g in glyphs), options)
        spelled = tuple((a.symbol, a.mirrored, a.origin is None) for a in word.letters)
        return self._known[key].get(spelled, ())


def _ways(pattern: Pattern) -> Iterator[tuple[Pattern, tuple[str, ...]]]:
    """The pattern with its alternatives taken, in every way, and the options that were taken."""
    names = [name for name, _ in pattern.substitutions]
    nodes = [pattern.control, *(node for _, node in pattern.substitutions)]
    for chosen in product(*(list(islice(_options(node), _WAYS + 1)) for node in nodes)):
        (control, taken), *contents = chosen
        made = tuple((name, node) for name, (node, _) in zip(names, contents, strict=True))
        yield Pattern(control, made), taken + sum((own for _, own in contents), ())


def _options(node: Node) -> Iterator[tuple[Node, tuple[str, ...]]]:
    match node:
        case Alt(options=options):
            for option in options:
                for made, taken in _options(option):
                    yield made, (unparse(option), *taken)
        case Concat(parts=parts):
            for chosen in product(*(list(islice(_options(part), _WAYS + 1)) for part in parts)):
                yield Concat(tuple(part for part, _ in chosen)), sum((taken for _, taken in chosen), ())
        case Mirror(body=body):
            for made, taken in _options(body):
                yield Mirror(made), taken
        case Count(body=body, mode=mode, negative=negative, value=value):
            for made, taken in _options(body):
                yield Count(made, mode, negative, value), taken
        case _:
            yield node, ()


def untried(
    recorder: Recorder, axis: str, told: set[tuple[str, ...]], number: int, fate: str
) -> Iterator[Event]:
    """Candidates that were never taken up, by growing bound."""
    notes = [note for note in recorder.notes if note[0] == "words" and note[1] == axis]
    if not notes:
        return
    _, _, problem, found, tolerance = notes[-1]
    words: dict[str, Sequence[Word]] = {name: own.words for name, own in found.items()}
    stream = CandidateStream(problem, words, tolerance, recorder.objective)
    taken = iter(stream.take, None)
    fresh = (c for c in taken if tuple(str(w) for w in c.words.values()) not in told)
    for n, candidate in enumerate(islice(fresh, UNTRIED)):
        yield CandidateJudged(
            axis,
            {name: str(word) for name, word in candidate.words.items()},
            dict(candidate.counters),
            candidate.bound,
            fate,
            number=number + n,
            tolerance=tolerance,
            floor=candidate.bound,
        )
    if next(fresh, None) is not None:
        yield LeftOut(axis, "candidates", 1)
