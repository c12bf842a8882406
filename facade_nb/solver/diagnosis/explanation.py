"""Why a design has no layout, in a designer's words, with the smallest change that would work where one is found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, islice
from math import inf

from ...design.errors import NoLayout, Suggestion, quoted
from ...design.model import Axis, Design
from .. import tuning
from ..analysis.systems import Analysis, refuted
from ..budget import Clock, Stopped
from ..model.letters import Word
from ..model.problem import AxisProblem
from ..selection.axis import AxisSearch
from ..words.enumeration import axis_words
from ..words.instances import MAX_SPELLED, instances, next_longer
from .obstacles import aligns, obstacle, one_group
from .refusal import Blame, canvas_of, is_held, layers_of, names_of, refuse, remedies_of, short, tolerance
from .remedies import Remedies, nice, size_of

__all__ = ["explain", "ran_out"]

_SURE = ("analysis", "letters", "time", "memory", "stop")
"""What does not depend on which words there are, or says itself that some were left out."""


def explain(blame: Blame) -> NoLayout:
    """The reason why a search found nothing, and what would help."""
    clock, problem = blame.clock, blame.walk.problem
    if not blame.best.complete:
        return ran_out(blame.design, clock, [problem])
    clock.progress.at("explanation", problem.axis)
    clock.allot(1.0)
    clock.extend()
    try:
        reason = _explain(blame)
        sides = [blame.walk, *([blame.other] if blame.other else [])]
        names = [name for side in sides for name, found in side.found.items() if found.left < inf]
        if names and reason.constraint not in _SURE:
            plural = "patterns" if len(names) > 1 else "pattern"
            reason.message += f" Some words of {plural} {names_of(names)} were left out; one of them may do."
        return reason
    except Stopped:
        if clock.asked:
            return ran_out(blame.design, clock, [problem])
        text = (
            f"There is no layout; the time was over after {clock.seconds:.1f} s, before it was found out why."
        )
        return NoLayout(text, problem.axis, constraint="time", stage=clock.progress.stage)


def ran_out(design: Design, clock: Clock, problems: Sequence[AxisProblem]) -> NoLayout:
    """The search was cut short: at what, after how long, and what would help."""
    progress = clock.progress
    counters = [
        name
        for problem in problems
        for name, own in problem.counters
        if own.max is None and own.value is None and progress.axis in ("", problem.axis)
    ]
    names = tuple(dict.fromkeys(counters))
    if clock.asked:
        text, advice = f"Stopped after {clock.seconds:.1f} s", ""
    elif clock.full:
        text = f"Out of memory after {clock.seconds:.1f} s (the search has taken {tuning.MEMORY // 10**6} MB)"
        advice = " Larger letters or a smaller canvas would help"
    else:
        text = f"{'Out of time' if clock.over else 'Given up'} after {clock.seconds:.1f} s"
        advice = " A longer time limit may find one" if clock.over else " There are too many alignments"
        if names:
            advice += f"; so may a max for {'counters' if len(names) > 1 else 'counter'} {names_of(names)}"
        advice += "."
    where = f", {progress}" if str(progress) else ""
    axis = progress.axis or (problems[0].axis if len(problems) == 1 else "")
    patterns = (progress.pattern,) if progress.pattern else ()
    return NoLayout(
        f"{text}{where}; no layout yet.{advice}",
        axis,
        patterns=patterns,
        counters=() if clock.asked else names,
        group=progress.group,
        layers=layers_of(design, axis, patterns, progress.group) if patterns or progress.group else (),
        constraint="stop" if clock.asked else "memory" if clock.full else "time",
        stage=progress.stage,
    )


def _explain(blame: Blame) -> NoLayout:
    walk, other = blame.walk, blame.other
    sides = [_widely(walk), *([_widely(other)] if other else [])]
    for side in sides:
        proof = refuted(side.problem, blame.clock.check)
        helper = remedies_of(blame, side.problem.axis)
        reason = (
            _contradiction(blame, side, proof, helper)
            or _length(blame, side, helper)
            or _no_candidate(blame, side, helper)
        )
        if reason is not None:
            return reason
    if other is not None:
        found = {side.problem.axis: _values(side, blame.shared) for side in sides}
        values = {axis: own for axis, (own, _) in found.items()}
        if not values["x"] & values["y"]:
            return _tied(blame, values, all(whole for _, whole in found.values()))
        walk = next((side for side in (walk, other) if not aligns(blame, side)), walk)
    return obstacle(blame, one_group(blame, walk))


def _widely(walk: AxisSearch) -> AxisSearch:
    """The same search with every word, also those that no word of another pattern goes with."""
    if all(found.words for found in walk.found.values()):
        return walk
    own = AxisSearch(walk.problem, walk.objective, walk.tolerance, walk.method, walk.check)
    own.found.update(axis_words(own.problem, own.tolerance, None, own.check, narrow=False))
    return own


# Pattern analysis


def _contradiction(
    blame: Blame, walk: AxisSearch, analysis: Analysis | None, helper: Remedies
) -> NoLayout | None:
    """Patterns that can never be of one length."""
    conflict = analysis.conflict("binding") if analysis is not None else None
    if analysis is None or conflict is None:
        return None
    problem = walk.problem
    equations = [analysis.equations[n] for n in (conflict.equation, *conflict.against)]
    patterns = tuple(dict.fromkeys(name for equation in equations for name in equation.patterns))
    met = {variable for equation in equations for variable in equation.coefficients}
    counters = tuple(dict.fromkeys(c for v in sorted(met) if (c := analysis.variables[v].counter)))
    held = [
        name
        for name, own in problem.counters
        if any(name in problem.pattern[p].counters for p in patterns)
        and (own.value is not None or own.max is not None or own.min > 0)
    ]
    found = helper.counters(held)
    return refuse(blame, problem, conflict.text, "analysis", found, patterns=patterns, counters=counters)


# Words


def _length(blame: Blame, walk: AxisSearch, helper: Remedies) -> NoLayout | None:
    """A pattern without a word that is neither too long nor too short, whatever the others are."""
    problem = walk.problem
    for name, found in walk.found.items():
        if found.shortest.size > problem.canvas + walk.tolerance + 1e-9:
            text = (
                f"Pattern {quoted(name)}: its shortest word, {short(found.shortest)}, measures "
                f"{found.shortest.size:.4g} m, and the canvas is {canvas_of(problem)}."
            )
            held = [c for c in problem.pattern[name].counters if is_held(problem, c)]
            better = chain(
                helper.counters(held),
                helper.canvas([found.shortest.size]),
                _resized(helper, problem, found.shortest),
            )
            return refuse(blame, problem, text, "canvas", better, patterns=[name], counters=held)
    for name, found in walk.found.items():
        if not found.words:
            return _too_short(blame, walk, name, helper)
    return None


def _too_short(blame: Blame, walk: AxisSearch, name: str, helper: Remedies) -> NoLayout:
    """A pattern whose words cannot fill the canvas, not even with what the patterns above insert."""
    problem = walk.problem
    symbols, counters = problem.symbol, dict(problem.counters)
    every = instances(
        problem.pattern[name],
        symbols.__getitem__,
        counters.__getitem__,
        problem.canvas + walk.tolerance,
        walk.check,
        problem.canvas,
    )
    if (
        not every.words
    ):  # all have an unsized letter, or a counter in common with a pattern that leaves no value
        return refuse(
            blame,
            problem,
            f"Pattern {quoted(name)} has no word that fits the canvas.",
            "canvas",
            patterns=[name],
        )
    low = problem.canvas - walk.tolerance
    longest = max(every.words, key=lambda word: word.size)
    held = [c for c in longest.counters if is_held(problem, c)]
    if every.clipped:
        text = (
            f"Pattern {quoted(name)} would need words of more than {MAX_SPELLED:,} letters to fill the canvas, "
            f"which is {canvas_of(problem)}; no word may have more."
        )
        heaviest = _heaviest([longest])
        tries = (size_of(own, nice(problem.canvas / n)) for own in heaviest for n in (100, 30))
        better = iter(helper.working(tries))
        return refuse(
            blame, problem, text, "letters", better, patterns=[name], symbols=heaviest, counters=every.clipped
        )
    longer, more = next_longer(
        problem.pattern[name],
        symbols.__getitem__,
        counters.__getitem__,
        problem.canvas + walk.tolerance,
        problem.canvas,
        walk.check,
    )
    if longest.size < low:
        return _gap(blame, walk, name, helper, longest, longer, more)
    near = sorted(
        [*every.words, *([longer] if longer else [])], key=lambda word: abs(word.size - problem.canvas)
    )[:2]
    shown = " and ".join(f"{short(word)}, {word.size:.4g} m" for word in near)
    text = (
        f"Pattern {quoted(name)} has no word that fills the canvas, which is {canvas_of(problem)}, within a "
        f"tolerance of {walk.tolerance:.4g} m. Nearest: {shown}."
    )
    better = chain(
        helper.canvas(word.size for word in near),
        tolerance(blame, helper),
        helper.counters(held),
        _resized(helper, problem, near[0]),
    )
    return refuse(blame, problem, text, "tolerance", better, patterns=[name], counters=held)


def _gap(
    blame: Blame,
    walk: AxisSearch,
    name: str,
    helper: Remedies,
    longest: Word,
    longer: Word | None,
    more: bool,
) -> NoLayout:
    """A pattern whose words are all too short, or all too short or too long.

    `longest` is the longest one that is not too long, `longer` the shortest one that is; `more`: there are longer ones.
    """
    problem = walk.problem
    held = [c for c in longest.counters if is_held(problem, c)]
    better = chain(
        helper.counters(held),
        helper.canvas([longest.size, *([longer.size] if longer else [])]),
        _resized(helper, problem, longest),
        *([_resized(helper, problem, longer)] if longer else []),
    )
    if longer is None:
        text = (
            f"Pattern {quoted(name)}: its longest word, {short(longest)}, measures {longest.size:.4g} m and cannot "
            f"fill the canvas, which is {canvas_of(problem)}."
        )
        if not blame.design.patterns[name].parsed.symbols:
            text += " It has no letters yet: write some, or make the layers that have it invisible."
    else:
        least = walk.found[name].shortest.size
        below = f"{'at most ' if longest.size > least + 1e-9 else ''}{longest.size:.4g} m"
        above = f"{longer.size:.4g} m{' or more' if more else ''}"
        text = (
            f"Pattern {quoted(name)}: its words measure {below} or {above}, and the canvas is {canvas_of(problem)}. "
            f"Nearest are {short(longest)} and {short(longer)}."
        )
    return refuse(blame, problem, text, "canvas", better, patterns=[name], counters=held)


def _resized(helper: Remedies, problem: AxisProblem, word: Word) -> Iterator[Suggestion]:
    """The symbol that takes most of a word, at the size with which the word just fills the canvas."""
    for name in _heaviest([word]):
        own = [a.size or 0.0 for a in word.letters if a.symbol == name and not a.transparent]
        size = (problem.canvas - (word.size - sum(own))) / len(own)
        if size > 0:
            yield from helper.working([size_of(name, nice(size))])


def _heaviest(words: Sequence[Word]) -> list[str]:
    total: dict[str, float] = {}
    for word in words:
        for letter in word.letters:
            if letter.size is not None and not letter.transparent:
                total[letter.symbol] = total.get(letter.symbol, 0.0) + letter.size
    return sorted(total, key=lambda name: -total[name])[:1]


# Counters


def _no_candidate(blame: Blame, walk: AxisSearch, helper: Remedies) -> NoLayout | None:
    """Every pattern has words that fit, but not under one value of each counter, or not together."""
    problem = walk.problem
    if next(walk.in_order(), None) is not None:
        return None
    users: dict[str, list[str]] = {}
    for c, _ in problem.counters:
        users[c] = [n for n, p in problem.patterns if c in p.counters]
    shared = [c for c, names in users.items() if len(names) > 1]
    for c in shared:
        values = {n: {word.counters[c] for word in walk.found[n].words} for n in users[c]}
        if not set.intersection(*values.values()):
            shown = ", ".join(f"{quoted(name)} fits with {_span(own)}" for name, own in values.items())
            text = f"Patterns {names_of(users[c])} share counter {quoted(c)}, and no value of it fits all of them"
            text += f": {shown}."
            better = _balance(helper, walk, users[c], [c])
            return refuse(blame, problem, text, "counters", better, patterns=users[c], counters=[c])
    patterns = [n for n, p in problem.patterns if any(c in p.counters for c in shared)] or list(walk.found)
    sharing = (
        f" They share {'counters' if len(shared) > 1 else 'counter'} {names_of(shared)}." if shared else ""
    )
    text = (
        f"Patterns {names_of(patterns)} have no words that fit the canvas of {problem.canvas:.4g} m together."
    )
    text += sharing
    better = _balance(helper, walk, patterns, shared)
    constraint = "counters" if shared else "canvas"
    return refuse(blame, problem, text, constraint, better, patterns=patterns, counters=shared)


def _balance(
    helper: Remedies, walk: AxisSearch, patterns: Sequence[str], counters: Sequence[str]
) -> Iterator[Suggestion]:
    """What may bring the words of several patterns together."""
    yield from helper.counters([c for c in counters if is_held(walk.problem, c)])
    yield from helper.canvas()
    per_pattern = [walk.found[name].words for name in patterns]
    yield from helper.size(dict.fromkeys(name for words in per_pattern for name in _heaviest(words[-1:])))


def _tied(blame: Blame, values: Mapping[Axis, set[tuple[int, ...]]], whole: bool) -> NoLayout:
    """`whole`: these are all values that there are."""
    names = names_of(blame.shared)
    known = "" if whole else f", as far as the first {tuning.COMPARED:,} candidates say"
    text = (
        f"{'Counters' if len(blame.shared) > 1 else 'Counter'} {names} is used both across and up, and no value fits "
        f"both{known}: across it can be {_list(values['x'])}, up {_list(values['y'])}."
    )
    across, up = remedies_of(blame, "x"), remedies_of(blame, "y")
    better = chain(across.counters(blame.shared), up.canvas(), across.canvas())
    refusal = refuse(blame, blame.walk.problem, text, "counters", better, counters=blame.shared)
    refusal.axis, refusal.group, refusal.layers = "", "", ()
    return refusal


def _values(walk: AxisSearch, names: Sequence[str]) -> tuple[set[tuple[int, ...]], bool]:
    """Values of counters of the first candidates, and whether these are all."""
    order = walk.in_order()
    values = {tuple(c.counters[n] for n in names) for c in islice(order, tuning.COMPARED)}
    return values, next(order, None) is None


def _list(values: set[tuple[int, ...]]) -> str:
    shown = ", ".join("/".join(map(str, v)) for v in sorted(values)[:8])
    return (shown + (", …" if len(values) > 8 else "")) or "nothing"


def _span(values: set[int]) -> str:
    """``k = 2 … 6`` without the name: whole ranges shortly."""
    if not values:
        return "none"
    low, high = min(values), max(values)
    if low == high:
        return str(low)
    return f"{low} … {high}" if len(values) == high - low + 1 else _list({(v,) for v in values})
