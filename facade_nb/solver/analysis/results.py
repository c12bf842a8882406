"""What pattern analysis finds, as frozen values, and how it is told (supplement 3.1)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Literal

from .linear import Form, Refusal, number
from .terms import Term, Variable

__all__ = [
    "STRENGTHS",
    "Analysis",
    "Conflict",
    "Equation",
    "LinearSystem",
    "Row",
    "Strength",
    "brief",
    "exact_size",
    "spelled",
    "tell",
]

Strength = Literal["binding", "exact", "preferred"]
"""How far an equation can be relied on.

- ``binding``: it holds in every layout, at the solved sizes.
- ``exact``: it does not depend on sizes, and holds where nothing is inserted and no gap opens beside either pattern.
- ``preferred``: as ``exact``, and only as far as sizes stay as preferred.
"""

STRENGTHS: tuple[Strength, ...] = ("binding", "exact", "preferred")


@dataclass(frozen=True, slots=True)
class Equation:
    """What follows from two patterns being of one length, or from a content being as long as its symbol elsewhere.

    Attributes
    ----------
    patterns
        The pair; for a content, the pattern that substitutes it first.
    prefix, suffix
        The terms both begin and both end with.
    left, right
        What is left of each.
    coefficients, constant
        Left minus right, which is to be 0: by variable; metres, or times where a common base is divided out.
    text
        ``m + 2 = l``; empty where there is no equation.
    system
        ``counters``, ``unsized``, or ``none`` where nothing follows; then `note` says why.
    strength
        How far to rely on it.
    symbol
        The substituted symbol whose extent it is about; empty for a pair of whole patterns.
    """

    patterns: tuple[str, str]
    prefix: tuple[Term, ...]
    left: tuple[Term, ...]
    right: tuple[Term, ...]
    suffix: tuple[Term, ...]
    coefficients: Form = field(default_factory=dict)
    constant: Fraction = Fraction(0)
    text: str = ""
    system: Literal["counters", "unsized", "none"] = "none"
    strength: Strength = "preferred"
    symbol: str = ""
    note: str = ""

    @property
    def form(self) -> Form:
        """Coefficients and constant in one."""
        return {**self.coefficients, "": self.constant} if self.constant else self.coefficients

    def to_dict(self) -> dict[str, Any]:
        """Plain data; numbers that are not whole become floats, `text` has them exactly."""
        return {
            "patterns": list(self.patterns),
            **{
                part: [term.to_dict() for term in getattr(self, part)]
                for part in ("prefix", "left", "right", "suffix")
            },
            "coefficients": _plain(self.coefficients),
            "constant": _plain_number(self.constant),
            "text": self.text,
            "system": self.system,
            "strength": self.strength,
            "symbol": self.symbol,
            "note": self.note,
        }


@dataclass(frozen=True, slots=True)
class Row:
    """A row of a system in reduced echelon form: its pivot by the free variables.

    `sources` are the numbers, in `Analysis.equations`, of the equations it follows from.
    """

    pivot: str
    coefficients: Form
    constant: Fraction
    text: str
    sources: tuple[int, ...]
    strength: Strength

    @property
    def form(self) -> Form:
        """Pivot minus the rest, which is 0."""
        rest = {name: -value for name, value in self.coefficients.items()}
        return {self.pivot: Fraction(1), **rest, "": -self.constant}

    def to_dict(self) -> dict[str, Any]:
        """Plain data: pivot = Σ coefficients · variables + constant."""
        return {
            "pivot": self.pivot,
            "coefficients": _plain(self.coefficients),
            "constant": _plain_number(self.constant),
            "text": self.text,
            "sources": list(self.sources),
            "strength": self.strength,
        }


@dataclass(frozen=True, slots=True)
class Conflict:
    """The first equation that contradicts the ones before, stronger ones being treated first.

    Attributes
    ----------
    equation, against
        Numbers in `Analysis.equations`: the one, and those before that it contradicts; none where it cannot hold
        by itself.
    kind
        ``constant``, ``whole`` or ``bounds``: see `Refusal`.
    strength
        The weakest of those that take part. A ``binding`` one proves that there is no layout.
    text
        A sentence for a designer.
    """

    equation: int
    against: tuple[int, ...]
    kind: Refusal
    strength: Strength
    text: str

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "equation": self.equation,
            "against": list(self.against),
            "kind": self.kind,
            "strength": self.strength,
            "text": self.text,
        }


@dataclass(frozen=True, slots=True)
class LinearSystem:
    """One of the two systems.

    Attributes
    ----------
    variables
        Counters; or sizes of unsized symbols and their products with counters, then counters as parameters.
    equations
        Numbers, in `Analysis.equations`, in the order in which they are treated.
    reduced
        The reduced rows. Those of the unsized system that hold no size are conditions on counters that follow.
    resolved, free
        Variables with one value; variables the others are expressed by.
    inconsistent
        Why there is no solution; None where there is.
    """

    variables: tuple[str, ...]
    equations: tuple[int, ...]
    reduced: tuple[Row, ...]
    resolved: Mapping[str, Fraction]
    free: tuple[str, ...]
    inconsistent: Conflict | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "variables": list(self.variables),
            "equations": list(self.equations),
            "reduced": [row.to_dict() for row in self.reduced],
            "resolved": _plain(self.resolved),
            "free": list(self.free),
            "inconsistent": self.inconsistent.to_dict() if self.inconsistent else None,
        }


@dataclass(frozen=True, slots=True)
class Analysis:
    """The result.

    Attributes
    ----------
    equations
        One for every pair of patterns, and for every content whose symbol stands in another pattern.
    counters, unsized
        The two systems.
    unanalysed
        Patterns whose length is not linear in the counters, with the reason; no more than their common ends with
        others is known.
    variables
        What the names of the systems mean.
    """

    equations: tuple[Equation, ...]
    counters: LinearSystem
    unsized: LinearSystem
    unanalysed: Mapping[str, str]
    variables: Mapping[str, Variable]

    def error(self, equation: Equation, counters: Mapping[str, int], sizes: Mapping[str, float]) -> float:
        """Left minus right for values of the counters and of the unsized symbols in it; 0: it holds."""
        exact = {name: exact_size(size) for name, size in sizes.items()}
        own = (
            value * self.variables[name].value(counters, exact)
            for name, value in equation.coefficients.items()
        )
        return float(sum(own, equation.constant))

    def conflict(self, at_least: Strength = "exact") -> Conflict | None:
        """The strongest contradiction of both systems that is at least so strong."""
        found = [system.inconsistent for system in (self.counters, self.unsized) if system.inconsistent]
        strong = [c for c in found if STRENGTHS.index(c.strength) <= STRENGTHS.index(at_least)]
        return min(strong, key=lambda c: STRENGTHS.index(c.strength), default=None)

    def blame(self, at_least: Strength = "exact") -> str | None:
        """A sentence that names the patterns which contradict each other, for a failure; None: none do."""
        conflict = self.conflict(at_least)
        return conflict.text if conflict else None

    def to_dict(self) -> dict[str, Any]:
        """Plain data for the trace document: whole numbers as they are, others as floats; texts are exact."""
        return {
            "equations": [equation.to_dict() for equation in self.equations],
            "counters": self.counters.to_dict(),
            "unsized": self.unsized.to_dict(),
            "unanalysed": dict(self.unanalysed),
        }


def exact_size(size: float) -> Fraction:
    """The number that a decimal text means, to a millionth where it is not smaller itself."""
    exact = Fraction(repr(float(size)))
    return exact.limit_denominator(1_000_000) or exact


def tell(
    equations: Sequence[Equation],
    n: int,
    against: Sequence[int],
    kind: Refusal,
    strength: Strength,
    variables: Mapping[str, Variable],
) -> str:
    """The sentence of a `Conflict`: who, after which common ends, needs what, and why that cannot be."""
    equation = equations[n]
    sides = (equation.left, equation.right) if equation.left else (equation.right, equation.left)
    left, right = (brief(spelled(part)) for part in sides)
    ends = "after their common ends, " if equation.prefix or equation.suffix else ""
    head = f"{_claim(equation, strength)}: {ends}{left} "
    if not equation.coefficients:
        differ = f", and they differ by {number(abs(equation.constant))} m" if strength == "preferred" else ""
        return f"{head}stands against {right}{differ}."
    names = dict.fromkeys(name for m in sorted({n, *against}) for name in equations[m].coefficients)
    within = ", ".join(_range(variables[name]) for name in names)
    known = " and ".join(f"{equations[m].text} ({_pair(equations[m])})" for m in against)
    reason = {
        "constant": "that is impossible",
        "whole": "no whole numbers satisfy that",
        "bounds": f"that is out of reach for {within}",
    }[kind]
    return f"{head}against {right} needs {equation.text}; {f'with {known}, ' if known else ''}{reason}."


def _claim(equation: Equation, strength: Strength) -> str:
    pair = _pair(equation)
    who = f"Symbol {equation.symbol!r} in {pair}" if equation.symbol else pair[0].upper() + pair[1:]
    return (
        who
        + {
            "binding": " can never be of one length",
            "exact": " can be of one length only with gaps in one of them",
            "preferred": " can never be of one length at the preferred sizes",
        }[strength]
    )


def _pair(equation: Equation) -> str:
    return "patterns {!r} and {!r}".format(*equation.patterns)


def _range(variable: Variable) -> str:
    low, high = (
        None if end is None else number(Fraction(end)) for end in (variable.bounds.low, variable.bounds.high)
    )
    if high is not None:
        return f"{variable.name} from {low} to {high}"
    return f"{variable.name} {'>' if variable.bounds.above else '≥'} {low}"


def spelled(shown: Sequence[Term]) -> str:
    """Terms as a pattern writes them."""
    return " ".join(term.text for term in shown) or "nothing"


def brief(text: str) -> str:
    """The text, cut where it is too long for a sentence."""
    return text if len(text) <= 60 else text[:59] + "…"


def _plain(form: Mapping[str, Fraction]) -> dict[str, int | float]:
    return {name: _plain_number(value) for name, value in form.items()}


def _plain_number(value: Fraction) -> int | float:
    return int(value) if value.denominator == 1 else float(value)
