"""Exact linear systems with whole and bounded unknowns, and their text (supplement 3.1).

A *form* maps variable names to coefficients; the name ``""`` is the constant. An equation is a form that is to
be 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Literal

__all__ = ["Bounds", "Elimination", "Form", "Refusal", "equation_text", "form_text", "number", "solved_text"]

Form = Mapping[str, Fraction]

Refusal = Literal["constant", "whole", "bounds"]
"""Why an equation contradicts the ones before: nothing is left of it but a constant other than 0; no whole
numbers satisfy them all; none within the bounds do."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """Where a variable may lie. None: unbounded. `above`: it is more than `low`, not equal to it."""

    low: Fraction | None = None
    high: Fraction | None = None
    above: bool = False


class Elimination:
    """Equations brought to reduced row echelon form one by one, exactly.

    An equation that contradicts those before is refused, and the others stay as they are: so the first one that is
    refused contradicts the ones before it, not a later one.

    Parameters
    ----------
    columns
        All variables; earlier ones are expressed by later ones.
    bounds
        Where each may lie.
    whole
        Those that are whole numbers. Equations between them alone are solved over the whole numbers too.
    """

    def __init__(self, columns: Sequence[str], bounds: Mapping[str, Bounds], whole: Iterable[str]) -> None:
        self.columns, self.bounds = tuple(columns), bounds
        self.rows: dict[str, dict[str, Fraction]] = {}
        """By pivot: a form with coefficient 1 at the pivot and 0 at all other pivots."""
        self.sources: dict[str, frozenset[int]] = {}
        """By pivot: numbers of the equations its row is made of."""
        self._whole = frozenset(whole)
        # All whole solutions are `_point` plus whole multiples of the vectors of `_basis`.
        self._point: dict[str, int] = dict.fromkeys(self._whole, 0)
        self._basis: list[dict[str, int]] = [{name: 1} for name in sorted(self._whole)]

    def add(self, form: Form, source: int) -> tuple[Refusal | None, frozenset[int]]:
        """Add ``form = 0``.

        Returns
        -------
        Why it is refused (None: it is not), and the numbers of the equations that take part in it.
        """
        rest = {name: value for name, value in form.items() if value}
        sources = frozenset((source,))
        for name in [name for name in rest if name in self.rows]:
            _subtract(rest, rest[name], self.rows[name])
            sources |= self.sources[name]
        pivot = next((name for name in self.columns if name in rest), None)
        if pivot is None:
            return ("constant" if rest else None), sources
        if not _reachable(form, self.bounds) or not _reachable(rest, self.bounds):
            return "bounds", sources
        lead = rest[pivot]
        row = {name: value / lead for name, value in rest.items()}
        changed = {pivot: (row, sources)}
        for other, own in self.rows.items():
            if pivot in own:
                new = dict(own)
                _subtract(new, own[pivot], row)
                changed[other] = (new, self.sources[other] | sources)
                if not _reachable(new, self.bounds):
                    return "bounds", changed[other][1]
        if all(name in self._whole for name in row if name):
            solutions = self._lattice(row)
            if solutions is None:
                whole = (self.sources[p] for p, own in self.rows.items() if self._whole.issuperset(own.keys() - {""}))
                return "whole", sources.union(*whole)
            self._point, self._basis = solutions
        for name, (new, own_sources) in changed.items():
            self.rows[name], self.sources[name] = new, own_sources
        return None, sources

    @property
    def free(self) -> tuple[str, ...]:
        """Variables that no row expresses by others."""
        return tuple(name for name in self.columns if name not in self.rows)

    @property
    def resolved(self) -> dict[str, Fraction]:
        """Variables that have one value."""
        return {p: -row.get("", Fraction(0)) for p, row in self.rows.items() if row.keys() <= {p, ""}}

    def _lattice(self, row: Form) -> tuple[dict[str, int], list[dict[str, int]]] | None:
        """The whole solutions that satisfy a row too, or None: Euclid's algorithm on the vectors of the basis."""
        scale = lcm(*(value.denominator for value in row.values()))
        weights = {name: int(value * scale) for name, value in row.items()}
        missing = -weights.pop("", 0) - sum(w * self._point[name] for name, w in weights.items())
        basis = [dict(vector) for vector in self._basis]
        along = [sum(w * vector.get(name, 0) for name, w in weights.items()) for vector in basis]
        step = gcd(*along)
        if step == 0 or missing % step:
            return None
        while len(moving := [i for i, value in enumerate(along) if value]) > 1:
            least = min(moving, key=lambda i: abs(along[i]))
            for i in moving:
                if i != least:
                    times = along[i] // along[least]
                    along[i] -= times * along[least]
                    for name, value in basis[least].items():
                        basis[i][name] = basis[i].get(name, 0) - times * value
        vector = basis.pop(moving[0])
        times = missing // along[moving[0]]
        point = {name: value + times * vector.get(name, 0) for name, value in self._point.items()}
        return point, basis


