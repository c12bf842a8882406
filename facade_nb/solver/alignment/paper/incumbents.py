"""Good alignments, soon: what the exact search need not exceed.

The paper aligns control patterns first, and many words pair by pair. Both leave out almost everything, which is
what makes them fast, and may leave out the best. Here they are searches along guides (`prealignment`, `word_pairs`,
`guides`): what they find is an alignment like any other, priced exactly, and sets the limit of the exact search.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import inf

from ... import tuning
from ..group import Group
from ..observer import Observer
from ..pricing import Priced, Structure
from .deepening import Deepening, Ends
from .guides import Guide
from .prealignment import control_group, control_guides
from .word_pairs import merged_guides

__all__ = ["incumbents"]


def incumbents(
    groups: Sequence[Group],
    ends: Ends,
    *,
    cap: float = inf,
    keep: int = 8,
    check: Callable[[], None] | None = None,
    accept: Callable[[Priced], bool] | None = None,
    observer: Observer | None = None,
) -> Iterator[Priced]:
    """What one walk meets first, and alignments along prealigned control words, and along words merged pair by pair."""

    def along(guides: Sequence[Guide], cap: float) -> Priced | None:
        search = Deepening(
            Ends(groups, check, guides, ends), cap=cap, keep=1, check=check, accept=accept, alone=True
        )
        search.go(tuning.INCUMBENT_PATHS)
        return search.result().best

    def apart(own: Sequence[Group], guides: Sequence[Guide] = ()) -> Structure | None:
        search = Deepening(Ends(own, check, guides), keep=1, check=check, alone=True)
        if search.ends.least < inf:
            search.go(tuning.INCUMBENT_PATHS)
        best = search.result().best
        return None if best is None else best.structure

    search = Deepening(ends, cap=cap, keep=keep, check=check, accept=accept, alone=True)
    search.go(tuning.INCUMBENT_PATHS)
    for priced in search.result().ties:
        cap = min(cap, priced.cost)
        yield priced
    controls = [control_group(group) or group for group in groups]
    if any(control is not group for control, group in zip(controls, groups, strict=True)):
        aligned = apart(controls)
        if aligned is not None:
            guides = control_guides(groups, controls, aligned)
            best = along(guides, cap)
            if observer is not None:
                nodes = tuple((guide.group, guide.nodes) for guide in guides)
                observer.prealigned(nodes, inf if best is None else best.cost)
            if best is not None:
                cap = best.cost
                yield best
    guides = [
        guide
        for g, group in enumerate(groups)
        for guide in merged_guides(g, group, lambda own, inner: apart([own], inner))
    ]
    if guides:
        best = along(guides, cap)
        if observer is not None:
            parts = tuple((guide.group, guide.bands, guide.nodes) for guide in guides)
            observer.merged(parts, inf if best is None else best.cost)
        if best is not None:
            yield best
