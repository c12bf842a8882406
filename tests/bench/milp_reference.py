"""The second formulation of `milp`, for many words.

One solid word, the reference, has a path over its own letters; its arcs, and the gaps between its letters, are the
columns. Each other word has a path of its own through the states (place in the reference, place in the word); what it
puts into a column adds up to the use of that column. So a column's ω is bounded by each word's difference from the
reference with no big M, which a formulation by column numbers would need throughout.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass, field

from .milp import Part, Place, Programme, Task, TooLarge, Words, meet_canvas, minus, tie_lengths

__all__ = ["pose_reference"]


def pose_reference(task: Task, gaps: int = 2, most: int = 400_000) -> Programme:
    """The formulation by a reference word, with at most `gaps` columns between two of its letters.

    Raises
    ------
    ValueError
        No word is solid throughout, or no letter is opaque.
    TooLarge
        There would be more than `most` arcs.
    """
    begin = time.perf_counter()
    words = Words(task)
    solid = [b for b, word in enumerate(words.words) if word and not any(x.transparent for x in word)]
    if not solid or words.waived:
        raise ValueError("expected a word without transparent letters, and an opaque letter")
    reference = max(solid, key=lambda b: (len(words.words[b]), -b))
    programme = _Reference(words, reference, gaps, most).pose()
    programme.build = time.perf_counter() - begin
    return programme


@dataclass(slots=True)
class _Column:
    """A column of the reference: its use, and what each other word may put into it."""

    use: int
    part: Part
    high: int
    low: int
    omega: int
    source: object
    target: object
    arcs: dict[int, list[tuple[Place, Part, int]]] = field(default_factory=dict)


class _Reference:
    """The formulation by a reference word, as it is built."""

    def __init__(self, words: Words, reference: int, gaps: int, most: int) -> None:
        self.words, self.task, self.reference, self.gaps, self.most = words, words.task, reference, gaps, most
        self.programme = Programme()
        self.flow: dict[object, dict[int, float]] = {}
        self.lengths: dict[tuple[int, int], dict[int, float]] = {}
        self.total: dict[int, float] = {}
        self.others = [b for b in range(len(words.words)) if b != reference]
        self.places = {b: self._places(b) for b in self.others}
        self.made = 0

    def _places(self, b: int) -> list[Place]:
        todo: list[Place] = [(0, False, 0)]
        known = set(todo)
        while todo:
            for part in self.words.parts(b, todo.pop()):
                if part.after not in known:
                    known.add(part.after)
                    todo.append(part.after)
        return sorted(known)

    def pose(self) -> Programme:
        """Build it all."""
        word = self.words.words[self.reference]
        for i in range(len(word) + 1):
            if not self._attached(i):
                self._gaps(i)
            else:
                for h in range(self.gaps):
                    self._pass((i, h), (i, h + 1), None)
            for part in self.words.parts(self.reference, (i, False, 0)):
                if not part.empty:
                    self._column(part, (i, self.gaps), (part.after[0], 0))
        self._ends(len(word))
        for row in self.flow.values():
            self.programme.add(row, 0.0, 0.0)
        tie_lengths(self.programme, self.words, self.lengths)
        meet_canvas(self.programme, self.task, self.total)
        return self.programme

    def _attached(self, i: int) -> bool:
        """C4: no gap beside an attached letter of the reference."""
        word = self.words.words[self.reference]
        return any(0 <= k < len(word) and word[k].attached for k in (i - 1, i))

    def _gaps(self, i: int) -> None:
        before: int | None = None
        for h in range(self.gaps):
            column = self._column(Part((i, False, 0)), (i, h), (i, h + 1))
            if before is not None:  # gaps are used in order
                self.programme.add({column.use: 1.0, before: -1.0})
            before = column.use
            self._pass((i, h), (i, h + 1), column)

    def _pass(self, source: object, target: object, column: _Column | None) -> None:
        """Go on without a column."""
        arc = self.programme.number(0.0, 1.0, True)
        self._flow((self.reference, source), (self.reference, target), arc)
        for b in self.others:
            for place in self.places[b]:
                own = self.programme.number(0.0, 1.0)
                self._flow((b, source, place), (b, target, place), own)

    def _flow(self, source: object, target: object, arc: int) -> None:
        self.flow.setdefault(source, {})[arc] = 1.0
        self.flow.setdefault(target, {})[arc] = -1.0

    def _ends(self, n: int) -> None:
        """One unit goes from the beginning to the end of each word."""
        one = self.programme.number(0.0, 1.0)
        self.programme.low[one] = 1.0
        self.flow.setdefault((self.reference, (0, 0)), {})[one] = -1.0
        self.flow.setdefault((self.reference, (n, self.gaps)), {})[one] = 1.0
        for b in self.others:
            self.flow.setdefault((b, (0, 0), (0, False, 0)), {})[one] = -1.0
            finals = []
            for place in self.places[b]:
                if self.words.done(b, place):
                    final = self.programme.number(0.0, 1.0)
                    finals.append(final)
                    self.flow.setdefault((b, (n, self.gaps), place), {})[final] = 1.0
            self.programme.add({**dict.fromkeys(finals, 1.0), one: -1.0}, 0.0, 0.0)

    def _column(self, part: Part, source: object, target: object) -> _Column:
        programme, task = self.programme, self.task
        use = programme.number(0.0, 1.0, True)
        column = _Column(
            use, part, programme.number(0.0, task.widest), programme.number(0.0, task.widest),
            programme.number(1.0, task.tolerance), source, target,
        )  # fmt: skip
        self._flow((self.reference, source), (self.reference, target), use)
        for b in self.others:
            column.arcs[b] = []
            link: dict[int, float] = {use: -1.0}
            for place in self.places[b]:
                for own in self.words.parts(b, place):
                    if not self._fits(column.part, b, own):
                        continue
                    self.made += 1
                    if self.made > self.most:
                        raise TooLarge(f"more than {self.most} arcs")
                    arc = programme.number(0.0, 1.0, True)
                    self._flow((b, source, place), (b, target, own.after), arc)
                    link[arc] = 1.0
                    column.arcs[b].append((place, own, arc))
            programme.add(link, 0.0, 0.0)
        self._price(column)
        self._constrain(column)
        return column

    def _fits(self, part: Part, b: int, own: Part) -> bool:
        """Whether the reference and another word can share a column: C3, and the tolerance."""
        if part.guarded and own.soft and b in self.words.above[self.reference]:
            return False
        if own.guarded and part.soft and self.reference in self.words.above[b]:
            return False
        if part.empty or own.empty:
            return True
        counts = self.task.weights.paper
        most = min(self.task.tolerance, self.task.cutoff - self._loose(part, own)) + 1e-8
        difference = own.size - part.size
        if difference > 0 and (counts or not part.soft):
            return difference <= most
        if difference < 0 and not own.elastic and (counts or not own.soft):
            return -difference <= most
        return most >= 0.0

    def _loose(self, *parts: Part) -> float:
        """What Λ charges for neighbours within elements."""
        weights = self.task.weights
        return 0.0 if weights.paper else weights.loose * self.words.share * sum(part.loose for part in parts)

    def _price(self, column: _Column) -> None:
        programme, task, weights = self.programme, self.task, self.task.weights
        part, use, high, low, omega = column.part, column.use, column.high, column.low, column.omega
        widest = task.widest
        empty = 0.0 if weights.paper else weights.empty * self.words.share
        loose = 0.0 if weights.paper else weights.loose * self.words.share
        soft_counts = weights.paper
        self.total[high] = 1.0
        sizes: list[dict[int, float]] = [{use: part.size}]
        least = part.size if not part.empty and (soft_counts or not part.soft) else widest
        programme.add({high: 1.0, use: -widest})
        programme.add(minus({use: part.size}, {high: 1.0}))
        programme.add({low: 1.0, use: -least})
        programme.add({high: 1.0, low: -1.0, omega: -1.0})
        if part.empty:
            programme.cost[high] += empty
        else:
            programme.cost[use] += loose * part.loose
            if part.soft and loose:
                programme.cost[high] += loose
                programme.cost[use] -= loose * part.size
        for b in self.others:
            size, absent, hangs, apart = self._sizes(b, column, least)
            sizes.append(size)
            programme.add(minus(size, {high: 1.0}))
            slack = dict.fromkeys(absent if soft_counts else {**absent, **hangs}, least)
            programme.add(minus(minus({low: 1.0}, size), slack))
            if apart:
                programme.add({**apart, omega: -1.0})
            if empty and absent:
                spent = programme.number(empty)
                programme.add({high: 1.0, use: -widest, spent: -1.0, **dict.fromkeys(absent, widest)})
                programme.add({spent: -1.0, **dict.fromkeys(absent, part.size)})
            if loose and hangs:
                spent = programme.number(loose)
                row = minus({high: 1.0, use: -widest, spent: -1.0}, size)
                for arc in hangs:
                    row[arc] = row.get(arc, 0.0) + widest
                programme.add(row)
                programme.add({spent: -1.0, **{arc: max(0.0, part.size - own) for arc, own in hangs.items()}})
        programme.widths.append((high, sizes))

    def _sizes(
        self, b: int, column: _Column, least: float
    ) -> tuple[dict[int, float], dict[int, float], dict[int, float], dict[int, float]]:
        """A word's size in a column; its empty and its hanging arcs; and how far each is from the reference."""
        size: dict[int, float] = {}
        absent: dict[int, float] = {}
        hangs: dict[int, float] = {}
        apart: dict[int, float] = {}
        pieces: dict[int, dict[int, float]] = {}
        part = column.part
        firm = not part.empty and (self.task.weights.paper or not part.soft)
        loose = 0.0 if self.task.weights.paper else self.task.weights.loose * self.words.share
        for _, own, arc in column.arcs[b]:
            if own.empty:
                absent[arc] = 1.0
                continue
            if own.size:
                size[arc] = own.size
            if own.soft:
                hangs[arc] = own.size
            self.programme.cost[arc] += loose * own.loose
            for k in own.whole:
                self.lengths.setdefault((b, k), {})[arc] = self.words.words[b][k].size or 0.0
            for k in own.elastic:
                pieces.setdefault(k, {})[arc] = 1.0
            difference = own.size - part.size
            if firm and difference > 0:
                apart[arc] = difference
            elif firm and difference < 0 and not own.elastic and (self.task.weights.paper or not own.soft):
                apart[arc] = -difference
        for k, arcs in pieces.items():
            most = self.words.words[b][k].size or self.task.widest
            length = self.programme.number(0.0, most)
            self.programme.add({length: 1.0, **dict.fromkeys(arcs, -most)})
            self.lengths.setdefault((b, k), {})[length] = 1.0
            size[length] = 1.0
        return size, absent, hangs, apart

    def _constrain(self, column: _Column) -> None:
        """C1 and C3."""
        part = column.part

        def which(b: int, test: Iterable[bool]) -> dict[int, float]:
            return {arc: 1.0 for (_, _, arc), yes in zip(column.arcs[b], test, strict=True) if yes}

        opaque = {
            arc: 1.0 for b in self.others for arc in which(b, (own.opaque for _, own, _ in column.arcs[b]))
        }
        if part.empty or part.soft:
            self.programme.add(minus({column.use: 1.0}, opaque))
        elif not part.opaque:
            raise AssertionError("a solid part is soft or opaque")
        for b in self.others:
            guarded = which(b, (own.guarded for _, own, _ in column.arcs[b]))
            for a in self.words.above[b] if guarded else ():
                if a not in (b, self.reference):
                    soft = which(a, (own.soft for _, own, _ in column.arcs[a]))
                    if soft:
                        self.programme.add({**guarded, **soft, column.use: -1.0})
