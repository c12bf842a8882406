"""Words of a pattern that fit the canvas (the paper's 5.1, Eq. 7, Figure 7), and those of all patterns of an axis."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from math import floor, inf
from numbers import Real

from ...design.errors import DesignError, Fault, listed, nearest, quoted
from ...design.fields import describe
from ...design.limits import LEAST_LENGTH, MOST_COUNT, MOST_LENGTH
from ...design.model import Counter, Symbol
from ...design.pattern import parse
from .. import tuning
from ..budget import Progress
from ..cache import CACHE
from ..model.letters import Word
from ..model.precision import EPS
from ..model.problem import AxisProblem
from .instances import Instances, Range, instances, ranges

__all__ = ["across", "axis_words", "words"]

_SPAN = f"sizes lie between {LEAST_LENGTH:f} and {MOST_LENGTH:,.0f}"


def axis_words(
    problem: AxisProblem,
    tolerance: float,
    progress: Progress | None = None,
    check: Callable[[], None] | None = None,
    across: Mapping[str, Range] | None = None,
    narrow: bool = True,
) -> dict[str, Instances]:
    """The words of every pattern of an axis that Eq. 7 may allow, in the order of `AxisProblem.patterns`.

    A counter that stands in several patterns is tried only where each of them has words. A pattern's words are no
    shorter than what the opaque letters above it can leave; words that depend on nothing that has changed
    are not listed again.

    Parameters
    ----------
    tolerance
        Metres.
    across
        What the other axis says of counters (`ranges`).
    narrow
        Whether patterns are asked what they say of the counters of others.
    """
    symbols, counters = problem.symbol, dict(problem.counters)
    limit = problem.canvas + tolerance
    common = _common(problem, limit, across or {}, check) if narrow else {}
    canvas = problem.canvas
    above = {
        name: [r[: r.index(name)] for _, r in problem.groups if name in r] for name, _ in problem.patterns
    }
    opaque: dict[str, float] = {}
    found: dict[str, Instances] = {}
    for name, pattern in problem.patterns:
        if progress is not None:
            progress.at("words", problem.axis, pattern=name)
        rooms = [sum(opaque[o] for o in set(rows)) for rows in above[name] if all(o in opaque for o in rows)]
        low = max((canvas - tolerance - room for room in rooms), default=0.0)
        used = (*pattern.symbols, *pattern.substituted)
        own_common = {c: common[c] for c in pattern.counters if c in common}
        key = (
            pattern,
            tuple(symbols.get(s) for s in used),
            tuple(counters[c] for c in pattern.counters),
            limit,
            canvas,
            low,
            tuple(own_common.items()),
        )
        known: tuple[Instances, float] | None = CACHE.words.get(key)
        if known is None:
            try:
                own = instances(
                    pattern,
                    lambda s: symbols.get(s) or Symbol(s),
                    lambda c: counters[c],
                    limit,
                    check,
                    canvas,
                    low - EPS if low > 0 else -inf,
                    own_common,
                )
            except DesignError as error:
                raise DesignError(Fault(f"patterns.{name}", str(error))) from None
            known = own, max((_opaque(word) for word in own.words), default=0.0)
            CACHE.words.put(
                key,
                known,
                tuning.WORD_BYTES
                + sum(tuning.WORD_BYTES + tuning.WORD_LETTER_BYTES * len(word) for word in own.words),
            )
        found[name], opaque[name] = known
    return found


def across(
    other: AxisProblem,
    shared: Collection[str],
    tolerance: float,
    check: Callable[[], None] | None = None,
) -> dict[str, Range]:
    """Between which values of the counters that two axes share the other one has words.

    Parameters
    ----------
    tolerance
        A fraction of the canvas.
    """
    symbols, counters = other.symbol, dict(other.counters)
    limit = other.canvas * (1.0 + tolerance)
    found: dict[str, Range] = {}
    for _, pattern in other.patterns:
        own = ranges(pattern, symbols.__getitem__, counters.__getitem__, limit, check)
        for name in own.keys() & set(shared):
            low, high = found.get(name, own[name])
            found[name] = max(low, own[name][0]), min(high, own[name][1])
    return found


def _common(
    problem: AxisProblem, limit: float, across: Mapping[str, Range], check: Callable[[], None] | None
) -> dict[str, Range]:
    """Values of counters beyond which some pattern has no word."""
    symbols, counters = problem.symbol, dict(problem.counters)
    found: dict[str, Range] = dict(across)
    shared = {c for c in counters if sum(c in p.counters for _, p in problem.patterns) > 1}
    for _, pattern in problem.patterns:
        if shared & set(pattern.counters):
            key = (
                pattern,
                tuple([symbols.get(s) for s in (*pattern.symbols, *pattern.substituted)]),
                tuple([counters[c] for c in pattern.counters]),
                limit,
            )
            known = CACHE.ranges.get(key)
            if known is None:
                known = ranges(
                    pattern, lambda s: symbols.get(s) or Symbol(s), lambda c: counters[c], limit, check
                )
                CACHE.ranges.put(key, known)
            own = known
            for c in shared & own.keys():
                low, high = found.get(c, own[c])
                found[c] = max(low, own[c][0]), min(high, own[c][1])
    # where there is no common value the failure is explained by the values that each pattern has
    return {c: (low, high) for c, (low, high) in found.items() if low <= high}


def _opaque(word: Word) -> float:
    return sum(letter.size or 0.0 for letter in word.letters if letter.opaque)


def words(
    pattern: str,
    sizes: Mapping[str, float],
    canvas: float,
    tolerance: float,
    counters: Mapping[str, tuple[int, int | None]] | None = None,
    unsized_step: float | None = None,
) -> list[Word]:
    """Words of a pattern with canvas − tolerance ≤ Σ sizes ≤ canvas + tolerance (Eq. 7 for a pattern on its own).

    Parameters
    ----------
    pattern
        Pattern text.
    sizes
        Preferred sizes in metres. Symbols without one are unsized and may stand only as placeholders of a
        control pattern.
    canvas, tolerance
        Metres.
    counters
        Bounds ``(min, max)`` by name; default from 0 without an upper bound. Names that the pattern does not
        have are ignored, so that the same bounds can be given for several patterns.
    unsized_step
        Sample unsized symbols at positive multiples of this many metres, as the paper's Figure 7 does.
        If it is None, a word with unsized letters is listed once, and is kept if its sized letters leave room
        for them.

    Returns
    -------
    Words in lexicographic order of counter values, alternatives, and sampled sizes. A counter that repeats only
    letters without a size is tried up to 16 at most; a `UserWarning` says so.

    Raises
    ------
    PatternError
        For a faulty text.
    DesignError
        For a solid symbol without a size, or a size, bound or step that is out of range.
    """
    parsed = parse(pattern)
    faults = [
        Fault(f"sizes.{name}", f"expected a positive size in metres, found {describe(size)}; {_SPAN}")
        for name, size in sizes.items()
        if not _is_length(size) or size < LEAST_LENGTH
    ]
    faults += [
        Fault(what, f"expected metres, 0 or more, at most {MOST_LENGTH:,.0f}, found {describe(value)}")
        for what, value in (("canvas", canvas), ("tolerance", tolerance))
        if not _is_length(value)
    ]
    faults += [
        Fault("pattern", f"symbol {quoted(name)} stands for itself and needs a size{nearest(name, sizes)}")
        for name in parsed.symbols
        if name in parsed.solids and name not in sizes
    ]
    if unsized_step is not None and (not _is_length(unsized_step) or unsized_step < LEAST_LENGTH):
        shown = describe(unsized_step)
        faults.append(Fault("unsized_step", f"expected a positive length in metres, found {shown}; {_SPAN}"))
    bounds: dict[str, Counter] = {}
    for name, given in (counters or {}).items():
        if not _is_range(given):
            faults.append(
                Fault(
                    f"counters.{name}",
                    f"expected (min, max), whole numbers within {MOST_COUNT:,} either way, found {describe(given)}",
                )
            )
        elif given[1] is not None and given[0] > given[1]:
            faults.append(Fault(f"counters.{name}", f"expected min ≤ max, found {given[0]} and {given[1]}"))
        else:
            bounds[name] = Counter(name, given[0], given[1])
    if faults:
        raise DesignError(faults)
    found = instances(
        parsed,
        lambda name: Symbol(name, sizes.get(name)),
        lambda name: bounds.get(name) or Counter(name),
        canvas + tolerance,
        low=canvas - tolerance,
    )
    if found.endless and found.left < inf:
        names = ", ".join(map(repr, found.endless))
        warnings.warn(
            f"Counter {names} repeats nothing that has a size; it was tried up to {tuning.MAX_COPIES} only.",
            stacklevel=2,
        )
    kept: list[Word] = []
    for word in found.words:
        unsized = list(dict.fromkeys(a.symbol for a in word.letters if a.size is None))
        if unsized and unsized_step is not None:
            sampled = _sample(word, unsized, unsized_step, canvas + tolerance)
            kept += [w for w in sampled if w.size >= canvas - tolerance - EPS]
        elif unsized or word.size >= canvas - tolerance - EPS:
            kept.append(word)
    return kept


def _is_length(value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return 0 <= float(value) <= MOST_LENGTH
    except OverflowError:
        return False


def _is_range(value: object) -> bool:
    if not isinstance(value, Sequence) or len(value) != 2:
        return False
    low, high = value
    return all(isinstance(v, int) and abs(v) <= MOST_COUNT for v in (low, 0 if high is None else high))


def _sample(word: Word, unsized: Sequence[str], step: float, limit: float) -> Iterator[Word]:
    most = max(0, floor((limit - word.size) / step + EPS))
    if most ** len(unsized) > tuning.MAX_SAMPLES:
        samples = f"{most:,} samples of {listed(unsized)} each make over {tuning.MAX_SAMPLES:,} words"
        text = f"expected a larger step: {samples}"
        raise DesignError(Fault("unsized_step", text))
    for multiples in product(range(1, most + 1), repeat=len(unsized)):
        size = dict(zip(unsized, (m * step for m in multiples), strict=True))
        letters = tuple(a if a.size is not None else replace(a, size=size[a.symbol]) for a in word.letters)
        made = replace(word, letters=letters)
        if made.size <= limit + EPS:
            yield made
