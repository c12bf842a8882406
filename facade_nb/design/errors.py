"""What can be wrong with a design, and how it is told.

A fault names its place, says what was expected and what was found. Errors carry all faults found, not the first.
Whatever the document, what is told of it is a few lines: names are cut in the middle, lists and faults are counted.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from difflib import get_close_matches
from heapq import nsmallest
from itertools import islice
from typing import Any

__all__ = [
    "DesignError",
    "FacadeError",
    "Fault",
    "GrammarError",
    "NoLayout",
    "PatternError",
    "Suggestion",
    "cut",
    "listed",
    "nearest",
    "quoted",
]

_NAME = 60
"""Most characters of a name in a sentence."""
_PLACE = 200
_MESSAGE = 1200
_FAULTS = 20
"""So many faults are told; `DesignError.faults` has all of them."""
_LISTED = 8
"""Most names in a list."""
_COMPARED = 100
"""A name is compared with so many others, letter by letter."""


def cut(text: str, most: int = _NAME) -> str:
    """The text, its middle left out where it is too long."""
    if len(text) <= most:
        return text
    tail = most // 3
    return f"{text[: most - tail - 1]}…{text[len(text) - tail :]}"


def quoted(name: object) -> str:
    """A name in quotation marks, cut where it is too long for a sentence."""
    return repr(cut(str(name)))


def listed(names: Iterable[object], most: int = _LISTED) -> str:
    """Names in quotation marks with commas, the first ones of many."""
    known = names if isinstance(names, Collection) else list(names)
    rest = len(known) - most
    return ", ".join(map(quoted, islice(known, most))) + (f", … and {rest:,} more" if rest > 0 else "")


class FacadeError(Exception):
    """Base of the errors that are the user's to mend. Their text is meant to be read, without a traceback."""

    def _render_traceback_(self) -> list[str]:
        """IPython asks for this: in a notebook a mistake in a design shows its message and nothing else."""
        return [f"{type(self).__name__}: {self}"]


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that is wrong.

    Attributes
    ----------
    place
        Where, as a path in the document: ``patterns.Bx``, ``layers[1].x.mask``; empty for a bare pattern text.
    message
        What was expected and what was found, in one sentence, with the nearest valid name where there is one.
    line, column
        Position inside a pattern text, from 1; None for faults outside texts.
    excerpt
        The line of the text and a caret under the place, two lines; empty for faults outside texts.
    """

    place: str
    message: str
    line: int | None = None
    column: int | None = None
    excerpt: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "place", cut(self.place, _PLACE))
        object.__setattr__(self, "message", cut(self.message, _MESSAGE))

    def __str__(self) -> str:
        where = self.place
        if self.line is not None:
            where = f"{where}, " if where else ""
            where += f"line {self.line}, column {self.column}"
        head = f"{where}: {self.message}" if where else self.message
        return f"{head}\n{self.excerpt}" if self.excerpt else head


class DesignError(FacadeError, ValueError):
    """Raised for a design, or a text in it, that cannot be read. `faults` lists every fault that was found."""

    def __init__(self, faults: Iterable[Fault] | Fault | str) -> None:
        if isinstance(faults, str):
            faults = Fault("", faults)
        self.faults: tuple[Fault, ...] = (faults,) if isinstance(faults, Fault) else tuple(faults)
        told = [str(fault) for fault in self.faults[:_FAULTS]]
        if len(self.faults) > _FAULTS:
            told.append(f"… and {len(self.faults) - _FAULTS:,} more faults")
        super().__init__("\n".join(told))


class PatternError(DesignError):
    """A pattern text that cannot be read: one fault, with line, column and caret."""

    @property
    def fault(self) -> Fault:
        """The one fault."""
        return self.faults[0]


class GrammarError(DesignError):
    """A texture grammar that cannot be used: all faults found, in the order of the text."""


@dataclass(frozen=True, slots=True)
class Suggestion:
    """A change of a design with which it has been found to work.

    Attributes
    ----------
    text
        What it would be: ``a width of 10 m``, ``counter 'k' up to 8``, ``'B' not unoccludable``.
    path
        The field to change: ``("canvas", "width")``, ``("counters", "k", "max")``, ``("symbols", "B", "opaque")``; or
        ``("tolerances",)``, an argument of `solve`.
    value
        Its new value.
    """

    text: str
    path: tuple[str, ...]
    value: Any


@dataclass(eq=False)
class NoLayout(FacadeError):
    """Raised for a valid design that has no layout, or for which none was found in time.

    Attributes
    ----------
    message
        What is to blame, in a designer's words, and a small change that works, if one was found.
    axis
        ``"x"`` or ``"y"``; empty if both axes take part.
    patterns, symbols, counters, layers
        Names of what is to blame, for a view to point at.
    group
        The alignment group that is to blame; empty if the axis has only one.
    constraint
        What cannot be kept: ``analysis`` (patterns of different length), ``canvas`` (words too long or too short),
        ``letters`` (words of too many letters), ``counters`` (no common value), ``C1``, ``C3``, ``C4``,
        ``tolerance`` (no alignment keeps within it), ``bounds`` (min and max of sizes), ``sizes`` (one size for all
        letters of a symbol), ``room`` (none is left for an unsized symbol), ``shapes`` (too many); or ``time``,
        ``memory``, ``stop``: the search was cut short.
    suggestions
        Changes that were tried and work, in the order in which the message names them.
    stage
        Which stage the search had reached when it was cut short.
    trace
        What the solver did until then, where a trace was asked for.
    """

    message: str
    axis: str = ""
    patterns: tuple[str, ...] = field(default=())
    symbols: tuple[str, ...] = field(default=())
    counters: tuple[str, ...] = field(default=())
    group: str = ""
    layers: tuple[str, ...] = field(default=())
    constraint: str = ""
    suggestions: tuple[Suggestion, ...] = field(default=())
    stage: str = ""
    trace: Any = field(default=None, repr=False)

    def __post_init__(self) -> None:
        self.message = cut(self.message, 2 * _MESSAGE)

    def __str__(self) -> str:
        return self.message

    @property
    def suggestion(self) -> Suggestion | None:
        """The first of the changes that work."""
        return self.suggestions[0] if self.suggestions else None


def nearest(name: str, valid: Iterable[str]) -> str:
    """Return ``"; did you mean 'x'?"`` for the valid name nearest to `name`, or an empty text.

    However many names there are, few are compared letter by letter: those of about the same length, the ones that
    begin alike first.
    """
    if len(name) > _NAME:
        return ""
    lower = name.lower()
    names = [own for v in valid if abs(len(own := str(v)) - len(name)) <= _NAME]
    found = next((own for own in names if own.lower() == lower), None)
    if found is None:

        def apart(own: str) -> tuple[bool, int]:
            return own[:1].lower() != lower[:1], abs(len(own) - len(name))

        few = names if len(names) <= _COMPARED else nsmallest(_COMPARED, names, key=apart)
        found = next(iter(get_close_matches(name, few, n=1, cutoff=0.5)), None)
    return "" if found is None else f"; did you mean {found!r}?"
