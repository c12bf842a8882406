"""Aligning groups by the best-first search, all in one call."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf

from ...model.precision import EPS
from ..found import Found
from ..group import Group
from ..pricing import Priced
from .binding import best_first

__all__ = ["search_best"]


def search_best(
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
        Says whether a structure will do; those that will not are passed over. As it may look at anything,
        no path is dropped for another then.
    """
    run = best_first(groups, keep=keep, nodes=nodes, check=check, accept=accept)
    step = 0.01 * max(group.canvas for group in groups)
    while not run.done and run.found.bound <= cap + EPS:
        run.advance(min(cap, run.found.bound + step))
        if run.found.bound >= cap:
            break
        step *= 1.6
    return run.found
