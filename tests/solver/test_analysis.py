"""Pattern analysis against the supplement's examples, against the words themselves, and against the solver."""

from __future__ import annotations

import doctest
import json
from collections import Counter as Tally
from collections.abc import Mapping
from fractions import Fraction
from itertools import combinations, product
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from facade_nb import Design, NoLayout, gallery, solve
from facade_nb.design import parse
from facade_nb.design.model import AXES, Counter
from facade_nb.design.pattern import Pattern
from facade_nb.solver.analysis import Analysis, AnalysisDone, Equation, analyse
from facade_nb.solver.events import Trace
from facade_nb.solver.flatten import MAX_VARIANTS, Counters, Run, Tricky, counts, flatten, terms, trim
from facade_nb.solver.linear import Bounds, Elimination, equation_text, form_text, number
from facade_nb.solver.problem import axis_problem


def design(
    patterns: Mapping[str, str],
    sizes: Mapping[str, Any],
    counters: Mapping[str, Any] | None = None,
    groups: Mapping[str, str] | None = None,
    canvas: float = 10.0,
) -> Design:
    """One layer a pattern, listed topmost first; every pattern in a group of its own unless said."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "test",
            "canvas": {"width": canvas, "height": 1.0},
            "symbols": {
                "Y": {"size": 1.0},
                **{n: s if isinstance(s, dict) else {"size": s} for n, s in sizes.items()},
            },
            "counters": dict(counters or {}),
            "patterns": {**patterns, "Y": "Y"},
            "layers": [
                {
                    "name": name,
                    "x": {"pattern": name, "group": (groups or {}).get(name, name)},
                    "y": {"pattern": "Y"},
                }
                for name in reversed(patterns)
            ],
        }
    )


def analysed(*args: Any, **named: Any) -> Analysis:
    return analyse(axis_problem(design(*args, **named), "x"))


def between(analysis: Analysis, p: str, q: str, symbol: str = "") -> Equation:
    return next(e for e in analysis.equations if e.patterns == (p, q) and e.symbol == symbol)


def texts(shown: Any) -> list[str]:
    return [part.text for part in shown]


HOUSE = {"Cx": "cec; c := C", "Dx": "fdf; d := D", "Bx": "A(BA)^k"}
HOUSE_SIZES = {"A": 0.5, "B": 1.2, "C": {"size": 0.3, "opaque": False}, "D": 1.1}
APARTMENT = {
    "Mx": "f g f'; g := AB(DB)^j A",
    "Fx": "f g f'; f := GDBDB",
    "Bx": "GC A(BA)^k CG",
}
APARTMENT_SIZES = {"A": 0.8, "B": 1.2, "C": 2.2, "D": 0.3, "G": 0.6}


# The worked examples


def test_supplement() -> None:
    found = analysed({"P0": "A^k c C^m c A^k; c := C", "P1": "A^k C^l A^k"}, {"A": 2, "C": 1.3})
    (equation,) = found.equations
    assert equation.text == "m + 2 = l"
    assert [texts(part) for part in (equation.prefix, equation.left, equation.right, equation.suffix)] == [
        ["A^k"],
        ["C^{m+2}"],
        ["C^l"],
        ["A^k"],
    ]
    assert equation.coefficients == {"m": 1, "l": -1}
    assert equation.constant == 2
    assert equation.system == "counters"
    assert [row.text for row in found.counters.reduced] == ["m = l − 2"]
    assert found.counters.free == ("k", "l")
    assert found.counters.resolved == {}
    assert found.unsized.equations == ()
    assert found.blame("preferred") is None


def test_residential_house_in_terms_of_its_counter() -> None:
    found = analysed(HOUSE, HOUSE_SIZES)
    assert between(found, "Cx", "Bx").text == "|e| = 1.7k − 0.1"
    assert between(found, "Dx", "Bx").text == "2|f| = 1.7k − 0.6"
    assert between(found, "Cx", "Dx").text == "|e| = 2|f| + 0.5"
    assert {row.text for row in found.unsized.reduced} == {"|e| = 1.7k − 0.1", "|f| = 0.85k − 0.3"}
    assert found.unsized.free == ("k",)
    assert found.blame("preferred") is None


def test_residential_house_with_a_fixed_counter_is_resolved() -> None:
    found = analysed(HOUSE, HOUSE_SIZES, {"k": {"value": 3}})
    assert found.unsized.resolved == {"|e|": 5, "|f|": Fraction("2.25")}


def test_apartment_house_ties_contents_to_what_is_left_standing() -> None:
    found = analysed(APARTMENT, APARTMENT_SIZES)
    assert between(found, "Fx", "Mx", "f").text == "|f| = 3.6"
    assert between(found, "Mx", "Fx", "g").text == "|g| = 1.5j + 2.8"
    pair = between(found, "Fx", "Bx")
    assert (texts(pair.prefix), texts(pair.suffix)) == (["G"], ["G'"])
    assert pair.text == "|g| = 2k − 0.8"
    assert found.unsized.resolved == {"|f|": Fraction("3.6")}
    assert {row.text for row in found.unsized.reduced} == {"|f| = 3.6", "|g| = 1.5j + 2.8"}
    # 2k = 1.5j + 3.6 has no whole solution: 20k − 15j is a multiple of 5, and 36 is not.
    conflict = found.unsized.inconsistent
    assert conflict is not None
    assert (conflict.kind, conflict.strength) == ("whole", "preferred")
    assert found.blame() is None


def test_apartment_house_at_sizes_that_fit() -> None:
    found = analysed(APARTMENT, {**APARTMENT_SIZES, "C": 2.25})
    assert found.blame("preferred") is None
    rows = {row.pivot: row for row in found.unsized.reduced}
    assert rows["|f|"].text == "|f| = 3.6"
    assert rows["j"].text == "j = 4/3 k − 7/3"  # follows for the counters, though no two patterns say it
    assert rows["j"].sources == tuple(
        found.equations.index(between(found, *pair)) for pair in (("Fx", "Mx", "f"), ("Mx", "Bx"))
    )
    counters, sizes = {"j": 3, "k": 4}, {"f": 3.6, "g": 7.3}
    assert [found.error(equation, counters, sizes) for equation in found.equations] == [0.0] * 5


def test_a_resolved_counter_makes_products_linear() -> None:
    found = analysed({"P": "(em)^k e; m := D", "R": "A^k", "S": "A^2"}, {"A": 1, "D": 0.25})
    assert between(found, "P", "S").coefficients == {"k·|e|": 1, "|e|": 1, "k": Fraction("0.25")}
    assert found.counters.resolved == {"k": 2}
    assert found.unsized.resolved == {"|e|": Fraction("0.5")}
    assert found.blame("preferred") is None


# Contradictions


@pytest.mark.parametrize(
    ("patterns", "sizes", "counters", "kind", "strength", "text"),
    [
        (
            {"P": "A^mA^mA", "Q": "A^lA^l"},
            {"A": 2},
            {},
            "whole",
            "binding",
            "Patterns 'P' and 'Q' can never be of one length: A^{2m+1} against A^{2l} needs 2m + 1 = 2l; "
            "no whole numbers satisfy that.",
        ),
        (
            {"P": "A^2", "Q": "A^3"},
            {"A": 2},
            {},
            "constant",
            "binding",
            "Patterns 'P' and 'Q' can never be of one length: after their common ends, A stands against nothing.",
        ),
        (
            {"P": "B A^3", "Q": "A^m C^2"},
            {"A": 2, "B": 1, "C": 3.2},
            {"m": {"value": 1}},
            "constant",
            "preferred",
            "Patterns 'P' and 'Q' can never be of one length at the preferred sizes: B A^3 stands against A C^2, "
            "and they differ by 1.4 m.",
        ),
        (
            {"P": "A^m", "Q": "A^l A^l A", "R": "A^nA^n"},
            {"A": 2},
            {"m": {"min": 1}},
            "whole",
            "binding",
            "Patterns 'P' and 'R' can never be of one length: A^m against A^{2n} needs m = 2n; "
            "with m = 2l + 1 (patterns 'P' and 'Q'), no whole numbers satisfy that.",
        ),
        (
            {"P": "A^m A^2", "Q": "A^l"},
            {"A": 2},
            {"l": {"max": 1}},
            "bounds",
            "binding",
            "Patterns 'P' and 'Q' can never be of one length: A^{m+2} against A^l needs m + 2 = l; "
            "that is out of reach for m ≥ 0, l from 0 to 1.",
        ),
        (
            {"P": "e m; m := A", "Q": "B^k"},
            {"A": 3, "B": 2},
            {"k": {"max": 1}},
            "bounds",
            "preferred",
            "Patterns 'P' and 'Q' can never be of one length at the preferred sizes: e A against B^k needs "
            "|e| = 2k − 3; that is out of reach for |e| > 0, k from 0 to 1.",
        ),
        (
            {"P": "A B^k", "Q": "ε"},
            {"A": 3, "B": 2},
            {},
            "bounds",
            "binding",
            "Patterns 'P' and 'Q' can never be of one length: A B^k against nothing needs 2k + 3 = 0; "
            "that is out of reach for k ≥ 0.",
        ),
        (
            {"P": "f A; f := B^2", "Q": "f A; f := B^k B^k B", "R": "f A e; e := A"},
            {"A": 3, "B": 2},
            {},
            "whole",
            "binding",
            "Symbol 'f' in patterns 'P' and 'Q' can never be of one length: after their common ends, "
            "B against B^{2k} needs 2k = 1; no whole numbers satisfy that.",
        ),
    ],
)
def test_contradictions(
    patterns: dict[str, str], sizes: dict[str, float], counters: Any, kind: str, strength: str, text: str
) -> None:
    found = analysed(patterns, sizes, counters)
    conflict = found.conflict("preferred")
    assert conflict is not None
    assert conflict.text == text
    assert (conflict.kind, conflict.strength) == (kind, strength)
    assert found.blame("exact") == (text if strength != "preferred" else None)


def test_the_strongest_contradiction_is_told_first() -> None:
    """P and Q differ at the preferred sizes only; Q and R whatever they are."""
    found = analysed({"P": "B", "Q": "A^2", "R": "A^3"}, {"A": 2, "B": 1})
    conflict = found.conflict("preferred")
    assert conflict is not None
    assert (found.equations[conflict.equation].patterns, conflict.strength) == (("Q", "R"), "binding")
    assert found.equations[found.counters.equations[0]].patterns == ("Q", "R")


@pytest.mark.parametrize(("copies", "fits"), [(3, True), (4, False)])
def test_a_counter_of_either_sign_repeats_as_often_as_it_is_far_from_zero(copies: int, fits: bool) -> None:
    for low, high in ((-3, 2), (-2, 3), (-3, -1)):
        found = analysed({"P": "A^k", "Q": "A" * copies}, {"A": 1}, {"k": {"min": low, "max": high}})
        assert found.counters.resolved == ({"abs(k)": copies} if fits else {})
        assert (found.conflict() is None) == fits


def test_an_unsized_symbol_is_longer_than_nothing_and_within_its_own_bounds() -> None:
    patterns = {"P": "e m; m := A", "Q": "A^k"}
    for high, fits in ((1, False), (2, True)):
        assert (analysed(patterns, {"A": 1}, {"k": {"max": high}}).blame("preferred") is None) == fits
    for most, fits in ((1.5, False), (2.0, True)):
        sizes = {"A": 1, "e": {"max": most}}
        assert (analysed(patterns, sizes, {"k": {"value": 3}}).blame("preferred") is None) == fits


def test_what_contradicts_is_left_out_of_the_rows() -> None:
    found = analysed({"P": "A^m", "Q": "A^l A^l A", "R": "A^nA^n"}, {"A": 2})
    assert [row.text for row in found.counters.reduced] == ["m = 2l + 1"]
    assert found.counters.free == ("l", "n")


# How far an equation can be relied on


@pytest.mark.parametrize(
    ("sizes", "groups", "strength"),
    [
        ({"A": 2}, {}, "binding"),  # each alone in its group, all opaque: nothing can be inserted
        (
            {"A": 2},
            {"P": "one", "Q": "one"},
            "exact",
        ),  # an opaque letter of either may stand where the other is empty
        ({"A": {"size": 2, "opaque": False}}, {}, "exact"),  # gaps may open beside it
        ({"A": {"size": 2, "transparent": True}}, {}, "binding"),
    ],
)
def test_strength_of_equations_without_sizes(
    sizes: dict[str, Any], groups: dict[str, str], strength: str
) -> None:
    assert analysed({"P": "A^2", "Q": "A^m"}, sizes, groups=groups).equations[0].strength == strength


def test_a_pattern_that_nothing_opaque_stands_with_spans_the_canvas() -> None:
    sizes = {"A": 2, "C": {"size": 2, "opaque": False}}
    pair = {"P": "one", "C": "one"}
    assert (
        between(analysed({"P": "A^2", "C": "C", "Q": "A^m"}, sizes, groups=pair), "P", "Q").strength
        == "binding"
    )
    # its only opaque letter may be missing: then nothing in the group is opaque, and C1 is waived
    found = analysed({"P": "A^m", "C": "C", "Q": "A^2"}, sizes, groups=pair)
    assert between(found, "P", "Q").strength == "exact"


@pytest.mark.parametrize("canvas", [8.0, 9.0])
def test_binding_equations_hold_in_layouts(canvas: float) -> None:
    one = design({"P0": "A^k c C^m c A^k; c := C", "P1": "A^k C^l A^k"}, {"A": 2, "C": 1}, canvas=canvas)
    (equation,) = analyse(axis_problem(one, "x")).equations
    assert equation.strength == "binding"
    layout = solve(one)
    assert layout.counters["m"] + 2 == layout.counters["l"]


def test_a_binding_contradiction_has_no_layout() -> None:
    one = design({"P": "A^2", "Q": "A^3"}, {"A": 2}, canvas=5)
    assert analyse(axis_problem(one, "x")).conflict("binding") is not None
    with pytest.raises(NoLayout):
        solve(one)


def test_an_exact_contradiction_can_have_a_layout_with_gaps() -> None:
    one = design({"P": "A^2", "Q": "A^3"}, {"A": 2}, groups={"P": "one", "Q": "one"}, canvas=5)
    found = analyse(axis_problem(one, "x"))
    assert found.conflict("binding") is None
    assert found.blame() == (
        "Patterns 'P' and 'Q' can be of one length only with gaps in one of them: "
        "after their common ends, A stands against nothing."
    )
    rows = solve(one).x.groups["one"].rows
    assert any(not element for row in rows for element in row.columns)


# Alternatives


def test_alternatives_of_different_length_are_not_analysed_beyond_common_ends() -> None:
    found = analysed({"P": "A(B|CC)A^2", "Q": "A^kA", "R": "AB^mA"}, {"A": 1, "B": 2, "C": 3})
    assert found.unanalysed == {"P": "its alternatives are not of one length: A B A^2 or A C^2 A^2"}
    pair = between(found, "P", "R")
    assert pair.system == "none"
    assert pair.note == "The alternatives of 'P' differ in length."
    assert [texts(part) for part in (pair.prefix, pair.left, pair.right, pair.suffix)] == [
        ["A"],
        ["B A|C^2 A"],
        ["B^m"],
        ["A"],
    ]
    assert between(found, "Q", "R").system == "counters"


def test_alternatives_of_one_length_are_analysed() -> None:
    either_order = analysed({"P": "A(BC|CB)", "Q": "A B^k C"}, {"A": 1, "B": 2, "C": 2})
    assert between(either_order, "P", "Q").strength == "binding"
    assert either_order.counters.resolved == {"k": 1}
    same_size = analysed({"P": "A(B|C)", "Q": "A B^k"}, {"A": 1, "B": 2, "C": 2})
    assert same_size.unanalysed == {}
    assert same_size.counters.resolved == {"k": 1}
    assert between(same_size, "P", "Q").strength == "preferred"


def test_too_many_alternatives() -> None:
    ways = MAX_VARIANTS.bit_length()
    found = analysed({"P": "(A|B)" * ways, "Q": "A"}, {"A": 1, "B": 2})
    assert found.unanalysed == {"P": f"there are more than {MAX_VARIANTS} ways to choose its alternatives"}
    assert found.equations == ()
    contents = "; ".join(f"{s} := A|B" for s in "abcdef")
    assert analysed({"P": "abcdef; " + contents}, {"A": 1, "B": 2}).unanalysed == found.unanalysed


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
MODES = ["", "~", "|", ".", ":", "@"]


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
            return f"({draw(bodies(depth - 1, named, choices))})^{draw(st.sampled_from(MODES))}{times}"
        case "counter" if named:
            sign, name = draw(st.sampled_from(["", "-"])), draw(st.sampled_from("kn"))
            return f"({draw(bodies(depth - 1, False, choices))})^{draw(st.sampled_from(MODES))}{sign}{name}"
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


# The trace


def test_plain_data() -> None:
    found = analysed(HOUSE, HOUSE_SIZES)
    trace = Trace([AnalysisDone("x", found.to_dict())])
    (event,) = json.loads(json.dumps(trace.to_dict(), allow_nan=False))["events"]
    assert (event["event"], event["axis"]) == ("AnalysisDone", "x")
    document = event["analysis"]
    assert document["unsized"]["variables"] == ["|e|", "|f|", "k"]
    assert document["equations"][1] == {
        "patterns": ["Cx", "Bx"],
        "prefix": [],
        "left": [
            {"text": "C", "letters": ["C"], "exponent": {"": 1}},
            {"text": "e", "letters": ["e"], "exponent": {"": 1}},
            {"text": "C", "letters": ["C"], "exponent": {"": 1}},
        ],
        "right": [
            {"text": "A", "letters": ["A"], "exponent": {"": 1}},
            {"text": "(BA)^k", "letters": ["B", "A"], "exponent": {"k": 1}},
        ],
        "suffix": [],
        "coefficients": {"|e|": 1, "k": -1.7},
        "constant": 0.1,
        "text": "|e| = 1.7k − 0.1",
        "system": "unsized",
        "strength": "preferred",
        "symbol": "",
        "note": "",
    }
    assert document["unsized"]["reduced"][0] == {
        "pivot": "|e|",
        "coefficients": {"k": 1.7},
        "constant": -0.1,
        "text": "|e| = 1.7k − 0.1",
        "sources": document["unsized"]["reduced"][0]["sources"],
        "strength": "preferred",
    }


@pytest.mark.parametrize("name", gallery.names())
def test_gallery(name: str) -> None:
    """Whatever layout there is satisfies every binding equation; every design is told about without a fault."""
    one = gallery.load(name)
    for axis in AXES:
        problem = axis_problem(one, axis)
        found = analyse(problem)
        pairs = {e.patterns for e in found.equations if not e.symbol}
        known = [n for n, _ in problem.patterns if n not in found.unanalysed]
        assert pairs >= set(combinations(known, 2))
        assert found.conflict("binding") is None
        json.dumps(found.to_dict(), allow_nan=False)


def test_the_documentation_says_what_the_code_does() -> None:
    page = Path(__file__).parents[2] / "docs" / "analysis.md"
    outcome = doctest.testfile(
        str(page), module_relative=False, encoding="utf-8", optionflags=doctest.REPORT_NDIFF
    )
    assert outcome.failed == 0
    assert outcome.attempted > 15
