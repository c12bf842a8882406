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

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf

from .columns import EPS, Band, Group, Option, Position

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
    spans
        Per band: least and greatest size that the pieces of the letter it stands in have taken so far, at
        no cost.
    learnt
        Unsized symbols that have stood as a whole: ``(symbol, least, greatest)`` size at no cost.
    trail
        The columns whose price depends on the lengths of pieces. Paths are compared only where it is the
        same.
    """

    group: int
    state: State
    cost: float
    width: float
    columns: int
    firm: bool = True
    owed: bool = False
    trail: tuple[object, ...] = ()
    parent: Path | None = None
    column: tuple[Option, ...] = ()
    spans: tuple[tuple[float, float], ...] = ()
    learnt: tuple[tuple[str, float, float], ...] = ()
    dropped: bool = False


@dataclass(slots=True, eq=False)
class Edge:
    """A column that may come next. `cost` = ω + empty·E + loose·Λ of its solid and whole letters."""

    column: tuple[Option, ...]
    state: State
    cost: float
    omega: float
    width: float
    least: float
    firm: bool
    owed: bool
    tied: bool


def shortfall(group: Group, path: Path) -> float:
    """Least cost still to come at the end of a path.

    With rests R_b and W ≥ `path.width` + max R_b, band b is short of W by at least d_b = W − width − R_b.
    In each column it is short by ω_j, or it is empty there and pays for it, or it holds a non-opaque letter
    and pays Λ. As ω is shared by all bands and Σ weights ≤ 1, Σ weight_b·d_b + fit·|W − canvas| is a lower
    bound, convex in W, so that its least is where it turns. Non-opaque letters to come are loose before
    whatever stands behind them, which a band pays if it is more than its part of that sum.

    Columns already laid could be made wider than they are charged for: a firm one at 1 > fit a metre, which
    never pays, another one at `under` a metre. Rests of cut and of unsized letters follow from what their
    pieces have taken so far; they are soft, because a piece may leave its range at 1 a metre of ω. So W may
    stay below the longest soft rest at that price, which is the same ω that pays for what bands are short
    of. Returns infinity where no W within the tolerance can be reached.
    """
    width, canvas, objective = path.width, group.canvas, group.objective
    longest = soft_longest = 0.0
    rests: list[tuple[float, float, float]] = []  # rest, weight, looseness
    by_loose = objective.loose * group.share
    strain = 0.0
    for b, (band, position, weight) in enumerate(zip(group.bands, path.state, group.weights, strict=True)):
        i = position >> 3
        mid = position & 4
        least = band.rest_min[i + 1] if mid else band.rest_min[i]
        most = band.rest_max[i]
        if least > longest:
            longest = least
        multiple = 1
        if band.tied:
            if mid and (size := band.letters[i].size) is not None:
                low, high = path.spans[b]
                least = max(least, size - high + band.rest_min[i + 1])
                most = min(most, size - low + band.rest_max[i + 1]) if size > low else band.rest_max[i + 1]
            if path.learnt and (waiting := band.unsized_from(i + 1 if mid else i)):
                known = {symbol: (low, high) for symbol, low, high in path.learnt}
                if all(symbol in known for symbol, _ in waiting):
                    multiple += sum(n for _, n in waiting)
                    least += sum(n * known[symbol][0] for symbol, n in waiting)
                    if not mid or band.letters[i].size is not None:
                        sized = band.rest_min[i] if not mid else most_sized(band, i, path.spans[b])
                        most = sized + sum(n * known[symbol][1] for symbol, n in waiting)
            if least > soft_longest:
                soft_longest = least
        strain += weight * multiple
        rests.append((most, weight, by_loose * band.soft_rest[i]))
    low = width + longest
    if low > canvas + group.tolerance + EPS:
        return inf
    below = objective.fit if path.firm else group.under
    scale = 1.0 if strain <= 1.0 else 1.0 / strain
    soft = width + soft_longest
    best = inf
    turns = [low]
    if low < canvas:
        turns.append(canvas)
    if low < soft:
        turns.append(soft)
    top = max(canvas, soft)
    turns += [width + rest for rest, _, _ in rests if low < width + rest < top]
    for total in turns:
        over = total - canvas
        value = objective.fit * over if over > 0 else -below * over
        future = total - width
        short = loose = 0.0
        for rest, weight, own in rests:
            lack = weight * scale * (future - rest)
            if lack > own:
                short += lack - own
            loose += own
        need = soft - total
        value += loose + (need if need > short else short)
        if value < best:
            best = value
    return max(best, _by_pairs(group, path, objective.fit * max(0.0, low - canvas))) if group.pairs else best


def _by_pairs(group: Group, path: Path, fit: float) -> float:
    """The bound that the dearest pair of rows gives; what other rows are loose by comes on top, as Λ is a sum."""
    by_loose = group.objective.loose * group.share
    loose = [by_loose * band.soft_rest[p >> 3] for band, p in zip(group.bands, path.state, strict=True)]
    total = sum(loose)
    return fit + max(
        table.at(path.state[a] >> 3, path.state[b] >> 3) + total - loose[a] - loose[b]
        for a, b, table in group.pairs
    )


def most_sized(band: Band, i: int, span: tuple[float, float]) -> float:
    """Greatest size of the sized letters to come, of which letter i has given up `span` already."""
    return max(0.0, (band.letters[i].size or 0.0) - span[0]) + band.rest_min[i + 1]


def edges(
    group: Group,
    state: State,
    owed: bool,
    made: float,
    limit: float,
    check: Callable[[], None] | None = None,
) -> list[Edge]:
    """Every column that may come next, keeps the constraints and the tolerance, and costs more than `made` and at
    most `limit`, cheapest first.

    The edges of a node are kept with the group, as other paths lead to it too.
    """
    known = group.edges.get((state, owed))
    if known is None or known[0] < limit:
        costs = _make_edges(group, state, owed, limit, check)
        costs.sort(key=_by_cost)
        known = group.edges[state, owed] = (limit, costs)
    costs = known[1]
    return costs[
        bisect_right(costs, made + EPS, key=_by_cost) : bisect_right(costs, limit + EPS, key=_by_cost)
    ]


def _by_cost(edge: Edge) -> float:
    return edge.cost


def _make_edges(
    group: Group, state: State, owed: bool, limit: float, check: Callable[[], None] | None
) -> list[Edge]:
    """The edges that leave a node.

    Elements are chosen band by band. What is chosen already bounds ω, E and Λ from below, so that a column
    that has become too dear is given up; runs of solid letters only grow, so that the rest of a band's runs
    go with it.
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
        high: float,
        low: float,
        low_all: float,
        empties: int,
        loose: float,
        softs: int,
        soft_sizes: float,
        elastic: bool,
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
                low,
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
        if check is not None and b == 2:
            check()
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
                args = (
                    high_,
                    low_,
                    low_all_,
                    empties,
                    loose + option.loose,
                    softs + 1,
                    soft_sizes + size,
                    elastic,
                )
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

    def __init__(self, groups: Sequence[Group], check: Callable[[], None] | None = None) -> None:
        self.groups = tuple(groups)
        self.check = check
        self.later = [0.0] * (len(groups) + 1)
        for g in range(len(groups) - 1, -1, -1):
            group = groups[g]
            self.later[g] = self.later[g + 1] + shortfall(group, self._enter(g))

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
        return self._enter(0)

    def _enter(self, g: int) -> Path:
        group = self.groups[g]
        return Path(g, group.start, 0.0, 0.0, 0, spans=((0.0, 0.0),) * len(group.bands))

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
        laid = path.cost + later
        out: list[tuple[float, Path]] = []
        for edge in edges(group, path.state, path.owed, made - laid, limit - laid, self.check):
            cost = path.cost + edge.cost
            width = path.width + edge.width
            firm = path.firm and edge.firm
            trail = (*path.trail, edge.column) if edge.tied else path.trail
            if all(p >> 2 == band.end >> 2 for p, band in zip(edge.state, group.bands, strict=True)):
                cost += self._closing(group, width, firm)
                bound = cost + later
                if bound == inf:
                    continue
                if width < group.canvas - group.tolerance - EPS:
                    trail = (
                        *trail,
                        path,
                    )  # too narrow as it is: only its price can tell, so it is like no other
                g = path.group + 1
                state = self.groups[g].start if g < len(self.groups) else ()
                child = Path(g, state, cost, 0.0, path.columns + 1, True, False, trail, path, edge.column)
                child.spans = ((0.0, 0.0),) * len(state)
                child.learnt = self._learn(group, path, edge)[1] if group.tied else path.learnt
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
                child.spans, child.learnt = (
                    self._learn(group, path, edge) if group.tied else (path.spans, path.learnt)
                )
                bound = cost + shortfall(group, child) + later
                if bound == inf:
                    continue
            out.append((bound, child))
        return out

    @staticmethod
    def _learn(
        group: Group, path: Path, edge: Edge
    ) -> tuple[tuple[tuple[float, float], ...], tuple[tuple[str, float, float], ...]]:
        """What the pieces in a column say about the letters they belong to."""
        least, most = (edge.least, edge.width) if edge.firm else (0.0, inf)
        spans: list[tuple[float, float]] = []
        learnt = path.learnt
        for b, (band, option) in enumerate(zip(group.bands, edge.column, strict=True)):
            span = path.spans[b]
            if not band.tied or option.empty:
                spans.append(span)
                continue
            if not option.transparent:
                spans.append((0.0, 0.0))
                continue
            low = least if len(option.letters) == 1 else 0.0
            last = option.letters[-1]
            for i in option.letters:
                begun = span if i == option.letters[0] and not option.begins else (0.0, 0.0)
                span = (begun[0] + low, begun[1] + most)
                letter = band.letters[i]
                done = i != last or option.ends
                new = letter.size is None and all(symbol != letter.symbol for symbol, _, _ in learnt)
                if done and new and letter.symbol not in band.free:
                    learnt = (*learnt, (letter.symbol, *span))
            spans.append((0.0, 0.0) if option.ends else span)
        return tuple(spans), learnt

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


