"""The rules of columns: against their words in docs/problem.md, and the sweeps' twin of them, on random columns.

The compiled search is held to the reference search, which asks the rules, in `test_compiled`; the browser's drag in
`facade_nb/widgets/test/solver/weights.test.ts`.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import pairwise
from math import inf

import numpy as np
import pytest

from facade_nb.solver import Letter
from facade_nb.solver.alignment import rules
from facade_nb.solver.alignment.elements import Option
from facade_nb.solver.alignment.group import Group
from facade_nb.solver.alignment.heuristic.placement import Table
from tests.solver.ida_cases import case_group, random_case

Cells = list[tuple[Letter, ...]]


def walk(group: Group, rng: random.Random) -> Iterator[tuple[Option, ...]]:
    """Columns that follow each other, element by element at random, until every word is read."""
    state = list(group.start)
    for _ in range(40):
        choices = [band.options(p) for band, p in zip(group.bands, state, strict=True)]
        if not all(choices) or all(p >> 3 == len(b.letters) for p, b in zip(state, group.bands, strict=True)):
            return
        column = tuple(rng.choice(own[:4]) for own in choices)
        yield column
        state = [option.target for option in column]


def cells_of(group: Group, column: tuple[Option, ...]) -> Cells:
    """The letters of each row."""
    own = [tuple(b.letters[i] for i in o.letters) for b, o in zip(group.bands, column, strict=True)]
    return [own[b] for b in group.band_of]


def broken(group: Group, cells: Cells, begins: bool, owed: bool) -> str | None:
    """What forbids a column, but for the tolerance: docs/problem.md, word for word."""
    if not any(cells):
        return "empty"
    if owed and not begins:
        return "boundary"
    opaque = any(cell and all(letter.opaque for letter in cell) for cell in cells)
    asks = any(not cell or any(not a.transparent and not a.opaque for a in cell) for cell in cells)
    if asks and not opaque and any(a.opaque for band in group.bands for a in band.letters):
        return "C1"
    for i, cell in enumerate(cells):
        if any(a.unoccludable and not a.transparent for a in cell):
            for above in cells[:i]:
                if any(not a.transparent and not a.opaque for a in above):
                    return "C3"
    return None


def cost(group: Group, cells: Cells) -> tuple[float, float]:
    """ω, and ω + empty·E + loose·Λ, of a column whose letters have sizes."""
    plain, objective = group.objective.plain, group.objective
    sizes = [sum(a.size or 0.0 for a in cell) for cell in cells]
    soft = [any(not a.transparent and not a.opaque for a in cell) for cell in cells]
    here = [i for i, cell in enumerate(cells) if cell]
    width = max(sizes[i] for i in here)
    counted = here if plain else [i for i in here if not soft[i]] or here
    omega = width - min(sizes[i] for i in counted)
    total = omega
    for i, cell in enumerate(cells):
        share = 1.0 / len(group.bands) / group.band_of.count(group.band_of[i])
        if not cell:
            total += objective.empty * share * width
        elif not cell[0].transparent:
            beside = sum(min(a.size or 0.0, b.size or 0.0) for a, b in pairwise(cell))
            total += objective.loose * share * (beside + (width - sizes[i] if soft[i] else 0.0))
    return omega, total


@pytest.mark.parametrize("seed", range(0, 600, 2))
def test_columns_keep_to_the_words(seed: int) -> None:
    group, rng = case_group(random_case(seed)), random.Random(seed)
    owed = False
    for column in walk(group, rng):
        cells = cells_of(group, column)
        found = rules.broken(group, owed, column)
        expected = broken(group, cells, any(o.begins for o in column), owed)
        if expected is not None or all(o.size is not None for o in column):
            assert found == expected or (expected is None and found == "omega")
        if expected is None and all(o.size is not None for o in column):
            total = rules.tally(group, column)
            omega, price = cost(group, cells)
            assert total.omega == pytest.approx(omega, abs=1e-9)
            assert rules.price(group, total, total.omega) == pytest.approx(price, abs=1e-9)
            assert (found == "omega") == (omega > group.tolerance + 1e-9)
            joined = rules.Tally()
            for option in column:  # in any order, and in parts
                joined = rules.Tally().plus(option, group.objective.plain).joined(joined)
            assert joined.omega == pytest.approx(total.omega, abs=1e-12)
        owed = not any(o.ends for o in column)


@pytest.mark.parametrize("seed", range(0, 900, 2))
def test_sweeps_price_as_the_rules_do(seed: int) -> None:
    group, rng = case_group(random_case(seed)), random.Random(seed)
    if group.objective.plain or any(letter.transparent for band in group.bands for letter in band.letters):
        return  # of transparent letters sweeps take the pieces to be as long as is left
    columns = list(walk(group, rng))
    if [p >> 3 for p in (o.target for o in columns[-1])] != [len(b.letters) for b in group.bands]:
        return
    table = Table(group)
    priced, width = table._columns(table.spots(columns))
    for column, own, wide in zip(columns, priced, width, strict=True):
        total = rules.tally(group, column)
        if not any(o.letters for o in column):
            expected = 0.0  # a column in which nothing stands is left out at the end
        elif rules.unbacked(group, column) or total.omega > group.tolerance + 1e-9:
            expected = inf
        else:
            expected = rules.price(group, total, total.omega)
        assert own == (expected if expected == inf else pytest.approx(expected, abs=1e-9))
        assert np.isclose(wide, total.high)
