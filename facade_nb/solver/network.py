"""The alignment decision network, made as it is walked (the paper's 5.2, supplement 3.3).

A node is a position in every word of a group; an edge is a column; a path from the first node to the last is an
alignment. Groups that share an unsized symbol are walked one after the other on one path. Nothing of the network is
stored: `Network.children` makes the edges that leave a path's end, and only those within a budget.

Lower bounds, both exact where nothing is elastic:

*Elastic letters cost nothing at first.* A column is charged for its solid and its whole sized letters alone, whatever
lengths the pieces of cut letters will get. A complete path is priced exactly by a linear programme (`pricing`).

*Shortfall.* Whatever comes, W will be at least what has been laid plus the longest word still to come, and every
metre that a shorter word falls short of W is paid for, as ω, as looseness or as empty columns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from .columns import EPS, Group, Option, Position

__all__ = ["Edge", "Network", "Path", "Seen", "State", "edges", "shortfall"]

State = tuple[Position, ...]


@dataclass(slots=True, eq=False)
class Path:
    """A partial alignment: linked columns, the newest at the end.

    Attributes
    ----------
    group
        Which group it is in; the number of groups: it is complete.
    state
        Position of every band of that group.
    cost, width, columns
        Lower bound of J so far; W so far in this group; columns so far.
    firm
        No column so far could be widened without cost.
    owed
        No letter ended at the last boundary, so one must begin there.
    trail
        The columns whose price depends on the lengths of pieces. Paths are compared only where it is the same.
    """

    group: int
    state: State
    cost: float
    width: float
    columns: int
    firm: bool = True
    owed: bool = False
    trail: tuple[tuple[Option, ...], ...] = ()
    parent: Path | None = None
    column: tuple[Option, ...] = ()
    dropped: bool = False


@dataclass(slots=True, eq=False)
class Edge:
    """A column that may come next. `cost` = ω + empty·E + loose·Λ of its solid and whole letters."""

    column: tuple[Option, ...]
    state: State
    cost: float
    omega: float
    width: float
    firm: bool
    owed: bool
    tied: bool


def shortfall(group: Group, state: State, width: float, firm: bool) -> float:
    """Least cost still to come from a node.

    With rests R_b and W ≥ `width` + max R_b, band b is short of W by at least d_b = W − width − R_b. In each column it
    is short by ω_j, or it is empty there and pays for it, or it holds a non-opaque letter and pays Λ. As ω is
    shared by all bands and Σ weights ≤ 1, Σ weight_b·d_b + fit·|W − canvas| is a lower bound, convex in W.
    Returns infinity where no W within the tolerance can be reached.
    """
    longest = 0.0
    for band, position in zip(group.bands, state, strict=True):
        i = position >> 3
        least = band.rest_min[i + 1] if position & 4 else band.rest_min[i]
        if least > longest:
            longest = least
    low = width + longest
    over = low - group.canvas
    if over > group.tolerance + EPS:
        return inf
    fit = group.objective.fit
    best = fit * over if over > 0 else 0.0
    for weight, band, position in zip(group.weights, group.bands, state, strict=True):
        lack = longest - band.rest_max[position >> 3]
        if lack > 0:
            best += weight * lack
    if over < 0 and fit and firm and group.stiff:
        best = min(_at(group, state, width, total) for total in _breaks(group, state, width, low))
    return best


def _breaks(group: Group, state: State, width: float, low: float) -> list[float]:
    """Where the bound, as a function of W between `low` and the canvas, may turn."""
    rests = (width + band.rest_max[position >> 3] for band, position in zip(group.bands, state, strict=True))
    return [low, group.canvas, *(rest for rest in rests if low < rest < group.canvas)]


def _at(group: Group, state: State, width: float, total: float) -> float:
    value = group.objective.fit * abs(total - group.canvas)
    for weight, band, position in zip(group.weights, group.bands, state, strict=True):
        value += weight * max(0.0, total - width - band.rest_max[position >> 3])
    return value


def edges(group: Group, state: State, owed: bool, limit: float) -> list[Edge]:
    """Every column that may come next, keeps the constraints and the tolerance, and costs at most `limit`.

    Elements are chosen band by band. What is chosen already bounds ω, E and Λ from below, so that a column that has
    become too dear is given up; runs of solid letters only grow, so that the rest of a band's runs go with it.
    """
    objective, mu, share = group.objective, group.tolerance + EPS, group.share
    limit += EPS
    plain = objective.plain
    by_empty, by_loose = objective.empty * share, objective.loose * share
    guards, waived = group.guards, group.waived
    choices = [band.options(position) for band, position in zip(group.bands, state, strict=True)]
    last = len(choices) - 1
    chosen: list[Option] = []
    made: list[Edge] = []

    def close(
        high: float, low: float, low_all: float, empties: int, loose: float, softs: int, soft_sizes: float, elastic: bool
    ) -> None:
        rested = low < inf
        if not rested:
            low = high if elastic else low_all
        omega = high - low if high > low else 0.0
        cost = omega + by_empty * empties * high + by_loose * (loose + softs * high - soft_sizes)
        if cost > limit or omega > mu:
            return
        some = backed = begun = ended = tied = guarded = False
        needy = empties > 0
        for option in chosen:
            if option.empty:
                continue
            some = True
            begun = begun or option.begins
            ended = ended or option.ends
            tied = tied or option.tied
            guarded = guarded or option.guarded
            backed = backed or option.opaque
            needy = needy or option.soft
        if not some or (owed and not begun) or (needy and not backed and not waived):  # C1
            return
        if guarded:  # C3
            for b, option in enumerate(chosen):
                if option.guarded and any(chosen[o].soft for o in guards[b]):
                    return
        firm = rested or not elastic
        made.append(
            Edge(
                tuple(chosen),
                tuple([option.target for option in chosen]),
                cost,
                omega,
                high,
                firm,
                not ended,
                tied or not firm,
            )
        )

    def descend(
        b: int,
        high: float,
        low: float,
        low_all: float,
        empties: int,
        loose: float,
        softs: int,
        soft_sizes: float,
        elastic: bool,
    ) -> None:
        for option in choices[b]:
            if option.empty:
                if by_empty * (empties + 1) * high + by_loose * loose > limit:
                    continue
                chosen.append(option)
                if b == last:
                    close(high, low, low_all, empties + 1, loose, softs, soft_sizes, elastic)
                else:
                    descend(b + 1, high, low, low_all, empties + 1, loose, softs, soft_sizes, elastic)
                chosen.pop()
                continue
            size = option.size
            if size is None:
                chosen.append(option)
                if b == last:
                    close(high, low, low_all, empties, loose, softs, soft_sizes, True)
                else:
                    descend(b + 1, high, low, low_all, empties, loose, softs, soft_sizes, True)
                chosen.pop()
                continue
            high_ = size if size > high else high
            counts = plain or not option.soft
            low_ = size if counts and size < low else low
            if low_ < inf:
                omega = high_ - low_
                if omega > mu or omega + by_empty * empties * high_ + by_loose * loose > limit:
                    if size > low and not option.transparent:
                        break  # longer runs are dearer still
                    continue
            chosen.append(option)
            low_all_ = size if size < low_all else low_all
            if option.soft:
                args = (high_, low_, low_all_, empties, loose + option.loose, softs + 1, soft_sizes + size, elastic)
            else:
                args = (high_, low_, low_all_, empties, loose + option.loose, softs, soft_sizes, elastic)
            if b == last:
                close(*args)
            else:
                descend(b + 1, *args)
            chosen.pop()

    descend(0, 0.0, inf, inf, 0, 0.0, 0, 0.0, False)
    return made


class Network:
    """The network of one group, or of several that share unsized symbols, with lower bounds for what is to come."""

    def __init__(self, groups: Sequence[Group]) -> None:
        self.groups = tuple(groups)
        self.later = [0.0] * (len(groups) + 1)
        for g in range(len(groups) - 1, -1, -1):
            group = groups[g]
            start = shortfall(group, group.start, 0.0, True) if group.bands else 0.0
            self.later[g] = self.later[g + 1] + start

    def ceiling(self) -> float:
        """No alignment within the tolerances costs more, so that a larger budget changes nothing."""
        total = 0.0
        for group in self.groups:
            objective = group.objective
            width = group.canvas + group.tolerance
            columns = sum(len(band.letters) + 1 for band in group.bands)
            letters = sum(letter.size or 0.0 for band in group.bands for letter in band.letters)
            total += columns * group.tolerance + objective.empty * width + objective.fit * group.tolerance
            total += objective.loose * (letters + width)
        return total

    def root(self) -> Path:
        """The path without columns."""
        return Path(0, self.groups[0].start, 0.0, 0.0, 0)

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

    def children(self, path: Path, budget: float) -> list[tuple[float, Path]]:
        """Paths longer by one column, each with the lower bound of its J, within the budget."""
        group = self.groups[path.group]
        later = self.later[path.group + 1]
        left = budget - path.cost - later
        out: list[tuple[float, Path]] = []
        for edge in edges(group, path.state, path.owed, left):
            cost = path.cost + edge.cost
            width = path.width + edge.width
            firm = path.firm and edge.firm
            trail = (*path.trail, edge.column) if edge.tied else path.trail
            if all(p >> 2 == band.end >> 2 for p, band in zip(edge.state, group.bands, strict=True)):
                cost += self._closing(group, width, firm)
                bound = cost + later
                if bound > budget + EPS:
                    continue
                g = path.group + 1
                state = self.groups[g].start if g < len(self.groups) else ()
                child = Path(g, state, cost, 0.0, path.columns + 1, True, False, trail, path, edge.column)
            else:
                bound = cost + shortfall(group, edge.state, width, firm) + later
                if bound > budget + EPS:
                    continue
                child = Path(
                    path.group, edge.state, cost, width, path.columns + 1, firm, edge.owed, trail, path, edge.column
                )
            out.append((bound, child))
        return out

    @staticmethod
    def _closing(group: Group, width: float, firm: bool) -> float:
        """Price of W at the end of a group: exact where nothing is elastic, a lower bound otherwise.

        Widening a firm column costs at least 1 a metre in ω and gains `fit` < 1, so that W as laid is what counts.
        """
        over = width - group.canvas
        if over > group.tolerance + EPS or (group.stiff and -over > group.tolerance + EPS):
            return inf
        if over < 0 and not firm:
            return 0.0
        return group.objective.fit * abs(over)


class Seen:
    """The transposition table: the best paths known at each node.

    Of two paths at one node, the one that is no cheaper, has no more columns and cannot become cheaper by its W is
    dropped. |W − canvas| changes by at most the difference of the two W, whatever comes; a wider or narrower path
    may only replace another where the tolerance on W cannot make the difference.
    """

    def __init__(self, network: Network, keep: int) -> None:
        self._network = network
        self._keep = keep
        self._known: dict[object, list[Path]] = {}

    def drops(self, path: Path, budget: float) -> bool:
        """Whether a known path makes this one needless; if not, it becomes known, and what it beats is dropped."""
        key = (path.group, path.state, path.owed, path.trail)
        known = self._known.get(key)
        if known is None:
            self._known[key] = [path]
            return False
        equals = 0
        for other in known:
            verdict = self._beats(other, path, budget)
            if verdict > 0:
                return True
            equals += verdict == 0
        if equals >= self._keep:
            return True
        for other in known:
            if self._beats(path, other, budget) > 0:
                other.dropped = True
        known[:] = [other for other in known if not other.dropped]
        known.append(path)
        return False

    def _beats(self, a: Path, b: Path, budget: float) -> int:
        """1: `a` makes `b` needless; 0: as good as it in every respect; -1: neither."""
        dw = a.width - b.width
        slack = 0.0
        if abs(dw) > EPS:
            if a.group == len(self._network.groups):
                return -1
            group = self._network.groups[a.group]
            fit = group.objective.fit
            if dw < 0:
                least = a.width + max(band.at_least(p) for band, p in zip(group.bands, a.state, strict=True))
                if least < group.canvas - group.tolerance:
                    return -1
            elif not fit or budget / fit + dw > group.tolerance:
                return -1
            slack = fit * abs(dw)
        if a.cost + slack < b.cost - EPS:
            return 1
        if a.cost + slack <= b.cost + EPS and a.columns >= b.columns:
            return 0 if slack <= EPS and a.columns == b.columns and a.cost >= b.cost - EPS else 1
        return -1
