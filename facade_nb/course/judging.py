"""Judges that several chapters use."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import wraps
from numbers import Real
from typing import Any, TypeGuard

from ..solver.experiments import Case, experiment, weigh
from .exercises import Open

__all__ = ["Judge", "among", "cheapest", "experimental", "function", "metres", "number", "numbers"]

Judge = Callable[[object], str]


def number(right: float, wrong: str = "") -> Judge:
    """A number, within a thousandth; what is said of a wrong one."""

    def judge(answer: object) -> str:
        if not _is_number(answer):
            return f"Expected a number, found {answer!r}."
        return "" if abs(float(answer) - right) < 1e-3 else (wrong or f"It is not {answer:g}.")

    return judge


def numbers(right: Sequence[float], names: Sequence[str]) -> Judge:
    """Several numbers; it says which are wrong, and not what they are."""

    def judge(answer: object) -> str:
        if not isinstance(answer, (list, tuple)) or len(answer) != len(right):
            return f"Expected a list of {len(right)} numbers, found {answer!r}."
        for given in answer:
            if given is ...:
                raise Open("put numbers in the place of the dots.")
            if not _is_number(given):
                return f"Expected numbers, found {given!r}."
        off = [n for n, a, b in zip(names, answer, right, strict=True) if abs(float(a) - b) > 1e-3]
        return f"Look again at {', '.join(off)}." if off else ""

    return judge


def _is_number(value: object) -> TypeGuard[float]:
    return type(value) is not bool and isinstance(value, Real)


def among(right: str, choices: Sequence[str]) -> Judge:
    """One of some words."""

    def judge(answer: object) -> str:
        if answer not in choices:
            return f"Expected one of {', '.join(map(repr, choices))}; found {answer!r}."
        return "" if answer == right else f"It is not {answer!r}."

    return judge


def cheapest(case: Case, given: str) -> Judge:
    """An alignment that breaks no rule and is as cheap as can be; `given` stands in the cell already."""

    def judge(answer: object) -> str:
        if not isinstance(answer, str):
            return f"Expected an alignment as a text, such as {given!r}; found {answer!r}."
        if answer.replace(" ", "") == given.replace(" ", ""):
            raise Open("that is the alignment above. Change it.")
        weighed = weigh(case, answer)
        if weighed.faults:
            return weighed.faults[0]
        best = experiment(case).cost
        return "" if weighed.cost < best + 1e-4 else f"J is {weighed.cost:.3f} m. There is a cheaper one."

    return judge


def metres(value: object) -> str:
    """A length as it is told; whatever else it is, as it is."""
    return f"{value:.4g} m" if _is_number(value) else repr(value)


def function(judge: Callable[[Callable[..., Any]], str]) -> Judge:
    """A function, which is judged by what it returns."""

    def of(answer: object) -> str:
        if not callable(answer):
            return f"Expected a function, found {answer!r}."

        @wraps(answer)
        def asked(*about: object) -> object:
            said = answer(*about)
            if said is None or said is ...:
                raise Open("your function returns nothing; put your code in the place of the dots.")
            return said

        return judge(asked)

    return of


def experimental(judge: Callable[[Callable[..., Any]], str]) -> Judge:
    """A function that is tried in experiments, which tell its faults themselves."""

    def of(answer: object) -> str:
        if callable(answer) and _is_open(answer):
            raise Open("put your code in the place of the dots.")
        return judge(answer) if callable(answer) else f"Expected a function, found {answer!r}."

    return of


def _is_open(answer: Callable[..., Any]) -> bool:
    """Whether a function does nothing: dots alone, and perhaps a docstring."""
    code = getattr(answer, "__code__", None)
    return code is not None and not code.co_names and set(code.co_consts) <= {None, ..., answer.__doc__}
