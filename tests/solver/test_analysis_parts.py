"""The parts of pattern analysis by properties: terms against words, equations against sizes, exact systems."""

from __future__ import annotations

from collections import Counter as Tally
from collections.abc import Mapping
from fractions import Fraction
from itertools import combinations, product
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from facade_nb.design import parse
from facade_nb.design.model import Counter
from facade_nb.design.modes import MODES
from facade_nb.design.pattern import Pattern
from facade_nb.solver.analysis.linear import Bounds, Elimination, equation_text, form_text, number
from facade_nb.solver.analysis.systems import Analysis
from facade_nb.solver.analysis.terms import Counters, Run, Tricky, counts, flatten, terms, trim
from tests.oracle.analysing import analysed, between, texts

# Flattening, against the words


@pytest.mark.parametrize(
    ("pattern", "bounds", "shown"),
    [
        ("A^k c C^m c A^k; c := C", {}, "A^k C^{m+2} A^k"),
        ("A(BA)^k", {"k": (2, 2)}, "A B A B A"),
        ("(AA)^k A", {}, "A^{2k+1}"),
        ("(ABAB)^k", {}, "(AB)^{2k}"),
        ("((AB)^k C)^2", {}, "(AB)^k C (AB)^k C"),
        ("(EkG)^~n", {}, "(EkGG'k'E')^n"),
        ("(EkG)^|n", {}, "(EkG)^n (G'k'E')^n"),
        ("(EkG)^.n", {}, "(EkGk'E')^n"),
        ("(EkG)^:n", {"n": (1, None)}, "(EkGG'k')^{n-1} E k G G' k' E'"),
        ("(EkG)^:n", {}, "(EkGG'k')^{n-[n ≥ 1]} (EkGG'k'E')^{[n ≥ 1]}"),
        ("(EkG)^@n", {"n": (1, None)}, "(EkGk')^{n-1} E k G k' E'"),
        ("A^@n", {"n": (1, None)}, "A^n"),
        ("(AB)^n", {"n": (-3, -1)}, "(B'A')^{abs(n)}"),
        ("(AB)^-n", {"n": (-3, 3)}, "(B'A')^{abs(n)}"),
        ("A^{of bays}A", {}, "A^{{of bays}+1}"),
        ("((AB)^k)^.2", {"k": (1, None)}, "(AB)^k A' (B'A')^{k-1} (AB)^k A' (B'A')^{k-1}"),
    ],
)
def test_terms(pattern: str, bounds: dict[str, tuple[int, int | None]], shown: str) -> None:
    parsed = parse(pattern)
    times = Counters(Counter(name, *bounds.get(name, (0, None))) for name in parsed.counters)
    contents = {name: flatten(node, times, {})[0] for name, node in parsed.substitutions}
    (runs,) = flatten(parsed.control, times, contents)
    assert " ".join(texts(terms(runs))) == shown


@pytest.mark.parametrize(
    ("pattern", "bounds", "reason"),
    [
        ("(AB)^@k", (-1, 3), "counter 'k' may be of either sign, and so which letter is shared at ^@"),
        ("((AB)^k)^.2", (0, None), "which letter is shared at ^. depends on a counter inside"),
        ("(AB)^1500", (0, None), "it has more than 2,000 terms"),
    ],
)
def test_patterns_that_are_not_linear(pattern: str, bounds: tuple[int, int | None], reason: str) -> None:
    sizes = {"A": 1, "B": 2}
    found = analysed({"P": pattern, "Q": "A"}, sizes, {"k": {"min": bounds[0], "max": bounds[1]}})
    assert found.unanalysed == {"P": reason}
    assert found.equations == ()


LETTERS = ["A", "B", "C"]
RANGES = [(0, None), (1, None), (2, None), (0, 2), (2, 2), (-2, 3), (-3, -1), (-2, 0), (-2, -2)]


