"""From the recorder's notes to events, made one after the other as they are asked for.

Axis by axis, stage by stage; `StageBegun.at` says when it really was, because the axes may take turns where a
counter ties them. The steps of one network are told together, as they happened in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from itertools import islice
from math import isfinite
from typing import Any

from ...design.model import AXES
from ..analysis.systems import Analysis
from ..events import (
    AxisPosed,
    AxisSolved,
    BoundariesPlaced,
    CandidateJudged,
    Event,
    GroupNote,
    HoleFound,
    LeftOut,
    LetterPlaced,
    NoLayoutFound,
    PairInconsistent,
    PathChosen,
    PatternNotAnalysed,
    PatternsCompared,
    ShapeMerged,
    StageBegun,
    StageEnded,
    SystemReduced,
    SystemSolved,
    TraceBegun,
    TraceEnded,
    Warned,
)
from ..model.layout import Layout
from ..model.precision import EPS
from ..model.problem import axis_problem
from .codec import from_plain
from .network_events import Walked, band_notes, column_note
from .recorder import Answer, Judged, Recorder
from .shape_events import hidden
from .sizing_events import active_set, system_posed
from .word_events import untried, words_judged

__all__ = ["tell"]

SHAPES = 20_000
"""So many hidden shapes are told."""


def tell(recorder: Recorder) -> Iterator[Event]:
    """Every event of a call of `solve`."""
    objective = {f.name: getattr(recorder.objective, f.name) for f in fields(recorder.objective)}
    yield _checked(
        TraceBegun,
        {
            "axis": "",
            "design": recorder.design.to_dict(),
            "objective": objective,
            "tolerances": recorder.tolerances,
            "search": recorder.search,
        },
    )
    if recorder.design.stack:
        for axis in AXES:
            yield from _axis(recorder, axis)
    if recorder.layout is not None:
        yield from _merged(recorder, recorder.layout)
    if recorder.error is not None:
        own = recorder.error
        yield NoLayoutFound(
            own.axis,
            own.message,
            own.patterns,
            own.symbols,
            own.counters,
            own.group,
            own.layers,
            own.constraint,
            tuple(suggestion.text for suggestion in own.suggestions),
            own.stage,
        )
    yield TraceEnded("", recorder.seconds)


def _axis(recorder: Recorder, axis: str) -> Iterator[Event]:
    posed = axis_problem(recorder.design, "x" if axis == "x" else "y")
    layers: dict[str, list[str]] = {}
    for layer in recorder.design.stack:
        layers.setdefault(layer.along(posed.axis).group, []).append(layer.name)
    groups = tuple(GroupNote(name, tuple(layers[name]), patterns) for name, patterns in posed.groups)
    yield AxisPosed(axis, posed.canvas, groups)
    candidates = _Candidates(recorder, axis)
    notes = [note for note in recorder.notes if note[1] == axis]
    last = max((n for n, note in enumerate(notes) if note[0] == "end" and note[2] == "search"), default=-1)
    for n, (kind, _, *own) in enumerate(notes):
        if kind == "begin":
            yield StageBegun(axis, own[0], own[1])
        elif kind == "analysis":
            yield from _analysis(axis, own[0])
        elif kind == "words":
            yield from words_judged(*own)
        elif kind == "candidate":
            yield candidates.event(own[0])
        elif kind == "end":
            if n == last:
                yield from candidates.rest()
                yield from _networks(recorder, axis)
            yield StageEnded(axis, own[0], own[1])
    if axis in recorder.answers:
        yield from _sized(recorder, axis, recorder.answers[axis])


def _analysis(axis: str, analysis: Analysis) -> Iterator[Event]:
    document: Mapping[str, Any] = analysis.to_dict()
    for name, reason in document["unanalysed"].items():
        yield PatternNotAnalysed(axis, name, reason)
    for number, equation in enumerate(document["equations"]):
        yield _checked(PatternsCompared, {"axis": axis, "number": number, **equation})
    for system in ("counters", "unsized"):
        own = dict(document[system])
        conflict = own.pop("inconsistent")
        yield _checked(SystemReduced, {"axis": axis, "system": system, **own})
        if conflict is not None:
            patterns = document["equations"][conflict["equation"]]["patterns"]
            yield _checked(
                PairInconsistent, {"axis": axis, "system": system, "patterns": patterns, **conflict}
            )


def _checked(kind: type[Event], plain: Mapping[str, Any]) -> Event:
    return from_plain({"event": kind.__name__, **plain}, kind.__name__)


class _Candidates:
    """The candidates of an axis, numbered as they are told."""

    def __init__(self, recorder: Recorder, axis: str) -> None:
        self.recorder, self.axis = recorder, axis
        self.answer = recorder.answers.get(axis)
        self.told: set[tuple[str, ...]] = set()
        self.number = 0
        self.found = False

    def event(self, own: Judged) -> CandidateJudged:
        words = {name: str(word) for name, word in own.candidate.words.items()}
        self.told.add(tuple(words.values()))
        self.number += 1
        fate = self._fate(own)
        self.found = self.found or fate == "best"
        return CandidateJudged(
            self.axis,
            words,
            dict(own.candidate.counters),
            own.candidate.bound,
            fate,
            own.cost,
            own.columns,
            own.deviation,
            self.number - 1,
            own.tolerance,
            own.omega,
            own.floor if isfinite(own.floor) else None,
            own.networks,
        )

    def _fate(self, own: Judged) -> str:
        answer = self.answer
        if answer is not None and own.candidate is answer.solved.candidate:
            return "best"
        if own.cost is not None:
            if self.recorder.objective.plain or answer is None:
                return "other axis"
            return "tied" if own.cost <= answer.solved.cost + EPS else "dearer"
        if own.done:
            return "no sizes" if own.unsizable else "no alignment"
        if answer is not None and (answer.complete or own.floor > answer.solved.cost + EPS):
            return "bound"
        return "stopped"

    def rest(self) -> Iterator[Event]:
        """The answer, where it was found outside the search, in haste; and candidates that were never taken up."""
        left, answer = self.recorder.left.get(self.axis, 0), self.answer
        if answer is not None and not self.found:
            solved = answer.solved
            omega = sum(priced.omegas[k] for priced, k in solved.parts)
            yield self.event(
                Judged(
                    solved.candidate, answer.tolerance, solved.candidate.bound, (), False, True,
                    solved.cost, omega, solved.columns, solved.sized.deviation,
                )
            )  # fmt: skip
            left -= left > 0
        if left:
            yield LeftOut(self.axis, "candidates", left)
        elif not self.recorder.objective.plain:
            fate = "bound" if answer is not None and answer.complete else "stopped"
            yield from untried(self.recorder, self.axis, self.told, self.number, fate)


def _networks(recorder: Recorder, axis: str) -> Iterator[Event]:
    """The networks of an axis that are told, then the paths that were chosen in them."""
    answer = recorder.answers.get(axis)
    walks = [walk for walk in recorder.walks.values() if walk.axis == axis]
    chosen = {} if answer is None else {found[0].number: found[1] for found in answer.paths if found}
    told = {w.number: Walked(w, chosen.get(w.number)) for w in walks if w.steps or w.number in chosen}
    for walked in told.values():
        yield from walked.events()
    if len(told) < len(walks):
        yield LeftOut(axis, "networks", len(walks) - len(told))
    if answer is None:
        return
    names = [name for name, _ in axis_problem(recorder.design, "x" if axis == "x" else "y").groups]
    solved = answer.solved
    for name, group, (priced, k), found in zip(names, solved.groups, solved.parts, answer.paths, strict=True):
        yield PathChosen(
            axis,
            name,
            band_notes(group),
            tuple(
                column_note(group, *own) for own in zip(priced.structure[k], priced.pieces[k], strict=True)
            ),
            priced.omegas[k],
            priced.widths[k],
            None if found is None else found[0].number,
            () if found is None or found[1] is None else told[found[0].number].chain(found[1]),
        )


def _sized(recorder: Recorder, axis: str, answer: Answer) -> Iterator[Event]:
    """The least-squares system, its solution, and where that puts every letter."""
    sized = answer.solved.sized
    seconds, times = recorder.sized.get(axis, (0.0, 0))
    yield StageBegun(axis, "sizing", _end_of_search(recorder, axis))
    yield system_posed(axis, sized.system)
    yield from active_set(axis, sized.system, sized.solution)
    yield SystemSolved(
        axis,
        tuple(sized.solution.x.tolist()),
        tuple(sized.solution.multipliers.tolist()),
        sized.placed,
        sized.deviation,
        sized.solution.iterations,
    )
    for g, (name, own) in enumerate(answer.layout.groups.items()):
        yield BoundariesPlaced(axis, name, own.columns)
        priced, k = answer.solved.parts[g]
        for i, row in enumerate(own.rows):
            b = answer.solved.groups[g].band_of[i]
            for j, element in enumerate(row.columns):
                letters = priced.structure[k][j][b].letters
                for place, (n, letter) in enumerate(zip(letters, element, strict=True)):
                    yield LetterPlaced(
                        axis, name, row.layer, row.pattern, j, place, n,
                        letter.symbol, letter.start, letter.end, letter.mirrored, letter.transparent,
                    )  # fmt: skip
    yield StageEnded(axis, "sizing", seconds, times)
    layout = answer.layout
    yield AxisSolved(axis, layout.cost, layout.gap, layout.proven, answer.complete)


def _end_of_search(recorder: Recorder, axis: str) -> float:
    begun = [note[3] for note in recorder.notes if note[:3] == ("begin", axis, "search")]
    spent = [note[3] for note in recorder.notes if note[:3] == ("end", axis, "search")]
    return begun[-1] + spent[-1] if begun and spent else 0.0


def _merged(recorder: Recorder, layout: Layout) -> Iterator[Event]:
    """Shapes, what is hidden and why, holes, warnings."""
    notes = [note for note in recorder.notes if note[1] == ""]
    for kind, _, name, seconds in notes:
        if kind == "begin":
            yield StageBegun("", name, seconds)
    for shape in layout.shapes:
        yield ShapeMerged("", *(getattr(shape, f.name) for f in fields(shape)))
    pairs = sum(
        len(layout.x.row(own.name).letters) * len(layout.y.row(own.name).letters)
        for own in recorder.design.stack
    )
    yield from islice(hidden(recorder.design, layout.x, layout.y, layout.shapes), SHAPES)
    if pairs - len(layout.shapes) > SHAPES:
        yield LeftOut("", "hidden shapes", pairs - len(layout.shapes) - SHAPES)
    for hole in layout.holes:
        yield HoleFound("", hole)
    for kind, _, name, seconds in notes:
        if kind == "end":
            yield StageEnded("", name, seconds)
    for text in layout.warnings:
        yield Warned("", text)
