"""Why words that fit the canvas cannot be aligned or sized: which qualifier, bound or tolerance forbids it."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain, islice

from ...design.errors import NoLayout, quoted
from .. import tuning
from ..analysis.systems import analyse
from ..budget import Stopped
from ..candidates.stream import CandidateStream
from ..effort import Effort
from ..model.problem import AxisProblem
from ..selection.axis import AxisSearch
from .refusal import Blame, canvas_of, is_held, names_of, refuse, remedies_of, short, tolerance
from .remedies import Remedies, relaxed

__all__ = ["aligns", "obstacle", "one_group"]

_BREAKS = {
    "C1": "not opaque, and something opaque must stand behind it",
    "C3": "unoccludable, and nothing that is not opaque may stand before it",
    "C4": "attached, and no gap may open beside it",
}


def one_group(blame: Blame, walk: AxisSearch) -> AxisSearch:
    """The search of one group alone, where there are several and that one cannot be aligned by itself."""
    problem = walk.problem
    if len(problem.groups) > 1:
        for group in problem.groups:
            patterns = tuple((n, p) for n, p in problem.patterns if n in group[1])
            own = replace(problem, groups=(group,), patterns=patterns)
            trial = AxisSearch(own, walk.objective, walk.tolerance, walk.method, walk.check)
            trial.enumerate()
            if not aligns(blame, trial):
                return trial
    return walk


def aligns(blame: Blame, walk: AxisSearch, unsure: bool = True) -> bool:
    """Whether some likely candidate of the axis aligns, whatever its counters; `unsure` if that takes too long."""
    trial = AxisSearch(
        walk.problem,
        walk.objective,
        walk.tolerance,
        walk.method,
        Effort(blame.clock.check, most=tuning.ASIDE),
        found=dict(walk.found),
    )
    try:
        stream = CandidateStream(trial.problem, trial.words(), trial.tolerance, trial.objective, trial.check)
        likely = (stream.take() for _ in range(tuning.TRIED))
        return any(c is not None and trial.solve(trial.case(c)) is not None for c in likely)
    except Stopped:
        return unsure


def obstacle(blame: Blame, walk: AxisSearch) -> NoLayout:
    """Try again without one qualifier at a time; the first that helps is to blame."""
    problem = walk.problem
    helper = remedies_of(blame, problem.axis)
    along = "across" if problem.axis == "x" else "up"
    qualifiers = [(constraint, own) for _, symbol in problem.symbols for constraint, own in relaxed(symbol)]
    helpful = [(c, own) for c, own in qualifiers if helper.sizes(own) is not None]
    if helpful:
        constraint, first = helpful[0]
        name = first.path[1]
        text = f"{quoted(name)} is {_BREAKS[constraint]}: every alignment {along} breaks that."
        standing = [n for n, p in problem.patterns if name in p.symbols]
        same = [own for c, own in helpful if c == constraint]
        others = [own for c, own in helpful if c != constraint]
        return refuse(
            blame,
            problem,
            text,
            constraint,
            [*same[:1], *others[:1], *same[1:]],
            patterns=standing,
            symbols=[name],
        )
    reason = _no_room(blame, walk, helper, along)
    if reason is not None:
        return reason
    if blame.best.unsizable:
        reason = _sizes(blame, walk, helper, along)
        if reason is not None:
            return reason
    nearest = next(walk.in_order(), None)
    words = ", ".join(f"{n} = {short(w)}" for n, w in nearest.words.items()) if nearest else ""
    advice = analyse(problem, blame.clock.check).blame("exact")
    text = (
        f"No alignment of {names_of(list(walk.found))} {along} keeps within the canvas of {problem.canvas:.4g} m and a "
        f"tolerance of {walk.tolerance:.4g} m with something opaque behind every gap."
        + (f" Nearest: {words}." if words else "")
        + (f" {advice}" if advice else "")
    )
    held = [c for c, _ in problem.counters if is_held(problem, c)]
    sizes = [word.size for word in nearest.words.values()] if nearest else []
    better = chain(
        tolerance(blame, helper),
        helper.counters(held),
        helper.canvas(sizes),
        helper.size(n for n, s in problem.symbols if s.size is not None),
    )
    return refuse(blame, problem, text, "tolerance", better, patterns=list(walk.found))


def _no_room(blame: Blame, walk: AxisSearch, helper: Remedies, along: str) -> NoLayout | None:
    """An unsized symbol that would have to be of no length: without it there is an alignment."""
    problem, end = walk.problem, blame.clock.check.seconds + tuning.ASIDE
    for name, pattern in problem.patterns:
        for symbol in sorted(pattern.placeholders):
            if problem.symbol[symbol].size is not None:
                continue
            patterns = tuple((n, p.without(symbol) if n == name else p) for n, p in problem.patterns)
            without = replace(problem, patterns=patterns)
            trial = AxisSearch(without, walk.objective, walk.tolerance, walk.method, walk.check)
            trial.enumerate()
            if blame.clock.check.seconds > end or not aligns(blame, trial, unsure=False):
                continue
            text = (
                f"There is no room for {quoted(symbol)} of pattern {quoted(name)} {along}: it would have to be of "
                "no length. Without it there is an alignment."
            )
            found = chain(
                helper.counters(c for c, _ in problem.counters if is_held(problem, c)), helper.canvas()
            )
            return refuse(blame, problem, text, "room", found, patterns=[name], symbols=[symbol])
    return None


def _sizes(blame: Blame, walk: AxisSearch, helper: Remedies, along: str) -> NoLayout | None:
    """The words can be aligned, but no sizes satisfy the alignment."""
    problem = walk.problem
    reason = _out_of_bounds(blame, walk, helper)
    if reason is not None:
        return reason
    bounded = [s for _, s in problem.symbols if s.min is not None or s.max is not None]
    better = list(islice(helper.bounds(bounded), 2))
    blamed = list(dict.fromkeys(own.path[1] for own in better))
    if blamed:
        within = ", ".join(_bounds(problem, name) for name in blamed)
        text = f"The words can be aligned {along}, but no sizes satisfy the alignment with {within}."
        constraint = "bounds"
    else:
        blamed = [s.name for s in bounded] or [n for n, s in problem.symbols if s.size is not None]
        within = ", within their min and max" if bounded else ""
        text = (
            f"The words can be aligned {along}, but no sizes satisfy all of the alignment at once: "
            f"{names_of(blamed[:6])} must each have one size everywhere{within}, and these demands contradict "
            "each other."
        )
        constraint = "bounds" if bounded else "sizes"
    held = [c for c, _ in problem.counters if is_held(problem, c)]
    found = chain(better, helper.counters(held), helper.canvas())
    patterns = [n for n, p in problem.patterns if set(blamed) & set(p.symbols)]
    return refuse(blame, problem, text, constraint, found, patterns=patterns, symbols=blamed)


def _bounds(problem: AxisProblem, name: str) -> str:
    own = problem.symbol[name]
    low, high = own.min, own.max
    parts = [
        *([f"at least {low:.4g} m"] if low is not None else []),
        *([f"at most {high:.4g} m"] if high is not None else []),
    ]
    return f"{quoted(name)} {' and '.join(parts)}"


def _out_of_bounds(blame: Blame, walk: AxisSearch, helper: Remedies) -> NoLayout | None:
    """A word that is longer than the canvas at the least sizes of its symbols, or shorter at their greatest."""
    problem, symbols = walk.problem, walk.problem.symbol
    candidate = next(walk.in_order(), None)
    for name, word in candidate.words.items() if candidate else ():
        own = [symbols[letter.symbol] for letter in word.letters]
        least = sum(s.min or 0.0 for s in own)
        greatest = None if any(s.max is None for s in own) else sum(s.max or 0.0 for s in own)
        if least > problem.canvas + 1e-9:
            text = f"{short(word)} of pattern {quoted(name)} measures at least {least:.4g} m, by the min of"
        elif own and greatest is not None and greatest < problem.canvas - 1e-9:
            text = f"{short(word)} of pattern {quoted(name)} measures at most {greatest:.4g} m, by the max of"
        else:
            continue
        bounded = {s.name: s for s in own if s.min is not None or s.max is not None}
        text += f" {names_of(list(bounded)[:6])}, and the canvas is {canvas_of(problem)}."
        better = chain(
            helper.bounds(bounded.values()),
            helper.canvas([least if least > problem.canvas else greatest or 0.0]),
        )
        return refuse(blame, problem, text, "bounds", better, patterns=[name], symbols=list(bounded))
    return None