@st.composite
def bodies(draw: st.DrawFn, depth: int = 3, named: bool = True, choices: bool = False) -> str:
    """Pattern text; `named`: counters k and n may stand in it."""
    kinds = ["letter", "letter", "pair", "pair", "mirror", "number", "counter"] + ["choice"] * choices
    match draw(st.sampled_from(kinds)) if depth else "letter":
        case "pair":
            return draw(bodies(depth - 1, named, choices)) + draw(bodies(depth - 1, named, choices))
        case "mirror":
            return f"({draw(bodies(depth - 1, named, choices))})'"
        case "choice":
            return f"({draw(bodies(depth - 1, named, choices))}|{draw(bodies(depth - 1, named, choices))})"
        case "number":
            times = draw(st.integers(-3, 3))
            return f"({draw(bodies(depth - 1, named, choices))})^{draw(st.sampled_from(list(MODES)))}{times}"
        case "counter" if named:
            sign, name = draw(st.sampled_from(["", "-"])), draw(st.sampled_from("kn"))
            return f"({draw(bodies(depth - 1, False, choices))})^{draw(st.sampled_from(list(MODES)))}{sign}{name}"
        case _:
            return draw(st.sampled_from(LETTERS))


@st.composite
def counted(draw: st.DrawFn) -> tuple[list[Counter], dict[str, int]]:
    """Bounds of k and n, and a value of each within them."""
    own, values = [], {}
    for name in "kn":
        low, high = draw(st.sampled_from(RANGES))
        own.append(Counter(name, low, high))
        values[name] = draw(st.integers(low, low + 3 if high is None else high))
    return own, values


def spelled_out(runs: list[Run], times: Counters, values: Mapping[str, int]) -> list[tuple[str, bool]]:
    out: list[tuple[str, bool]] = []
    for run in runs:
        n = sum(c * (int(times.variables[v].value(values, {})) if v else 1) for v, c in run.exponent.items())
        assert n >= 0
        out += run.letters * n
    return out


@settings(max_examples=300, deadline=None)
@given(bodies(), counted())
def test_terms_spell_the_words(text: str, bounded: tuple[list[Counter], dict[str, int]]) -> None:
    own, values = bounded
    pattern = parse(text)
    times = Counters(own)
    try:
        (runs,) = flatten(pattern.control, times, {})
    except Tricky as reason:
        assert "is shared at" in str(reason)
        return
    (word,) = pattern.words(values)
    letters = spelled_out(runs, times, values)
    tally = Tally(symbol for symbol, _ in letters)
    assert tally == Tally(glyph.symbol for glyph in word)
    assert {symbol: n for symbol, n in tally.items() if n} == {
        symbol: n
        for symbol, exponent in counts(runs).items()
        if (n := sum(c * (times.variables[v].value(values, {}) if v else 1) for v, c in exponent.items()))
    }
    if all(c.min >= 0 or (c.max is not None and c.max <= 0) for c in own):
        assert letters == [(glyph.symbol, glyph.mirrored) for glyph in word]


@settings(max_examples=150, deadline=None)
@given(bodies(choices=True), counted())
def test_every_choice_of_alternatives_is_flattened(
    text: str, bounded: tuple[list[Counter], dict[str, int]]
) -> None:
    own, values = bounded
    assume(all(c.min >= 0 or (c.max is not None and c.max <= 0) for c in own))
    pattern, times = parse(text), Counters(own)
    try:
        found = flatten(pattern.control, times, {})
    except Tricky:
        assume(False)
    spelled = {tuple(spelled_out(runs, times, values)) for runs in found}
    assert spelled == {
        tuple((glyph.symbol, glyph.mirrored) for glyph in word) for word in pattern.words(values)
    }


@settings(max_examples=150, deadline=None)
@given(st.lists(bodies(), min_size=2, max_size=3), counted())
def test_trimming_takes_words_apart(texts: list[str], bounded: tuple[list[Counter], dict[str, int]]) -> None:
    own, values = bounded
    times = Counters(own)
    try:
        sequences = [flatten(parse(text).control, times, {})[0] for text in texts]
    except Tricky:
        assume(False)
    prefix, rests, suffix = trim(sequences)
    for whole, rest in zip(sequences, rests, strict=True):
        parts = [spelled_out(part, times, values) for part in (whole, prefix, rest, suffix)]
        letters, start, middle, end = ([symbol for symbol, _ in part] for part in parts)
        assert [*start, *middle, *end] == letters
    firsts = [rest[0] for rest in rests if rest]
    if len(firsts) == len(rests) and all(run.exponent.keys() == {""} for run in firsts):
        assert len({run.letters[0][0] for run in firsts}) > 1


