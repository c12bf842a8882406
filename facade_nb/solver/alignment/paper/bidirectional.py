"""Both ways at once: two walks that meet in the middle of the network (the paper's 5.2).

Every path from the first node to the last has exactly one edge by which half of all letters have been read. The
forward walk follows paths as far as that edge, the backward walk from the last node to where such edges end. Each
sees about the square root of what one walk would see. Where the façade has a mirror axis both walk one network, so
that what has been weighed for one serves the other.

Whatever the forward walk has brought to a node is joined with whatever the backward walk brings there. The joined
alignment has a lower bound, made up of both, of W, and of the letters that are cut at the node; if that passes, it
is priced (`pricing`), exactly. As everything within the limit is joined, the best is optimal.

Halves whose lengths are good, each by themselves, may make thousands of wholes whose lengths are not. If one after the
other turns out like that, the pass goes on forward alone: programmes of longer and longer parts tell sooner then.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from ... import tuning
from ...effort import spend
from ...model.precision import EPS
from ..bands import Band
from ..elements import Option
from ..found import Found
from ..observer import Observer, Places
from ..pricing import Priced, Structure, price
from .halves import Half, Side, closing
from .pieces import Stretch, excess, ledger_bound, merged
from .relaxation import Relaxation
from .transposition import Transpositions

__all__ = ["Meeting"]


_ERROR = 0.1 * EPS
"""The linear programmes are at least that exact, metres."""


class Meeting:
    """One pass of both walks under a limit.

    Attributes
    ----------
    thinned
        Something was left out for it would have had pieces of no length (`proper`).

    Parameters
    ----------
    limit
        Nothing dearer is followed. It comes down with every alignment found.
    found
        Where alignments go.
    known
        J, and the number of columns, of an alignment with nothing but positive pieces that is known to exist.
    proper
        Follow only what can have nothing but positive pieces within the limit.
    alone
        Walk forward only, all the way: finds some alignment sooner, and the best later.
    """

    def __init__(
        self,
        forward: Side,
        backward: Side,
        limit: float,
        found: Found,
        *,
        keep: int = 8,
        nodes: int = 1_000_000,
        check: Callable[[], None] | None = None,
        accept: Callable[[Priced], bool] | None = None,
        known: tuple[float, int] = (inf, 0),
        proper: bool = False,
        alone: bool = False,
        observer: Observer | None = None,
    ) -> None:
        self.forward, self.backward, self.limit, self.found = forward, backward, limit, found
        self.keep, self.nodes, self.check, self.accept = keep, nodes, check, accept
        self.known, self.observer = known, observer
        self.proper, self.thinned, self.alone = proper, False, alone
        self._idle = 0  # so many joined alignments, one after the other, were no better than what was known
        self.arrived: dict[tuple[int, Places], list[Half]] = {}
        self._elements: dict[tuple[int, int, int], dict[tuple[tuple[int, ...], bool], Option]] = {}

    def run(self) -> None:
        """Walk forward, then backward, and join."""
        if not self.forward.total:
            return
        if self.alone:
            self._walk(self.forward, self._finish)
            return
        self._walk(self.forward, self._arrive)
        if not self.arrived:
            return
        for halves in self.arrived.values():
            halves.sort(key=_cost)
        self._walk(self.backward, self._join_all)
        if self._idle >= tuning.IDLE_JOINS and not self.found.cut:
            self._walk(self.forward, self._finish)

    def _walk(self, side: Side, meet: Callable[[Half], bool]) -> None:
        """Depth first; `meet` takes a half and says whether to go on from it."""
        table = Transpositions(side, self.keep)
        root = side.root()
        if root.bound > self.limit + EPS or not meet(root):
            return
        stack = [(root, iter(side.onward(root, self.limit)))]
        while stack and (side is self.forward or self._idle < tuning.IDLE_JOINS):
            half, children = stack[-1]
            child = None if half.dropped else next(children, None)
            if child is None:
                stack.pop()
                continue
            if child.bound > self.limit + EPS:  # it was not when its node was taken up
                side.pruned(child, "bound", self.limit)
                continue
            if self._hopeless(side, child):
                side.pruned(child, "best", self._rival)
                continue
            if side is self.backward and 2 * side.progress(child) > side.total:
                continue  # the other walk's half
            other = table.drops(child) if self.accept is None else None
            if other is not None:
                side.pruned(child, "known", other.cost)
                continue
            reason = self._beyond(side, child) if child.trail else ""
            if reason:
                side.pruned(child, reason, self._rival if reason == "best" else self.limit)
                continue
            self.found.nodes += 1
            if self.check is not None:
                self.check()
            if self.found.nodes >= self.nodes:
                self.found.cut = True
                return
            if self.observer is not None:
                self.observer.visited(side.way, *side.key(child), child.cost, child.bound)
            if meet(child):
                stack.append((child, iter(side.onward(child, self.limit))))

    def _hopeless(self, side: Side, half: Half) -> bool:
        """Whether it cannot lead to anything better than what is known, not even by its number of columns.

        Where a column ends, a letter begins or ends; and where the next one begins, if no letter is cut there.
        """
        left = side.total - side.progress(half)
        if left and (half.owed or not any(p & 4 for p in half.state)):
            left -= 1
        return self._no_better(half.bound, half.columns + left)

    def _beyond(self, side: Side, half: Half) -> str:
        """Why lengths that depend on each other make it too dear (`relaxation`); empty: they do not.

        Reasons are those of `Observer.pruned`.
        """
        g = half.group
        inside = g < len(side.groups)
        later = side.later[g + 1 if inside else g]
        key = tuple([column for _, column in half.laid()])
        known = side.relaxed.get(key)
        if known is None:
            spend(self.check, tuning.RELAXED)
            relaxed = Relaxation(side, half)
            known = side.relaxed[key] = relaxed.value - _ERROR, relaxed.positive() - _ERROR
        bound, positive = known[0] + later, known[1] + later
        half.bound = max(half.bound, bound)
        if half.bound > self.limit + EPS:
            side.beyond = min(side.beyond, half.bound)
            return "bound"
        if self._hopeless(side, half):
            return "best"
        best = self.found.best
        rival = best.cost if best is not None and best.proper else self.known[0] if self.known[1] else inf
        if half.bound >= rival - EPS and positive > rival + EPS:
            return "length"  # it ties at best, with pieces of no length
        if self.proper and positive > self.limit + EPS:
            self.thinned = True
            side.beyond = min(side.beyond, positive)
            return "length"
        return ""

    @property
    def _rival(self) -> float:
        """J of the best alignment that is known; where there is none, the limit."""
        best = self.found.best
        return min(self.limit, self.known[0], inf if best is None else best.cost)

    def _no_better(self, bound: float, columns: int) -> bool:
        best = self.found.best
        if best is not None and best.proper and bound >= best.cost - EPS:
            return columns < best.columns or (columns == best.columns and len(self.found.ties) >= self.keep)
        return bound >= self.known[0] - EPS and columns < self.known[1]

    def _finish(self, half: Half) -> bool:
        """Take in what has come to the last node."""
        if half.group < len(self.forward.groups):
            return True
        self._join(self.forward.key(half), half, self.backward.root())
        return False

    def _arrive(self, half: Half) -> bool:
        """Keep what has come to the middle."""
        if 2 * self.forward.progress(half) < self.forward.total:
            return True
        self.arrived.setdefault(self.forward.key(half), []).append(half)
        return False

    def _join_all(self, half: Half) -> bool:
        """Join with whatever came to the same node from the left."""
        key = self.backward.key(half)
        for other in self.arrived.get(key, ()):
            if other.cost + half.cost > self.limit + EPS:
                self.backward.beyond = min(self.backward.beyond, other.cost + half.cost)
                break
            if not other.dropped:
                self._join(key, other, half)
            if self._idle >= tuning.IDLE_JOINS:
                break
        return True

    def _join(self, key: tuple[int, Places], left: Half, right: Half) -> None:
        if left.owed and right.owed:
            return
        bound = self._joined_bound(key, left, right)
        columns = left.columns + right.columns
        if bound > self.limit + EPS:
            self.backward.beyond = min(self.backward.beyond, bound)
            return
        if self._no_better(bound, columns):
            return
        structure = self._read(left, right)
        if structure is None:
            return
        priced = self._priced(structure)
        if priced is None:
            return
        self._idle += 1
        if priced.cost > self.limit + EPS:
            self.backward.beyond = min(self.backward.beyond, priced.cost)
            return
        if self.accept is not None and not self.accept(priced):
            return
        before = len(self.found.ties), self.found.best
        known = any(other.structure == structure for other in self.found.ties)
        if not known:
            self.found.offer(priced, self.keep)
        if known or before != (len(self.found.ties), self.found.best):
            self._idle = 0
            if self.observer is not None:
                self.observer.met(*key, priced.cost, priced.columns)
        self.limit = min(self.limit, priced.cost)

    def _priced(self, structure: Structure) -> Priced | None:
        """What a whole alignment costs."""
        if structure not in self.forward.priced:
            self.forward.priced[structure] = price(self.forward.groups, structure)
        return self.forward.priced[structure]

    def _joined_bound(self, key: tuple[int, Places], left: Half, right: Half) -> float:
        """Both halves, the letters cut at the node, and W."""
        cost = left.cost + right.cost
        width = left.width + right.width
        groups = self.forward.groups
        if left.ledger or right.ledger:
            ledger = {(s.group, s.band, s.letter): s for s in left.ledger}
            for stretch in right.ledger:
                own = self._from_left(stretch)
                at = (own.group, own.band, own.letter)
                ledger[at] = merged(ledger[at], own) if at in ledger else own
            for at, stretch in list(ledger.items()):
                size = groups[at[0]].bands[at[1]].letters[at[2]].size
                if size is not None:
                    del ledger[at]
                    if not stretch.mixed:
                        more, wider = excess(stretch, size)
                        cost += more
                        width += wider
            cost += ledger_bound(ledger.values(), groups)
        if any(key[1]):
            cost += closing(groups[key[0]], width, left.firm and right.firm)
        return cost

    def _from_left(self, stretch: Stretch) -> Stretch:
        """The same stretch, its letter counted from the left."""
        last = len(self.forward.groups) - 1
        letters = self.backward.groups[stretch.group].bands[stretch.band].letters
        return Stretch(
            last - stretch.group,
            stretch.band,
            len(letters) - 1 - stretch.letter,
            stretch.low,
            stretch.high,
            stretch.down,
            stretch.ups,
            stretch.ended,
            stretch.mixed,
        )

    def _read(self, left: Half, right: Half) -> Structure | None:
        """The whole alignment, read from the left; None where the joint breaks C4."""
        groups = self.forward.groups
        last = len(groups) - 1
        out: list[list[tuple[Option, ...]]] = [[] for _ in groups]
        for g, column in left.laid():
            out[g].append(column.options)
        state = list(left.state)
        current = left.group
        for mirrored_group, column in reversed(right.laid()):
            g = last - mirrored_group
            bands = groups[g].bands
            if g != current:
                current, state = g, list(groups[g].start)
            options: list[Option] = []
            for b, option in enumerate(column.options):
                own = self._element(g, b, bands[b], state[b], option)
                if own is None:
                    return None
                options.append(own)
            state = [option.target for option in options]
            out[g].append(tuple(options))
        return tuple(tuple(columns) for columns in out)

    def _element(self, g: int, b: int, band: Band, position: int, mirrored: Option) -> Option | None:
        """The element from the left that the backward lattice read from the right."""
        known = self._elements.get((g, b, position))
        if known is None:
            known = self._elements[g, b, position] = {(o.letters, o.ends): o for o in band.options(position)}
        count = len(band.letters) - 1
        return known.get((tuple([count - i for i in reversed(mirrored.letters)]), mirrored.begins))


def _cost(half: Half) -> float:
    return half.cost
