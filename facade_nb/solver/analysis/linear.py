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

__all__ = [
    "Bounds",
    "Elimination",
    "Form",
    "Refusal",
    "equation_text",
    "form_text",
    "number",
    "primitive",
]

Form = Mapping[str, Fraction]

Refusal = Literal["constant", "whole", "bounds"]
"""Why an equation contradicts the ones before: nothing is left of it but a constant other than 0; no whole
numbers satisfy them all; none within the bounds do."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """Where a variable may lie. None: unbounded. `above`: it is more than `low`, not equal to it."""

    low: Fraction | int | None = None
    high: Fraction | int | None = None
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
        # Rows are kept in whole numbers without a common factor, which is much faster than in fractions.
        self._rows: dict[str, dict[str, int]] = {}
        self.sources: dict[str, frozenset[int]] = {}
        """By pivot: numbers of the equations its row is made of."""
        self._whole = frozenset(whole)
        # All whole solutions are `_point` plus whole multiples of the vectors of `_basis`.
        self._point: dict[str, int] = dict.fromkeys(self._whole, 0)
        self._basis: list[dict[str, int]] = [{name: 1} for name in sorted(self._whole)]

    def add(self, form: Form, sources: frozenset[int]) -> tuple[Refusal | None, frozenset[int]]:
        """Add ``form = 0``, which follows from the equations of these numbers.

        Returns
        -------
        Why it is refused (None: it is not), and the numbers of the equations that take part in it.
        """
        row = given = primitive(form)
        for name in [name for name in given if name in self._rows]:
            row = _eliminated(row, name, self._rows[name])
            sources |= self.sources[name]
        pivot = next((name for name in self.columns if name in row), None)
        if pivot is None:
            return ("constant" if row else None), sources
        if not _reachable(given, self.bounds) or not _reachable(row, self.bounds):
            return "bounds", sources
        changed = {pivot: (row, sources)}
        for other, own in self._rows.items():
            if pivot in own:
                new = _eliminated(own, pivot, row)
                changed[other] = (new, self.sources[other] | sources)
                if not _reachable(new, self.bounds):
                    return "bounds", changed[other][1]
        if all(name in self._whole for name in row if name):
            solutions = self._lattice(row)
            if solutions is None:
                whole = (self.sources[p] for p, own in self._rows.items() if self._whole >= own.keys() - {""})
                return "whole", sources.union(*whole)
            self._point, self._basis = solutions
        for name, (new, own_sources) in changed.items():
            self._rows[name], self.sources[name] = new, own_sources
        return None, sources

    @property
    def rows(self) -> dict[str, dict[str, Fraction]]:
        """By pivot: a form with coefficient 1 at the pivot and 0 at all other pivots."""
        return {
            pivot: {name: Fraction(value, row[pivot]) for name, value in row.items()}
            for pivot, row in self._rows.items()
        }

    @property
    def free(self) -> tuple[str, ...]:
        """Variables that no row expresses by others."""
        return tuple(name for name in self.columns if name not in self._rows)

    @property
    def resolved(self) -> dict[str, Fraction]:
        """Variables that have one value."""
        return {
            pivot: Fraction(-row.get("", 0), row[pivot])
            for pivot, row in self._rows.items()
            if row.keys() <= {pivot, ""}
        }

    def _lattice(self, row: Mapping[str, int]) -> tuple[dict[str, int], list[dict[str, int]]] | None:
        """The whole solutions that satisfy a row too, or None: Euclid's algorithm on the vectors of the basis."""
        missing = -sum(value * (self._point[name] if name else 1) for name, value in row.items())
        basis = [dict(vector) for vector in self._basis]
        along = [sum(row.get(name, 0) * value for name, value in vector.items()) for vector in basis]
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


def primitive(form: Mapping[str, Fraction | int]) -> dict[str, int]:
    """The form times a positive number, in whole numbers without a common factor and without zeros."""
    kept = {name: value for name, value in form.items() if value}
    scale = lcm(*(value.denominator for value in kept.values()))
    whole = {name: value.numerator * (scale // value.denominator) for name, value in kept.items()}
    factor = gcd(*whole.values())
    return {name: value // factor for name, value in whole.items()} if factor > 1 else whole


def _eliminated(form: Mapping[str, int], pivot: str, row: Mapping[str, int]) -> dict[str, int]:
    """A positive multiple of the form, without the pivot."""
    up, down = row[pivot], form[pivot]
    if up < 0:
        up, down = -up, -down
    out = {name: up * value for name, value in form.items()}
    for name, value in row.items():
        out[name] = out.get(name, 0) - down * value
    return primitive(out)


def _reachable(form: Mapping[str, int], bounds: Mapping[str, Bounds]) -> bool:
    """Whether the form can be 0 with every variable within its own bounds."""
    for sign in (1, -1):
        least: Fraction | int = 0
        above = False
        for name, value in form.items():
            if not name:
                least += sign * value
                continue
            own = bounds[name]
            end = own.low if sign * value > 0 else own.high
            if end is None:
                break
            if end:
                least += sign * value * end
            above = above or (own.above and sign * value > 0)
        else:
            if least > 0 or (above and least == 0):
                return False
    return True


def number(value: Fraction) -> str:
    """``2``, ``1.7``; ``5/3`` where decimals do not end."""
    sign = "−" if value.numerator < 0 else ""
    whole, rest = abs(value.numerator), value.denominator
    if rest == 1:
        return f"{sign}{whole}"
    places = next((n for n in range(1, 10) if 10**n % rest == 0), 0)
    if not places:
        return f"{sign}{whole}/{rest}"
    digits = f"{whole * 10**places // rest:0{places + 1}d}"
    return f"{sign}{digits[:-places]}.{digits[-places:]}"


def form_text(form: Form) -> str:
    """``1.7k − 0.1``: variables in their order in the form, the constant last; ``0`` where nothing is left."""
    parts = [(name, value) for name, value in form.items() if name and value]
    parts += [("", form[""])] if form.get("") else []
    text = ""
    for name, value in parts:
        size = number(value).removeprefix("−")
        blank = " " if "/" in size or (len(name) > 1 and name[:2].isalpha()) else ""
        own = size if not name else name if size == "1" else f"{size}{blank}{name}"
        if text:
            text += f" − {own}" if value.numerator < 0 else f" + {own}"
        else:
            text = f"−{own}" if value.numerator < 0 else own
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
        rest = {name: -sign * value for name, value in form.items() if name not in left}
        order = sorted(rest, key=lambda name: (name not in lead, rest[name] < 0))
        return f"{form_text(left)} = {form_text({name: rest[name] for name in order})}"
    left = {name: value for name, value in form.items() if value > 0}
    right = {name: -value for name, value in form.items() if value < 0}
    if not left.keys() - {""}:
        left, right = right, left
    return f"{form_text(left)} = {form_text(right)}"
