"""Why a design has no layout, in a designer's words, with the smallest change that would work where one is found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import islice

from ..design.errors import NoLayout
from ..design.model import Axis, Design, Symbol
from .analysis import analyse
from .axis import AxisSearch, Best
from .problem import AxisProblem
from .search import Stopped

__all__ = ["explain"]

_STOPPED = "The search was stopped before any layout was found."
_EXTENT: dict[Axis, str] = {"x": "wide", "y": "high"}
_SIZE: dict[Axis, str] = {"x": "width", "y": "height"}


def explain(
    design: Design,
    walk: AxisSearch,
    best: Best,
    *,
    other: AxisSearch | None = None,
    shared: Sequence[str] = (),
) -> NoLayout:
    """The reason why `walk` found nothing. `other` is the other axis, where counters tie the two."""
    try:
        return _explain(design, walk, best, other, shared)
    except Stopped:
        return NoLayout(_STOPPED, walk.problem.axis)


def _explain(
    design: Design, walk: AxisSearch, best: Best, other: AxisSearch | None, shared: Sequence[str]
) -> NoLayout:
    problem = walk.problem
    if not best.complete:
        return NoLayout(_STOPPED, problem.axis)
    for side in (walk, *([other] if other else [])):
        proof = analyse(side.problem).blame("binding")
        if proof is not None:
            return NoLayout(proof, side.problem.axis, patterns=tuple(side.found))
        reason = _too_long(side) or _no_words(side) or _no_candidate(side)
        if reason is not None:
            return reason
    if other is not None:
        across, up = _values(walk, shared), _values(other, shared)
        if not across & up:
            names = ", ".join(repr(c) for c in shared)
            return NoLayout(
                f"Counter {names} is used both across and up, and no value of it fits both: across it can be "
                f"{_list(across)}, up {_list(up)}. Use another name on one axis, or change the canvas.",
                counters=tuple(shared),
            )
        likely = next((side for side in (walk, other) if not _aligns(side)), walk)
        return _constraint(design, likely, best)
    return _constraint(design, walk, best)


def _values(walk: AxisSearch, names: Sequence[str]) -> set[tuple[int, ...]]:
    return {tuple(c.counters[n] for n in names) for c in islice(walk.in_order(), 200)}


def _list(values: set[tuple[int, ...]]) -> str:
    shown = ", ".join("/".join(map(str, v)) for v in sorted(values)[:8])
    return (shown + (", …" if len(values) > 8 else "")) or "nothing"


def _aligns(walk: AxisSearch) -> bool:
    """Whether some likely candidate of the axis aligns, whatever its counters."""
    trial = walk.restricted({})
    likely = (trial.stream.take() for _ in range(8)) if trial.stream else ()
    return any(c is not None and trial.solve(trial.case(c)) is not None for c in likely)


def _too_long(walk: AxisSearch) -> NoLayout | None:
    problem = walk.problem
    for name, found in walk.found.items():
        if found.shortest.size > problem.canvas + walk.tolerance + 1e-9:
            return NoLayout(
                f"Pattern {name!r}: its shortest word, {_short(found.shortest)}, measures "
                f"{found.shortest.size:.4g} m, and the canvas is {_canvas(problem)}. A {_SIZE[problem.axis]} of "
                f"{found.shortest.size:.4g} m would hold it.",
                problem.axis,
                patterns=(name,),
            )
    return None


def _short(word: object) -> str:
    text = str(word)
    return text if len(text) <= 60 else text[:57] + "…"


def _no_words(walk: AxisSearch) -> NoLayout | None:
    """A pattern whose longest word cannot fill the canvas, whatever the others add."""
    problem = walk.problem
    if _any(walk):
        return None
    for name, found in walk.found.items():
        if any(letter.size is None for word in found.words for letter in word.letters):
            continue
        longest = max(found.words, key=lambda word: word.size)
        room = problem.canvas - walk.tolerance - _inserted(walk, name)
        if longest.size < room - 1e-9:
            bounded = [c for c in longest.counters if _bounded(problem, c)]
            hint = f" Counter {bounded[0]!r} would have to go further." if bounded else ""
            return NoLayout(
                f"Pattern {name!r}: its longest word, {_short(longest)}, measures {longest.size:.4g} m and cannot "
                f"fill the canvas, which is {_canvas(problem)}.{hint} A {_SIZE[problem.axis]} of "
                f"{longest.size:.4g} m would be filled.",
                problem.axis,
                patterns=(name,),
                counters=tuple(bounded),
            )
    return None


def _any(walk: AxisSearch) -> bool:
    return next(walk.in_order(), None) is not None


def _bounded(problem: AxisProblem, counter: str) -> bool:
    own = dict(problem.counters).get(counter)
    return own is not None and (own.max is not None or own.value is not None)


def _inserted(walk: AxisSearch, name: str) -> float:
    """How much the opaque letters of the patterns above this one may add, in the group where they add most."""
    most = 0.0
    for _, rows in walk.problem.groups:
        if name in rows:
            above = dict.fromkeys(rows[: rows.index(name)])
            most = max(most, sum(_opaque(walk, other) for other in above if other != name))
    return most


def _opaque(walk: AxisSearch, name: str) -> float:
    words = walk.found[name].words
    return max((sum(a.size or 0.0 for a in word.letters if a.opaque) for word in words), default=0.0)


def _no_candidate(walk: AxisSearch) -> NoLayout | None:
    problem = walk.problem
    if _any(walk):
        return None
    shared = [c for c, _ in problem.counters if sum(c in p.counters for _, p in problem.patterns) > 1]
    patterns = tuple(n for n, p in problem.patterns if any(c in p.counters for c in shared)) or tuple(
        walk.found
    )
    blame = f" They share counter {', '.join(map(repr, shared))}." if shared else ""
    return NoLayout(
        f"Patterns {', '.join(map(repr, patterns))} have no words that fit the canvas of "
        f"{problem.canvas:.4g} m together.{blame} Change the canvas {_SIZE[problem.axis]}, "
        "the sizes, or the bounds of the counters.",
        problem.axis,
        patterns=patterns,
        counters=tuple(shared),
    )


def _constraint(design: Design, walk: AxisSearch, best: Best) -> NoLayout:
    """Try again without one qualifier at a time; the first that helps is to blame."""
    problem = walk.problem
    for name, symbol in problem.symbols:
        for quality, relaxed, meaning, remedy in _relaxed(symbol):
            if _solvable(walk, problem, name, relaxed):
                return NoLayout(
                    f"{name!r} is {quality}, and {meaning}: every alignment {_along(problem.axis)} breaks that. "
                    f"It would work if {name!r} were {remedy}.",
                    problem.axis,
                    symbols=(name,),
                )
    if best.unsizable:
        reason = _out_of_bounds(walk)
        if reason is not None:
            return reason
        bounded = tuple(n for n, s in problem.symbols if s.min is not None or s.max is not None)
        blamed = bounded or tuple(n for n, s in problem.symbols if s.size is not None)
        return NoLayout(
            f"The words can be aligned {_along(problem.axis)}, but no sizes satisfy all of the alignment at once: "
            f"{', '.join(map(repr, blamed[:6]))} must each have one size everywhere, within their min and max, and "
            "these demands contradict each other.",
            problem.axis,
            patterns=tuple(walk.found),
            symbols=blamed,
        )
    shortest = next(walk.in_order(), None)
    words = ""
    if shortest is not None:
        words = " Nearest: " + ", ".join(f"{n} = {_short(w)}" for n, w in shortest.words.items()) + "."
    return NoLayout(
        f"No alignment of {', '.join(map(repr, walk.found))} {_along(problem.axis)} keeps within the canvas "
        f"of {problem.canvas:.4g} m with something opaque behind every gap.{words}{_advice(problem)}",
        problem.axis,
        patterns=tuple(walk.found),
    )


def _out_of_bounds(walk: AxisSearch) -> NoLayout | None:
    """A word that is longer than the canvas at the least sizes of its symbols, or shorter at their greatest."""
    problem, symbols = walk.problem, walk.problem.symbol
    candidate = next(walk.in_order(), None)
    for name, word in candidate.words.items() if candidate else ():
        own = [symbols[letter.symbol] for letter in word.letters]
        least = sum(s.min or 0.0 for s in own)
        if least > problem.canvas + 1e-9:
            text = f"{_short(word)} of pattern {name!r} measures at least {least:.4g} m, by the min of"
        elif (
            own
            and all(s.max is not None for s in own)
            and sum(s.max or 0.0 for s in own) < problem.canvas - 1e-9
        ):
            most = sum(s.max or 0.0 for s in own)
            text = f"{_short(word)} of pattern {name!r} measures at most {most:.4g} m, by the max of"
        else:
            continue
        blamed = tuple(dict.fromkeys(s.name for s in own if s.min is not None or s.max is not None))
        names = ", ".join(map(repr, blamed[:6]))
        return NoLayout(
            f"{text} {names}, and the canvas is {_canvas(problem)}.",
            problem.axis,
            patterns=(name,),
            symbols=blamed,
        )
    return None


def _advice(problem: AxisProblem) -> str:
    """What pattern analysis finds odd."""
    blame = analyse(problem).blame("exact")
    return f" {blame}" if blame else ""


def _canvas(problem: AxisProblem) -> str:
    return f"{problem.canvas:.4g} m {_EXTENT[problem.axis]}"


def _along(axis: Axis) -> str:
    return "across" if axis == "x" else "up"


def _relaxed(symbol: Symbol) -> list[tuple[str, Symbol, str, str]]:
    out: list[tuple[str, Symbol, str, str]] = []
    if symbol.unoccludable:
        meaning = "nothing that is not opaque may stand before it"
        out.append(("unoccludable", replace(symbol, unoccludable=False), meaning, "not unoccludable"))
    if symbol.attached:
        out.append(("attached", replace(symbol, attached=False), "no gap may open beside it", "not attached"))
    if not symbol.opaque and not symbol.transparent:
        out.append(
            ("not opaque", replace(symbol, opaque=True), "something opaque must stand behind it", "opaque")
        )
    return out


def _solvable(walk: AxisSearch, problem: AxisProblem, name: str, symbol: Symbol) -> bool:
    changed = replace(problem, symbols=tuple((n, symbol if n == name else s) for n, s in problem.symbols))
    trial = AxisSearch(changed, walk.objective, walk.tolerance, walk.method, walk.check)
    trial.enumerate()
    likely = (trial.stream.take() for _ in range(8)) if trial.stream else ()
    return any(c is not None and trial.solve(trial.case(c)) is not None for c in likely)
