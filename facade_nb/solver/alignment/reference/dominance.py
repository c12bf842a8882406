"""The transposition table of both searches: which partial alignments make others needless."""

from __future__ import annotations

from ...model.precision import EPS
from .network import Network
from .paths import Path

__all__ = ["Seen"]


class Seen:
    """The transposition table: the best paths known at each node.

    Of two paths at one node, the one that is no cheaper, has no more columns and cannot become cheaper by
    its W is dropped. |W − canvas| changes by at most the difference of the two W, whatever comes; a
    narrower path may replace a wider one where it cannot end below canvas − μ.

    The price of a path also depends on the lengths of pieces that answer to an equation. Where a column holds one such
    piece, all that matters of it is the range of lengths that cost nothing, what a metre beyond costs, and how far
    the tolerance lets it go; all of that adds up over a letter's pieces, and of two paths the one with the wider
    ranges can only be cheaper (`paths.gathered`). Other columns with such pieces have to be the same (`trail`).
    """

    def __init__(self, network: Network, keep: int) -> None:
        self._network = network
        self._keep = keep
        self._known: dict[object, list[Path]] = {}

    def drops(self, path: Path) -> bool:
        """Whether a known path makes this one needless; if not, it becomes known, and what it beats is dropped."""
        key = (path.group, path.state, path.owed, path.trail, tuple([own[0] for own in path.ranges]))
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
        if a.cost > b.cost + EPS or dw > EPS or (a.pinched and not b.pinched):
            return -1
        slack = 0.0
        wider = False
        for (_, low, high, up, more), (_, low_b, high_b, up_b, more_b) in zip(
            a.ranges, b.ranges, strict=True
        ):
            if low > low_b + EPS or high < high_b - EPS or up > up_b + EPS or more < more_b - EPS:
                return -1
            wider = (
                wider or low < low_b - EPS or high > high_b + EPS or up < up_b - EPS or more > more_b + EPS
            )
        if abs(dw) > EPS or wider:
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
            equal = slack <= EPS and a.columns == b.columns and a.cost >= b.cost - EPS
            return 0 if equal and not wider else 1
        return -1
