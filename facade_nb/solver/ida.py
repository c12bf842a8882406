"""The paper's search: informed iterative deepening with a transposition table (5.2; Reinefeld and Marsland
1994).

Depth first, so that no global ranking of edges is needed: each node ranks the edges that leave it, by their
lower bound and then by the fewer symbols, which favours more columns. What exceeds the threshold is not
made; if nothing was found, the distance of the threshold from the lower bound doubles and the search begins
again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf

from .columns import EPS, Group
from .network import Network, Path
from .pricing import Priced, price
from .search import Found
from .seen import Seen

__all__ = ["search_ida"]


def search_ida(
    groups: Sequence[Group],
    *,
    cap: float = inf,
    keep: int = 8,
    nodes: int = 1_000_000,
    check: Callable[[], None] | None = None,
    accept: Callable[[Priced], bool] | None = None,
) -> Found:
    """Like `search.search`, and with the same result."""
    network = Network(groups, check)
    found = Found(bound=network.later[0])
    if found.bound > cap + EPS or found.bound == inf:
        return found
    step = 0.01 * max(group.canvas for group in groups)
    limit = min(cap, network.ceiling())
    while True:
        threshold = min(limit, network.later[0] + step)
        network.gather = threshold <= min(group.tolerance for group in groups)
        dive = _Dive(network, threshold, found, keep, nodes, check, accept)
        dive.visit(network.root())
        if found.nodes >= nodes:
            found.cut = True
            return found
        all_seen = threshold >= network.ceiling()
        found.bound = found.ties[0].cost if found.ties else (inf if all_seen else max(found.bound, threshold))
        if found.ties or threshold >= limit:
            return found
        step *= 2.0


class _Dive:
    """One depth-first pass under a threshold."""

    def __init__(
        self,
        network: Network,
        threshold: float,
        found: Found,
        keep: int,
        nodes: int,
        check: Callable[[], None] | None,
        accept: Callable[[Priced], bool] | None,
    ) -> None:
        self.network, self.threshold, self.found = network, threshold, found
        self.keep, self.nodes, self.check, self.accept = keep, nodes, check, accept
        self.seen = Seen(network, keep)

    def visit(self, path: Path) -> None:
        found, network = self.found, self.network
        found.nodes += 1
        if self.check is not None and not found.nodes & 63:
            self.check()
        if found.nodes >= self.nodes:
            return
        if network.complete(path):
            priced = price(network.groups, network.structure(path))
            if priced is None or priced.cost > self.threshold + EPS:
                return
            if self.accept is None or self.accept(priced):
                found.offer(priced, self.keep)
                self.threshold = min(self.threshold, priced.cost)
            return
        children = network.children(path, -inf, self.threshold)
        children.sort(key=lambda item: (item[0], sum(len(option.letters) for option in item[1].column)))
        for bound, child in children:
            if bound > self.threshold + EPS:
                return
            if self.accept is not None or not self.seen.drops(child):
                self.visit(child)
