"""The code of what is played: the functions that do what an event tells, as text with its tokens."""

from __future__ import annotations

import inspect
import io
import keyword
import textwrap
import tokenize
from collections.abc import Callable, Mapping
from typing import Any

from ...solver import Trace
from ...solver.alignment.paper.ida import search_ida
from ...solver.alignment.pricing import price
from ...solver.alignment.reference.best_first import BestFirst
from ...solver.alignment.reference.network import Network
from ...solver.analysis.linear import Elimination
from ...solver.analysis.systems import analyse
from ...solver.assembly.shapes import find_holes, merge
from ...solver.candidates.stream import CandidateStream
from ...solver.selection.axis import AxisSearch
from ...solver.sizing.least_squares import least_squares
from ...solver.sizing.system import size_axis
from ...solver.trace.active_set import steps
from ...solver.trace.weights import refusal
from ...solver.trace.word_events import words_judged
from ...solver.words.enumeration import axis_words
from .timeline import begun

__all__ = ["code"]

_STAGES: Mapping[str, Callable[..., Any]] = {
    "analysis": analyse,
    "words": axis_words,
    "candidates": AxisSearch.best,
    "alignment": BestFirst.advance,
    "sizing": size_axis,
    "merging": merge,
}
_KINDS: Mapping[str, Callable[..., Any]] = {
    "SystemReduced": Elimination.add,
    "WordJudged": words_judged,
    "CandidateJudged": CandidateStream.take,
    "EdgeWeighed": Network.children,
    "EdgeRefused": refusal,
    "StructurePriced": price,
    "SystemSolved": least_squares,
    "ActiveSetStep": steps,
    "HoleFound": find_holes,
}
"""What is shown for an event of a kind, where its stage's function does not say it best."""


def code(trace: Trace) -> dict[str, Any]:
    """The functions behind the stages and kinds of this trace's events.

    Each has its tokens as ``[text, class]``: the class is empty, ``k`` (keyword), ``s`` (string) or ``c`` (comment).
    """
    stages = dict(_STAGES)
    if begun(trace).search == "ida":
        stages["alignment"] = search_ida
    functions = {_name(f): f for f in (*stages.values(), *_KINDS.values())}
    return {
        "stages": {stage: _name(function) for stage, function in stages.items()},
        "kinds": {kind: _name(function) for kind, function in _KINDS.items()},
        "functions": {name: _told(function) for name, function in functions.items()},
    }


def _name(function: Callable[..., Any]) -> str:
    module = function.__module__.removeprefix("facade_nb.")
    return f"{module}.{function.__qualname__}"


def _told(function: Callable[..., Any]) -> dict[str, Any]:
    lines, first = inspect.getsourcelines(function)
    module = function.__module__.replace(".", "/")
    return {
        "file": f"{module}.py",
        "line": first,
        "tokens": _tokens(textwrap.dedent("".join(lines)).rstrip()),
    }


def _tokens(text: str) -> list[list[str]]:
    """The text in pieces, each with the class of its colour."""
    lines = text.splitlines(keepends=True)
    pieces: list[list[str]] = []
    row, column = 1, 0

    def upto(end: tuple[int, int], kind: str) -> None:
        nonlocal row, column
        taken = ""
        while row < end[0]:
            taken += lines[row - 1][column:]
            row, column = row + 1, 0
        if row <= len(lines):
            taken += lines[row - 1][column : end[1]]
        column = end[1]
        if taken and pieces and pieces[-1][1] == kind:
            pieces[-1][0] += taken
        elif taken:
            pieces.append([taken, kind])

    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        kind = _class(token)
        if kind:
            upto(token.start, "")
            upto(token.end, kind)
    upto((len(lines), len(lines[-1])), "")
    return pieces


def _class(token: tokenize.TokenInfo) -> str:
    if token.type == tokenize.COMMENT:
        return "c"
    if token.type == tokenize.STRING or tokenize.tok_name[token.type].startswith("FSTRING"):
        return "s"
    return "k" if token.type == tokenize.NAME and keyword.iskeyword(token.string) else ""
