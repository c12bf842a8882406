"""A learner's functions: asked with care, so that a fault in one is told in a sentence, with its name and its line."""

from __future__ import annotations

import inspect
import linecache
import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from numbers import Real
from typing import Any

import numpy as np

from ...design.errors import FacadeError, cut
from .views import Choice, Column, Node, Pass

__all__ = ["ROLES", "Asked", "ExperimentError", "Functions", "Key"]

Key = tuple[float, ...]
"""By what things are put in order; the least comes first."""

ROLES = {
    "heuristic": ("node", "metres that are still to come"),
    "column_error": ("column", "metres by which the elements of a column disagree"),
    "constraint": ("column", "True where the column is allowed, False where it is not"),
    "tie_break": ("column", "a number, or a tuple of numbers; the least comes first"),
    "next_limit": ("pass", "the limit of the next pass, in metres"),
    "bound": ("candidate", "metres that the candidate costs at least"),
    "candidate_order": ("candidate", "a number, or a tuple of numbers; the least comes first"),
}
"""What each function is asked about, and what it says."""

_NO_LENGTHS = ("constraint", "tie_break", "candidate_order")


class ExperimentError(FacadeError, ValueError):
    """A learner's function cannot be used: it raised, or what it returned is not what was asked for."""


@dataclass(frozen=True, slots=True)
class Functions:
    """What a learner puts in the place of the product's own. None leaves that as it is. `ROLES` has the terms."""

    heuristic: Callable[[Node], Any] | None = None
    column_error: Callable[[Column], Any] | None = None
    constraint: Callable[[Column], Any] | None = None
    tie_break: Callable[[Column], Any] | None = None
    next_limit: Callable[[Pass], Any] | None = None
    bound: Callable[[Choice], Any] | None = None
    candidate_order: Callable[[Choice], Any] | None = None

    def __post_init__(self) -> None:
        for own in fields(self):
            function = getattr(self, own.name)
            if function is not None:
                _check(own.name, function)

    @property
    def own_columns(self) -> bool:
        """Whether columns cost something else, or fewer are allowed: then another answer may be the best."""
        return self.column_error is not None or self.constraint is not None

    def asked(self, role: str) -> Asked | None:
        """The function of a role, ready to be asked."""
        function = getattr(self, role)
        return None if function is None else Asked(role, function)

    @property
    def changed(self) -> tuple[str, ...]:
        """What is the learner's own: ``heuristic = nothing`` and so on."""
        given = [(own.name, getattr(self, own.name)) for own in fields(self)]
        return tuple(f"{role} = {_name(function)}" for role, function in given if function is not None)


class Asked:
    """One function of a learner, in its role."""

    def __init__(self, role: str, function: Callable[[Any], Any]) -> None:
        self.role, self.function = role, function

    def metres(self, about: object, most: float = math.inf) -> float:
        """What it says, as a length: 0 or more, and at most `most`."""
        said = self._ask(about)
        if isinstance(said, bool) or not isinstance(said, Real):
            raise self._wrong(said, about)
        value = float(said)
        if not 0.0 <= value <= most:
            raise self._wrong(value, about)
        return value

    def truth(self, about: object) -> bool:
        """What it says, as yes or no."""
        said = self._ask(about)
        if not isinstance(said, (bool, np.bool_)):
            raise self._wrong(said, about)
        return bool(said)

    def key(self, about: object) -> Key:
        """What it says, as something to put in order by."""
        said = self._ask(about)
        parts = tuple(said) if isinstance(said, (tuple, list)) else (said,)
        if not all(isinstance(own, Real) and not math.isnan(own) for own in parts):
            raise self._wrong(said, about)
        return tuple(map(float, parts))

    def _ask(self, about: object) -> object:
        try:
            return self.function(about)
        except Exception as error:  # a learner's function may raise anything
            where = _place(self.function, error)
            has = ""
            if isinstance(error, AttributeError) and error.obj is about:
                has = f" A {ROLES[self.role][0]} has {', '.join(_names(about))}."
            raise ExperimentError(
                f"{self.role} {_name(self.function)!r}{where} raised {type(error).__name__}: {cut(str(error), 200)}\n"
                f"It was asked about the {ROLES[self.role][0]} {about}.{has}"
            ) from None

    def _wrong(self, said: object, about: object) -> ExperimentError:
        what, expected = ROLES[self.role]
        found = f"{cut(repr(said))}" + (
            "" if isinstance(said, (float, type(None))) else f" ({type(said).__name__})"
        )
        hint = ""
        if said is None:
            hint = " Is a return missing?"
        elif isinstance(said, float) and math.isnan(said):
            hint = " That is not a number."
        elif self.role == "constraint":
            hint = " That is neither True nor False."
        elif isinstance(said, float) and said < 0:
            hint = " That is negative."
        elif isinstance(said, float):
            hint = " That is not finite."
        return ExperimentError(
            f"{self.role} {_name(self.function)!r}{_place(self.function)} returned {found} for the {what} "
            f"{about}.{hint}\n"
            f"Expected: {expected}{'' if self.role in _NO_LENGTHS else ', 0 or more'}."
        )


def _name(function: Callable[..., Any]) -> str:
    return str(getattr(function, "__name__", None) or type(function).__name__)


def _names(about: object) -> list[str]:
    return [name for name in dir(about) if not name.startswith("_")]


def _check(role: str, function: object) -> None:
    what, expected = ROLES[role]
    if not callable(function):
        raise ExperimentError(
            f"{role}: expected a function of a {what} that returns {expected}; found {cut(repr(function))}"
        )
    try:
        inspect.signature(function).bind(None)
    except TypeError:
        raise ExperimentError(
            f"{role} {_name(function)!r}{_place(function)} does not take one argument. It is asked about a {what}, "
            f"as in def {_name(function) if _name(function).isidentifier() else role}({what}): …"
        ) from None
    except ValueError:
        pass  # built in, without a signature that could be read


def _place(function: Callable[..., Any], error: BaseException | None = None) -> str:
    """Where it stands in its cell or file: the line that raised, or its first one."""
    own = inspect.unwrap(function)
    code = getattr(own, "__code__", None) or getattr(vars(type(own)).get("__call__"), "__code__", None)
    if code is None:
        return ""
    line = code.co_firstlineno
    at = error.__traceback__ if error is not None else None
    while at is not None:
        if at.tb_frame.f_code.co_filename == code.co_filename:
            line = at.tb_lineno  # the innermost line of the same cell: a helper's, where that raised
        at = at.tb_next
    text = linecache.getline(code.co_filename, line).strip()
    return f", line {line}" + (f" ({cut(text, 80)})" if text else "") + ","
