"""Whatever a document holds, it is refused in a few lines, in time that grows as it does, and with numbers in range."""

from __future__ import annotations

import copy
import random
import unicodedata
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb.design import (
    Canvas,
    Counter,
    Design,
    DesignError,
    Fault,
    NoLayout,
    PatternError,
    Symbol,
    edit,
    errors,
    parse,
)
from facade_nb.design.errors import cut, listed, nearest, quoted
from facade_nb.design.limits import MOST_COUNT, range_faults
from facade_nb.design.tree import MAX_LETTERS

LONG = "x" * 3_000_000
LINES = 70  # of at most 20 faults, each with an excerpt


def document(**sections: Any) -> dict[str, Any]:
    """A document with one pattern."""
    return {
        "format": "facade-nb/design/1",
        "symbols": {"A": {"size": 1}},
        "patterns": {"a": "A^k"},
    } | sections


def layer(pattern: Any, **fields: Any) -> dict[str, Any]:
    return {"name": "l", "x": {"pattern": pattern}, "y": {"pattern": "a"}} | fields


def refused(one: Any) -> DesignError:
    with pytest.raises(DesignError) as error:
        Design.from_dict(one)
    return error.value


def faulty(n: int) -> Iterator[tuple[str, dict[str, Any]]]:
    """Documents of n parts, each of them at fault in one way."""
    sized = {f"name{i * 7919 % 100_003}": {"size": 1} for i in range(n)}
    yield "patterns", document(patterns={f"p{i}": f"A(B{'x' * (i % 50)}C*" for i in range(n)})
    yield "signs", document(patterns={f"p{i}": "A（B）" for i in range(n)})
    yield "braces", document(patterns={f"p{i}": "A^{k+1}" for i in range(n)})
    yield "unsized", document(symbols=sized, patterns={f"p{i}": f"<namex{i}>" for i in range(n)})
    yield "unsized in one", document(symbols=sized, patterns={"p": "".join(f"<x{i}>" for i in range(n))})
    yield (
        "names of patterns",
        document(
            patterns={f"p{i}": "A" for i in range(n)}, layers=[layer(f"q{i}", name=f"l{i}") for i in range(n)]
        ),
    )
    yield (
        "mask",
        document(
            patterns={"a": "".join(f"<n{i}>" for i in range(n))},
            layers=[layer("a", x={"pattern": "a", "mask": [f"m{i}" for i in range(n)]})],
        ),
    )
    yield "hidden", document(patterns={"a": {"text": "A", "hidden": [f"m{i}" for i in range(n)]}})
    yield "shapes", document(symbols=sized, shapes={f"q{i} r{i}": {} for i in range(n)})
    yield "fields", document(**{f"fild{i}": 1 for i in range(n)})
    yield "fields of symbols", document(symbols={name: {"sise": 1} for name in sized})
    yield "placements", document(symbols={name: {"size": 1, "placement": "centre"} for name in sized})
    yield "counters", document(counters={f"{i}k": {} for i in range(n)})
    yield "layers", document(layers=[layer("a") for _ in range(n)])


KINDS = [kind for kind, _ in faulty(1)]


@pytest.mark.parametrize("kind", KINDS)
def test_many_faults_are_told_in_a_few_lines(kind: str) -> None:
    error = refused(dict(faulty(300))[kind])
    text = str(error)
    assert len(error.faults) >= 299
    assert text.endswith(f"… and {len(error.faults) - 20:,} more faults")
    assert text.count("\n") < LINES and len(text) < 12_000


