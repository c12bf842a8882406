"""A trace as tables, one for each stage; pandas is loaded when one is asked for. ``docs/trace.md`` has the columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import TYPE_CHECKING, Any

from ..events import (
    PRUNED,
    ActiveSetStep,
    AxisPosed,
    BandNote,
    BoundariesPlaced,
    CandidateJudged,
    EdgeRefused,
    EdgeWeighed,
    LetterNote,
    NetworkClosed,
    NetworkOpened,
    NodeTaken,
    PairInconsistent,
    PathChosen,
    PatternsCompared,
    StageBegun,
    StageEnded,
    SystemPosed,
    SystemSolved,
    WordJudged,
)
from ..model.letters import Letter
from ..model.sizing import FREE

if TYPE_CHECKING:
    import pandas as pd

    from .trace import Trace

__all__ = [
    "active_set",
    "analysis",
    "candidates",
    "edges",
    "equations",
    "nodes",
    "path",
    "rest_of",
    "timings",
    "words",
]

_Row = dict[str, Any]


def _frame(rows: Sequence[Mapping[str, Any]], columns: Sequence[str]) -> pd.DataFrame:
    """A table with these columns first, whatever else the rows have behind them."""
    import pandas as pd

    more = dict.fromkeys(key for row in rows for key in row if key not in columns)
    return pd.DataFrame([dict(row) for row in rows], columns=[*columns, *more])


def analysis(trace: Trace) -> pd.DataFrame:
    """Pairs of patterns, or contents and their symbols; `left` and `right`: what the common ends leave of each."""
    bad = {(e.axis, e.equation): e.text for e in trace.of_kind(PairInconsistent)}
    rows: list[_Row] = []
    for e in trace.of_kind(PatternsCompared):
        row: _Row = {name: getattr(e, name) for name in _ANALYSIS if hasattr(e, name)}
        for side in ("prefix", "left", "right", "suffix"):
            row[side] = " ".join(str(term["text"]) for term in getattr(e, side)) or "ε"
        row["equation"] = e.text
        row["inconsistent"] = bad.get((e.axis, e.number), "")
        rows.append(row)
    return _frame(rows, _ANALYSIS)


_ANALYSIS = (
    "axis", "number", "patterns", "symbol", "prefix", "left", "right", "suffix", "equation", "system", "strength",
    "inconsistent", "note",
)  # fmt: skip


def words(trace: Trace) -> pd.DataFrame:
    """Words, kept and dropped; a column ``counter.k`` for each counter k."""
    rows: list[_Row] = []
    for e in trace.of_kind(WordJudged):
        row: _Row = {name: getattr(e, name) for name in _WORDS}
        rows.append({**row, **_counters(e.counters)})
    return _frame(rows, _WORDS)


_WORDS = ("axis", "pattern", "word", "size", "low", "high", "kept", "reason", "tolerance", "choices")


def _counters(values: Mapping[str, int]) -> _Row:
    return {f"counter.{name}": value for name, value in values.items()}


def candidates(trace: Trace) -> pd.DataFrame:
    """Candidates; a column ``word.P`` for each pattern P, ``counter.k`` for each counter k."""
    rows: list[_Row] = []
    for e in trace.of_kind(CandidateJudged):
        row: _Row = {name: getattr(e, name) for name in _CANDIDATES}
        row.update({f"word.{name}": word for name, word in e.words.items()})
        rows.append({**row, **_counters(e.counters)})
    return _frame(rows, _CANDIDATES)


_CANDIDATES = (
    "axis", "number", "fate", "cost", "omega", "columns", "deviation", "bound", "floor", "tolerance", "networks",
)  # fmt: skip


def _bands(trace: Trace) -> dict[tuple[str, int], tuple[tuple[BandNote, ...], ...]]:
    return {(e.axis, e.network): e.bands for e in trace.of_kind(NetworkOpened)}


def _spelled(letters: Sequence[LetterNote]) -> str:
    spelled = (str(Letter(a.symbol, a.size, mirrored=a.mirrored)) for a in letters)
    return " ".join(spelled)


def rest_of(band: BandNote, place: int) -> str:
    """The suffix of a word that is still to come at a place; ``…`` before a letter that is cut and begun."""
    rest = _spelled(band.letters[place >> 1 :])
    return f"…{rest}" if place & 1 else rest or "ε"


def nodes(trace: Trace) -> pd.DataFrame:
    """Nodes in the order in which they were taken up; `rests`: what is still to come of each word."""
    known, rows = _bands(trace), list[_Row]()
    for e in trace.of_kind(NodeTaken):
        groups = known[e.axis, e.network]
        bands = groups[e.group] if e.group < len(groups) else ()
        row: _Row = {name: getattr(e, name) for name in _NODES if name != "rests"}
        row["rests"] = tuple(rest_of(band, place) for band, place in zip(bands, e.places, strict=True))
        rows.append(row)
    return _frame(rows, _NODES)


_NODES = ("axis", "network", "group", "places", "rests", "cost", "bound", "width", "columns", "path", "way")


def edges(trace: Trace) -> pd.DataFrame:
    """Columns that were weighed or refused; `chosen`: on the path of the alignment that was taken."""
    known, rows = _bands(trace), list[_Row]()
    chosen = _chosen(trace)
    for e in trace.events:
        if not isinstance(e, (EdgeWeighed, EdgeRefused)):
            continue
        row: _Row = {name: getattr(e, name, None) for name in _EDGES}
        row["column"] = _column(known[e.axis, e.network][e.group], e.column)
        row["chosen"] = isinstance(e, EdgeWeighed) and (
            (e.axis, e.network, e.path) in chosen
            or (e.axis, e.network, *sorted((e.places, e.after or ())), e.column) in chosen
        )
        if isinstance(e, EdgeRefused):
            row["fate"] = "pruned" if e.constraint in PRUNED else "forbidden"
        rows.append(row)
    return _frame(rows, _EDGES)


def _chosen(trace: Trace) -> set[tuple[Any, ...]]:
    """The edges of the chosen paths: by the number of the path, or where it has none by both ends and the column."""
    out: set[tuple[Any, ...]] = set()
    for e in trace.of_kind(PathChosen):
        out |= {(e.axis, e.network, n) for n in e.nodes}
        before = tuple(0 for _ in e.bands)
        for column in () if e.nodes else e.columns:
            out.add((e.axis, e.network, before, column.after, column.letters))
            before = column.after
    return out


_EDGES = (
    "axis", "network", "group", "places", "after", "column", "omega", "cost", "width", "bound", "fate", "constraint",
    "text", "chosen", "path", "parent", "way",
)  # fmt: skip


def _column(bands: Sequence[BandNote], column: Sequence[tuple[int, ...] | None]) -> str:
    """A column as text, the topmost word first: ``C/A A``; ``*`` where it may be anything."""
    elements = (
        "*" if own is None else _spelled([band.letters[i] for i in own]) or "ε"
        for band, own in zip(bands, column, strict=True)
    )
    return "/".join(elements)


def path(trace: Trace) -> pd.DataFrame:
    """The chosen alignments, one line for each element; `start` and `end` are the solved boundaries of its column."""
    posed = {(e.axis, group.name): group for e in trace.of_kind(AxisPosed) for group in e.groups}
    placed = {(e.axis, e.group): e.boundaries for e in trace.of_kind(BoundariesPlaced)}
    rows: list[_Row] = []
    for e in trace.of_kind(PathChosen):
        group, at = posed[e.axis, e.group], placed[e.axis, e.group]
        for j, column in enumerate(e.columns):
            for b, band in enumerate(e.bands):
                element = _spelled([band.letters[n] for n in column.letters[b]]) or "ε"
                for i in band.rows:
                    values = (
                        e.axis, e.group, j, i, group.layers[i], group.patterns[i], element, sum(column.sizes[b]),
                        column.width, column.omega, at[j], at[j + 1],
                    )  # fmt: skip
                    rows.append(dict(zip(_PATH, values, strict=True)))
    rows.sort(key=lambda row: (row["axis"], row["group"], row["column"], row["row"]))
    return _frame(rows, _PATH)


_PATH = (
    "axis", "group", "column", "row", "layer", "pattern", "element", "size", "width", "omega", "start", "end",
)  # fmt: skip


def equations(trace: Trace) -> pd.DataFrame:
    """The least-squares systems: a line for each bound of a variable and each row."""
    solved = {e.axis: e for e in trace.of_kind(SystemSolved)}
    rows: list[_Row] = []
    for e in trace.of_kind(SystemPosed):
        answer = solved[e.axis]
        n = len(e.variables)
        terms: list[dict[int, float]] = [{v: 1.0} for v in range(n)] + [{} for _ in e.rows]
        for r, v, coefficient in e.entries:
            terms[n + r][v] = coefficient
        for c, name in enumerate((*e.variables, *e.rows)):
            lower, upper = e.lower[c], e.upper[c]
            rows.append(
                {
                    "axis": e.axis,
                    "kind": "bound" if c < n else "equation" if lower == upper else "inequality",
                    "name": name,
                    "terms": _terms(terms[c], e.variables),
                    "lower": -inf if lower <= -FREE else lower,
                    "upper": inf if upper >= FREE else upper,
                    "value": sum(k * answer.solution[v] for v, k in terms[c].items()),
                    "placed": sum(k * answer.placed[v] for v, k in terms[c].items()),
                    "multiplier": answer.multipliers[c],
                    "active": answer.multipliers[c] != 0.0 or lower == upper,
                }
            )
    return _frame(rows, _EQUATIONS)


_EQUATIONS = (
    "axis", "kind", "name", "terms", "lower", "upper", "value", "placed", "multiplier", "active",
)  # fmt: skip


def _terms(terms: Mapping[int, float], names: Sequence[str]) -> str:
    text = ""
    for v, coefficient in terms.items():
        sign = " − " if coefficient < 0 else " + " if text else ""
        size = "" if abs(coefficient) == 1 else f"{abs(coefficient):g}·"
        text += (sign if text else sign.strip()) + size + names[v]
    return text


def active_set(trace: Trace) -> pd.DataFrame:
    """Steps of the active-set method; `entered` and `left` by their names."""
    names = {e.axis: (*e.variables, *e.rows) for e in trace.of_kind(SystemPosed)}
    rows: list[_Row] = []
    for e in trace.of_kind(ActiveSetStep):
        row: _Row = {name: getattr(e, name) for name in _ACTIVE}
        for side in ("entered", "left"):
            row[side] = tuple(names[e.axis][c] for c in row[side])
        rows.append(row)
    return _frame(rows, _ACTIVE)


_ACTIVE = ("axis", "round", "step", "entered", "left", "active", "objective", "violation")


def timings(trace: Trace) -> pd.DataFrame:
    """Seconds of each stage, and of each network that is told, which is part of the search."""
    rows: list[_Row] = []
    begun: dict[tuple[str, str], float] = {}
    for e in trace.events:
        if isinstance(e, StageBegun):
            begun[e.axis, e.stage] = e.at
        elif isinstance(e, StageEnded):
            at = begun.get((e.axis, e.stage))
            rows.append({"axis": e.axis, "stage": e.stage, "at": at, "seconds": e.seconds, "times": e.times})
        elif isinstance(e, NetworkClosed):
            stage = f"network {e.network}"
            rows.append({"axis": e.axis, "stage": stage, "seconds": e.seconds, "times": e.nodes})
    return _frame(rows, ("axis", "stage", "at", "seconds", "times"))
