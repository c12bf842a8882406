"""Pattern analysis: what the patterns of an axis say about counters and unsized symbols before any word is made
(supplement 3.1).

All layers span the canvas, so any two patterns are of one length. Common ends trimmed away, that is a linear
equation between counters, or between the sizes of unsized symbols with counters as parameters. Both systems are
solved exactly. How far an equation can be relied on is its `Strength`; ``docs/analysis.md`` has the reasoning.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from math import prod
from typing import Literal

from ...design.pattern import Pattern
from ..model.problem import AxisProblem
from .linear import Bounds, Elimination, Form, equation_text, form_text, primitive
from .results import (
    STRENGTHS,
    Analysis,
    Conflict,
    Equation,
    LinearSystem,
    Row,
    Strength,
    brief,
    exact_size,
    spelled,
    tell,
)
from .terms import (
    Counters,
    Exponent,
    Run,
    Runs,
    Term,
    Tricky,
    Variable,
    check_ways,
    counts,
    flatten,
    terms,
    trim,
)

__all__ = ["Analysis", "Conflict", "Equation", "LinearSystem", "Row", "Strength", "analyse", "refuted"]


def analyse(problem: AxisProblem, check: Callable[[], None] | None = None) -> Analysis:
    """Compare every pair of patterns of an axis (supplement 3.1). Never fails: what it cannot tell, it says.

    `check` is called now and then; it may raise `budget.Stopped`.
    """
    return _Analyser(problem, check).result()


def refuted(problem: AxisProblem, check: Callable[[], None] | None = None) -> Analysis | None:
    """What proves that an axis has no layout: the `binding` equations, if they contradict each other; None if not.

    That is much sooner known than all that `analyse` finds: only patterns that are sure to fill the canvas are
    compared, and few are.
    """
    return _Analyser(problem, check).proof()


@dataclass(frozen=True, slots=True)
class _Flat:
    """A pattern or a content, flattened: once for every choice of alternatives.

    `linear`: all are of one length at the preferred sizes; `sure`: whatever the sizes.
    """

    variants: list[Runs]
    linear: bool
    sure: bool


class _Analyser:
    def __init__(self, problem: AxisProblem, check: Callable[[], None] | None = None) -> None:
        self.problem, self.check = problem, check
        self.symbols = problem.symbol
        self.sizes = {n: None if s.size is None else exact_size(s.size) for n, s in problem.symbols}
        self.times = Counters(own for _, own in problem.counters)
        self.measures: dict[str, Variable] = {}
        self.factors: dict[str, tuple[str, str]] = {}
        self.unanalysed: dict[str, str] = {}
        self.flat: dict[str, _Flat] = {}
        self.contents: dict[tuple[str, str], _Flat] = {}
        for name, pattern in problem.patterns:
            self._flatten(name, pattern)
        self.equations: list[Equation] = []

    def result(self) -> Analysis:
        spans = {n: self._spans(n, pattern) for n, pattern in self.problem.patterns if n in self.flat}
        self._extents()
        for p, q in combinations(self.flat, 2):
            if self.check is not None:
                self.check()
            self._compare((p, q), self.flat[p], self.flat[q], spans[p] and spans[q])
        return self._solved()

    def proof(self) -> Analysis | None:
        """What contradicts itself among the equations that hold in every layout."""
        sure = [n for n, pattern in self.problem.patterns if n in self.flat and self._spans(n, pattern)]
        self._extents(binding=True)
        for p, q in combinations(sure, 2):
            if self.check is not None:
                self.check()
            self._compare((p, q), self.flat[p], self.flat[q], True)
        self.equations = [own for own in self.equations if own.strength == "binding"]
        found = self._solved() if self.equations else None
        return found if found is not None and found.conflict("binding") is not None else None

    def _solved(self) -> Analysis:
        """Both systems of the equations that there are."""
        variables = {**self.measures, **self.times.variables}
        met = {
            name for flat in self.flat.values() for v in flat.variants for run in v for name in run.exponent
        }
        whole = [name for name in self.times.variables if name in met]
        counters = self._system("counters", whole, variables)
        sizes = sorted(self.measures, key=lambda name: not self.measures[name].counter)
        unsized = self._system("unsized", [*sizes, *whole], variables, counters)
        return Analysis(tuple(self.equations), counters, unsized, self.unanalysed, variables)

    # Patterns into terms

    def _flatten(self, name: str, pattern: Pattern) -> None:
        try:
            contents = {own: flatten(node, self.times, {}) for own, node in pattern.substitutions}
            check_ways(prod(map(len, contents.values())))
            ways = product(*contents.values())
            chosen = (dict(zip(contents, way, strict=True)) for way in ways)
            found = [v for way in chosen for v in flatten(pattern.control, self.times, way)]
            check_ways(len(found))
        except Tricky as reason:
            self.unanalysed[name] = str(reason)
            return
        own_flat = self.flat[name] = self._gather(found)
        self.contents.update({(name, own): self._gather(each) for own, each in contents.items()})
        if not own_flat.linear:
            shown = " or ".join(sorted({spelled(terms(own)) for own in own_flat.variants}))
            self.unanalysed[name] = f"its alternatives are not of one length: {brief(shown)}"

    def _gather(self, found: Iterable[Runs]) -> _Flat:
        variants: list[Runs] = []
        for own in found:
            if own not in variants:
                variants.append(own)
        each = [counts(own) for own in variants]
        lengths = [self._length(own) for own in each] if len(each) > 1 else []
        return _Flat(
            variants,
            all(own == lengths[0] for own in lengths),
            all(own == each[0] for own in each),
        )

    def _length(self, symbols: Mapping[str, Exponent]) -> dict[str, Fraction]:
        """Metres: a linear form in counters, unsized symbols, and products of both."""
        out: dict[str, Fraction] = {}
        for symbol, exponent in symbols.items():
            size = self.sizes[symbol]
            for counter, times in exponent.items():
                name = counter if size is not None else self._measure(symbol, counter)
                out[name] = out.get(name, Fraction(0)) + times * (1 if size is None else size)
        return {name: value for name, value in out.items() if value}

    def _measure(self, symbol: str, counter: str) -> str:
        """The variable that is the size of an unsized symbol, or its product with a counter's variable."""
        name = f"{counter}·|{symbol}|" if counter else f"|{symbol}|"
        if name not in self.measures:
            if counter:
                times = self.times.variables[counter]
                self.measures[name] = Variable(name, times.counter, symbol, times.indicator)
                self.factors[name] = counter, self._measure(symbol, "")
            else:
                own = self.symbols[symbol]
                low = 0 if own.min is None else exact_size(own.min)
                high = None if own.max is None else exact_size(own.max)
                self.measures[name] = Variable(name, symbol=symbol, bounds=Bounds(low, high, above=not low))
        return name

    def _spans(self, name: str, pattern: Pattern) -> bool:
        """Whether the letters of a pattern are sure to fill the canvas without a gap, in every layout.

        No gap opens beside letters that are opaque or transparent. A row is empty in a column only where another
        row stands there with opaque letters (C1), or where no letter of the group is opaque.
        """
        if not self._closed(pattern.solids):
            return False
        surely = any(
            self.symbols[symbol].opaque
            and symbol not in pattern.placeholders
            and all(self.times.least(counts(own).get(symbol, {})) > 0 for own in self.flat[name].variants)
            for symbol in pattern.solids
            if not self.symbols[symbol].transparent
        )
        patterns = self.problem.pattern
        for _, rows in self.problem.groups:
            others = set(rows) - {name}
            solid = (self.symbols[s] for other in others for s in patterns[other].solids)
            if name in rows and (
                not others or (surely and not any(s.opaque and not s.transparent for s in solid))
            ):
                return True
        return False

    def _closed(self, symbols: Iterable[str]) -> bool:
        return all(self.symbols[symbol].opaque or self.symbols[symbol].transparent for symbol in symbols)

    # Equations

    def _extents(self, binding: bool = False) -> None:
        """A symbol that is substituted in one pattern and left standing in another has the extent of its content.

        Only where both are sure to be there: a word may have no instance of it, or an empty content.
        """
        for symbol in dict.fromkeys(symbol for _, symbol in self.contents):
            stands = [
                n for n in self.flat if all(self._certain(own, symbol) for own in self.flat[n].variants)
            ]
            fills = [n for n, own in self.contents if own == symbol and stands and self._filled(n, symbol)]
            for name in fills:
                if binding and not self._solid(name):
                    continue
                instance = _Flat([[Run(((symbol, False),), {"": 1})]], True, True)
                self._compare(
                    (name, stands[0]), instance, self.contents[name, symbol], self._solid(name), symbol
                )
            for pair in combinations([n for n in fills if not binding or self._solid(n)], 2):
                p, q = (self.contents[name, symbol] for name in pair)
                self._compare(pair, p, q, all(map(self._solid, pair)), symbol)

    def _certain(self, runs: Runs, symbol: str) -> bool:
        return self.times.least(counts(runs).get(symbol, {})) > 0

    def _filled(self, name: str, symbol: str) -> bool:
        """Whether every word of a pattern has an instance of a substituted symbol, with content."""
        control = flatten(self.problem.pattern[name].control, self.times, {})
        content = self.contents[name, symbol].variants
        return all(self._certain(own, symbol) for own in control) and all(
            any(self.times.least(run.exponent) > 0 for run in own) for own in content
        )

    def _solid(self, name: str) -> bool:
        return self._closed(self.problem.pattern[name].solids)

    def _compare(self, pair: tuple[str, str], p: _Flat, q: _Flat, bound: bool, symbol: str = "") -> None:
        """The equation of two patterns, or of two extents, that are to be of one length."""
        prefix, rests, suffix = trim([*p.variants, *q.variants])
        left, right = rests[: len(p.variants)], rests[len(p.variants) :]
        shown = (pair, terms(prefix), _shown(left), _shown(right), terms(suffix))
        if not (p.linear and q.linear):
            own = " and ".join(repr(n) for n, flat in zip(pair, (p, q), strict=True) if not flat.linear)
            self.equations.append(
                Equation(*shown, symbol=symbol, note=f"The alternatives of {own} differ in length.")
            )
            return
        net = _difference(counts(left[0]), counts(right[0]))
        form, sized = self._divided(net)
        sized = sized or not (p.sure and q.sure)
        strength: Strength = "preferred" if sized else "binding" if bound else "exact"
        if not form:
            note = "Of one length whatever the counters" + (
                ", at the preferred sizes." if sized else " and the sizes."
            )
            self.equations.append(Equation(*shown, strength=strength, symbol=symbol, note=note))
            return
        lead = frozenset(name for name in form if name in self.measures)
        text = equation_text(form, lead)
        constant = form.pop("", Fraction(0))
        system: Literal["counters", "unsized"] = "unsized" if lead else "counters"
        self.equations.append(Equation(*shown, form, constant, text, system, strength, symbol))

    def _divided(self, net: Mapping[str, Exponent]) -> tuple[dict[str, Fraction], bool]:
        """The form that has to be 0, and whether preferred sizes are in it.

        If every symbol is in excess by a multiple of the same number of times, as B and A are in (BA)^m against
        (BA)^l, that number is 0 whatever the sizes are, because sizes are positive. So is every number of times
        where all excess is on one side.
        """
        excess = list(net.values())
        if excess and all(_multiple(own, excess[0]) for own in excess):
            return _whole(excess[0]), False
        form = self._length(net)
        if all(self.sizes[symbol] is None for symbol in net):
            return _whole(form), False
        signs = {value > 0 for own in excess for value in own.values()}
        return form, len(signs) > 1

    # Systems

    def _system(
        self,
        kind: str,
        columns: Sequence[str],
        variables: Mapping[str, Variable],
        known: LinearSystem | None = None,
    ) -> LinearSystem:
        """Add the equations of a system to an elimination, the strongest first, after what is known already."""
        order = [n for n, equation in enumerate(self.equations) if equation.system == kind]
        order.sort(key=lambda n: STRENGTHS.index(self.equations[n].strength))
        elimination = Elimination(
            columns, {name: own.bounds for name, own in variables.items()}, self.times.variables
        )
        for row in known.reduced if known else ():
            elimination.add(row.form, frozenset(row.sources))
        conflict: Conflict | None = None
        for n in order:
            form, sources = self._with_values(n, known)
            refusal, sources = elimination.add(form, sources)
            if refusal and conflict is None:
                against, strength = tuple(sorted(sources - {n})), self._weakest(sources)
                text = tell(self.equations, n, against, refusal, strength, variables)
                conflict = Conflict(n, against, refusal, strength, text)
        own = set(order)
        rows = {p: row for p, row in elimination.rows.items() if elimination.sources[p] & own}
        used = {name for n in order for name in self.equations[n].coefficients}
        used |= {name for row in rows.values() for name in row}
        shown = columns if known is None else [name for name in columns if name in used]
        return LinearSystem(
            tuple(shown),
            tuple(order),
            tuple(self._row(pivot, row, columns, elimination.sources[pivot]) for pivot, row in rows.items()),
            {pivot: value for pivot, value in elimination.resolved.items() if pivot in rows},
            tuple(name for name in elimination.free if name in shown),
            conflict,
        )

    def _with_values(self, n: int, known: LinearSystem | None) -> tuple[Form, frozenset[int]]:
        """The form of an equation; its products with a resolved counter as multiples of the size."""
        form, sources = self.equations[n].form, frozenset((n,))
        if known is None or not known.resolved:
            return form, sources
        out: dict[str, Fraction] = {}
        for name, value in form.items():
            counter, size = self.factors.get(name, ("", name))
            if counter in known.resolved:
                value, name = value * known.resolved[counter], size
                sources |= frozenset(next(row.sources for row in known.reduced if row.pivot == counter))
            out[name] = out.get(name, Fraction(0)) + value
        return out, sources

    def _weakest(self, sources: Iterable[int]) -> Strength:
        return STRENGTHS[max(STRENGTHS.index(self.equations[n].strength) for n in sources)]

    def _row(self, pivot: str, row: Form, columns: Sequence[str], sources: frozenset[int]) -> Row:
        rest = {name: -row[name] for name in (*columns, "") if name in row and name != pivot}
        text = f"{pivot} = {form_text(dict(sorted(rest.items(), key=lambda item: item[1] < 0)))}"
        constant = rest.pop("", Fraction(0))
        return Row(pivot, rest, constant, text, tuple(sorted(sources)), self._weakest(sources))


def _shown(variants: Sequence[Runs]) -> tuple[Term, ...]:
    """What is left of a pattern; one term for all where there is a choice."""
    ways = [terms(own) for own in variants]
    return (
        ways[0] if len(ways) == 1 else (Term("|".join(spelled(own) for own in ways).replace("nothing", "ε")),)
    )


def _difference(p: Mapping[str, Exponent], q: Mapping[str, Exponent]) -> dict[str, Exponent]:
    out: dict[str, Exponent] = {}
    for symbol in dict.fromkeys((*p, *q)):
        own, other = p.get(symbol, {}), q.get(symbol, {})
        net = {v: own.get(v, 0) - other.get(v, 0) for v in dict.fromkeys((*own, *other))}
        net = {name: value for name, value in net.items() if value}
        if net:
            out[symbol] = net
    return out


def _multiple(a: Exponent, b: Exponent) -> bool:
    """Whether one is a positive multiple of the other."""
    if a.keys() != b.keys():
        return False
    name = next(iter(b))
    return a[name] * b[name] > 0 and all(a[v] * b[name] == b[v] * a[name] for v in b)


def _whole(form: Mapping[str, Fraction | int]) -> dict[str, Fraction]:
    return {name: Fraction(value) for name, value in primitive(form).items()}
