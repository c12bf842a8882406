"""The edges that leave a node of a tall stack: columns whose right edge lies where the skeleton has one.

With many rows there are far too many columns to look at. Here a column's width is chosen first, among the
sizes of the elements that may come next, and only such that the skeleton leaves a path from there; then every row
has few elements left that keep it in step, and what the others cost at least is known when one is chosen.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from ...model.precision import EPS
from ..elements import Option
from ..group import Group
from ..rules import fills, tally
from .edges import Maker
from .paths import Edge, Path
from .skeleton import Skeleton

__all__ = ["steps"]

_Choice = tuple[float, float, bool, Option]
"""Price at the column's width, size (infinite: it does not count in ω), is as wide as the column, the element."""


def steps(
    group: Group,
    skeleton: Skeleton,
    path: Path,
    made: float,
    limit: float,
    check: Callable[[], None] | None = None,
    most: float = inf,
) -> list[Edge]:
    """Every column that may come next, such that it and what is then still to come cost at most `limit`.

    But not those that cost at most `made`. With `most`, only so many of each width.
    """
    return _Stepper(group, skeleton, path, made, limit, check, most).make()


class _Stepper(Maker):
    def __init__(
        self,
        group: Group,
        skeleton: Skeleton,
        path: Path,
        made: float,
        limit: float,
        check: Callable[[], None] | None,
        most: float,
    ) -> None:
        super().__init__(group, path.state, path.owed, limit, check, most)
        self.skeleton, self.width, self.slack = skeleton, path.width, limit + EPS
        self.made_before = made + EPS

    def make(self) -> list[Edge]:
        """All of them, in no order."""
        group, skeleton = self.group, self.skeleton
        if len(self.chosen) < len(self.choices):
            return []
        heights = {o.size for options in self.choices for o in options if o.size is not None and not o.empty}
        if not group.stiff:
            heights.add(0.0)
        for height in _distinct(sorted(heights)):
            right = self.width + height
            rest = skeleton.ahead(right, right if group.stiff else skeleton.width)
            if rest <= self.slack:
                self._fill(height, right, rest)
        return self.made

    def _fill(self, height: float, right: float, rest: float) -> None:
        """All columns of one width."""
        room = self.skeleton.width - right + EPS
        choices: list[tuple[int, list[_Choice]]] = []
        group = self.group
        for b, (band, options) in enumerate(zip(group.bands, self.choices, strict=True)):
            own: list[_Choice] = []
            for option in options:
                size = option.size
                if size is not None and size > height + EPS:
                    if not option.transparent:
                        break
                    continue
                if band.at_least(option.target) > room:
                    continue
                if option.empty:
                    own.append((self.by_empty * height, inf, False, option))
                elif size is None:
                    own.append((0.0, inf, False, option))
                else:
                    loose = option.loose + (height - size if option.soft else 0.0)
                    counts = fills(group, option)
                    own.append((self.by_loose * loose, size if counts else inf, size >= height - EPS, option))
            if not own:
                return
            own.sort(key=_by_price)
            choices.append((b, own))
        choices.sort(key=lambda c: len(c[1]))
        after, hits = [rest], [height <= EPS]
        for _, own in reversed(choices):
            after.append(after[-1] + own[0][0])
            hits.append(hits[-1] or any(hit for _, _, hit, _ in own))
        after.reverse()
        hits.reverse()
        if hits[0] and after[0] <= self.slack:
            self.limit, self.floor = self.slack - rest, self.made_before - rest
            self.enough = len(self.made) + self.most
            self._choose(0, choices, after, hits, height, 0.0, inf, height <= EPS)

    def _choose(
        self,
        n: int,
        choices: list[tuple[int, list[_Choice]]],
        after: list[float],
        hits: list[bool],
        height: float,
        price: float,
        low: float,
        hit: bool,
    ) -> None:
        if n == len(choices):
            if hit:
                self._finish(height)
            return
        if self.check is not None:
            self.calls += 1
            if not self.calls & 7:
                self.check()
        if (not hit and not hits[n]) or len(self.made) >= self.enough:
            return
        b, own = choices[n]
        room = self.slack - price - after[n + 1]
        for cost, size, hits_, option in own:
            low_ = size if size < low else low
            omega = height - low_ if low_ < inf else 0.0
            if cost > room:
                break
            if omega + cost > room or omega > self.mu:
                continue
            self.chosen[b] = option
            self._choose(n + 1, choices, after, hits, height, price + cost, low_, hit or hits_)

    def _finish(self, height: float) -> None:
        column = tally(self.group, self.chosen)
        self._close(column._replace(high=height), 0.0)


def _by_price(choice: _Choice) -> float:
    return choice[0]


def _distinct(values: list[float]) -> list[float]:
    """Growing numbers without those that are all but equal to the one before."""
    out: list[float] = []
    for value in values:
        if not out or value > out[-1] + EPS:
            out.append(value)
    return out
