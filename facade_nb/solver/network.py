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

__all__ = ["Edge", "Network", "Path", "State", "edges", "shortfall"]

State = tuple[Position, ...]


Range = tuple[tuple[int, int, int], float, float, float]
"""What the pieces of a tied letter (group, band, letter) may add up to: least and greatest total at no cost, and the
price of a metre more. A metre less costs 1."""


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
    ranges
        The tied letters that have pieces in columns of which only a range of lengths matters.
    ahead
        What the rows still cost each other, by pairs.
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
    ranges: tuple[Range, ...] = ()
    ahead: float = 0.0
    spans: tuple[tuple[float, float], ...] = ()
    learnt: tuple[tuple[str, float, float], ...] = ()
    dropped: bool = False


@dataclass(slots=True, eq=False)
class Edge:
    """A column that may come next.

    Attributes
    ----------
    cost, omega
        ω + empty·E + loose·Λ of its solid and whole letters; ω of them.
    width, least
        Largest size in it; least size of a row that has to fill it.
    rise
        By how much it makes the bound by pairs rise: `cost` + what is ahead after it − what was ahead before it.
    ahead
        What the rows still cost each other after it, by pairs.
    firm, owed, tied
        It cannot be widened without cost; no letter ends at its right edge; its price depends on the
        lengths of pieces.
    single
        The band and letter of such a piece, where it is the only one, and the price of a metre by which it
        widens the column.
    """

    column: tuple[Option, ...]
    state: State
    cost: float
    omega: float
    width: float
    least: float
    rise: float
    ahead: float
    firm: bool
    owed: bool
    tied: bool
    single: tuple[int, int, float] | None


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
    return max(best, path.ahead + objective.fit * max(0.0, low - canvas))


def ahead(group: Group, state: State) -> float:
    """What the rows still cost each other, by pairs with the reference (see `pairs`)."""
    if group.reference is None:
        return 0.0
    place = state[group.reference]
    return sum(table.at(place, p) for table, p in zip(group.pairs, state, strict=True) if table is not None)


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
    most: float = inf,
) -> list[Edge]:
    """Every column that may come next and keeps the constraints and the tolerance, by how much the bound rises with it.

    Only those that make it rise by more than `made` and at most `limit`, the least first. The edges of a node
    are kept with the group, as other paths lead to it too. With `most`, only so many, whichever come first.
    """
    if most < inf:
        return _Maker(group, state, owed, limit, check, most).make()
    known = group.edges.get((state, owed))
    if known is None or known[0] < limit:
        fresh = _Maker(group, state, owed, limit, check).make()
        fresh.sort(key=_by_rise)
        known = group.edges[state, owed] = (limit, fresh)
    found = known[1]
    return found[
        bisect_right(found, made + EPS, key=_by_rise) : bisect_right(found, limit + EPS, key=_by_rise)
    ]


def _by_rise(edge: Edge) -> float:
    return edge.rise


