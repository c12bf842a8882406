"""The code of what is played: the functions that do what an event tells, the line, and the values of its variables."""

from __future__ import annotations

import dataclasses
import inspect
import io
import keyword
import textwrap
import tokenize
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from ...solver import Trace
from ...solver import events as told
from ...solver.alignment.paper.bidirectional import Meeting
from ...solver.alignment.paper.deepening import Deepening
from ...solver.alignment.paper.halves import Side
from ...solver.alignment.paper.ida import search_ida
from ...solver.alignment.reference.best_first import BestFirst
from ...solver.alignment.reference.network import Network
from ...solver.analysis.linear import Elimination
from ...solver.analysis.systems import analyse
from ...solver.assembly.shapes import find_holes, merge
from ...solver.events import Event
from ...solver.selection.axis import AxisSearch
from ...solver.sizing.least_squares import least_squares
from ...solver.sizing.system import size_axis
from ...solver.trace.active_set import steps
from ...solver.trace.weights import refusal
from ...solver.trace.word_events import words_judged
from ...solver.words.enumeration import axis_words
from .timeline import begun, segments

__all__ = ["code", "places"]

_STAGES: Mapping[str, Callable[..., Any]] = {
    "analysis": analyse,
    "words": axis_words,
    "candidates": AxisSearch.best,
    "alignment": BestFirst.advance,
    "sizing": size_axis,
    "merging": merge,
}


@dataclass(frozen=True, slots=True)
class _Place:
    """Where an event comes from: a function, how its line begins, and its variables by the fields of the event."""

    function: Callable[..., Any]
    line: str = ""
    values: Mapping[str, str] | None = None


_KINDS: Mapping[str, _Place] = {
    "SystemReduced": _Place(Elimination.add),
    "WordJudged": _Place(words_judged),
    "CandidateJudged": _Place(AxisSearch.best, "solved = self._turn(case"),
    "StructurePriced": _Place(
        BestFirst.advance, "priced = price(", {"priced.cost": "cost", "priced.columns": "columns"}
    ),
    "SystemSolved": _Place(least_squares),
    "ActiveSetStep": _Place(steps),
    "HoleFound": _Place(find_holes),
}
"""What is shown for an event of a kind, where its stage's function does not say it best."""

_SEARCHES: Mapping[str, Mapping[str, _Place]] = {
    "best": {
        "LimitRaised": _Place(
            BestFirst.advance, "if not self.paused", {"limit": "limit", "found.bound": "bound"}
        ),
        "NodeTaken": _Place(
            BestFirst.advance,
            "self.log.node(item, bound)",
            {"item.state": "places", "item.cost": "cost", "bound": "bound", "item.columns": "columns"},
        ),
        "EdgeWeighed": _Place(
            BestFirst._take,
            "if not drops:",
            {"child.state": "after", "bound": "bound", "drops": "fate", "ω": "omega"},
        ),
        "EdgeRefused": _Place(refusal, "", {"constraint": "constraint", "amount": "amount"}),
        "pruned": _Place(
            Network.children,
            "for edge in found:",
            {"path.state": "places", "limit": "against", "path.cost + edge.cost": "cost", "bound": "bound"},
        ),
    },
    "ida": {
        "LimitRaised": _Place(
            Deepening._round, "meeting = Meeting(", {"self._threshold": "limit", "found.bound": "bound"}
        ),
        "NodeTaken": _Place(
            Meeting._walk,
            "self.found.nodes += 1",
            {"side.way": "way", "child.state": "places", "child.cost": "cost", "child.bound": "bound"},
        ),
        "EdgeWeighed": _Place(
            Side.onward,
            "columns, beyond = lattice.columns(",
            {"half.state": "places", "column.omega": "omega", "column.cost": "cost"},
        ),
        "EdgeRefused": _Place(refusal, "", {"constraint": "constraint", "amount": "amount"}),
        "bound": _Place(
            Side.onward,
            'self.pruned(child, "bound", limit)',
            {"half.state": "places", "child.cost": "cost", "child.bound": "bound", "limit": "against"},
        ),
        "known": _Place(
            Meeting._walk,
            'side.pruned(child, "known"',
            {"child.state": "after", "child.cost": "cost", "other.cost": "against"},
        ),
        "best": _Place(
            Meeting._walk,
            'side.pruned(child, "best"',
            {"child.bound": "bound", "self._rival": "against"},
        ),
        "length": _Place(
            Meeting._walk,
            "side.pruned(child, reason",
            {"child.bound": "bound", "self.limit": "against", "reason": "constraint"},
        ),
        "WaysMet": _Place(
            Meeting._join,
            "self.found.offer(",
            {"key": "places", "priced.cost": "cost", "priced.columns": "columns"},
        ),
    },
}
"""The same of the searches; what an edge is pruned by has a place of its own."""


