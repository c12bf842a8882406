"""An answer found elsewhere, as it is here: under another objective, or before an edit.

An edit seldom changes which structure is the best. What the last one costs now bounds J from above before anything is
searched: no candidate has to be aligned further than that. It is a bound and no more: the answer is what the search
finds within it, with the same ties as without.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf

from ..alignment.elements import Option
from ..alignment.group import Group
from ..alignment.pricing import Columns, Priced, price
from ..candidates.stream import Candidate
from ..model.letters import Word
from .axis import AxisSearch, Solved

__all__ = ["adopted", "carried", "upper_bound"]


def adopted(walk: AxisSearch, other: Solved, *, respelled: bool = False) -> Solved | None:
    """Another search's answer, priced and sized as here; None: its words do not fit, or not within the tolerance.

    With `respelled` a pattern may be written in another way by now: what counts is that its word is one still.
    """
    candidate = _respelled(walk, other.candidate) if respelled else _now(walk, other.candidate)
    return None if candidate is None else carried(walk, other, candidate)


def carried(walk: AxisSearch, other: Solved, candidate: Candidate) -> Solved | None:
    """The structure of an answer with the words of a candidate, priced and sized; None: not within the tolerance."""
    case = walk.case(candidate)
    case.clusters, case.groups = walk.searches.groups(candidate)
    ties: list[list[Priced]] = []
    for cluster in case.clusters:
        priced = _priced([case.groups[g] for g in cluster], other, cluster)
        if priced is None:
            return None
        ties.append([priced])
    return walk.size(case, ties)


def upper_bound(walk: AxisSearch, before: Solved) -> float:
    """What the structure of an earlier answer costs with the words there are now; infinite where it cannot be.

    Whether its symbols can be sized is not asked; where they cannot, all there is may cost more.
    """
    candidate = _now(walk, before.candidate)
    if candidate is None:
        return inf
    case = walk.case(candidate)
    walk.open(case)
    cost = 0.0
    for run, cluster in zip(case.runs, case.clusters, strict=True):
        if run.ties:
            cost += run.ties[0].cost
            continue
        priced = _priced([case.groups[g] for g in cluster], before, cluster)
        if priced is None:
            return inf
        run.expect(priced)
        cost += priced.cost
    return cost


def _now(walk: AxisSearch, before: Candidate) -> Candidate | None:
    """The candidate with the same letters and counters; None: one of its words does not fit any more."""
    words: dict[str, Word] = {}
    for name, own in walk.words().items():
        word = _same(own, before.words[name])
        if word is None:
            return None
        words[name] = word
    return Candidate(words, before.counters)


def _respelled(walk: AxisSearch, before: Candidate) -> Candidate | None:
    """The candidate with the same letters, whatever its counters; None: there is none, or they contradict another."""
    words: dict[str, Word] = {}
    counters: dict[str, int] = {}
    for name, own in walk.words().items():
        wanted = before.words.get(name)
        word = None if wanted is None else _same(own, wanted) or _alike_in(own, wanted, counters)
        if word is None or any(counters.setdefault(name, n) != n for name, n in word.counters.items()):
            return None
        words[name] = word
    return Candidate(words, counters)


def _alike_in(words: Sequence[Word], wanted: Word, counters: Mapping[str, int]) -> Word | None:
    """The word with these letters that agrees with some counters, if there is one."""
    spelling = _spelling(wanted)
    for word in words:
        agrees = all(counters.get(name, n) == n for name, n in word.counters.items())
        if agrees and len(word.letters) == len(wanted.letters) and _spelling(word) == spelling:
            return word
    return None


def _same(words: Sequence[Word], wanted: Word) -> Word | None:
    spelling = None
    for word in words:
        if word is wanted:
            return word
        if word.counters == wanted.counters and len(word.letters) == len(wanted.letters):
            spelling = spelling or _spelling(wanted)
            if _spelling(word) == spelling:
                return word
    return None


def _spelling(word: Word) -> list[tuple[object, ...]]:
    """All that says of a word's letters which columns they may share: with other qualifiers it is another word."""
    return [
        (
            own.symbol,
            own.mirrored,
            own.transparent,
            own.opaque,
            own.attached,
            own.unoccludable,
            own.size is None,
        )
        for own in word.letters
    ]


def _priced(groups: Sequence[Group], other: Solved, cluster: Sequence[int]) -> Priced | None:
    structure: list[Columns] = []
    for group, g in zip(groups, cluster, strict=True):
        priced, k = other.parts[g]
        columns = _alike(group, priced.structure[k])
        if columns is None:
            return None
        structure.append(columns)
    return price(groups, tuple(structure))


def _alike(group: Group, columns: Columns) -> Columns | None:
    """The same columns, of the elements of another group with the same words; None: it has no such elements."""
    if any(len(column) != len(group.bands) for column in columns):
        return None
    state = list(group.start)
    out: list[tuple[Option, ...]] = []
    for column in columns:
        own: list[Option] = []
        for b, option in enumerate(column):
            same = group.bands[b].alike(state[b], option)
            if same is None:
                return None
            state[b] = same.target
            own.append(same)
        out.append(tuple(own))
    return tuple(out)
