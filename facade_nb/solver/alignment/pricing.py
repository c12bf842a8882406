"""What a finished structure costs: the sizes of cut pieces and unsized letters that make its J least.

A *structure* says which letters and pieces stand in which column, for every group that is searched
together. With the sizes open, J is a maximum of linear functions of them: ω_j = M_j − m_j with M_j at
least, m_j at most every size in the column; E and Λ grow with M_j; and with 0 ≤ fit < 1 both Ω + fit·(W −
canvas) and Ω + fit·(canvas − W) grow with every M_j, so that their larger one is convex and M_j sits on the
largest size at the optimum. One small linear programme gives the exact answer. Only the demand W ≥ canvas −
μ is not convex (M_j could be blown up to meet it); where it is not met by itself, we branch on which row is
the largest of a column.

Pieces may shrink to nothing in that optimum. If no equally good sizes keep every piece positive, the
structure is
*improper*: another one, without the piece, says the same. Proper structures win ties.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import inf

import numpy as np

from ..model.layout import Terms
from ..model.precision import EPS
from ..model.sums import dot
from .elements import Option
from .group import Group
from .linear_programme import FREE, solve_lp
from .rules import fills, slope, tally
from .rules import price as column_price

__all__ = ["Columns", "Priced", "Structure", "price", "terms_of"]

Columns = tuple[tuple[Option, ...], ...]
"""Per column, per band: the option taken."""
Structure = tuple[Columns, ...]
"""Per group: its columns."""

_Term = tuple[float, dict[int, float]]  # constant + Σ coefficient · variable


@dataclass(frozen=True, slots=True)
class Priced:
    """A structure with the sizes that make it cheapest.

    Attributes
    ----------
    cost, omega
        J and Ω, summed over groups.
    columns
        Number of columns, summed over groups.
    proper
        Every piece is positive.
    pieces
        Per group, per column, per band: the size of each letter or piece, metres.
    widths, omegas
        Per group: W, and Ω.
    """

    cost: float
    omega: float
    columns: int
    proper: bool
    structure: Structure
    pieces: tuple[tuple[tuple[tuple[float, ...], ...], ...], ...]
    widths: tuple[float, ...]
    omegas: tuple[float, ...]
    unsized: dict[str, float] = field(default_factory=dict)


class _Programme:
    """Variables and constraints of the linear programme, as they are met."""

    def __init__(self) -> None:
        self.cost: list[float] = []
        self.low: list[float] = []
        self.high: list[float] = []
        self.terms: list[dict[int, float]] = []
        self.bounds: list[tuple[float, float]] = []
        self.constant = 0.0
        self.pieces: list[int] = []

    def variable(self, low: float = 0.0, cost: float = 0.0) -> int:
        self.cost.append(cost)
        self.low.append(low)
        self.high.append(FREE)
        return len(self.cost) - 1

    def add(self, term: dict[int, float], low: float, high: float) -> None:
        self.terms.append(term)
        self.bounds.append((low, high))

    def solve(self, extra: Sequence[tuple[dict[int, float], float, float]] = ()) -> np.ndarray | None:
        n = len(self.cost)
        terms = [*self.terms, *(t for t, _, _ in extra)]
        rows = np.zeros((len(terms), n))
        for r, term in enumerate(terms):
            for v, coefficient in term.items():
                rows[r, v] = coefficient
        bounds = [*self.bounds, *((low, high) for _, low, high in extra)]
        lower = np.array([*self.low, *(b[0] for b in bounds)])
        upper = np.array([*self.high, *(b[1] for b in bounds)])
        return solve_lp(np.array(self.cost), rows, upper, lower)


def price(groups: Sequence[Group], structure: Structure) -> Priced | None:
    """Least J of a structure, or None where no sizes keep within the tolerances."""
    sizes = _Sizes(groups, structure)
    if not sizes.programme.cost:
        return _measure(groups, structure, sizes, None)
    programme = sizes.programme
    for g, group in enumerate(groups):
        sizes.add_columns(g, group)
    x = None if sizes.impossible else _solve_with_floor(groups, sizes, ())
    if x is None:
        return None
    priced = _measure(groups, structure, sizes, x)
    pieces = programme.pieces
    if priced is None or not pieces or min(x[p] for p in pieces) >= 1e-6:
        return priced
    spread = _spread(groups, sizes, _cost(programme, x))
    if spread is None:
        return replace(priced, proper=False)
    measured = _measure(groups, structure, sizes, spread)
    return priced if measured is None else replace(priced, pieces=measured.pieces, unsized=measured.unsized)


def _cost(programme: _Programme, x: np.ndarray) -> float:
    return dot(np.array(programme.cost), x)


class _Sizes:
    """The size of every element of a structure as constant + variables."""

    def __init__(self, groups: Sequence[Group], structure: Structure) -> None:
        self.groups = groups
        self.structure = structure
        self.programme = _Programme()
        self.unsized: dict[str, int] = {}
        self.impossible = False
        self.parts: list[list[list[list[_Term]]]] = []
        self.floors: list[dict[int, float]] = []
        self.largest: list[list[tuple[int, list[_Term]]]] = []
        for group, columns in zip(groups, structure, strict=True):
            self.parts.append(self._parts(group, columns))

    def _parts(self, group: Group, columns: Sequence[Sequence[Option]]) -> list[list[list[_Term]]]:
        programme = self.programme
        parts: list[list[list[_Term]]] = [[[] for _ in group.bands] for _ in columns]
        for b, band in enumerate(group.bands):
            stands: list[list[tuple[int, int]]] = [[] for _ in band.letters]
            for j, column in enumerate(columns):
                for k, i in enumerate(column[b].letters):
                    stands[i].append((j, k))
                    parts[j][b].append((0.0, {}))
            for i, letter in enumerate(band.letters):
                places = stands[i]
                total: _Term
                if letter.size is not None:
                    total = (letter.size, {})
                elif letter.symbol in self.unsized:
                    total = (0.0, {self.unsized[letter.symbol]: 1.0})
                else:
                    v = self.unsized[letter.symbol] = programme.variable()
                    programme.pieces.append(v)
                    total = (0.0, {v: 1.0})
                if len(places) == 1:
                    j, k = places[0]
                    parts[j][b][k] = total
                    continue
                balance = {v: -c for v, c in total[1].items()}
                for j, k in places:
                    v = programme.variable()
                    programme.pieces.append(v)
                    parts[j][b][k] = (0.0, {v: 1.0})
                    balance[v] = 1.0
                programme.add(balance, total[0], total[0])
        return parts

    def size(self, g: int, j: int, b: int) -> _Term:
        constant = 0.0
        terms: dict[int, float] = {}
        for c, t in self.parts[g][j][b]:
            constant += c
            for v, coefficient in t.items():
                terms[v] = terms.get(v, 0.0) + coefficient
        return constant, terms

    def add_columns(self, g: int, group: Group) -> None:
        """ω, E and Λ of every column, W, and the tolerances."""
        objective, programme, mu = group.objective, self.programme, group.tolerance
        width_const = 0.0
        width_terms: dict[int, float] = {}
        tops: list[tuple[int, list[_Term]]] = []
        for j, column in enumerate(self.structure[g]):
            sizes = {b: self.size(g, j, b) for b, option in enumerate(column) if not option.empty}
            elastic = any(t for _, t in sizes.values())
            empties = sum(option.empty for option in column)
            rest = [b for b in sizes if fills(group, column[b])] or list(sizes)
            softs = [b for b in sizes if column[b].soft]
            if not elastic:
                total = tally(
                    group, column, [sizes[b][0] if b in sizes else None for b in range(len(column))]
                )
                if total.omega > mu + EPS:
                    self.impossible = True
                programme.constant += column_price(group, total, total.omega)
                width_const += total.high
                continue
            high = programme.variable(-FREE, slope(group, empties, len(softs)))
            low = programme.variable(-FREE, -1.0)
            fixed_low, fixed_high = inf, -inf
            for b, (constant, terms) in sizes.items():
                if not terms:
                    fixed_high = max(fixed_high, constant)
                    if b in rest:
                        fixed_low = min(fixed_low, constant)
                    continue
                programme.add({high: 1.0, **{v: -c for v, c in terms.items()}}, constant, FREE)
                if b in rest:
                    programme.add({low: 1.0, **{v: -c for v, c in terms.items()}}, -FREE, constant)
            if fixed_high > -inf:
                programme.low[high] = fixed_high
            if fixed_low < inf:
                programme.high[low] = fixed_low
            programme.add({high: 1.0, low: -1.0}, -FREE, mu)
            for b in sizes:
                programme.constant += group.by_loose * column[b].loose
            for b in softs:
                programme.constant -= group.by_loose * sizes[b][0]
            width_terms[high] = 1.0
            tops.append((high, list(sizes.values())))
        gap = group.canvas - width_const
        if width_terms:
            programme.add(width_terms, -FREE, gap + mu)
        elif abs(gap) > mu + EPS:
            self.impossible = True
        if objective.fit:
            t = programme.variable(0.0, 1.0)
            for sign in (1.0, -1.0):
                row = {v: -sign * objective.fit * c for v, c in width_terms.items()}
                programme.add({t: 1.0, **row}, -sign * objective.fit * gap, FREE)
        self.largest.append(tops)
        self.floors.append(width_terms)

    def floor(self, g: int, group: Group, x: np.ndarray) -> tuple[float, float]:
        """(W, canvas − μ) of a group."""
        total = 0.0
        for j in range(len(self.structure[g])):
            total += max(
                _value(self.size(g, j, b), x)
                for b, option in enumerate(self.structure[g][j])
                if not option.empty
            )
        return total, group.canvas - group.tolerance


def _value(term: _Term, x: np.ndarray | None) -> float:
    constant, terms = term
    return constant if x is None else constant + sum(c * float(x[v]) for v, c in terms.items())


def _solve_with_floor(
    groups: Sequence[Group], sizes: _Sizes, pins: tuple[tuple[dict[int, float], float, float], ...]
) -> np.ndarray | None:
    """Solve; where W falls below canvas − μ, ask for more and branch on the row that is to be the largest."""
    x = sizes.programme.solve(pins)
    if x is None:
        return None
    for g, group in enumerate(groups):
        width, floor = sizes.floor(g, group, x)
        if width >= floor - 1e-8:
            continue
        asked = dict(sizes.floors[g])
        if not asked:
            return None
        const = _constant_width(sizes, g)
        demand = (asked, floor - const, FREE)
        if demand not in pins:
            pins = (*pins, demand)
            x = sizes.programme.solve(pins)
            if x is None:
                return None
            width, _ = sizes.floor(g, group, x)
            if width >= floor - 1e-8:
                return _solve_with_floor(groups, sizes, pins)
        best: np.ndarray | None = None
        for high, terms in sizes.largest[g]:
            if float(x[high]) <= max(_value(t, x) for t in terms) + 1e-9:
                continue
            for constant, linear in terms:
                pin = ({high: 1.0, **{v: -c for v, c in linear.items()}}, constant, constant)
                found = _solve_with_floor(groups, sizes, (*pins, pin))
                if found is not None and (
                    best is None or _cost(sizes.programme, found) < _cost(sizes.programme, best) - EPS
                ):
                    best = found
            return best
    return x


def _constant_width(sizes: _Sizes, g: int) -> float:
    return sum(
        max(sizes.size(g, j, b)[0] for b, option in enumerate(column) if not option.empty)
        for j, column in enumerate(sizes.structure[g])
        if not any(sizes.size(g, j, b)[1] for b, option in enumerate(column) if not option.empty)
    )


def _spread(groups: Sequence[Group], sizes: _Sizes, value: float) -> np.ndarray | None:
    """Equally good sizes with the smallest piece as large as possible; None where that is nothing."""
    programme = sizes.programme
    least = programme.variable(0.0)
    saved = programme.cost
    budget = ({v: c for v, c in enumerate(saved) if c}, -FREE, value + 1e-10)
    programme.cost = [0.0] * len(saved)
    programme.cost[least] = -1.0
    programme.high[least] = 1.0
    extra = [budget, *(({p: 1.0, least: -1.0}, 0.0, FREE) for p in programme.pieces)]
    x = programme.solve(extra)
    programme.cost = saved
    if x is None or float(x[least]) < 1e-6:
        return None
    for g, group in enumerate(groups):
        width, floor = sizes.floor(g, group, x)
        if width < floor - 1e-8:
            return None
    return x


def _measure(
    groups: Sequence[Group], structure: Structure, sizes: _Sizes, x: np.ndarray | None
) -> Priced | None:
    """Ω and J from the sizes themselves, whatever the programme said."""
    cost = omega = 0.0
    pieces: list[tuple[tuple[tuple[float, ...], ...], ...]] = []
    widths: list[float] = []
    omegas: list[float] = []
    for g, group in enumerate(groups):
        objective = group.objective
        width = group_omega = 0.0
        taken: list[tuple[tuple[float, ...], ...]] = []
        for j, column in enumerate(structure[g]):
            parts = tuple(
                tuple(max(0.0, _value(term, x)) for term in sizes.parts[g][j][b])
                for b in range(len(group.bands))
            )
            taken.append(parts)
            total = tally(group, column, [sum(own) for own in parts])
            if total.omega > group.tolerance + 1e-7:
                return None
            group_omega += total.omega
            width += total.high
            cost += column_price(group, total, total.omega)
        if abs(width - group.canvas) > group.tolerance + 1e-7:
            return None
        cost += objective.fit * abs(width - group.canvas)
        omega += group_omega
        pieces.append(tuple(taken))
        widths.append(width)
        omegas.append(group_omega)
    unsized = {} if x is None else {symbol: float(x[v]) for symbol, v in sizes.unsized.items()}
    columns = sum(len(group_columns) for group_columns in structure)
    return Priced(cost, omega, columns, True, structure, tuple(pieces), tuple(widths), tuple(omegas), unsized)


def terms_of(group: Group, columns: Columns, pieces: Sequence[Sequence[Sequence[float]]]) -> Terms:
    """What a priced group's J is made of beside Ω (docs/problem.md)."""
    empty = loose = width = 0.0
    for column, parts in zip(columns, pieces, strict=True):
        total = tally(group, column, [sum(own) for own in parts])
        empty += group.share * total.empties * total.high
        loose += group.share * (total.loose + total.softs * total.high - total.soft_sizes)
        width += total.high
    return Terms(empty, loose, abs(width - group.canvas), group.objective)
