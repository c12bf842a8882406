"""Patterns flattened into terms: letters repeated a number of times that is linear in the counters
(supplement 3.1).

``A^k c C^m c A^k; c := C`` becomes A^k C C^m C A^k and then A^k C^{m+2} A^k. This is the symbolic twin of
`facade_nb.design.tree.spellings`: the same words, with the counters left open.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import Any, NamedTuple

from ...design.model import Counter
from ...design.modes import shared
from ...design.pattern import Alt, Concat, Count, Empty, Mirror, Node, Sym
from ...design.text import spell
from .. import tuning
from .linear import Bounds, form_text

__all__ = [
    "Counters",
    "Exponent",
    "Run",
    "Runs",
    "Term",
    "Tricky",
    "Variable",
    "check_ways",
    "counts",
    "flatten",
    "terms",
    "trim",
]


Exponent = Mapping[str, int]
"""A number of times: coefficients by variable, ``""`` the constant."""


_COUNT = Bounds(0)


class Tricky(Exception):
    """Why the size of a pattern cannot be told from its counters by a linear form."""


@dataclass(frozen=True, slots=True)
class Variable:
    """An unknown of the analysis.

    Attributes
    ----------
    name
        ``k`` a counter, ``abs(k)`` one that may be negative, ``[k ≥ 1]`` 1 or 0, ``|e|`` the size of a symbol in
        metres, ``k·|e|`` a product.
    counter, symbol
        What it is made of; one may be empty.
    indicator
        Whether it says only if the counter is other than 0.
    bounds
        Where it may lie.
    """

    name: str
    counter: str = ""
    symbol: str = ""
    indicator: bool = False
    bounds: Bounds = _COUNT

    def value(self, counters: Mapping[str, int], sizes: Mapping[str, Fraction]) -> Fraction:
        """Its value for values of counters and sizes of symbols."""
        value = sizes[self.symbol] if self.symbol else Fraction(1)
        if self.counter:
            times = abs(counters[self.counter])
            value *= min(1, times) if self.indicator else times
        return value


@dataclass(frozen=True, slots=True)
class Term:
    """A part of a flattened pattern, as a view shows it.

    Attributes
    ----------
    text
        ``A``, ``C^{m+2}``, ``(BA)^k``, or ``AB|C`` where a choice is left open.
    letters
        Letters of its base, as patterns write them, mirrored ones with ``'``; empty for a choice.
    exponent
        How often the base is repeated: coefficients by variable, ``""`` the constant.
    """

    text: str
    letters: tuple[str, ...] = ()
    exponent: Exponent = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return {"text": self.text, "letters": list(self.letters), "exponent": dict(self.exponent)}


class Run(NamedTuple):
    """A base, as (symbol, mirrored) pairs, repeated. A base of several letters has an exponent with a counter."""

    letters: tuple[tuple[str, bool], ...]
    exponent: Exponent


Runs = list[Run]


class Counters:
    """Counters as variables; those with one value are numbers.

    Parameters
    ----------
    counters
        The counters of the axis.
    """

    def __init__(self, counters: Iterable[Counter]) -> None:
        self._counters = {own.name: own for own in counters}
        self.variables: dict[str, Variable] = {}
        """Those met so far, by name."""

    def times(self, count: Count) -> tuple[Exponent, int]:
        """How often a count repeats its base, and its sign: 1, −1 (the base is mirrored), 0 (it may be either)."""
        if isinstance(count.value, int):
            value = -count.value if count.negative else count.value
            return _number(abs(value)), -1 if value < 0 else 1
        own = self._counters.get(count.value) or Counter(count.value)
        low, high = (own.value, own.value) if own.value is not None else (own.min, own.max)
        turn = -1 if count.negative else 1
        if low == high:
            return _number(abs(low)), -turn if low < 0 else turn
        name = own.name if own.name.isidentifier() else f"{{{own.name}}}"
        if low >= 0:
            bounds, sign = Bounds(low, high), 1
        elif high is not None and high <= 0:
            bounds, sign = Bounds(-high, -low), -1
        else:
            bounds, sign = Bounds(0, None if high is None else max(-low, high)), 0
        name = name if sign == 1 else f"abs({name})"
        self.variables.setdefault(name, Variable(name, own.name, bounds=bounds))
        return {name: 1}, turn * sign

    def positive(self, times: Exponent) -> Exponent:
        """1 where the number of times is at least 1, else 0."""
        if not times:
            return {}
        if self.least(times) >= 1:
            return _number(1)
        (variable,) = times
        name = f"[{variable} ≥ 1]"
        unit = Bounds(0, 1)
        self.variables.setdefault(name, Variable(name, self.variables[variable].counter, "", True, unit))
        return {name: 1}

    def least(self, times: Exponent) -> int:
        """A lower bound of a number of times."""
        total = times.get("", 0)
        for name, factor in times.items():
            if name:
                end = self.variables[name].bounds.low if factor > 0 else self.variables[name].bounds.high
                if end is None:
                    return -tuning.MAX_TERMS
                total += factor * int(end)
        return total


def flatten(node: Node, counters: Counters, contents: Mapping[str, Runs]) -> list[Runs]:
    """The tree as terms, once for every way to choose its alternatives.

    Parameters
    ----------
    node
        A control or content pattern.
    counters
        Resolves counts; learns the variables that are met.
    contents
        What stands for substituted symbols.

    Raises
    ------
    Tricky
        Where the number of letters is not linear in the counters, or the pattern is too large.
    """
    match node:
        case Sym(name=name):
            return [contents[name] if name in contents else [Run(((name, False),), _number(1))]]
        case Empty():
            return [[]]
        case Concat(parts=parts):
            return _choices([flatten(part, counters, contents) for part in parts])
        case Alt(options=options):
            found: list[Runs] = []
            for option in options:
                found += (own for own in flatten(option, counters, contents) if own not in found)
                check_ways(len(found))
            return found
        case Mirror(body=body):
            return [_mirrored(own) for own in flatten(body, counters, contents)]
        case Count(body=body):
            return [_counted(own, node, counters) for own in flatten(body, counters, contents)]


def _choices(parts: Sequence[Sequence[Runs]]) -> list[Runs]:
    check_ways(max(1, *(len(own) for own in parts)))
    found: list[Runs] = [[]]
    for own in parts:
        found = [_join(before, after) for before in found for after in own]
        check_ways(len(found))
    return found


def check_ways(ways: int) -> None:
    """Refuse a pattern with too many ways to choose its alternatives (`Tricky`)."""
    if ways > tuning.MAX_VARIANTS:
        raise Tricky(f"there are more than {tuning.MAX_VARIANTS} ways to choose its alternatives")


def _counted(base: Runs, count: Count, counters: Counters) -> Runs:
    """A count of one word of its base, in any mode (the supplement's Table 1)."""
    times, sign = counters.times(count)
    if not times or not base:
        return []
    w = _mirrored(base) if sign < 0 or (sign == 0 and count.negative) else base
    v = _mirrored(w)
    if sign == 0 and shared(count.mode, 2):
        letters = _expanded(w)
        if letters[0][0] != letters[-1][0]:
            raise Tricky(
                f"counter {count.value!r} may be of either sign, and so which letter is shared at ^{count.mode}"
            )
    match count.mode:
        case "":
            return _repeated(w, times)
        case "~":
            return _repeated(_join(w, v), times)
        case "|":
            return _join(_repeated(w, times), _repeated(v, times))
        case ".":
            return _repeated(_join(w, _without_first(v, counters, count.mode)), times)
        case ":":
            pair = _join(w, _without_last(v, counters, count.mode))
            last = _join(w, v)
        case "@":
            rest = _without_first(v, counters, count.mode)
            pair = _join(w, _without_last(rest, counters, count.mode) if rest else [])
            last = _join(w, rest)
        case _:
            raise Tricky(f"what ^{count.mode} does is not known here")
    once = counters.positive(times)
    return _join(_repeated(pair, _added(times, once, -1)), _repeated(last, once))


def _repeated(runs: Runs, times: Exponent) -> Runs:
    if not times or not runs:
        return []
    if times.keys() <= {""}:
        copies = times[""]
        if len(runs) == 1:
            return [Run(runs[0].letters, {name: copies * value for name, value in runs[0].exponent.items()})]
        _check_terms(copies * len(runs))
        return _join([], runs * copies)
    letters = _expanded(runs)
    root = _root(letters)
    return [Run(root, {name: value * (len(letters) // len(root)) for name, value in times.items()})]


def _expanded(runs: Runs) -> tuple[tuple[str, bool], ...]:
    """The letters of terms without counters, one by one."""
    if any(run.exponent.keys() - {""} for run in runs):
        raise Tricky("a counter stands inside another one")
    _check_terms(sum(len(run.letters) * run.exponent[""] for run in runs))
    return tuple(letter for run in runs for letter in run.letters * run.exponent[""])


def _check_terms(terms: int) -> None:
    if terms > tuning.MAX_TERMS:
        raise Tricky(f"it has more than {tuning.MAX_TERMS:,} terms")


def _root(letters: tuple[tuple[str, bool], ...]) -> tuple[tuple[str, bool], ...]:
    """The shortest word that is repeated in a word: AB for ABAB."""
    n = len(letters)
    return next(letters[:d] for d in range(1, n + 1) if n % d == 0 and letters[:d] * (n // d) == letters)


def _mirrored(runs: Runs) -> Runs:
    return [Run(tuple((s, not flag) for s, flag in run.letters[::-1]), run.exponent) for run in runs[::-1]]


def _without_first(runs: Runs, counters: Counters, mode: str) -> Runs:
    """The terms without their first letter, which must be certain to be there."""
    first = runs[0]
    if counters.least(first.exponent) < 1:
        raise Tricky(f"which letter is shared at ^{mode} depends on a counter inside")
    fewer = _added(first.exponent, _number(1), -1)
    singles = [Run((letter,), _number(1)) for letter in first.letters[1:]]
    return _join(singles, [*([Run(first.letters, fewer)] if fewer else []), *runs[1:]])


def _without_last(runs: Runs, counters: Counters, mode: str) -> Runs:
    return _mirrored(_without_first(_mirrored(runs), counters, mode))


def _join(before: Runs, after: Runs) -> Runs:
    """One after the other; like terms that meet become one: C C^m C is C^{m+2}."""
    out = list(before)
    for run in after:
        if out and out[-1].letters == run.letters:
            run = Run(run.letters, _added(out.pop().exponent, run.exponent))
        if run.exponent:
            out.append(run)
    return out


def _number(value: int) -> Exponent:
    return {"": value} if value else {}


def _added(a: Exponent, b: Exponent, times: int = 1) -> Exponent:
    out = dict(a)
    for name, value in b.items():
        out[name] = out.get(name, 0) + times * value
    return {name: value for name, value in out.items() if value}


def counts(runs: Runs) -> dict[str, dict[str, int]]:
    """How often each symbol stands in the terms."""
    out: dict[str, dict[str, int]] = {}
    for letters, exponent in runs:
        for symbol, _ in letters:
            own = out.setdefault(symbol, {})
            for name, value in exponent.items():
                own[name] = own.get(name, 0) + value
    return {symbol: {name: value for name, value in own.items() if value} for symbol, own in out.items()}


def trim(sequences: Sequence[Runs]) -> tuple[Runs, list[Runs], Runs]:
    """The terms that all begin with, what is left of each, and the terms that all end with.

    Letters are the same where their symbols are: a mirrored instance is as large as any other.
    """
    prefix, rests = _trim_start(sequences, 1)
    suffix, rests = _trim_start([rest[::-1] for rest in rests], -1)
    return prefix, [rest[::-1] for rest in rests], suffix[::-1]


def _trim_start(sequences: Sequence[Runs], step: int) -> tuple[Runs, list[Runs]]:
    """The terms that all begin with; `step` −1: terms, not the letters in them, come last one first."""
    rests = [list(own) for own in sequences]
    common: Runs = []
    while all(rests):
        heads = [rest[0] for rest in rests]
        if any(not _alike(head.letters, heads[0].letters) for head in heads[1:]):
            break
        shared = _shared([head.exponent for head in heads])
        if not shared:
            break
        common.append(Run(heads[0].letters, shared))
        for rest, head in zip(rests, heads, strict=True):
            left = _added(head.exponent, shared, -1)
            singles = left.keys() == {""} and len(head.letters) > 1
            bases = [(letter,) for letter in head.letters[::step]] * left[""] if singles else [head.letters]
            rest[:1] = [Run(base, _number(1) if singles else left) for base in bases] if left else []
    return common, rests


def _alike(p: tuple[tuple[str, bool], ...], q: tuple[tuple[str, bool], ...]) -> bool:
    return p == q or (len(p) == len(q) and all(a[0] == b[0] for a, b in zip(p, q, strict=True)))


def _shared(exponents: Sequence[Exponent]) -> Exponent:
    """The largest number of times that is surely within each."""
    names = dict.fromkeys(name for own in exponents for name in own)
    least = {name: min(own.get(name, 0) for own in exponents) for name in names}
    least = {name: value for name, value in least.items() if value}
    return least if all(value > 0 for value in least.values()) or least in exponents else {}


def terms(runs: Runs) -> tuple[Term, ...]:
    """The terms as a view shows them."""
    out: list[Term] = []
    for letters, exponent in runs:
        spelled = tuple(_spelled(symbol, flag) for symbol, flag in letters)
        base = spelled[0] if len(spelled) == 1 else f"({''.join(spelled)})"
        out.append(Term(base + _power(exponent), spelled, dict(exponent)))
    return tuple(out)


@lru_cache(maxsize=256)
def _spelled(symbol: str, mirrored: bool) -> str:
    return spell(symbol) + ("'" if mirrored else "")


def _power(exponent: Exponent) -> str:
    if exponent.keys() == {""}:
        return "" if exponent[""] == 1 else f"^{exponent['']}"
    text = form_text({name: Fraction(value) for name, value in exponent.items()})
    text = text.replace(" + ", "+").replace(" − ", "-")
    return f"^{text}" if spell(text) == text else f"^{{{text}}}"
