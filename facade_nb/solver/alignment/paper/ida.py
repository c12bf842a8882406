"""The paper's search: informed iterative deepening, from both ends at once (5.2, supplement 3.3).

The parts are in the package `paper`; docs/alignment-search.md goes through them in the paper's order.

First the deepening goes on by itself for a while, which is enough for nearly all words. If it is not, good
alignments are looked for through prealigned control words and words merged pair by pair, and the deepening
goes on with what they cost as its limit. So the answer is exact, whatever the heuristics miss.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf

from ...model.precision import EPS
from ..found import Found
from ..group import Group
from ..observer import Observer
from ..pricing import Priced
from .deepening import Deepening, Ends
from .incumbents import incumbents

__all__ = ["search_ida"]


def search_ida(
    groups: Sequence[Group],
    *,
    cap: float = inf,
    keep: int = 8,
    nodes: int = 1_000_000,
    check: Callable[[], None] | None = None,
    accept: Callable[[Priced], bool] | None = None,
    observer: Observer | None = None,
    ends: Ends | None = None,
    patience: int = 300,
) -> Found:
    """Like `core.search.search_best`, and with the same result.

    Parameters
    ----------
    observer
        Is told what happens (`alignment.observer`). Nothing that was weighed before is used then, so that it is
        told everything.
    ends
        The networks of the groups, with what an earlier search has weighed in them; None: they are made.
    patience
        So many partial alignments are taken up before a good alignment is looked for by prealigning and
        merging; 0: that is done first.
    """
    if ends is None or observer is not None:
        ends = Ends(groups, check)
    search = Deepening(ends, cap=cap, keep=keep, check=check, accept=accept, observer=observer)
    if ends.least > cap + EPS or ends.least == inf:
        return search.found
    if patience:
        search.go(min(nodes, patience))
    if not patience or (search.found.cut and nodes > patience):
        search.know(
            incumbents(groups, ends, cap=cap, keep=keep, check=check, accept=accept, observer=observer)
        )
        ends.watch(check, observer)
        search.go(nodes)
    found = search.result()
    if accept is None:
        ends.least = max(ends.least, found.bound)
    return found
