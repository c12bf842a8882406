"""The alignment decision network, made as it is walked (the paper's 5.2, supplement 3.3).

A node is a position in every word of a group; an edge is a column; a path from the first node to the last
is an alignment. Groups that share an unsized symbol are walked one after the other on one path. Nothing of
the network is stored: `Network.children` makes the edges that leave a path's end, and only those within a
budget.

Lower bounds, both exact where nothing is elastic:

*Elastic letters cost nothing at first.* A column is charged for its solid and its whole sized letters alone,
whatever lengths the pieces of cut letters will get. A complete path is priced exactly by a linear programme
(`pricing`).

*Shortfall.* Whatever comes, W will be at least what has been laid plus the longest word still to come, and
every metre that a shorter word falls short of W is paid for, as ω, as looseness or as empty columns.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf

from ...model.precision import EPS
from ..elements import Option
from ..group import Group, unsizable
from .edges import Made, edges
from .paths import Edge, Path, Span, Trailed, gathered
from .shortfall import ahead, shortfall
from .skeleton import Skeleton
from .tall_edges import steps

__all__ = ["Network", "ceiling"]

_NOTHING: Span = (0.0, 0.0, False)


class Network:
    """The network of one group, or of several that share unsized symbols, with lower bounds for what is to come.

    With `sizable`, columns are left out that no sizes of symbols can make. With `binds`, pieces that need more or less
    than what costs nothing may come up against the tolerance on ω; where no path may cost so much, they do not.
    Not `informed`, it says of what is to come that it costs nothing, as lessons want to see it (not of tall groups).
    """

    def __init__(
        self,
        groups: Sequence[Group],
        check: Callable[[], None] | None = None,
        most: float = inf,
        *,
        informed: bool = True,
    ) -> None:
        self.groups = tuple(groups)
        self.check = check
        self.most = most
        self.binds = False
        self.sizable = False
        self.tall = any(group.tall for group in groups)
        self._made: list[Made] = [{} for _ in groups]
        self.skeletons: list[Skeleton | None] = [None] * len(groups)
        self.later = [0.0] * (len(groups) + 1)
        self.informed = informed or self.tall
        for g in range(len(groups) - 1, -1, -1):
            group = groups[g]
            if self.informed:
                self.later[g] = self.later[g + 1] + shortfall(group, self._enter(g))

    def bind(self, limit: float) -> bool:
        """Look only for what costs at most `limit` from here on; False: there is no such alignment."""
        floors = [a - b for a, b in zip(self.later, self.later[1:], strict=False)]
        for g, group in enumerate(self.groups):
            if group.tall:
                skeleton = self.skeletons[g] = Skeleton(group, limit - sum(floors) + floors[g], self.check)
                if skeleton.root == inf:
                    return False
                floors[g] = max(floors[g], skeleton.root)
        for g in range(len(self.groups) - 1, -1, -1):
            self.later[g] = self.later[g + 1] + floors[g]
        return self.later[0] <= limit + EPS

    def root(self) -> Path:
        """The path without columns."""
        return self._enter(0)

    def _enter(self, g: int) -> Path:
        group = self.groups[g]
        path = Path(g, group.start, 0.0, 0.0, 0, spans=(_NOTHING,) * len(group.bands))
        path.ahead = ahead(group, group.start) if self.informed else 0.0
        return path

    def complete(self, path: Path) -> bool:
        """Whether every group is aligned."""
        return path.group == len(self.groups)

    def structure(self, path: Path) -> tuple[tuple[tuple[Option, ...], ...], ...]:
        """The columns of a complete path, per group."""
        columns: list[list[tuple[Option, ...]]] = [[] for _ in self.groups]
        node: Path | None = path
        while node is not None and node.parent is not None:
            columns[node.parent.group].append(node.column)
            node = node.parent
        return tuple(tuple(reversed(own)) for own in columns)

    def children(self, path: Path, made: float, limit: float) -> list[tuple[float, Path]]:
        """Paths longer by one column, each with the lower bound of its J.

        Columns are made that keep the path within `limit`, but not those that kept it within `made` before.
        """
        group = self.groups[path.group]
        later = self.later[path.group + 1]
        laid = path.cost + path.ahead + later
        out: list[tuple[float, Path]] = []
        skeleton = self.skeletons[path.group]
        if skeleton is not None:
            own = path.cost + later
            found = steps(group, skeleton, path, made - own, limit - own, self.check, self.most)
        elif not self.informed:
            own = path.cost + later
            every = edges(
                group, path.state, path.owed, -inf, inf, self.check, self.most, self._made[path.group]
            )
            found = [edge for edge in every if made - own + EPS < edge.cost <= limit - own + EPS]
        else:
            found = edges(
                group,
                path.state,
                path.owed,
                made - laid,
                limit - laid,
                self.check,
                self.most,
                self._made[path.group],
            )
        for edge in found:
            if self.sizable and unsizable(group, edge.column):
                continue
            cost = path.cost + edge.cost
            width = path.width + edge.width
            firm = path.firm and edge.firm
            trail, ranges = path.trail, path.ranges
            if edge.tied:
                if edge.pieces:
                    most = group.tolerance if self.binds else inf
                    ranges = gathered(ranges, trail, path.group, edge, most)
                else:
                    trail = (*trail, Trailed(path.group, edge.column))
            spans, learnt, pinched = path.spans, path.learnt, path.pinched or edge.pinched
            if group.tied:
                spans, learnt, tight = self._learn(group, path, edge)
                pinched = pinched or tight
            if all(p >> 2 == band.end >> 2 for p, band in zip(edge.state, group.bands, strict=True)):
                cost += self._closing(group, width, firm)
                bound = cost + later
                if bound == inf:
                    continue
                if ranges or width < group.canvas - group.tolerance - EPS:
                    trail = (*trail, path)  # only its price can tell how wide it gets, so it is like no other
                elif trail:
                    trail = (*trail, round(width, 9))  # what the pieces come to is added to this
                g = path.group + 1
                state = self.groups[g].start if g < len(self.groups) else ()
                child = Path(g, state, cost, 0.0, path.columns + 1, True, False, trail, path, edge.column)
                child.ranges = ranges
                child.spans = (_NOTHING,) * len(state)
                child.ahead = ahead(self.groups[g], state) if state and self.informed else 0.0
                child.learnt, child.late = learnt, pinched
            else:
                child = Path(
                    path.group,
                    edge.state,
                    cost,
                    width,
                    path.columns + 1,
                    firm,
                    edge.owed,
                    trail,
                    path,
                    edge.column,
                )
                child.spans, child.learnt = spans, learnt
                child.ahead = ahead(group, edge.state) if group.tall else edge.ahead
                child.ranges = ranges
                rest = shortfall(group, child) if self.informed else 0.0
                if skeleton is not None:
                    far = width if group.stiff else skeleton.width
                    rest = max(rest, skeleton.ahead(width, far))
                bound = cost + rest + later
                if bound == inf:
                    continue
                child.late = pinched and rest <= self._apart(group, child) + EPS
            child.pinched = pinched
            out.append((bound, child))
        return out

    @staticmethod
    def _apart(group: Group, path: Path) -> float:
        """What is still to come costs at least, whatever the pieces that are laid have paid for."""
        least = max([band.at_least(p) for band, p in zip(group.bands, path.state, strict=True)])
        return path.ahead + group.objective.fit * max(0.0, path.width + least - group.canvas)

    @staticmethod
    def _learn(
        group: Group, path: Path, edge: Edge
    ) -> tuple[tuple[Span, ...], tuple[tuple[str, float, float], ...], bool]:
        """What the pieces in a column say about the letters they belong to, and whether one of those is pinched.

        A piece beside something that has a size is as long as that, or pays 1 a metre. So if the pieces of a letter
        are as long as it is, but for one that may have any length or is still to come, nothing is left for that one.
        """
        least, most = (edge.least, edge.width) if edge.firm else (0.0, inf)
        spans: list[Span] = []
        pinched = False
        learnt = path.learnt
        for b, (band, option) in enumerate(zip(group.bands, edge.column, strict=True)):
            span = path.spans[b]
            if not band.tied or option.empty:
                spans.append(span)
                continue
            if not option.transparent:
                spans.append(_NOTHING)
                continue
            low = least if len(option.letters) == 1 else 0.0
            last = option.letters[-1]
            for i in option.letters:
                begun = span if i == option.letters[0] and not option.begins else _NOTHING
                span = (begun[0] + low, begun[1] + most, begun[2] or low <= EPS)
                letter = band.letters[i]
                done = i != last or option.ends
                if letter.size is not None and span[0] >= letter.size - EPS:
                    pinched = pinched or span[2] or not done
                new = letter.size is None and all(symbol != letter.symbol for symbol, _, _ in learnt)
                if done and new and not band.is_free(letter):
                    learnt = (*learnt, (letter.symbol, span[0], span[1]))
            spans.append(_NOTHING if option.ends else span)
        return tuple(spans), learnt, pinched

    @staticmethod
    def _closing(group: Group, width: float, firm: bool) -> float:
        """Price of W at the end of a group: exact where nothing is elastic, a lower bound otherwise.

        Widening a firm column costs at least 1 a metre in ω and gains `fit` < 1, so that W as laid is what
        counts.
        """
        over = width - group.canvas
        if over > group.tolerance + EPS or (group.stiff and -over > group.tolerance + EPS):
            return inf
        return (
            group.objective.fit * over if over > 0 else -(group.objective.fit if firm else group.under) * over
        )


def ceiling(groups: Sequence[Group]) -> float:
    """No alignment within the tolerances costs more, so that a larger budget changes nothing."""
    total = 0.0
    for group in groups:
        objective = group.objective
        width = group.canvas + group.tolerance
        columns = sum(len(band.letters) + 1 for band in group.bands)
        letters = sum(letter.size or 0.0 for band in group.bands for letter in band.letters)
        total += columns * group.tolerance + objective.empty * width + objective.fit * group.tolerance
        total += objective.loose * (letters + width)
    return total
