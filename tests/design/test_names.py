"""Names of any script, signs from elsewhere, and what stands in braces."""

from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb.design import Design, DesignError, PatternError, parse
from facade_nb.design.lookalikes import described, meant
from facade_nb.design.names import is_identifier, nfc
from facade_nb.design.text import spell

FORMAT = "facade-nb/design/1"


def fault(text: str) -> tuple[int | None, str]:
    """Column and message of a faulty text."""
    with pytest.raises(PatternError) as error:
        parse(text)
    return error.value.fault.column, error.value.fault.message


BARE = ["A", "b2", "Δ", "漢", "É", "कि", "กู่", "שָ", "b२", "ㄱ", "ʌ"]
NOT_BARE = ["ε", "window", "front door", "ˆ", "ª", "𝔣", "ⁿ", "A_1", "2", "♥", "ᄒ", "ℓ"]


@pytest.mark.parametrize("name", BARE)
def test_a_letter_of_any_script_with_its_marks_is_one_symbol(name: str) -> None:
    """facade_nb/widgets/test/solver/names.test.ts has the same list."""
    for form in ("NFC", "NFD"):
        assert parse(unicodedata.normalize(form, name)).symbols == (nfc(name),)
        assert parse("X" + unicodedata.normalize(form, name) + "X").symbols == ("X", nfc(name))
    assert spell(nfc(name)) == nfc(name)


@pytest.mark.parametrize("name", NOT_BARE)
def test_other_names_stand_in_angle_brackets(name: str) -> None:
    assert spell(name) == f"<{name}>"
    assert parse(f"<{name}>").symbols == (name,)


def test_korean_syllables_stored_letter_by_letter_are_one_symbol() -> None:
    assert parse("\u1112\u1161\u11ab\u1100\u1173\u11af").symbols == ("한", "글")
    assert parse("\ud558\u11ab").symbols == ("한",)


@pytest.mark.parametrize("name", ["é", "ชั้น", "मंज़िल", "קוֹמָה", "étages", "階", "n2", "_k", "of bays"])
def test_counters_are_named_in_any_script_and_compared_composed(name: str) -> None:
    for form in ("NFC", "NFD"):
        assert parse(f"A^{{{unicodedata.normalize(form, name)}}}").counters == (nfc(name),)
    design = Design.from_dict(
        {
            "format": FORMAT,
            "symbols": {"A": {"size": 1}},
            "patterns": {"a": f"A^{{{unicodedata.normalize('NFD', name)}}}"},
            "counters": {name: {"max": 3}},
        }
    )
    assert design.counters[nfc(name)].max == 3


@pytest.mark.parametrize(
    "name",
    [
        "2k",
        "k+1",
        "n/2",
        "k*2",
        "k·2",
        "k-1",
        "k 2",
        "k.1",
        "(k)",
        "k'",
        "k^2",
        "2 k",
        "k,m",
        "k=2",
        "k!",
        "♥",
    ],
)
def test_nothing_is_computed_in_braces(name: str) -> None:
    column, message = fault(f"A^{{k}}B^{{{name}}}")
    assert column == 8
    assert message == (
        f"expected a number or a counter; found {name!r}: a counter's name is made of letters, digits and _, and "
        "begins with a letter, such as {floors}; nothing is computed in it: 2k copies of B are (B^2)^k, k + 1 are B^k B"
    )
    with pytest.raises(DesignError, match="nothing is computed in it"):
        Design.from_dict({"format": FORMAT, "counters": {name: {}}})


def test_and_what_is_proposed_instead_is_read() -> None:
    assert ["".join(map(str, word)) for word in parse("(B^2)^k").words({"k": 2})] == ["BBBB"]
    assert ["".join(map(str, word)) for word in parse("B^k B").words({"k": 2})] == ["BBB"]


# text, column, the sign that was meant
SIGNS = [
    ("A(BA)ˆk", 6, "^"), ("A(BA)＾k", 6, "^"), ("A(BA)\u0302k", 6, "^"), ("(A｜B)", 3, "|"), ("(A∣B)", 3, "|"),
    ("(A¦B)", 3, "|"), ("(A│B)", 3, "|"), ("A（B)", 2, "("), ("(A）", 3, ")"), ("xm; m :＝ A", 8, "="),
    ("xm； m := A", 3, ";"), ("xm\u037e m := A", 3, ";"), ("xm; m ：= A", 7, ":"), ("xm; m ≔ A", 7, ":="),
    ("A‘", 2, "'"), ("A`", 2, "'"), ("A´", 2, "'"), ("Aʹ", 2, "'"), ("A\u0374", 2, "'"), ("A＇", 2, "'"),
    ("A^˜k", 3, "~"), ("A^～k", 3, "~"), ("A^∼k", 3, "~"), ("A^．k", 3, "."), ("A^•k", 3, "."), ("A・B", 2, "."),
    ("A^：k", 3, ":"), ("A^＠k", 3, "@"), ("A^–1", 3, "-"), ("A^—k", 3, "-"), ("A^－k", 3, "-"), ("A^‐k", 3, "-"),
    ("A^｛k}", 3, "{"), ("A^{k｝", 5, "}"), ("〈door>", 1, "<"), ("<door〉", 6, ">"), ("＜door>", 1, "<"),
    ("⟨door⟩", 1, "<"), ("<door⟩", 6, ">"), ("A＃", 2, "#"), ("Ａ", 1, "A"), ("Bｋ", 2, "k"), ("A１", 2, "1"),
    ("A^２", 3, "2"), ("𝐀", 1, "A"), ("ｱ", 1, "ア"), ("A₂", 2, "2"), ("A∅", 2, "ε"), ("A^º", 3, "o"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "column", "sign"), SIGNS)