def places(trace: Trace) -> Iterator[tuple[str, int, str]]:
    """For each event: the function that tells it, the line in it (0: the whole), and what its variables are."""
    own = _SEARCHES["ida" if begun(trace).search == "ida" else "best"]
    stage = "merging"
    stages = {**_STAGES, **({"alignment": search_ida} if begun(trace).search == "ida" else {})}
    for cut in segments(trace.events):
        stage = cut.stage
        for event in list(trace.events)[cut.first : cut.last + 1]:
            place = _place(event, own)
            if place is None:
                yield _name(stages[stage]), 0, _values(event, None)
            else:
                yield _name(place.function), _line(place), _values(event, place.values)


def _place(event: Event, searches: Mapping[str, _Place]) -> _Place | None:
    kind = type(event).__name__
    if isinstance(event, told.EdgeRefused) and event.constraint in told.PRUNED:
        return searches.get(event.constraint) or searches.get("pruned")
    return searches.get(kind) or _KINDS.get(kind)


@cache
def _line_of(function: Callable[..., Any], begins: str) -> int:
    lines, _ = inspect.getsourcelines(function)
    return next(n for n, text in enumerate(lines, 1) if text.strip().startswith(begins))


def _line(place: _Place) -> int:
    return _line_of(place.function, place.line) if place.line else 0


def _values(event: Event, names: Mapping[str, str] | None) -> str:
    """Variables as ``name = value``, one a line; without names, the fields of the event that are short."""
    pairs: list[tuple[str, Any]]
    if names is None:
        fields = {f.name: getattr(event, f.name) for f in dataclasses.fields(event)}
        pairs = [
            (name, value) for name, value in fields.items() if isinstance(value, (bool, int, float, str))
        ]
        pairs = [(name, value) for name, value in pairs if name not in ("axis", "at", "seconds", "text")][:8]
    else:
        pairs = [(name, getattr(event, field, None)) for name, field in names.items()]
        # that a path is overtaken comes later, and is not known where its edge is weighed
        pairs = [(name, value == "dropped" if name == "drops" else value) for name, value in pairs]
    return "\n".join(f"{name} = {_shown(value)}" for name, value in pairs if value is not None)


def _shown(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    text = str(value)
    return text if len(text) <= 60 else f"{text[:59]}…"


def code(trace: Trace) -> dict[str, Any]:
    """The functions behind a trace's events; for each event its function, the line in it, and its variables.

    Each has its tokens as ``[text, class]``: the class is empty, ``k`` (keyword), ``s`` (string) or ``c`` (comment).
    """
    found = list(places(trace))
    names = list(dict.fromkeys(name for name, _, _ in found))
    values = list(dict.fromkeys(text for _, _, text in found))
    number = {text: n for n, text in enumerate(values)}
    known = {_name(f): f for f in _functions()}
    return {
        "names": names,
        "function": np.array([names.index(name) for name, _, _ in found], np.int16),
        "line": np.array([line for _, line, _ in found], np.int16),
        "value": np.array([number[text] for _, _, text in found], np.int32),
        "values": values,
        "functions": {name: _told(known[name]) for name in names},
    }


def _functions() -> list[Callable[..., Any]]:
    searches = [place.function for own in _SEARCHES.values() for place in own.values()]
    return [*_STAGES.values(), search_ida, *(place.function for place in _KINDS.values()), *searches]


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