def test_what_is_left_of_a_repeated_base_is_single_letters() -> None:
    """(BA)^k against (B'A')^{k-1}: one B and one A are left over."""
    found = analysed({"P": "((AB)^k)^.2", "Q": "(AB)^k A (BA)^k"}, {"A": 1, "B": 2}, {"k": {"min": 1}})
    (pair,) = found.equations
    assert texts(pair.prefix) == ["(AB)^k", "A'", "(B'A')^{k-1}"]
    assert (texts(pair.left), texts(pair.right)) == (["(AB)^k", "A'", "(B'A')^{k-1}"], ["B", "A"])
    assert pair.text == "6k = 5"  # 3k + 1 + 3(k − 1) against 3


def test_nothing_is_trimmed_that_may_not_be_there() -> None:
    """(ABB')^{k − [k ≥ 1]} and (ABB)^m have nothing for sure in common."""
    pair = between(analysed({"P": "(AB)^:k", "Q": "(ABB)^m"}, {"A": 1, "B": 2}), "P", "Q")
    assert (pair.prefix, texts(pair.left)) == ((), ["(ABB')^{k-[k ≥ 1]}", "(ABB'A')^{[k ≥ 1]}"])
    assert pair.text == "5k + [k ≥ 1] = 5m"


# Equations, against the sizes of words

SIZES = {"A": 1.0, "B": 2.0, "C": 3.5}


def length(pattern: Pattern, values: Mapping[str, int], sizes: Mapping[str, float]) -> set[Fraction]:
    return {sum((Fraction(sizes[g.symbol]) for g in word), Fraction(0)) for word in pattern.words(values)}


def made(texts: list[str], own: list[Counter], extra: Mapping[str, Any] | None = None) -> Analysis:
    bounds = {c.name: {"min": c.min, "max": c.max} for c in own}
    patterns = {f"P{n}": text for n, text in enumerate(texts)}
    return analysed(patterns, {**SIZES, **(extra or {})}, bounds)


@settings(max_examples=150, deadline=None)
@given(st.lists(bodies(choices=True), min_size=2, max_size=3), counted())
def test_an_equation_holds_just_where_words_are_of_one_length(
    texts: list[str], bounded: tuple[list[Counter], dict[str, int]]
) -> None:
    own, values = bounded
    found = made(texts, own)
    for i, j in combinations(range(len(texts)), 2):
        names = (f"P{i}", f"P{j}")
        if any(e.patterns == names for e in found.equations) and not set(names) & set(found.unanalysed):
            equation = between(found, *names)
            (p,), (q,) = length(parse(texts[i]), values, SIZES), length(parse(texts[j]), values, SIZES)
            error = found.error(equation, values, {})
            assert (error > 0, error < 0) == (p > q, p < q)


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(st.lists(bodies(depth=2), min_size=2, max_size=4), counted(), st.data())
def test_words_of_one_length_satisfy_both_systems(
    texts: list[str], bounded: tuple[list[Counter], dict[str, int]], data: st.DataObject
) -> None:
    """Patterns filled up to a canvas by placeholders: then there is a candidate whose words all have its size."""
    own, values = bounded
    canvas = max(max(length(parse(text), values, SIZES)) for text in texts) + data.draw(st.integers(0, 2))
    patterns, sizes = [], {}
    for text, symbol in zip(texts, "uvwx", strict=False):
        (size,) = length(parse(text), values, SIZES)
        if size < canvas:
            copies = data.draw(st.integers(1, 2))
            shared = [own for own, known in sizes.items() if known * copies == canvas - size]
            symbol = data.draw(st.sampled_from([symbol, *shared]))
            sizes[symbol] = float((canvas - size) / copies)
            patterns.append(f"{symbol * (copies - 1)}m{symbol}; m := {text}")
        else:
            patterns.append(text)
    found = made(patterns, own)
    for equation in found.equations:
        assert found.error(equation, values, sizes) == 0
    for system in (found.counters, found.unsized):
        assert system.inconsistent is None
        exact = {name: Fraction(size) for name, size in sizes.items()}
        at = {name: variable.value(values, exact) for name, variable in found.variables.items()}
        for row in system.reduced:
            assert at[row.pivot] == sum((c * at[v] for v, c in row.coefficients.items()), row.constant)
        assert all(at[name] == value for name, value in system.resolved.items())


