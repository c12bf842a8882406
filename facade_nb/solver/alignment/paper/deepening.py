"""Informed iterative deepening (the paper's 5.2; Reinefeld and Marsland 1994).

A pass follows no partial alignment whose lower bound exceeds a limit (`bidirectional`). The first limit is the
lower bound of all alignments. If nothing is found, the next one is further from it, twice as far as the last,
and at least where the first partial alignment was given up. What a pass finds is optimal, because the pass
has seen everything within its limit; and where a pass gives nothing up, there is no alignment at all.

A pass is short as long as the limit is below the optimum, and may be long when it is far above. So it pays to
know an alignment: no limit need exceed its cost.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from math import inf

from ... import tuning
from ...model.precision import EPS
from ..found import Found
from ..group import Group
from ..observer import Observer
from ..pricing import Priced
from .bidirectional import Meeting
from .decision_network import Lattice, mirrored
from .guides import Guide
from .halves import Side

__all__ = ["Deepening", "Ends"]


class Ends:
    """The networks of groups that are searched together, from either end, with all that has been weighed.

    Parameters
    ----------
    guides
        Only what keeps to these is in the networks, so that what is found need not be optimal.
    like
        The networks of the same groups without guides, whose bounds serve here too.

    Attributes
    ----------
    least
        Lower bound of J that has been proven so far.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        check: Callable[[], None] | None,
        guides: Sequence[Guide] = (),
        like: Ends | None = None,
    ) -> None:
        ahead: list[Lattice] = []
        behind: list[Lattice] = []
        for g, group in enumerate(groups):
            if like is None:
                other, pairs, pairs_back = mirrored(group, check), None, None
            else:
                there = like.backward.lattices[-1 - g]
                other, pairs, pairs_back = there.group, like.forward.lattices[g].pairs, there.pairs
            own = [guide for guide in guides if guide.group == g]
            back = [guide.backward(groups) for guide in own]
            lattice = Lattice(group, check, pairs, own)
            ahead.append(lattice)
            behind.append(lattice if other is group and not own else Lattice(other, check, pairs_back, back))
        self.forward: Side = Side("forward", ahead)
        self.backward: Side = Side("backward", behind[::-1])
        self.least = max(self.forward.later[0], self.backward.later[0])

    def watch(self, check: Callable[[], None] | None, observer: Observer | None) -> None:
        """Say who is to be asked now and then, and who is to be told."""
        for side in (self.forward, self.backward):
            side.observer = observer
            for lattice in side.lattices:
                lattice.check = check


class Deepening:
    """Passes under growing limits.

    Parameters
    ----------
    alone
        See `bidirectional.Meeting`.

    Attributes
    ----------
    found
        What the last pass found.
    known
        An alignment that is known otherwise.
    """

    def __init__(
        self,
        ends: Ends,
        *,
        cap: float = inf,
        keep: int = 8,
        check: Callable[[], None] | None = None,
        accept: Callable[[Priced], bool] | None = None,
        observer: Observer | None = None,
        alone: bool = False,
    ) -> None:
        ends.watch(check, observer)
        self.ends, self.keep, self.check, self.accept = ends, keep, check, accept
        self.observer, self.alone = observer, alone
        self.found = Found(bound=ends.least)
        self.known: Priced | None = None
        self._alike: list[Priced] = []  # all that are as good as `known`
        self.limit = cap
        groups = ends.forward.groups
        self._step = 0.01 * max(group.canvas for group in groups)
        self._threshold = min(cap, ends.least)

    def know(self, alignments: Iterable[Priced]) -> None:
        """Tell of alignments that exist, so that nothing dearer is looked for."""
        for priced in alignments:
            if self.known is None or _better(priced, self.known):
                self.known, self._alike = priced, [priced]
            elif not _better(self.known, priced) and all(
                priced.structure != other.structure for other in self._alike
            ):
                self._alike.append(priced)
        if self.known is not None:
            self.limit = min(self.limit, self.known.cost)
            self._threshold = min(self._threshold, self.limit)

    def go(self, nodes: int) -> None:
        """Find the best, unless `nodes` partial alignments are taken up before that.

        Pieces of no length make for many alignments that say the same. So what cannot have positive pieces within
        the limit is left out at first (`relaxation`). Only if the last pass has left out anything, one more looks
        whether that is cheaper: at the same cost, positive pieces win.
        """
        if not self._round(nodes, proper=True) or self.found.cut:
            return
        found, ties = self.found, self.found.ties
        self.know(ties)
        if not (ties and ties[0].proper):
            self._threshold = self.limit if ties else self._threshold
            self._round(nodes, proper=False)
            return
        if ties[0].cost > self.ends.least + EPS:
            cap, self.limit = self.limit, ties[0].cost - 2 * EPS
            self._threshold = self.limit
            self._round(nodes, proper=False)
            self.limit = cap
        if not found.ties:
            found.ties = ties
            if not found.cut:
                found.bound = ties[0].cost

    def _round(self, nodes: int, proper: bool) -> bool:
        """Deepen; whether the last pass left something out for the length of its pieces."""
        found, known = self.found, self.known
        forward, backward = self.ends.forward, self.ends.backward
        # above the limit they are of no use: then something cheaper is looked for
        given = known is not None and known.cost <= self.limit + EPS
        found.cut, found.ties = False, self._alike[: self.keep] if given else []
        while True:
            if self.observer is not None:
                self.observer.deepened(self._threshold, max(found.bound, self.ends.least))
            forward.beyond = backward.beyond = inf
            before = found.nodes
            meeting = Meeting(
                forward,
                backward,
                self._threshold,
                found,
                keep=self.keep,
                nodes=nodes,
                check=self.check,
                accept=self.accept,
                known=(inf, 0) if known is None else (known.cost, known.columns if known.proper else 0),
                proper=proper,
                alone=self.alone,
                observer=self.observer,
            )
            meeting.run()
            thinned = meeting.thinned
            if found.cut:
                self.know(found.ties)
                return thinned
            beyond = min(forward.beyond, backward.beyond)
            done = bool(found.ties) and found.ties[0].cost <= self._threshold + EPS
            if not thinned:
                least = max(found.bound, beyond if known is None else min(beyond, known.cost))
                found.bound = found.ties[0].cost if done else least
            if done or self._threshold >= self.limit or beyond == inf:
                return thinned
            self._threshold = min(self.limit, max(beyond, self.ends.least + self._step))
            self._step *= (
                tuning.LIMIT_GROWTH if found.nodes - before < tuning.DEAR_PASS else tuning.LIMIT_GROWTH**3
            )

    def result(self) -> Found:
        """What is known now."""
        found, known = self.found, self.known
        best = found.best
        if known is not None and (best is None or _better(known, best)):
            found.ties = [known]
            if not found.cut:
                found.bound = known.cost
        return found


def _better(a: Priced, b: Priced) -> bool:
    """Least cost, then positive pieces, then most columns."""
    if abs(a.cost - b.cost) > EPS:
        return a.cost < b.cost
    return (not a.proper, -a.columns) < (not b.proper, -b.columns)