class Seen:
    """The transposition table: the best paths known at each node.

    Of two paths at one node, the one that is no cheaper, has no more columns and cannot become cheaper by
    its W is dropped. |W − canvas| changes by at most the difference of the two W, whatever comes; a
    narrower path may replace a wider one where it cannot end below canvas − μ.
    """

    def __init__(self, network: Network, keep: int) -> None:
        self._network = network
        self._keep = keep
        self._known: dict[object, list[Path]] = {}

    def drops(self, path: Path) -> bool:
        """Whether a known path makes this one needless; if not, it becomes known, and what it beats is dropped."""
        key = (path.group, path.state, path.owed, path.trail)
        known = self._known.get(key)
        if known is None:
            self._known[key] = [path]
            return False
        equals = 0
        for other in known:
            verdict = self._beats(other, path)
            if verdict > 0:
                return True
            equals += verdict == 0
        if equals >= self._keep:
            return True
        for other in known:
            if self._beats(path, other) > 0:
                other.dropped = True
        known[:] = [other for other in known if not other.dropped]
        known.append(path)
        return False

    def _beats(self, a: Path, b: Path) -> int:
        """1: `a` makes `b` needless; 0: as good as it in every respect; -1: neither."""
        dw = a.width - b.width
        slack = 0.0
        if abs(dw) > EPS:
            if a.group == len(self._network.groups):
                return -1
            group = self._network.groups[a.group]
            fit = group.objective.fit
            if dw > 0:
                return -1
            least = a.width + max(band.at_least(p) for band, p in zip(group.bands, a.state, strict=True))
            if least < group.canvas - group.tolerance:
                return -1
            slack = fit * abs(dw)
        if a.cost + slack < b.cost - EPS:
            return 1
        if a.cost + slack <= b.cost + EPS and a.columns >= b.columns:
            return 0 if slack <= EPS and a.columns == b.columns and a.cost >= b.cost - EPS else 1
        return -1