class Work:
    """Counts the names that are compared letter by letter, and those that are looked at."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.compared = self.looked_at = 0
        close, near = errors.get_close_matches, errors.nearest

        def counted(word: str, names: list[str], n: int = 3, cutoff: float = 0.6) -> list[str]:
            self.compared += len(names)
            return close(word, names, n, cutoff)

        def looking(name: str, valid: Any) -> str:
            names = list(valid)
            self.looked_at += len(names)
            return near(name, names)

        monkeypatch.setattr(errors, "get_close_matches", counted)
        monkeypatch.setattr("facade_nb.design.fields.nearest", looking)


@pytest.mark.parametrize("kind", KINDS)
def test_looking_for_names_takes_no_longer_with_more_faults(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of n names and n faults n² pairs could be compared: it is no more than so many times n."""
    for n in (200, 800):
        work = Work(monkeypatch)
        refused(dict(faulty(n))[kind])
        assert work.compared <= 20 * 100
        assert work.looked_at <= 20 * (n + 20)


def test_a_faulty_pattern_is_read_twice_at_most(monkeypatch: pytest.MonkeyPatch) -> None:
    from lark.parsers.lalr_parser_state import ParserState

    fed = 0
    feed = ParserState.feed_token

    def counted(self: Any, *arguments: Any, **options: Any) -> Any:
        nonlocal fed
        fed += 1
        return feed(self, *arguments, **options)

    monkeypatch.setattr(ParserState, "feed_token", counted)
    with pytest.raises(PatternError):
        parse("AB" * 1000 + "*")
    assert 2000 <= fed < 4100


@pytest.mark.parametrize(
    "one",
    [
        document(name=3, **{LONG: 1}),
        document(symbols={LONG: {"size": -1}}),
        document(symbols={LONG: {LONG: 1}}),
        document(counters={LONG + "+": {}}),
        document(patterns={LONG: "A("}),
        document(patterns={"a": LONG}),
        document(patterns={LONG: {"text": "A", "hidden": [LONG, 3]}}),
        document(patterns={"a": f"A;<{'x' * 19_000}> := B"}),
        document(layers=[layer(LONG, name=LONG), layer(LONG, name=LONG)]),
        document(layers=[layer("a", x={"pattern": "a", "mask": [LONG] * 3})]),
        document(layers=[layer("a", x={"pattern": "a", "mask": LONG})]),
        document(shapes={LONG: {}, "A " * 100_000 + "B": {}, f"{LONG} B": {"offset": LONG}}),
        document(canvas={"width": LONG, LONG: LONG}),
        document(format=LONG),
        LONG,
    ],
)  # fmt: skip
def test_names_of_three_megabytes_are_cut(one: Any) -> None:
    text = str(refused(one))
    assert len(text) < 3000 and text.count("\n") < 30


def test_a_file_of_megabytes_in_one_line_too() -> None:
    with pytest.raises(DesignError) as error:
        Design.from_json('{"format": "' + LONG)
    assert len(str(error.value)) < 300


def test_edits_are_told_shortly() -> None:
    one = Design.from_dict(document(patterns={f"p{i}": "A" for i in range(3000)}))
    for call in (
        lambda: edit.rename_pattern(one, LONG, "b"),
        lambda: edit.remove_layer(one, LONG),
        lambda: edit.move_layer(one, LONG, 0),
        lambda: edit.with_layer(one, LONG, depth=1),
        lambda: edit.with_shape(one, "A A", layer=LONG, kind="wall"),
    ):
        with pytest.raises(DesignError) as error:
            call()
        assert len(str(error.value)) < 300
    with pytest.raises(DesignError, match=r"'p0', 'p1', .*… and 2,992 more"):
        edit.rename_pattern(one, "q", "b")


def test_a_fault_and_a_reason_are_bounded_whoever_makes_them() -> None:
    assert len(str(Fault(LONG, LONG))) < 1600
    assert len(str(NoLayout(LONG))) < 2500


def test_cutting() -> None:
    assert cut("abc", 5) == "abc"
    assert cut("abcdefghij", 7) == "abcd…ij"
    assert len(cut(LONG)) == 60
    assert quoted("a'b") == '"a\'b"' and len(quoted(LONG)) == 62
    assert listed("abc") == "'a', 'b', 'c'" and listed([]) == ""
    assert listed(range(10), 2) == "'0', '1', … and 8 more"


