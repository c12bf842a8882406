"""Pattern analysis against the supplement's examples, against the words themselves, and against the solver."""

from __future__ import annotations

import doctest
import json
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest

from facade_nb import NoLayout, gallery, solve
from facade_nb.design.model import AXES
from facade_nb.solver import tuning
from facade_nb.solver.analysis.systems import analyse, refuted
from facade_nb.solver.events.base import StageBegun
from facade_nb.solver.model.problem import axis_problem
from tests.oracle.analysing import analysed, between, stacked, texts

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
    one = stacked({"P0": "A^k c C^m c A^k; c := C", "P1": "A^k C^l A^k"}, {"A": 2, "C": 1}, canvas=canvas)
    (equation,) = analyse(axis_problem(one, "x")).equations
    assert equation.strength == "binding"
    layout = solve(one)
    assert layout.counters["m"] + 2 == layout.counters["l"]


def test_a_binding_contradiction_has_no_layout() -> None:
    one = stacked({"P": "A^2", "Q": "A^3"}, {"A": 2}, canvas=5)
    assert analyse(axis_problem(one, "x")).conflict("binding") is not None
    with pytest.raises(NoLayout):
        solve(one)


@pytest.mark.parametrize(
    ("patterns", "canvas"),
    [
        ({"P": "A A^m A^m", "Q": "A^l A^l"}, 6.0),
        ({"P": "A A^m A^m", "Q": "A^l A^l"}, 60.0),
        ({"P": "(AB)^m (AB)^m", "Q": "AB (AB)^l (AB)^l", "R": "(AB)^k"}, 24.0),
    ],
)
def test_a_proof_ends_the_search_before_any_word_is_made(patterns: dict[str, str], canvas: float) -> None:
    """Each pattern is in a group of its own: only sizes tie them, and of words there would be no end."""
    one = stacked(patterns, {"A": 0.2, "B": 0.1}, canvas=canvas)
    proof = refuted(axis_problem(one, "x"))
    assert proof is not None
    assert proof.conflict("binding") == analyse(axis_problem(one, "x")).conflict("binding")
    for search in ("best", "ida"):
        with pytest.raises(NoLayout, match="can never be of one length") as caught:
            solve(one, trace=True, search=search, time_limit=None)
        assert caught.value.constraint == "analysis"
        stages = [event.stage for event in caught.value.trace.events if isinstance(event, StageBegun)]
        assert stages == ["analysis"]


def test_what_is_no_proof_is_searched() -> None:
    one = stacked({"P": "A A^m A^m", "Q": "A^l A^l"}, {"A": 2}, groups={"P": "one", "Q": "one"}, canvas=6)
    assert refuted(axis_problem(one, "x")) is None
    assert solve(one).complete


def test_an_exact_contradiction_can_have_a_layout_with_gaps() -> None:
    one = stacked({"P": "A^2", "Q": "A^3"}, {"A": 2}, groups={"P": "one", "Q": "one"}, canvas=5)
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
    ways = tuning.MAX_VARIANTS.bit_length()
    found = analysed({"P": "(A|B)" * ways, "Q": "A"}, {"A": 1, "B": 2})
    assert found.unanalysed == {
        "P": f"there are more than {tuning.MAX_VARIANTS} ways to choose its alternatives"
    }
    assert found.equations == ()
    contents = "; ".join(f"{s} := A|B" for s in "abcdef")
    assert analysed({"P": "abcdef; " + contents}, {"A": 1, "B": 2}).unanalysed == found.unanalysed


# Plain data


def test_plain_data() -> None:
    found = analysed(HOUSE, HOUSE_SIZES)
    document = json.loads(json.dumps(found.to_dict(), allow_nan=False))
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