def _subtract(form: dict[str, Fraction], times: Fraction, row: Form) -> None:
    for name, value in row.items():
        new = form.get(name, 0) - times * value
        if new:
            form[name] = Fraction(new)
        else:
            form.pop(name, None)


def _reachable(form: Form, bounds: Mapping[str, Bounds]) -> bool:
    """Whether the form can be 0 with every variable within its own bounds."""
    for sign in (1, -1):
        least: Fraction = sign * form.get("", Fraction(0))
        above = False
        for name, value in form.items():
            if not name or not value:
                continue
            own = bounds[name]
            end = own.low if sign * value > 0 else own.high
            if end is None:
                break
            least += sign * value * end
            above = above or (own.above and sign * value > 0)
        else:
            if least > 0 or (above and least == 0):
                return False
    return True


def number(value: Fraction) -> str:
    """``2``, ``1.7``; ``5/3`` where decimals do not end."""
    sign = "−" if value < 0 else ""
    value = abs(value)
    places, rest = 0, value.denominator
    while places < 9 and 10**places % rest:
        places += 1
    if 10**places % rest:
        return f"{sign}{value.numerator}/{value.denominator}"
    digits = f"{value.numerator * 10**places // rest:0{places + 1}d}"
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def form_text(form: Form) -> str:
    """``1.7k − 0.1``: variables in their order in the form, the constant last; ``0`` where nothing is left."""
    parts = [(name, value) for name, value in form.items() if name and value]
    parts += [("", form[""])] if form.get("") else []
    text = ""
    for name, value in parts:
        size = number(abs(value))
        own = size if not name else name if size == "1" else f"{size} {name}" if "/" in size else size + name
        if text:
            text += f" − {own}" if value < 0 else f" + {own}"
        else:
            text = f"−{own}" if value < 0 else own
    return text or "0"


def equation_text(form: Form, leading: frozenset[str] = frozenset()) -> str:
    """``form = 0`` as a person writes it, nothing negative where that can be.

    Parameters
    ----------
    form
        Left side minus right side.
    leading
        Where some of these names are in the form, they stand alone: on the left, or negative ones on the right.
    """
    lead = {name: value for name, value in form.items() if name in leading and value}
    if lead:
        sign = 1 if any(value > 0 for value in lead.values()) else -1
        left = {name: sign * value for name, value in lead.items() if sign * value > 0}
        right = {name: -sign * value for name, value in form.items() if name not in left}
        return f"{form_text(left)} = {form_text(right)}"
    left = {name: value for name, value in form.items() if value > 0}
    right = {name: -value for name, value in form.items() if value < 0}
    if not left:
        left, right = right, left
    return f"{form_text(left)} = {form_text(right)}"


def solved_text(pivot: str, row: Form) -> str:
    """``|e| = 1.7k − 0.1``: a reduced row, solved for its pivot."""
    return f"{pivot} = " + form_text({name: -value for name, value in row.items() if name != pivot})