def test_the_nearest_of_many_names() -> None:
    names = [f"other{i}" for i in range(5000)]
    assert nearest("windwo", [*names, "window"]) == "; did you mean 'window'?"
    assert nearest("WINDOW", [*names, "window"]) == "; did you mean 'window'?"
    assert nearest("qqq", names) == nearest(LONG, [LONG]) == ""


# Numbers


@pytest.mark.parametrize("value", [1e-308, 5e-324, 1e-7, 1.1e6, 1e308])
def test_sizes_lie_within_a_range(value: float) -> None:
    for one, place in [
        (document(canvas={"width": value}), "canvas.width"),
        (document(canvas={"height": value}), "canvas.height"),
        (document(symbols={"A": {"size": value}}), "symbols.A.size"),
        (document(symbols={"A": {"size": 1, "min": value}}), "symbols.A.min"),
        (document(symbols={"A": {"size": 1, "max": value}}), "symbols.A.max"),
    ]:
        assert f"{place}: expected a number from 0.000001 to 1,000,000; found {value}" in str(refused(one))


@pytest.mark.parametrize("value", [-1e308, 1e7, 1e308])
def test_offsets_and_depths_too(value: float) -> None:
    told = f"expected a number from -1,000,000 to 1,000,000; found {value}"
    assert told in str(refused(document(shapes={"A A": {"offset": value}})))
    assert told in str(refused(document(layers=[layer("a", depth=value)])))


@pytest.mark.parametrize("field", ["min", "max", "value"])
@pytest.mark.parametrize("value", [MOST_COUNT + 1, -MOST_COUNT - 1, 10**400, 1e300])
def test_counters_too(field: str, value: float) -> None:
    assert f"counters.k.{field}: expected a whole number from" in str(
        refused(document(counters={"k": {field: value}}))
    )


def test_a_design_that_was_not_read_is_checked_when_it_is_solved() -> None:
    one = Design(
        canvas=Canvas(1e308, 1e-308),
        symbols={"A": Symbol("A", 1e300, min=-1.0)},
        counters={"k": Counter("k", 10**400)},
    )
    places = [fault.place for fault in range_faults(one)]
    assert places == ["canvas.width", "canvas.height", "symbols.A.size", "symbols.A.min", "counters.k.min"]
    assert range_faults(Design()) == []


@pytest.mark.parametrize(
    ("text", "column", "letters"),
    [
        ("(A^1000)^1000", 10, "1,000,000"),
        ("A^~20000", 4, "40,000"),
        ("A^-20000 (B^15000)^2", 20, "30,000"),
        ("((((A^20000)^20000)^20000)^20000)^20000", 14, "400,000,000"),
        ("A^20000 B|C", 1, "20,001"),
        ("x m^1000; m := A^1000", 3, "1,000,001"),
        ("m^20000; m := A^20000B^20000", 1, "800,000,000"),
        ("(m^20000)^k; m := A B", 2, "0"),
    ],
)
def test_words_that_are_too_long_are_refused_when_they_are_read(text: str, column: int, letters: str) -> None:
    if letters == "0":  # with k at 0 there is a word
        assert parse(text).counters == ("k",)
        return
    with pytest.raises(PatternError) as error:
        parse(text)
    assert error.value.fault.column == column
    assert error.value.fault.message == f"a word would have {letters} letters; at most 20,000 are possible"


def test_as_are_too_many_words() -> None:
    with pytest.raises(PatternError, match="there would be over 20,000 words for one choice of counters"):
        parse("(A|B)" * 15)
    assert len(parse("(A|B)" * 14).ways()) == 2**14
    assert len(parse("(A|A)" * 20).ways()) == 1  # equal ones are one


