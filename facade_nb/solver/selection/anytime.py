"""Layouts that may not be the best: while a search takes long, and when the time is up.

Sweeps (`sweeping`) and dives (`dive`) find some alignment of a group soon. Here they are set on the candidates of an
axis, and what they find is sized.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, islice
from math import inf
from typing import TYPE_CHECKING

from .. import tuning
from ..alignment.core.instances import start_afresh
from ..budget import Stopped
from ..candidates.stream import CandidateStream
from ..model.precision import EPS

if TYPE_CHECKING:
    from .axis import AxisSearch, Case, Solved

__all__ = ["Anytime"]


def _short(case: Case) -> bool:
    """Whether its words can be swept: a search of longer ones takes much memory before it begins."""
    return all(len(word) <= tuning.SWEPT_LETTERS for word in case.candidate.words.values())


class Anytime:
    """What has been looked at so of one axis."""

    def __init__(self) -> None:
        self._others: Iterator[Case] | None = None
        self._further: CandidateStream | None = None
        self._extra: list[Case] = []
        self._looked = 0.0

    def forget(self) -> None:
        """Let go of all that has been looked at."""
        for case in self._extra:
            for group in case.groups:
                group.forget()
            case.runs.clear()
        self._extra.clear()
        self._others = self._further = None

    def hasty(self, walk: AxisSearch, best: Solved | None) -> Solved | None:
        """The best layout that can soon be had of the likeliest candidates, for when the time is up."""
        if walk.setting.extend is not None:
            walk.setting.extend()
        if start_afresh():
            for run in (
                *walk.searches.runs.values(),
                *(own for case in (*walk.cases, *self._extra) for own in case.runs),
            ):
                run.give_up()
        try:
            for way, most in tuning.LIKELY.items():
                for case in islice(self._likely(walk), most):
                    if way != "dive" and not _short(case):
                        continue
                    if not case.runs:
                        walk.open(case)
                    if way == "mend":
                        for run in case.runs:
                            run.mend()
                    solved = self.dive(
                        walk, case, inf if best is None else best.cost, at_once=True, sweep=way != "dive"
                    )
                    if solved is not None:
                        best = solved
                if best is not None:
                    break
            for better in self._polished(walk, best):
                best = better
        except (Stopped, MemoryError):
            pass  # what was found until now is all there is
        return best

    def _polished(self, walk: AxisSearch, best: Solved | None) -> Iterator[Solved]:
        """Layouts of the same candidate that cost less, each a little different from the one before."""
        cases = [*walk.cases, *self._extra]
        case = next((own for own in cases if best is not None and own.candidate is best.candidate), None)
        if case is None:
            return
        for run in case.runs:
            for _ in run.polish():
                found = [own.known for own in case.runs]
                solved = walk.size(case, found) if all(found) else None
                if solved is not None and solved.beats(best):
                    best = solved
                    yield solved

    def around(self, walk: AxisSearch, cost: float) -> Solved | None:
        """A layout of another candidate that costs less, while the search of some takes long."""
        spent = sum(run.spent for run in walk.searches.runs.values())
        if spent < tuning.LONG_EFFORT or self._looked > tuning.SWEPT_PART * spent:
            return None
        begin = walk.check.seconds
        if self._others is None:
            self._others = islice(self._likely(walk), tuning.LIKELY["sweep"])
        other = next(filter(_short, self._others), None)
        if other is not None and not other.runs:
            walk.open(other)
        solved = None if other is None else self.dive(walk, other, cost, at_once=True, sweep=True)
        self._looked += walk.check.seconds - begin
        return solved

    def _likely(self, walk: AxisSearch) -> Iterator[Case]:
        """The candidates that have been begun, by what they cost at least, and then others."""
        begun = sorted(walk.cases, key=lambda case: case.floor)
        yield from begun
        known = {tuple(map(id, case.candidate.words.values())) for case in begun}
        self._further = self._further or walk.fresh_stream()
        for n in count():
            if n == len(self._extra):
                candidate = self._further.take()
                if candidate is None:
                    return
                self._extra.append(walk.case(candidate))
            if tuple(map(id, self._extra[n].candidate.words.values())) not in known:
                yield self._extra[n]

    def dive(
        self, walk: AxisSearch, case: Case, cost: float, *, at_once: bool = False, sweep: bool = False
    ) -> Solved | None:
        """A layout of the candidate that costs less than `cost`, by structures that may not be the best."""
        if not at_once and not any(run.long for run in case.runs):
            return None
        for run in case.runs:
            run.dive(at_once=at_once or not run.long, sweep=sweep)
        found = [run.known for run in case.runs]
        if not all(found):
            return None
        total = sum(known[0].cost for known in found)
        if total >= min(cost, case.dived) - EPS:
            return None
        case.dived = total
        return walk.size(case, found)