@settings(max_examples=60, deadline=None)
@given(st.lists(bodies(depth=2), min_size=2, max_size=3))
def test_a_binding_or_exact_contradiction_is_one_at_all_sizes(texts: list[str]) -> None:
    own = [Counter("k", 0, 3), Counter("n", 0, 3)]
    found = made(texts, own)
    assume(found.blame() is not None)
    for k, n in product(range(4), repeat=2):
        for sizes in (SIZES, {"A": 1.0, "B": 1.0, "C": 1.0}, {"A": 3.0, "B": 0.5, "C": 0.25}):
            lengths = [length(parse(text), {"k": k, "n": n}, sizes) for text in texts]
            assert any(p != q for p, q in combinations(lengths, 2))


# Exact systems


def test_whole_numbers_are_looked_for_in_all_equations_together() -> None:
    """2x = z and 2y = z + 1 have whole solutions one by one, not together."""
    whole = Elimination("xyz", dict.fromkeys("xyz", Bounds()), "xyz")
    assert whole.add({"x": Fraction(2), "z": Fraction(-1)}, frozenset((0,)))[0] is None
    assert whole.add({"y": Fraction(2), "z": Fraction(-1), "": Fraction(-1)}, frozenset((1,))) == (
        "whole",
        frozenset((0, 1)),
    )
    assert whole.free == ("y", "z")
    assert (
        Elimination("xyz", dict.fromkeys("xyz", Bounds()), "").add({"x": Fraction(2)}, frozenset())[0] is None
    )


small = st.integers(-4, 4)


@settings(max_examples=300, deadline=None)
@given(st.lists(st.tuples(small, small, small, st.integers(-6, 6)), min_size=1, max_size=4))
def test_elimination_refuses_just_what_has_no_whole_solution(system: list[tuple[int, ...]]) -> None:
    """Against trying out every point: bounds of 0 to 6 keep that finite."""
    names = "xyz"
    elimination = Elimination(names, dict.fromkeys(names, Bounds(0, 6)), names)
    kept = []
    for n, row in enumerate(system):
        form = {name: Fraction(value) for name, value in zip([*names, ""], row, strict=True)}
        refusal, _ = elimination.add(form, frozenset((n,)))
        points = [p for p in product(range(7), repeat=3) if all(_at(own, p) == 0 for own in [*kept, row])]
        if refusal is None:
            kept.append(row)
        else:
            assert points == []
        for p in points:
            for pivot, own in elimination.rows.items():
                values = {**dict(zip(names, p, strict=True)), "": 1}
                assert sum(c * values[name] for name, c in own.items()) == 0
                assert own[pivot] == 1


def _at(row: tuple[int, ...], point: tuple[int, ...]) -> int:
    return sum(c * v for c, v in zip(row, (*point, 1), strict=True))


@pytest.mark.parametrize(
    ("value", "text"),
    [("2", "2"), ("-1.7", "−1.7"), ("5/3", "5/3"), ("-1/7", "−1/7"), ("0.05", "0.05"), ("0", "0")],
)
def test_numbers(value: str, text: str) -> None:
    assert number(Fraction(value)) == text


def test_texts_of_equations() -> None:
    form = {"k": Fraction(-2), "m": Fraction(5, 3), "floors": Fraction(3), "": Fraction(-1, 2)}
    assert form_text(form) == "−2k + 5/3 m + 3 floors − 0.5"
    assert equation_text(form) == "5/3 m + 3 floors = 2k + 0.5"
    assert equation_text(form, frozenset({"k"})) == "2k = 5/3 m + 3 floors − 0.5"
    assert equation_text({"": Fraction(2), "k": Fraction(-1)}) == "k = 2"
    assert equation_text({"": Fraction(2)}) == "0 = 2"
