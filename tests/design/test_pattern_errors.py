"""What is said of a faulty pattern text, and where the caret stands."""

from __future__ import annotations

import pytest

from facade_nb.design import PatternError, parse

OPERAND = "expected a symbol, '(' or ε"
OPERATOR = "expected an operator, a symbol, ';' or the end"
COUNT = "expected a number, a counter or a reflection mode (~ | . : @) after '^'"
CONTROL_FIRST = "expected the control pattern first, then ';' or a new line and the substitutions; found ':='"

# text, line, column, message
FAULTS = [
    ("", 1, 1, f"{OPERAND}; found the end of the text"),
    (" \n# only a comment", 1, 1, f"{OPERAND}; found the end of the text"),
    ("A|", 1, 3, f"{OPERAND} after '|'; found the end of the text"),
    ("|A", 1, 1, f"{OPERAND}; found '|'"),
    ("(A|)", 1, 4, f"{OPERAND} after '|'; found ')'"),
    ("A||B", 1, 3, f"{OPERAND} after '|'; found '|'"),
    ("A . ", 1, 4, f"{OPERAND} after '.'; found the end of the text"),
    ("A..B", 1, 3, f"{OPERAND} after '.'; found '.'"),
    ("·A", 1, 1, f"{OPERAND}; found '·'"),
    ("'A", 1, 1, f'{OPERAND}; found "\'"'),
    ("^2", 1, 1, f"{OPERAND}; found '^'"),
    ("2A", 1, 1, f"{OPERAND}; found '2'"),
    ("A B 2", 1, 5, f"{OPERATOR}; found '2'; a count is written with '^', such as A^2"),
    ("(A", 1, 1, "this '(' is not closed: expected ')' before the end of the text"),
    ("A(B(C)", 1, 2, "this '(' is not closed: expected ')' before the end of the text"),
    ("A((B)C", 1, 2, "this '(' is not closed: expected ')' before the end of the text"),
    ("(A\nB)", 1, 1, "this '(' is not closed: expected ')' before the end of the line"),
    ("x(m; m := A", 1, 2, "this '(' is not closed: expected ')' before ';'"),
    ("(A|", 1, 4, f"{OPERAND} after '|'; found the end of the text"),
    ("A)", 1, 2, "this ')' has no '(' before it: expected an operator, a symbol or the end; found ')'"),
    ("(A))B", 1, 4, "this ')' has no '(' before it: expected an operator, a symbol or the end; found ')'"),
    (")", 1, 1, f"{OPERAND}; found ')' (and no '(' stands before it)"),
    (
        "(A=B)",
        1,
        3,
        "expected an operator, a symbol, ')' or the end; found '='; a substitution is written with ':='",
    ),
    ("A^", 1, 3, f"{COUNT}; found the end of the text"),
    ("A^^2", 1, 3, f"{COUNT}; found '^'"),
    ("A^(k)", 1, 3, f"{COUNT}; found '('"),
    ("A^ε", 1, 3, f"{COUNT}; found 'ε'"),
    ("A^;m:=B", 1, 3, f"{COUNT}; found ';'"),
    ("A^~", 1, 4, "expected a number or a counter after '~'; found the end of the text"),
    ("A^~~k", 1, 4, "expected a number or a counter after '~'; found '~'"),
    ("A^-", 1, 4, "expected a number or a counter after '-'; found the end of the text"),
    (
        "A^-~k",
        1,
        4,
        "expected a number or a counter after '-'; found '~'",
    ),
    ("A^{k", 1, 3, "this '{' is not closed: expected '}' before the end of the line"),
    ("A^k}", 1, 4, f"{OPERATOR}; found '}}'"),
    ("A{k}", 1, 2, f"{OPERATOR}; found '{{k}}'"),
    ("A^{}", 1, 3, "expected a number or a counter between '{' and '}'; found nothing"),
    ("A^{-}", 1, 3, "expected a number or a counter between '{' and '}'; found nothing"),
    ("A^-{-k}", 1, 4, "expected one minus sign, before the brace or in it; found two"),
    (
        "A^{~k}",
        1,
        3,
        "a counter's name does not begin with '~'; a mode stands before the brace, as in ^~{floors}",
    ),
    ("A^20001", 1, 3, "expected a count of at most 20,000; found 20001"),
    ("A^" + "9" * 5000, 1, 3, "expected a count of at most 20,000; found 999999999999"),
    ("A<win\nB", 1, 2, "this '<' is not closed: expected '>' before the end of the line"),
    ("A>", 1, 2, f"{OPERATOR}; found '>'"),
    ("<>", 1, 1, "expected a name between '<' and '>': a name has at least one character"),
    ("< >", 1, 1, "expected a name between '<' and '>': a name has at least one character"),
    ("<*>", 1, 1, "expected a name between '<' and '>': '*' is the wildcard of shapes"),
    ("A~B", 1, 2, f"{OPERATOR}; found '~'; a reflection mode stands after '^', such as A^~k"),
    ("A*", 1, 2, f"{OPERATOR}; found '*'; a repetition is written with a count, such as A^k"),
    ("A?", 1, 2, f"{OPERATOR}; found '?'; what may be left out is written as a choice with ε, such as (A|ε)"),
    ("A,B", 1, 2, f"{OPERATOR}; found ','; symbols stand side by side, such as AB; choices are written A|B"),
    (
        "front_door",
        1,
        6,
        f"{OPERATOR}; found '_'; longer names stand in angle brackets, such as <front_door>",
    ),
    (
        "A²",
        1,
        2,
        f"{OPERATOR}; found '²' (U+00B2, superscript two); a count is written with '^', such as A^2",
    ),
    ("½", 1, 1, f"{OPERAND}; found '½'; only letters name symbols, other signs stand in angle brackets"),
    ("A…", 1, 2, f"{OPERATOR}; found '…'; only letters name symbols, other signs stand in angle brackets"),
    ("♥", 1, 1, f"{OPERAND}; found '♥'; only letters name symbols, other signs stand in angle brackets"),
    (
        "(\u0301",
        1,
        2,
        f"{OPERAND} after '('; found U+0301 (combining acute accent); \"'\" was probably meant",
    ),
    ("A (\x07)", 1, 4, f"{OPERAND} after '('; found U+0007 (unnamed character)"),
    (
        "A\u200bB",
        1,
        2,
        f"{OPERATOR}; found U+200B (zero width space); it is not seen: take it out",
    ),
    ("A # \ud800", 1, 5, f"{OPERATOR}; found U+D800 (unnamed character)"),
    ("m := A", 1, 3, CONTROL_FIRST),
    ("x m := A", 1, 5, CONTROL_FIRST),
    ("xm; m := A n := B", 1, 14, "expected ';' or a new line before the next substitution; found ':='"),
    ("xm; m :=", 1, 9, f"{OPERAND} after ':='; found the end of the text"),
    ("xm; m := ;", 1, 10, f"{OPERAND} after ':='; found ';'"),
    ("xm; m :=\nA", 1, 9, f"{OPERAND} after ':='; found the end of the line"),
    ("xm; := A", 1, 5, "expected a substitution, such as m := AB; found ':='"),
    ("xm; (m) := A", 1, 5, "expected a substitution, such as m := AB; found '('"),
    (
        "xm; m = A",
        1,
        7,
        "expected ':=' after 'm', for what follows the control pattern is a substitution; found '='; "
        "a substitution is written with ':='",
    ),
    (
        "A\nB",
        2,
        2,
        "expected ':=' after 'B', for what follows the control pattern is a substitution; found the end of the text",
    ),
    ("xm; m := A; m := B", 1, 13, "'m' is already substituted; a symbol has one content"),
    ("xm; n := A", 1, 5, "expected a symbol of the control pattern ('x', 'm'); found 'n'"),
    (
        "x<door>; <Door> := A",
        1,
        10,
        "expected a symbol of the control pattern ('x', 'door'); found 'Door'; did you mean 'door'?",
    ),
    ("ε; m := A", 1, 4, "expected a symbol of the control pattern (none, it has no symbols); found 'm'"),
    (
        "xm; m := AmB",
        1,
        11,
        "expected other symbols; the content of 'm' uses 'm', which is substituted in this pattern itself",
    ),
    (
        "mn; m := A\nn := Bm",
        2,
        7,
        "expected other symbols; the content of 'n' uses 'm', which is substituted in this pattern itself",
    ),
    ("(A^kB)^m", 1, 4, "counter 'k' stands inside counter 'm': expected a number for one of them"),
    ("A^k^k", 1, 3, "counter 'k' stands inside counter 'k': expected a number for one of them"),
    (
        "(A(B^{floors}|C)^2)^m",
        1,
        6,
        "counter 'floors' stands inside counter 'm': expected a number for one of them",
    ),
    (
        "xm; m := ((AB)^k)^n",
        1,
        16,
        "counter 'k' stands inside counter 'n': expected a number for one of them",
    ),
    (
        "x(ym)^k; m := (AB)^n",
        1,
        4,
        "'m' is repeated by counter 'k', but its content has counter 'n': a counter cannot stand inside a counter",
    ),
    (
        "m f\n  m^2^k\nm := A^n".replace("\n  ", " "),
        1,
        5,
        "'m' is repeated by counter 'k', but its content has counter 'n': a counter cannot stand inside a counter",
    ),
    (
        "(" * 60 + "A" + ")" * 60,
        1,
        61,
        "nested too deeply: at most 50 levels of groups and postfix operators are possible",
    ),
    (
        "A" + "'" * 51,
        1,
        1,
        "nested too deeply: at most 50 levels of groups and postfix operators are possible",
    ),
    (
        "# kommentar\r\nÄB\r\t漢 (C",
        3,
        4,
        "expected ':=' after '漢', for what follows the control pattern is a substitution; found '('",
    ),
    ("AB  # first\n\n; m := A  # second\nn := (", 4, 7, f"{OPERAND} after '('; found the end of the text"),
    (
        "AB  # first\n\n; m := A  # second",
        3,
        3,
        "expected a symbol of the control pattern ('A', 'B'); found 'm'",
    ),
]


