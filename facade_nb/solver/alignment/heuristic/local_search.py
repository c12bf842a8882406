"""Good alignments of many rows, at once.

To begin with, the letters of each row without placeholders are given a place, say, from the left. Columns can then end
at any of these places, each row with the letter that ends next to it, and the cheapest columns are a shortest path over
places. A sweep takes each row out and lays it back in where it costs least, given where all others stand, again a
shortest path, over columns and letters (`laying`); empty columns stand between the others, for letters that fit in
none. Rows with placeholders are laid after the others: what stands between placeholders finds its place, and joins
columns that are too narrow for it. Then neighbouring columns are joined wherever that makes J less. From where the
letters stand now all begins anew, until nothing changes.

Nothing is proven by it: it is what there is while the exact search goes on, and what that need not exceed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import inf
from statistics import median

from ... import tuning
from ...model.precision import EPS
from ..group import Group
from ..pricing import Columns, Priced, price
from .placement import Table, with_gaps, without_gaps
from .runs import Cuts

__all__ = ["can_sweep", "mended", "polished", "sweeps"]


def can_sweep(groups: Sequence[Group]) -> bool:
    """Whether there are several words somewhere, none too long, and an objective of more than Ω.

    Placeholders have to be cut, and some row has to have a solid letter.
    """
    bands = [band for group in groups for band in group.bands]
    return (
        any(len(group.bands) > 1 for group in groups)
        and max(len(band.letters) for band in bands) <= tuning.SWEPT_LETTERS
        and not any(group.objective.plain for group in groups)
        and all(band.cuts or not any(letter.transparent for letter in band.letters) for band in bands)
        and all(any(not a.transparent for band in group.bands for a in band.letters) for group in groups)
    )


def sweeps(
    groups: Sequence[Group],
    check: Callable[[], None] | None = None,
    fits: Callable[[Priced], bool] | None = None,
) -> Iterator[Priced]:
    """Alignments that keep all constraints, each cheaper than the one before.

    `check` may raise `Stopped`; `fits` says whether an alignment will do.
    """
    best = inf
    for priced, _, _ in _rounds(groups, check):
        if priced.cost < best - EPS and (fits is None or fits(priced)):
            best = priced.cost
            yield priced


def mended(
    groups: Sequence[Group], strain: Callable[[Priced], float], check: Callable[[], None] | None = None
) -> Priced | None:
    """An alignment that can be sized, near the cheapest that sweeps find.

    `strain` says by how much one cannot; 0: it can. Step by step, columns are joined, or one run of letters stands
    elsewhere, as long as that lessens the strain.
    """
    found = min(_rounds(groups, check), key=lambda one: one[0].cost, default=None)
    if found is None:
        return None
    priced, tables, cuts = found
    now = strain(priced)
    while now > 0.0:
        for changed, other in _changed(tables, cuts, check):
            left = strain(other)
            if left < tuning.LESS_STRAIN * now:
                cuts, now, priced = changed, left, other
                break
        else:
            return None
    return priced


def polished(
    groups: Sequence[Group],
    start: Priced,
    fits: Callable[[Priced], bool],
    check: Callable[[], None] | None = None,
) -> Iterator[Priced]:
    """Alignments cheaper than one that will do, each by a little change of the one before, until none is."""
    tables = [_table(group, start.unsized, check) for group in groups]
    cuts = [table.spots(columns) for table, columns in zip(tables, start.structure, strict=True)]
    best, going = start.cost, True
    while going:
        going = False
        for changed, other in _changed(tables, cuts, check):
            if other.cost < best - EPS and fits(other):
                best, cuts, going = other.cost, changed, True
                yield other
                break


def _rounds(
    groups: Sequence[Group], check: Callable[[], None] | None
) -> Iterator[tuple[Priced, list[Table], list[Cuts]]]:
    """Sweeps, with the sizes that unsized symbols have come to; with the spots at which all letters stand."""
    least = inf
    assumed = _assumed(groups)
    for _ in range(tuning.SWEEP_ROUNDS if assumed else 1):
        cheapest: Priced | None = None
        for own in _swept(groups, assumed, check):
            yield own
            if own[0].cost < least - EPS:
                least, cheapest = own[0].cost, own[0]
        if cheapest is None:
            return
        assumed = {symbol: cheapest.unsized.get(symbol, size) for symbol, size in assumed.items()}


def _swept(
    groups: Sequence[Group], assumed: Mapping[str, float], check: Callable[[], None] | None
) -> Iterator[tuple[Priced, list[Table], list[Cuts]]]:
    """Alignments of groups for some sizes of the unsized symbols that they share; the first one's in several ways."""
    tables = [_table(group, assumed, check) for group in groups]
    others: list[Cuts] = []
    for table in tables[1:]:
        cuts = next(_ways(table), None)
        if cuts is None:
            return
        others.append(cuts)
    for first in _ways(tables[0]):
        priced = _priced(tables, [first, *others])
        if priced is not None:
            yield priced, tables, [first, *others]