class _Maker:
    """Makes the edges that leave a node.

    Elements are chosen band by band, the reference first. What is chosen bounds ω, E and Λ from below, and
    so do the pairs of the reference's next position with those of the other bands; a column that has become
    too dear is given up. Runs of solid letters only grow, so that the rest of a band's runs goes with one
    whose ω is too large.
    """

    def __init__(
        self,
        group: Group,
        state: State,
        owed: bool,
        limit: float,
        check: Callable[[], None] | None,
        most: float = inf,
    ) -> None:
        self.group, self.owed, self.check, self.most = group, owed, check, most
        self.before = ahead(group, state)
        self.limit = limit + EPS + self.before
        self.mu = group.tolerance + EPS
        objective, share = group.objective, group.share
        self.plain = objective.plain
        self.by_empty, self.by_loose = objective.empty * share, objective.loose * share
        self.choices = [band.options(position) for band, position in zip(group.bands, state, strict=True)]
        bands = range(len(group.bands))
        self.order = (
            list(bands) if group.reference is None else sorted(bands, key=lambda b: b != group.reference)
        )
        self.rows: list[list[float] | None] = [None] * len(group.bands)
        self.rest = [0.0] * (len(group.bands) + 1)
        self.chosen: list[Option] = [options[0] for options in self.choices if options]
        self.made: list[Edge] = []
        self.calls = 0

    def make(self) -> list[Edge]:
        """All of them, in no order."""
        if len(self.chosen) < len(self.choices):
            return []  # an attached letter that ends its word forbids any further column (C4)
        self._descend(0, 0.0, inf, inf, 0, 0.0, 0, 0.0, False, 0.0)
        return self.made

    def _enter(self, option: Option) -> None:
        """Take the reference's element: look the pairs up that its next position is part of."""
        group = self.group
        total = 0.0
        for n in range(len(self.order) - 1, 0, -1):
            b = self.order[n]
            table = group.pairs[b]
            assert table is not None
            row = self.rows[b] = table.row(option.target)
            total += min([row[o.target >> 2] for o in self.choices[b]], default=inf)
            self.rest[n] = total

    def _descend(
        self,
        n: int,
        high: float,
        low: float,
        low_all: float,
        empties: int,
        loose: float,
        softs: int,
        soft_sizes: float,
        elastic: bool,
        ahead_so_far: float,
    ) -> None:
        if n == len(self.order):
            self._close(high, low, low_all, empties, loose, softs, soft_sizes, elastic, ahead_so_far)
            return
        if self.check is not None:
            self.calls += 1
            if not self.calls & 255:
                self.check()
        if len(self.made) >= self.most:
            return
        b = self.order[n]
        by_empty, by_loose, limit = self.by_empty, self.by_loose, self.limit
        paired = self.group.reference is not None
        for option in self.choices[b]:
            high_, low_, low_all_, empties_, loose_, softs_, sizes_, elastic_ = (
                high, low, low_all, empties, loose, softs, soft_sizes, elastic,
            )  # fmt: skip
            if paired and n == 0:
                self._enter(option)
            row = self.rows[b]
            ahead_ = ahead_so_far + row[option.target >> 2] if row is not None and n else ahead_so_far
            size = option.size
            if option.empty:
                empties_ += 1
            elif size is None:
                elastic_ = True
            else:
                if size > high:
                    high_ = size
                if size < low_all:
                    low_all_ = size
                if size < low and (self.plain or not option.soft):
                    low_ = size
                loose_ += option.loose
                if option.soft:
                    softs_ += 1
                    sizes_ += size
            omega = high_ - low_ if low_ < inf else 0.0
            bound = (
                omega
                + by_empty * empties_ * high_
                + by_loose * loose_
                + ahead_
                + (self.rest[n + 1] if paired else 0.0)
            )
            if omega > self.mu or bound > limit:
                if size is not None and size > low and omega > min(self.mu, limit) and not option.transparent:
                    break  # longer runs are dearer still
                continue
            self.chosen[b] = option
            self._descend(n + 1, high_, low_, low_all_, empties_, loose_, softs_, sizes_, elastic_, ahead_)

    def _close(
        self,
        high: float,
        low: float,
        low_all: float,
        empties: int,
        loose: float,
        softs: int,
        soft_sizes: float,
        elastic: bool,
        after: float,
    ) -> None:
        rested = low < inf
        if not rested:
            low = high if elastic else low_all
        omega = high - low if high > low else 0.0
        cost = omega + self.by_empty * empties * high + self.by_loose * (loose + softs * high - soft_sizes)
        if cost + after > self.limit or omega > self.mu:
            return
        some = backed = begun = ended = tied = guarded = False
        needy = empties > 0
        chosen = self.chosen
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
        if not some or (self.owed and not begun) or (needy and not backed and not self.group.waived):  # C1
            return
        if guarded:  # C3
            for b, option in enumerate(chosen):
                if option.guarded and any(chosen[o].soft for o in self.group.guards[b]):
                    return
        firm = rested or not elastic
        pieces = [(b, o.letters[0], len(o.letters)) for b, o in enumerate(chosen) if o.tied] if tied else []
        single: tuple[int, int, float] | None = None
        if firm and len(pieces) == 1 and pieces[0][2] == 1:
            single = (pieces[0][0], pieces[0][1], 1.0 + self.by_empty * empties + self.by_loose * softs)
        self.made.append(
            Edge(
                tuple(chosen),
                tuple([option.target for option in chosen]),
                cost,
                omega,
                high,
                low,
                cost + after - self.before,
                after,
                firm,
                not ended,
                tied or not firm,
                single,
            )
        )


def _gathered(ranges: tuple[Range, ...], g: int, group: Group, edge: Edge) -> tuple[Range, ...]:
    """Add a piece's column to what is known of its letter; a letter that is complete and within its range is done."""
    assert edge.single is not None
    b, i, up = edge.single
    low, high = edge.least, edge.width
    others: list[Range] = []
    for own in ranges:
        if own[0] == (g, b, i):
            low, high, up = low + own[1], high + own[2], min(up, own[3])
        else:
            others.append(own)
    size = group.bands[b].letters[i].size
    if edge.column[b].ends and size is not None and low - EPS <= size <= high + EPS:
        return tuple(others)
    return tuple(sorted([*others, ((g, b, i), low, high, up)]))


class Network:
    """The network of one group, or of several that share unsized symbols, with lower bounds for what is to come."""

    def __init__(
        self, groups: Sequence[Group], check: Callable[[], None] | None = None, most: float = inf
    ) -> None:
        self.groups = tuple(groups)
        self.check = check
        self.most = most
        self.gather = True
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
        path = Path(g, group.start, 0.0, 0.0, 0, spans=((0.0, 0.0),) * len(group.bands))
        path.ahead = ahead(group, group.start)
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
        for edge in edges(group, path.state, path.owed, made - laid, limit - laid, self.check, self.most):
            cost = path.cost + edge.cost
            width = path.width + edge.width
            firm = path.firm and edge.firm
            trail, ranges = path.trail, path.ranges
            if edge.tied:
                if edge.single is not None and self.gather:
                    ranges = _gathered(ranges, path.group, group, edge)
                else:
                    trail = (*trail, edge.column)
            if all(p >> 2 == band.end >> 2 for p, band in zip(edge.state, group.bands, strict=True)):
                cost += self._closing(group, width, firm)
                bound = cost + later
                if bound == inf:
                    continue
                if ranges or width < group.canvas - group.tolerance - EPS:
                    trail = (
                        *trail,
                        path,
                    )  # too narrow as it is: only its price can tell, so it is like no other
                g = path.group + 1
                state = self.groups[g].start if g < len(self.groups) else ()
                child = Path(g, state, cost, 0.0, path.columns + 1, True, False, trail, path, edge.column)
                child.ranges = ranges
                child.spans = ((0.0, 0.0),) * len(state)
                child.ahead = ahead(self.groups[g], state) if state else 0.0
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
                child.ahead = edge.ahead
                child.ranges = ranges
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
                if done and new and not band.is_free(letter):
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