@pytest.mark.parametrize(("text", "line", "column", "message"), FAULTS)
def test_faults_are_told_with_their_place(text: str, line: int, column: int, message: str) -> None:
    with pytest.raises(PatternError) as error:
        parse(text)
    fault = error.value.fault
    assert (fault.line, fault.column, fault.message) == (line, column, message)
    assert fault.place == ""
    assert str(error.value).startswith(f"line {line}, column {column}: {message}\n")


@pytest.mark.parametrize(
    ("text", "excerpt"),
    [
        ("A(B", "A(B\n ^"),
        ("# c\n\tA\tB%", "\tA\tB%\n\t \t ^"),
        ("漢字^", "漢字^\n     ^"),
        ("E\u0301*", "E\u0301*\n ^"),
        ("A\x07", "A\ufffd\n ^"),
        ("A\r\nB^\r\nC", "B^\n ^"),
        ("A" * 100 + "*", "…" + "A" * 44 + "*\n" + " " * 45 + "^"),
        ("*" + "A" * 100, "*" + "A" * 87 + "…\n^"),
    ],
)
def test_the_caret_stands_under_the_place(text: str, excerpt: str) -> None:
    with pytest.raises(PatternError) as error:
        parse(text)
    assert error.value.fault.excerpt == excerpt


def test_an_overlong_text_is_refused() -> None:
    with pytest.raises(PatternError, match="a pattern's text has at most 20,000 characters; found 20,001"):
        parse("A" * 20_001)


def test_deep_nesting_is_a_fault_not_a_crash() -> None:
    with pytest.raises(PatternError, match="nested too deeply"):
        parse("(" * 9_999 + ")" * 9_999)
    with pytest.raises(PatternError, match="expected a symbol"):
        parse("(" * 19_999)