def _table(group: Group, assumed: Mapping[str, float], check: Callable[[], None] | None) -> Table:
    table = Table(group, check)
    table.assume(assumed)
    return table


def _priced(tables: Sequence[Table], cuts: Sequence[Cuts]) -> Priced | None:
    structure: list[Columns] = []
    for table, own in zip(tables, cuts, strict=True):
        columns = table.structure(own)
        if columns is None:
            return None
        structure.append(columns)
    return price([table.group for table in tables], tuple(structure))


def _ways(table: Table) -> Iterator[Cuts]:
    """Columns that no sweep makes cheaper, from several beginnings."""
    for cuts in table.starts():
        cost = inf
        while True:
            cuts = _settled(table, cuts)
            now = table.cost(cuts)
            if now >= cost - EPS:
                break
            cost = now
            yield cuts
            cuts = table.again(cuts)


def _changed(
    tables: Sequence[Table], cuts: Sequence[Cuts], check: Callable[[], None] | None
) -> Iterator[tuple[list[Cuts], Priced]]:
    """Alignments that differ in one of the groups: first by two columns joined, then by a run of letters elsewhere."""
    for way in (_with_joined, _with_one_elsewhere):
        for g, (table, own) in enumerate(zip(tables, cuts, strict=True)):
            for move in way(table, own):
                if check is not None:
                    check()
                changed = [*cuts[:g], move, *cuts[g + 1 :]]
                priced = _priced(tables, changed) if table.cost(move) < inf else None
                if priced is not None:
                    yield changed, priced


def _with_joined(table: Table, cuts: Cuts) -> Iterator[Cuts]:
    """Two neighbouring columns as one."""
    for j in range(1, cuts.shape[1] - 1):
        yield table.joined(table.without(cuts, j))


def _with_one_elsewhere(table: Table, cuts: Cuts) -> Iterator[Cuts]:
    """The letters that one row has in one column somewhere else."""
    wide = with_gaps(cuts)
    for b in table.order:
        for j in table.runs(wide, b):
            yield table.joined(table.laid(wide, b, elsewhere=j))


def _settled(table: Table, cuts: Cuts) -> Cuts:
    """Columns that neither a sweep nor joining them makes cheaper."""
    cuts = table.joined(cuts)
    cost = table.cost(cuts)
    for _ in range(tuning.SWEEPS):
        wide = with_gaps(cuts)
        for b in table.order:
            wide = table.laid(wide, b)
            if b in table.wild:
                wide = with_gaps(without_gaps(wide))
        wide = table.joined(wide)
        now = table.cost(wide)
        if now >= cost - EPS:
            break
        cuts, cost = wide, now
    return cuts


def _assumed(groups: Sequence[Group]) -> dict[str, float]:
    """Sizes to begin with of the unsized symbols that several letters share: they fill their rows."""
    shares: dict[str, list[float]] = {}
    for group in groups:
        for band in group.bands:
            waiting = [letter.symbol for letter in band.letters if letter.size is None]
            room = max(0.0, group.canvas - sum(letter.size or 0.0 for letter in band.letters))
            for letter in band.letters:
                if letter.size is None and not band.is_free(letter):
                    shares.setdefault(letter.symbol, []).append(room / len(waiting))
    return {symbol: median(own) for symbol, own in shares.items()}
