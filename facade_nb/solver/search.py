"""The default alignment search: best first, exact.

Paths leave a queue by their lower bound; a complete one is priced and goes back with its exact J. What leaves the
queue priced is optimal, because everything else there has a bound that is no better. Columns are only made while
their bound stays within a budget, which begins just above the lower bound of the whole and doubles, so that
the exponentially many bad columns are never looked at; an incumbent from another candidate caps it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count
from math import inf

from .columns import EPS, Group
from .network import Network, Path, Seen
from .pricing import Priced, price

__all__ = ["Found", "Stopped", "search"]


class Stopped(Exception):
    """The time is up, or the caller asked to stop."""


@dataclass(slots=True)
class Found:
    """What a search found.

    Attributes
    ----------
    ties
        The best structures, equal in cost, propriety and number of columns; empty: no alignment within the cap.
    bound
        Proven lower bound of the cost.
    nodes
        How many partial paths were taken up.
    cut
        The search ended before it knew everything below its cap.
    """

    ties: list[Priced] = field(default_factory=list)
    bound: float = 0.0
    nodes: int = 0
    cut: bool = False

    @property
    def best(self) -> Priced | None:
        """The first of the ties."""
        return self.ties[0] if self.ties else None

    def offer(self, priced: Priced, keep: int) -> None:
        """Take a structure in, if none known is better."""
        best = self.best
        if best is not None and priced.cost <= best.cost + EPS:
            ours, theirs = (not priced.proper, -priced.columns), (not best.proper, -best.columns)
            if priced.cost < best.cost - EPS or ours < theirs:
                self.ties = [priced]
            elif ours == theirs and len(self.ties) < keep:
                self.ties.append(priced)
        elif best is None:
            self.ties = [priced]


def search(
    groups: Sequence[Group],
    *,
    cap: float = inf,
    keep: int = 8,
    nodes: int = 1_000_000,
    check: Callable[[], None] | None = None,
    accept: Callable[[Priced], bool] | None = None,
) -> Found:
    """Align groups that share unsized symbols (or one group alone), with the least J summed over them.

    Parameters
    ----------
    cap
        Alignments that cost more are not looked for.
    keep
        How many equally good structures to return.
    nodes
        After so many partial paths the best so far is returned, with the bound proven until then.
    check
        Called now and then; may raise `Stopped`.
    accept
        Says whether a structure will do; those that will not are passed over. As it may look at anything, no path is
        dropped for another then.
    """
    network = Network(groups)
    found = Found(bound=network.later[0])
    if found.bound > cap + EPS or found.bound == inf:
        return found
    step = 0.02 * max(group.canvas for group in groups)
    while True:
        budget = min(cap, network.later[0] + step)
        all_seen = _sweep(network, budget, found, keep, nodes, check, accept)
        if found.ties or found.cut:
            return found
        found.bound = inf if all_seen else max(found.bound, budget)
        if all_seen or budget >= cap:
            return found
        step *= 2.0


def _sweep(
    network: Network,
    budget: float,
    found: Found,
    keep: int,
    nodes: int,
    check: Callable[[], None] | None,
    accept: Callable[[Priced], bool] | None,
) -> bool:
    """One best-first pass within the budget. Returns whether the budget can no longer be what stopped it."""
    limit = network.ceiling()
    serial = count()
    queue: list[tuple[float, int, int, Path | Priced]] = [(network.later[0], 0, next(serial), network.root())]
    seen = Seen(network, keep)
    whole = budget >= limit
    while queue:
        bound, _, _, item = heappop(queue)
        if found.ties and bound > found.ties[0].cost + EPS:
            break
        if isinstance(item, Priced):
            if accept is None or accept(item):
                budget = min(budget, item.cost)
                found.bound = max(found.bound, item.cost)
                found.offer(item, keep)
            continue
        if item.dropped:
            continue
        if not found.ties:
            found.bound = max(found.bound, bound)
        found.nodes += 1
        if check is not None and not found.nodes & 63:
            check()
        if found.nodes >= nodes:
            found.cut = True
            return False
        if network.complete(item):
            priced = price(network.groups, network.structure(item))
            if priced is not None and priced.cost <= budget + EPS:
                if accept is None:
                    budget = min(budget, priced.cost)
                heappush(queue, (priced.cost, -priced.columns, next(serial), priced))
            continue
        for child_bound, child in network.children(item, budget):
            if accept is not None or not seen.drops(child, budget):
                heappush(queue, (child_bound, -child.columns, next(serial), child))
    return whole
