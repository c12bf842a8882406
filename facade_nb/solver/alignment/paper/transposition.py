"""The transposition table: which partial alignments make others needless.

(The paper's 5.2; Reinefeld and Marsland 1994.)

Many paths lead to one node. Where no price depends on lengths, what they may still cost depends on the node
and on W alone, so that of two paths the one that is no cheaper, has no more columns and cannot become cheaper
by its W need not be followed. |W − canvas| changes by at most the difference of the two W, whatever comes; a
narrower path may replace a wider one where it cannot end below canvas − μ.

Lengths of pieces matter by their ledgers, which are compared as functions (`lengths.Stretch.covers`), and by the
columns of their trails, which have to be the same. Columns that could be made wider to reach the canvas are one
more reason to keep a path, as long as that may be needed.
"""

from __future__ import annotations

from ...model.precision import EPS
from .halves import Half, Side

__all__ = ["Transpositions"]


class Transpositions:
    """The partial alignments of one pass, by node.

    Parameters
    ----------
    keep
        So many equally good paths to one node are kept.
    """

    def __init__(self, side: Side, keep: int) -> None:
        self._side = side
        self._keep = keep
        self._known: dict[object, list[Half]] = {}

    def drops(self, half: Half) -> Half | None:
        """A known path that makes this one needless; if none does, this one is known now, and what it beats dropped."""
        key = (
            half.group,
            half.state,
            half.owed,
            half.trail,
            tuple([(s.group, s.band, s.letter, s.mixed, s.ended) for s in half.ledger]),
        )
        known = self._known.get(key)
        if known is None:
            self._known[key] = [half]
            return None
        equals = 0
        for other in known:
            verdict = self._beats(other, half)
            if verdict > 0:
                return other
            equals += verdict == 0
        if equals >= self._keep:
            return known[0]
        kept = [other for other in known if self._beats(half, other) <= 0]
        if len(kept) < len(known):
            for other in known:
                other.dropped = other.dropped or other not in kept
        known[:] = [*kept, half]
        return None

    def _beats(self, a: Half, b: Half) -> int:
        """1: `a` makes `b` needless; 0: as good as it in every respect; -1: neither."""
        if a.cost > b.cost + EPS or a.width > b.width + EPS:
            return -1
        wider = False
        for own, other in zip(a.ledger, b.ledger, strict=True):
            if own is not other:
                if not own.covers(other):
                    return -1
                wider = wider or not other.covers(own)
        narrower = b.width - a.width > EPS
        slack = 0.0
        if (narrower or wider or b.lax) and a.group < len(self._side.groups):
            group = self._side.groups[a.group]
            least = a.width + max(band.at_least(p) for band, p in zip(group.bands, a.state, strict=True))
            if least < group.canvas - group.tolerance:
                return -1
            slack = group.objective.fit * (b.width - a.width) if narrower else 0.0
        if a.cost + slack < b.cost - EPS:
            return 1
        if a.cost + slack <= b.cost + EPS and a.columns >= b.columns:
            equal = slack <= EPS and a.columns == b.columns and a.cost >= b.cost - EPS
            return 0 if equal and not wider else 1
        return -1