@pytest.mark.parametrize(
    ("text", "counter", "field"),
    [
        ("A^k", {"min": 30_000}, "min"),
        ("A^k", {"min": 10**9}, "min"),
        ("A^k", {"value": 20_001}, "value"),
        ("A^k", {"max": -30_000, "min": -40_000}, "max"),
        ("A(AB)^~k", {"value": 5000}, "value"),
        ("x m; m := (A^100)^k", {"min": 201}, "min"),
        ("(A|B)^k", {"min": 30_000}, "min"),
    ],
)
def test_counters_that_leave_no_word_are_refused_when_they_are_read(
    text: str, counter: dict[str, int], field: str
) -> None:
    symbols = {"A": {"size": 1}, "B": {"size": 1}}
    error = refused(document(symbols=symbols, patterns={"a": text}, counters={"k": counter}))
    assert [fault.place for fault in error.faults] == [f"counters.k.{field}"]
    assert "expected a count with which pattern 'a' can be written out; found" in str(error)


def test_counters_that_leave_one_are_read() -> None:
    symbols = {"A": {"size": 1}, "B": {"size": 1}}
    for text, counter in [
        ("A^k", {"max": 10**9}),
        ("A^k|B", {"min": 10**6}),
        ("()^k", {"min": 10**9}),
        ("B", {"min": 10**9}),
    ]:
        Design.from_dict(document(symbols=symbols, patterns={"a": text}, counters={"k": counter}))
    Design.from_dict(document(counters={"k": {"value": MAX_LETTERS}}))


# Anything


HOUSE = document(
    name="n",
    canvas={"width": 4.0, "height": 2.0},
    symbols={
        "A": {"size": 1.0, "min": 0.5, "max": 2.0},
        "C": {"size": 0.3, "opaque": False, "placement": "left"},
    },
    counters={"k": {"min": 0, "max": 5, "value": 2}},
    patterns={"a": "A^k", "b": {"text": "e C e; C := A^k", "hidden": ["A"], "shapes": {"A A": {}}}},
    layers=[layer("b", x={"pattern": "b", "group": "g", "mask": ["A"]}, depth=1, visible=True)],
    shapes={"A *": {"kind": "window", "offset": 0.05, "thickness": 0.1, "visible": True}},
)
VALUES: list[Any] = [
    0, 1, -1, 0.5, 1e-308, 1e308, float("nan"), float("inf"), 10**400, -(10**400), 20_001, True, None,
    "", "1", "12,5", [], {}, "x" * 1000, ["A"], "e\u0301",
]  # fmt: skip


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    if path:
        yield path
    for key, member in (
        value.items() if isinstance(value, dict) else enumerate(value if isinstance(value, list) else ())
    ):
        yield from places(member, (*path, key))


@given(st.randoms(use_true_random=False))
def test_a_mangled_document_is_read_or_refused_shortly(chance: random.Random) -> None:
    one = copy.deepcopy(HOUSE)
    for _ in range(chance.randint(1, 3)):
        *path, last = chance.choice(list(places(one)))
        owner: Any = one
        for key in path:
            owner = owner[key]
        if isinstance(owner, dict) and chance.random() < 0.2:
            last = chance.choice(["2k", "k+1", "ｋ", "", "*", "a b c", "e\u0301"])
        owner[last] = copy.deepcopy(chance.choice(VALUES))
    try:
        design = Design.from_dict(one)
    except DesignError as error:
        assert len(str(error)) < 6000 and str(error).count("\n") < LINES
    else:
        assert Design.from_dict(design.to_dict()) == design


@given(st.text(st.sampled_from("AB(k)^|'.~:@;{}<>=-#\n 1²ε·∘⊙−’′ˆ｜（）") | st.characters(), max_size=14))
def test_any_text_is_a_pattern_or_refused_shortly(text: str) -> None:
    try:
        pattern = parse(text)
    except PatternError as error:
        assert len(str(error)) < 1500 and error.fault.column is not None
    else:
        assert parse(str(pattern)) == pattern
        assert all(unicodedata.normalize("NFC", name) == name for name in pattern.symbols)
