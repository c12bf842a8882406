"""A sentence for every event: what the player says while it goes on."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ...solver import Trace
from ...solver import events as told
from ...solver.events import Event

__all__ = ["caption", "captions"]


def captions(trace: Trace) -> dict[str, Any]:
    """The sentences of all events, in their order."""
    text = [caption(event) for event in trace.events]
    if any(isinstance(event, told.NoLayoutFound) for event in trace.events) and text:
        text[-1] = text[-1].replace("All done", "It ends without a layout,")
    return {"text": text}


def caption(event: Event) -> str:
    """What an event says, in a sentence of plain text."""
    return _SAY[type(event)](event)


def _m(value: float | None) -> str:
    if value is None:
        return "–"
    return f"{0.0 if abs(value) < 1e-9 else value:.4g} m"  # nothing but rounding is left


def _values(values: Mapping[str, Any]) -> str:
    return ", ".join(f"{name} = {value:g}" for name, value in values.items())


def _posed(e: told.AxisPosed) -> str:
    way = "Horizontally" if e.axis == "x" else "Vertically"
    groups = "; ".join(f"group {g.name}: {', '.join(dict.fromkeys(g.patterns))}" for g in e.groups)
    return f"{way}, {_m(e.canvas)} to fill. {groups}."


_STAGE = {
    "analysis": "Pattern analysis: what follows from patterns being equally long.",
    "words": "Words: what each pattern can write that fits the canvas (Eq. 7).",
    "search": "Candidates: one word of each pattern, and the alignment of each.",
    "sizing": "Sizing: least squares for the sizes of all symbols.",
    "merging": "Merging: every pair of a horizontal and a vertical letter makes a shape.",
}


def _compared(e: told.PatternsCompared) -> str:
    pair = f"{e.patterns[0]} against {e.patterns[1]}"
    if e.symbol:
        pair = f"The content of {e.symbol} in {e.patterns[0]} against {e.symbol} in {e.patterns[1]}"
    return f"{pair}: {e.text}." if e.text else f"{pair}: no equation; {e.note}."


def _reduced(e: told.SystemReduced) -> str:
    name = "counters" if e.system == "counters" else "unsized symbols"
    rows = "; ".join(str(row["text"]) for row in e.reduced)
    if rows:
        return f"The system of {name}, solved: {rows}."
    return f"The system of {name}: {'nothing is left that can hold' if e.equations else 'no equation'}."


def _word(e: told.WordJudged) -> str:
    values = f" for {_values(e.counters)}" if e.counters else ""
    verdict = "kept" if e.kept else f"dropped, {e.reason}"
    return f"{e.pattern}{values}: {e.word or 'ε'}, {_m(e.size)}: {verdict}."


def _candidate(e: told.CandidateJudged) -> str:
    values = f" ({_values(e.counters)})" if e.counters else ""
    cost = f", J ≥ {_m(e.proven)} is proven" if e.cost is None else f", J = {_m(e.cost)}"
    return f"Candidate {e.number}{values}: {e.fate}{cost}."


def _network(e: told.NetworkOpened) -> str:
    words = sum(len(bands) for bands in e.bands)
    return (
        f"Network {e.network} of group {', '.join(e.names)}: {words} different words, μ = {_m(e.tolerance)}."
    )


def _raised(e: told.LimitRaised) -> str:
    proven = "" if e.bound is None else f"; J ≥ {_m(e.bound)} is proven"
    return f"A pass through network {e.network} begins, limit {_m(e.limit)}{proven}."


def _node(e: told.NodeTaken) -> str:
    way = " from the end" if e.way == "backward" else ""
    f = f"f = g + h = {_m(e.cost)[:-2]} + {_m(max(0.0, e.bound - e.cost))[:-2]} = {_m(e.bound)}"
    return f"A node is expanded{way}, {_letters(e.places)} letters read: {f}."


def _letters(places: Sequence[int]) -> str:
    return "/".join(f"{place >> 1}{'+' if place & 1 else ''}" for place in places)


def _weighed(e: told.EdgeWeighed) -> str:
    fate = "; pruned, for a path as good has come to the same node" if e.fate == "dropped" else ""
    bound = "" if e.bound is None else f", f = {_m(e.bound)}"
    return f"A column of {_count(e.column)} letters is weighed: ω = {_m(e.omega)}{bound}{fate}."


def _count(column: Sequence[Sequence[int] | None]) -> str:
    return "/".join("any" if own is None else str(len(own)) for own in column)


def _refused(e: told.EdgeRefused) -> str:
    what = "pruned" if e.constraint in told.PRUNED else "forbidden"
    return f"A column of {_count(e.column)} letters is {what}: {e.text or e.constraint}"


def _region(e: told.RegionTraced) -> str:
    return f"The tolerance region of words {e.words[0] + 1} and {e.words[1] + 1} is traced: {len(e.lower)} steps."


def _priced(e: told.StructurePriced) -> str:
    if e.cost is None:
        return f"A complete path of {e.columns} columns: no sizes keep the tolerances."
    return f"A complete path of {e.columns} columns, priced: J = {_m(e.cost)}, Ω = {_m(e.omega)}."


def _closed(e: told.NetworkClosed) -> str:
    cut = ", given up" if e.cut else ""
    return f"Network {e.network} is done after {e.nodes} nodes{cut}: J ≥ {_m(e.bound)}."


def _chosen(e: told.PathChosen) -> str:
    n = len(e.columns)
    return (
        f"The alignment of group {e.group}: {n} column{'s' * (n != 1)}, Ω = {_m(e.error)}, W = {_m(e.width)}."
    )


def _posed_system(e: told.SystemPosed) -> str:
    return f"The least-squares system: {len(e.variables)} variables, {len(e.rows)} rows."


def _active(e: told.ActiveSetStep) -> str:
    what = "sizes" if e.round == 1 else "places"
    moved = [f"{len(e.entered)} enter" if e.entered else "", f"{len(e.left)} leave" if e.left else ""]
    return (
        f"Active set, {what}, step {e.step}: {', '.join(filter(None, moved)) or 'done'}; {e.active} active."
    )


def _letter(e: told.LetterPlaced) -> str:
    return f"{e.layer}: {e.symbol} from {_m(e.start)} to {_m(e.end)}."


def _solved(e: told.AxisSolved) -> str:
    return f"Axis {e.axis} is solved: J = {_m(e.cost)}, {'proven' if e.proven else f'gap {_m(e.gap)}'}."


def _shape(e: told.ShapeMerged) -> str:
    return f"{e.layer}: {e.x} {e.y} makes a {e.kind} ({e.geometry}, {e.material})."


def _hidden(e: told.ShapeHidden) -> str:
    why = {"behind": f"behind {e.by}", "mask": f"masked along {e.by}", "hidden": "hidden by its pattern"}
    return f"{e.layer}: {e.x} {e.y} makes no shape: {why.get(e.why, e.why)}."


_SAY: Mapping[type[Event], Callable[[Any], str]] = {
    told.TraceBegun: lambda e: f"solve was asked for {e.design['name']}.",
    told.AxisPosed: _posed,
    told.StageBegun: lambda e: _STAGE[e.stage],
    told.StageEnded: lambda e: f"Done in {1000 * e.seconds:.3g} ms.",
    told.LeftOut: lambda e: f"At least {e.count} more {e.what} are not told.",
    told.PatternNotAnalysed: lambda e: f"{e.pattern} is not analysed: {e.reason}",
    told.PatternsCompared: _compared,
    told.SystemReduced: _reduced,
    told.PairInconsistent: lambda e: e.text,
    told.WordJudged: _word,
    told.CandidateJudged: _candidate,
    told.NetworkOpened: _network,
    told.LimitRaised: _raised,
    told.NodeTaken: _node,
    told.EdgeWeighed: _weighed,
    told.EdgeRefused: _refused,
    told.RegionTraced: _region,
    told.WaysMet: lambda e: f"The walks from both ends meet: J = {_m(e.cost)}, {e.columns} columns.",
    told.ControlsAligned: lambda e: f"The control words are aligned first: J = {_m(e.cost)}.",
    told.PairsMerged: lambda e: f"Pairs of words are merged: J = {_m(e.cost)}.",
    told.StructurePriced: _priced,
    told.NetworkClosed: _closed,
    told.PathChosen: _chosen,
    told.SystemPosed: _posed_system,
    told.ActiveSetStep: _active,
    told.SystemSolved: lambda e: f"Sizes are found; deviation {_m(e.deviation)}.",
    told.BoundariesPlaced: lambda e: f"Group {e.group}: {len(e.boundaries)} boundaries are placed.",
    told.LetterPlaced: _letter,
    told.AxisSolved: _solved,
    told.ShapeMerged: _shape,
    told.ShapeHidden: _hidden,
    told.HoleFound: lambda e: f"A hole: {', '.join(f'{v:.4g}' for v in e.rect)}.",
    told.Warned: lambda e: e.text,
    told.NoLayoutFound: lambda e: f"No layout: {e.message}",
    told.TraceEnded: lambda e: f"All done in {1000 * e.seconds:.3g} ms.",
}
