"""The pattern language: known answers of the papers, words, printing, limits."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb.design import DesignError, Pattern, PatternError, parse
from facade_nb.design.pattern import Alt, Concat, Count, Empty, Glyph, Mirror, Sym

from ..work import calls
from .strategies import patterns, spellings_of


def words(text: str, **counters: int) -> list[str]:
    """Words as texts, letters without blanks."""
    return ["".join(map(str, word)) for word in parse(text).words(counters)]


TABLE_1 = {
    "": "E k G E k G",
    "~": "E k G G' k' E' E k G G' k' E'",
    "|": "E k G E k G G' k' E' G' k' E'",
    ".": "E k G k' E' E k G k' E'",
    ":": "E k G G' k' E k G G' k' E'",
    "@": "E k G k' E k G k' E'",
}


@pytest.mark.parametrize(("mode", "result"), TABLE_1.items())
def test_table_1(mode: str, result: str) -> None:
    assert words(f"(EkG)^{mode}2") == [result.replace(" ", "")]
    assert words(f"(EkG)^{mode}k", k=2) == [result.replace(" ", "")]
    assert words(f"(EkG)^{mode}{{floors}}", floors=2) == [result.replace(" ", "")]


@pytest.mark.parametrize(("glyph", "mode"), [("·", "."), ("∘", ":"), ("⊙", "@")])
def test_glyphs_of_the_paper_are_read_and_printed_in_ascii(glyph: str, mode: str) -> None:
    assert str(parse(f"(EkG)^{glyph}k")) == f"(EkG)^{mode}k"


@pytest.mark.parametrize("mode", TABLE_1)
def test_count_zero_is_the_empty_word_in_every_mode(mode: str) -> None:
    assert words(f"A(BC)^{mode}0D") == words(f"A(BC)^{mode}-kD", k=0) == ["AD"]


@pytest.mark.parametrize("mode", TABLE_1)
def test_a_negative_value_mirrors_the_base_in_every_mode(mode: str) -> None:
    expected = words(f"((EkG)')^{mode}2")
    assert (
        words(f"(EkG)^{mode}-2") == words(f"(EkG)^{mode}-k", k=2) == words(f"(EkG)^{mode}k", k=-2) == expected
    )
    assert words(f"(EkG)^{mode}{{-floors}}", floors=2) == expected
    assert words(f"(EkG)^{mode}-k", k=-2) == words(f"(EkG)^{mode}2")


@given(st.sampled_from("~|.:@"), st.integers(2, 5), st.integers(1, 5))
def test_modes_join_copies_and_mirror_images_at_shared_letters(mode: str, length: int, count: int) -> None:
    """Built seam by seam instead of by formula: at a pivot the mirrored twin of the shared letter is dropped."""
    base = [(letter, False) for letter in "ABCDE"[:length]]
    image = [(letter, True) for letter, _ in reversed(base)]
    pieces = [base] * count + [image] * count if mode == "|" else [base, image] * count
    word: list[tuple[str, bool]] = []
    for piece in pieces:
        if word and mode in (".", "@") and piece is image:
            piece = piece[1:]
        elif word and mode in (":", "@") and piece is base:
            word.pop()
        word.extend(piece)
    made = parse(f"({''.join(letter for letter, _ in base)})^{mode}{count}").words({})
    assert [[(glyph.symbol, glyph.mirrored) for glyph in w] for w in made] == [word]


def test_equations_1_to_3() -> None:
    assert [words("xm; m := A(BA)^k", k=k)[0] for k in range(3)] == ["xA", "xABA", "xABABA"]


def test_equations_4_to_6() -> None:
    text = "yBmAm^-1By; m := (AB)^k"
    assert words(text, k=1) == ["yBABAB'A'By"]
    assert words(text, k=2) == ["yBABABAB'A'B'A'By"]
    (word,) = parse(text).words({"k": 1})
    assert (
        "".join(glyph.symbol.lower() if glyph.transparent else glyph.symbol for glyph in word) == "ybABaBAby"
    )
    assert [glyph.origin for glyph in word] == [
        None,
        None,
        *[("m", 0)] * 2,
        None,
        *[("m", 1)] * 2,
        None,
        None,
    ]
    assert words(text.replace("m^-1", "m'"), k=2) == words(text, k=2)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("A|B", ["A", "B"]),
        ("A . B · C", ["ABC"]),
        ("A.(B|C)", ["AB", "AC"]),
        ("A(B|C)D|E", ["ABD", "ACD", "E"]),
        ("(A|B)^2", ["AA", "BB"]),
        ("(A|B)(A|B)", ["AA", "AB", "BA", "BB"]),
        ("A|A|B|A", ["A", "B"]),
        ("(A|ε)(A|ε)", ["AA", "A", ""]),
        ("ε", [""]),
        ("()", [""]),
        ("A()B", ["AB"]),
        ("(AB)'", ["B'A'"]),
        ("(AB')'", ["BA'"]),
        ("A''", ["A"]),
        ("(AB)^2'", ["B'A'B'A'"]),
        ("(AB)'^2", ["B'A'B'A'"]),
        ("((AB)^2C)^2", ["ABABCABABC"]),
        ("A^2^3", ["AAAAAA"]),
        ("(A^~1)^2", ["AA'AA'"]),
        ("(AB)^~-1", ["B'A'AB"]),
        ("b2Δ<front door>A10", ["b2Δ<front door>A10"]),
        ("<A><ε>", ["A<ε>"]),
        ("A^3B", ["AAAB"]),
        ("A^{3}B^{-2}", ["AAAB'B'"]),
        ("A’B′", ["A'B'"]),
        ("A^−1", ["A'"]),
        ("m m; m := A|B", ["AA", "BB"]),
        ("m n; m := A|B; n := C|D", ["AC", "AD", "BC", "BD"]),
        ("(m|n); m := A|B; n := C", ["A", "B", "C"]),
        ("f g f'; f := GD; g := A", ["GDAD'G'"]),
        ("(xm)'; m := AB'", ["BA'x'"]),
        ("(x|m)^2; m := A|B", ["xx", "AA", "BB"]),
        ("m^2m'; m := AB", ["ABABB'A'"]),
        ("(mE)^.1; m := AB", ["ABEB'A'"]),
        ("(Em)^.1; m := AB", ["EABE'"]),
    ],
)
def test_words(text: str, expected: list[str]) -> None:
    assert words(text) == expected


def test_a_counter_may_stand_in_fixed_counts() -> None:
    assert words("((AB)^k)^-1", k=2) == ["B'A'B'A'"]
    assert words("m^2; m := A^k", k=2) == ["AAAA"]
    assert words("(A^2)^k", k=2) == ["AAAA"]


def test_instances_of_a_counter_share_its_value() -> None:
    assert words("a^kb^kc^k", k=2) == ["aabbcc"]


def test_names_are_composed_without_shifting_columns() -> None:
    decomposed = "E\u0301B*"
    assert parse("E\u0301B").symbols == ("É", "B")
    with pytest.raises(PatternError) as error:
        parse(decomposed)
    assert error.value.fault.column == 4
    assert error.value.fault.excerpt == "E\u0301B*\n  ^"


def test_only_unsubstituted_letters_of_a_control_pattern_are_transparent() -> None:
    (plain,) = parse("AB").words({})
    assert plain == (Glyph("A"), Glyph("B"))
    (word,) = parse("Am; m := A").words({})
    assert word == (Glyph("A", transparent=True), Glyph("A"))


def test_what_a_pattern_says_of_itself() -> None:
    pattern = parse("y B^n m A m^-1; m := (AB|C)^k D^{floors}")
    assert pattern.counters == ("n", "k", "floors")
    assert pattern.symbols == ("y", "B", "A", "C", "D")
    assert pattern.placeholders == {"y", "A", "B"}
    assert pattern.solids == {"A", "B", "C", "D"}
    assert pattern.substituted == ("m",)
    plain = parse("AB")
    assert (plain.placeholders, plain.solids) == (frozenset(), {"A", "B"})


def test_spans_say_where_names_stand() -> None:
    pattern = parse("k^k m  # A\n\tm := A <k>^{k}")
    assert pattern.spans == {"k": ((1, 1), (2, 9)), "m": ((1, 5), (2, 2)), "A": ((2, 7),)}
    assert pattern.counter_spans == {"k": ((1, 3), (2, 13))}


def test_statements_comments_and_blanks_are_free() -> None:
    pattern = parse("m n")
    assert parse("\n ; # a comment; m := (\r\n  m\tn  # more\n\n;;") == pattern
    assert parse("m n\n\nm := A ;\n n := B;") == parse("mn;m:=A;n:=B")
    assert parse("A ^ ~ - k") == parse("A^~-k")


def test_tree() -> None:
    pattern = parse("A(B|ε)'^:-k; A := C")
    body = Mirror(Alt((Sym("B"), Empty())))
    assert pattern.control == Concat((Sym("A"), Count(body, ":", True, "k")))
    assert pattern.substitutions == (("A", Sym("C")),)


@given(patterns())
def test_printed_trees_are_read_as_the_same_pattern(pattern: Pattern) -> None:
    again = parse(str(pattern))
    assert again == pattern
    assert str(again) == str(pattern)


@given(st.data())
def test_every_spelling_is_read_as_the_same_pattern(data: st.DataObject) -> None:
    pattern = data.draw(patterns())
    assert parse(data.draw(spellings_of(str(pattern)))) == pattern


@given(patterns(), st.integers(-2, 3))
def test_printed_patterns_have_the_same_words(pattern: Pattern, value: int) -> None:
    counters = dict.fromkeys(pattern.counters, value)
    assert parse(str(pattern)).words(counters) == pattern.words(counters)


@given(patterns(), st.integers(-2, 3))
def test_words_have_only_the_symbols_told(pattern: Pattern, value: int) -> None:
    listed = pattern.words(dict.fromkeys(pattern.counters, value))
    glyphs = {glyph for word in listed for glyph in word}
    assert {glyph.symbol for glyph in glyphs} <= set(pattern.symbols)
    assert {glyph.symbol for glyph in glyphs if glyph.transparent} <= pattern.placeholders
    assert {glyph.symbol for glyph in glyphs if not glyph.transparent} <= pattern.solids
    assert len(set(listed)) == len(listed) > 0


@given(st.text(alphabet="ABmk12()|.'^~:@-{}<>;#=ε·⊙\n \tÉ\u0301²*", max_size=30) | st.text(max_size=20))
def test_any_text_is_a_pattern_or_a_pattern_error(text: str) -> None:
    try:
        pattern = parse(text)
    except PatternError as error:
        fault = error.fault
        assert fault.message
        lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        assert fault.line is not None and fault.column is not None
        assert 1 <= fault.line <= len(lines)
        assert 1 <= fault.column <= len(lines[fault.line - 1]) + 1
        assert fault.excerpt.count("\n") == 1 and fault.excerpt.endswith("^")
        return
    assert parse(str(pattern)) == pattern


@pytest.mark.parametrize(
    ("text", "counters", "message"),
    [
        ("(AB)^k", {"k": 10_001}, "a word would have 20,002 letters; at most 20,000 are possible"),
        ("(AB)^~k", {"k": 10**30}, "letters; at most 20,000 are possible"),
        ("A^2000^2000", {}, "at most 20,000 are possible"),
        ("A^20000B", {}, "a word would have 20,001 letters"),
        ("m^k; m := A^20000", {"k": 2}, "a word would have 40,000 letters"),
        ("(A|B)" * 40, {}, "over 20,000 words"),
        ("m|n; m := " + "(A|B)" * 14 + "; n := " + "(A|B)" * 14, {}, "over 20,000 words"),
        ("(A|B)^4000" * 9, {}, "letters"),
        ("A^k", {"n": 1}, "counter 'k' has no value"),
    ],
)
def test_words_out_of_all_bounds_are_refused_at_once(
    text: str, counters: dict[str, int], message: str
) -> None:
    with pytest.raises(DesignError, match=message):
        parse(text).words(counters)


def test_the_empty_word_may_be_counted_without_end() -> None:
    assert words("ε^k", k=10**9) == [""]


def test_reading_is_quick() -> None:
    texts = [f"ZYt(AB)^{{k}}C|(DE)^~2 F D(ED)^m F D(ED)^n'; t := XW^{i}" for i in range(60)]
    parse(texts[0])
    # about half a millisecond for some 2,400 calls, for each text anew
    assert all(calls(lambda: parse(text)) < 5_000 for text in texts[1:])  # noqa: B023
    assert calls(lambda: parse(texts[0])) < 10
    assert parse(texts[0]) is parse(texts[0])