def test_a_sign_from_elsewhere_is_named_with_the_one_that_was_meant(
    text: str, column: int, sign: str
) -> None:
    found, message = fault(text)
    assert found == column
    quotes = '"' if sign == "'" else "'"
    assert message.endswith(f"; {quotes}{sign}{quotes} was probably meant")
    assert f"(U+{ord(text[column - 1]):04X}" in message or f"U+{ord(text[column - 1]):04X} (" in message


@pytest.mark.parametrize(
    ("text", "column", "hint"),
    [
        ("A²", 2, "a count is written with '^', such as A^2"),
        ("Aᵏ", 2, "a count is written with '^', such as A^k"),
        ("A×2", 2, "a repetition is written with a count, such as A^k"),
        ("A∗", 2, "a repetition is written with a count, such as A^k"),
        ("A，B", 2, "symbols stand side by side, such as AB; choices are written A|B"),
        ("“A”", 1, "a mirrored instance is written with ', such as A'"),
        ("x m; m ＝ A", 8, "a substitution is written with ':='"),
        ("𝔣", 1, "a mirrored f is written f'"),
        ("A^’", 3, "it is read as ', which stands after what it mirrors"),
        ("A\u200dB", 2, "it is not seen: take it out"),
        ("\ufeffA", 1, "it is not seen: take it out"),
        ("A\ufe0f", 2, "it is not seen: take it out"),
        ("A☃", 2, "only letters name symbols, other signs stand in angle brackets"),
        ("A【B】", 2, "groups are written with ( )"),
    ],
)
def test_other_signs_are_told_with_what_is_written_instead(text: str, column: int, hint: str) -> None:
    found, message = fault(text)
    assert found == column
    assert message.endswith(f"; {hint}")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("<Ａ>", "'Ａ' (U+FF21, fullwidth latin capital letter a) stands in it; 'A' was probably meant"),
        ("<a⟩b>", "'⟩' (U+27E9, mathematical right angle bracket) stands in it; '>' was probably meant"),
        ("<a\u200bb>", "a name has no characters that are not seen (U+200B, zero width space)"),
        ("<\u0301a>", "a name does not begin with a mark (U+0301, combining acute accent)"),
        ("A^{ｋ}", "'ｋ' (U+FF4B, fullwidth latin small letter k) stands in it; 'k' was probably meant"),
        ("A^{２}", "'２' (U+FF12, fullwidth digit two) stands in it; '2' was probably meant"),
        ("A^{kˆ2}", "'ˆ' (U+02C6, modifier letter circumflex accent) stands in it; '^' was probably meant"),
        ("A^{k²}", "'²' (U+00B2, superscript two) stands in it; '2' was probably meant"),
        ("A^{k\u2060}", "a name has no characters that are not seen (U+2060, word joiner)"),
    ],
)
def test_names_in_brackets_and_braces_hold_no_other_form_of_a_sign(text: str, found: str) -> None:
    assert fault(text)[1].split(": ", 1)[1] == found


def test_what_is_read_today_is_read_still() -> None:
    for text, symbols in [
        ("A’B′", ("A", "B")),
        ("A · B", ("A", "B")),
        ("(AB)^⊙2", ("A", "B")),
        ("A^−1", ("A",)),
    ]:
        assert parse(text).symbols == symbols
    assert parse("<a;b#c><♥><ground floor><m²>").symbols == ("a;b#c", "♥", "ground floor", "m²")


@given(st.characters(min_codepoint=0x80))
def test_no_sign_but_a_letter_is_a_symbol(sign: str) -> None:
    """Whatever stands alone is a letter, or it is refused in a short text with a caret."""
    try:
        symbols = parse(f"A {sign} B").symbols
    except PatternError as error:
        assert len(str(error)) < 400 and str(error).endswith("^")
        return
    letters = [own for own in symbols if own not in ("A", "B")]
    assert all(unicodedata.category(own[0])[0] == "L" for own in letters)
    assert all(
        not meant(own[0]) or unicodedata.decomposition(own[0]).startswith("<compat>") for own in letters
    )


@given(st.characters())
def test_what_is_meant_is_one_of_the_language(sign: str) -> None:
    assert meant(sign) != sign
    assert described(sign).startswith("U+")


def test_identifiers() -> None:
    for name in ("k", "n2", "é", "e\u0301", "नाम", "_a"):
        assert is_identifier(name)
    for name in ("", "2k", "k+1", "of bays", "\u0301a", "♥"):
        assert not is_identifier(name)


def test_names_of_patterns_layers_and_groups_are_compared_composed() -> None:
    half = "\u0301"
    design = Design.from_dict(
        {
            "format": FORMAT,
            "symbols": {"A": {"size": 1}},
            "patterns": {f"facade{half}": "A"},
            "layers": [
                {
                    "name": f"e{half}",
                    "x": {"pattern": "facadé", "group": "é"},
                    "y": {"pattern": f"facade{half}"},
                }
            ],
        }
    )
    layer = design.layers[0]
    assert (layer.name, layer.x.pattern, layer.y.pattern, layer.x.group) == ("é", "facadé", "facadé", "é")
    with pytest.raises(DesignError, match="expected a name of its own"):
        Design.from_dict(
            design.to_dict()
            | {"layers": [*design.to_dict()["layers"], {**design.to_dict()["layers"][0], "name": f"e{half}"}]}
        )
