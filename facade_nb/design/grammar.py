"""The grammar of patterns and what is said where a text breaks it (docs/patterns.md)."""

from __future__ import annotations

from functools import lru_cache
from unicodedata import category
from unicodedata import name as unicode_name

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken
from lark.parsers.lalr_interactive_parser import InteractiveParser

from .errors import PatternError
from .text import fault_at

__all__ = ["GRAMMAR", "read_tree", "refuse", "show"]

# A letter may carry combining marks; Python's `re` has no class for marks, so the lexer takes every sign that is
# neither a word character nor an operator, and `reading` looks at it.
_MARKS = r"[^\w\s\x00-\x7f·∘⊙’′−]"

GRAMMAR = rf"""
start: _SEP? alternation (_SEP substitution)* _SEP?
substitution: (SYMBOL | LONG) _ASSIGN alternation
?alternation: sequence (BAR sequence)*
?sequence: term (DOT? term)*
?term: atom (MIRROR | count)*
?atom: SYMBOL | LONG | EPSILON | group
group: _LPAR alternation? _RPAR
count: _CARET (MODE | BAR | DOT)? MINUS? (NUMBER | SYMBOL | BRACED)

EPSILON.2: /ε(?!\d|{_MARKS})/
SYMBOL: /[^\W\d_]{_MARKS}*\d*/
LONG: /<[^<>\r\n]*>/
BRACED: /\{{[^{{}}\r\n]*\}}/
NUMBER: /\d+/
MIRROR: /['’′]/
BAR: "|"
DOT: "." | "·"
MODE: /:(?!=)|[~@∘⊙]/
MINUS: "-" | "−"
_ASSIGN: ":="
_LPAR: "("
_RPAR: ")"
_CARET: "^"
_SEP: /[;\r\n](?:[\s;]|#[^\r\n\ud800-\udfff]*)*/
%ignore /[^\S\r\n]+/
%ignore /#[^\r\n\ud800-\udfff]*/
"""

_OPERAND = "a symbol, '(' or ε"
_HINTS = {
    "*": "a repetition is written with a count, such as A^k",
    "+": "a repetition is written with a count, such as A^k",
    "?": "what may be left out is written as a choice with ε, such as (A|ε)",
    "=": "a substitution is written with ':='",
    "[": "groups are written with ( )",
    "]": "groups are written with ( )",
    "_": "longer names stand in angle brackets, such as <front_door>",
    ",": "symbols stand side by side, such as AB; choices are written A|B",
    "/": "choices are written A|B",
    "~": "a reflection mode stands after '^', such as A^~k",
    "@": "a reflection mode stands after '^', such as A^@k",
    ":": "a reflection mode stands after '^', such as A^:k; a substitution is written with ':='",
    "-": "a minus sign stands after '^', such as A^-1; longer names stand in angle brackets",
}


@lru_cache(maxsize=1)
def _parser() -> Lark:
    return Lark(GRAMMAR, parser="lalr", lexer="basic")


def read_tree(text: str) -> Tree[Token]:
    """The parse tree of a pattern text. Raises `PatternError` with line, column and caret."""
    try:
        return _parser().parse(text)
    except UnexpectedInput:
        pass
    raise _explain(text)


def refuse(text: str, offset: int, message: str) -> PatternError:
    """The error of a text that is at fault at an offset."""
    return PatternError(fault_at(text, offset, message))


def _explain(text: str) -> PatternError:
    """Read a faulty text again, one token at a time, and say what stops it where."""
    lexer = _parser().parse_interactive(text)
    tokens: list[Token] = []
    try:
        for token in lexer.iter_parse():
            tokens.append(token)
        offset, found = max((token.end_pos or 0 for token in tokens if token.type != "_SEP"), default=0), ""
    except UnexpectedCharacters as error:
        offset = error.pos_in_stream or 0
        found = text[offset]
    except UnexpectedToken as error:
        tokens.pop()
        offset, found = error.token.start_pos or 0, str(error.token)
    # The parser has already reduced its stack for the token that it then refused: make one that has not seen it.
    parser = _parser().parse_interactive("")
    for token in tokens:
        parser.feed_token(token)
    return refuse(text, *_message(offset, _found_kind(text, offset, found), parser, tokens))


def _found_kind(text: str, offset: int, found: str) -> str:
    """What stands at the offset: a token's text, a newline for the end of a line, empty for the text's end."""
    if found[:1] in ("\r", "\n"):
        return "\n" if text[offset:].strip() else ""
    return ";" if found.startswith(";") else found


def _message(offset: int, found: str, parser: InteractiveParser, tokens: list[Token]) -> tuple[int, str]:
    """Where to point, and what to say."""
    if found in ("<", "{"):
        closing = {"<": ">", "{": "}"}[found]
        return offset, f"this {found!r} is not closed: expected {closing!r} before the end of the line"
    opened: list[int] = []
    for token in tokens:
        if token.type == "_LPAR":
            opened.append(token.start_pos or 0)
        elif token.type == "_RPAR":
            opened.pop()
    accepted: set[str] = parser.accepts()  # type: ignore[no-untyped-call]  # lark leaves it unannotated
    expected = _expected(accepted, tokens[-1] if tokens else None)
    complete = "_CARET" in accepted  # an operand stands before this place
    if opened and complete and found in ("", "\n", ";", ":="):
        return opened[-1], f"this '(' is not closed: expected ')' before {_found(found)}"
    if found == ")" and not opened:
        if complete:
            return (
                offset,
                "this ')' has no '(' before it: expected an operator, a symbol or the end; found ')'",
            )
        return offset, f"expected {expected}; found ')' (and no '(' stands before it)"
    if found == ":=" and complete:
        if any(token.type == "_ASSIGN" for token in tokens):
            return offset, "expected ';' or a new line before the next substitution; found ':='"
        return (
            offset,
            "expected the control pattern first, then ';' or a new line and the substitutions; found ':='",
        )
    hint = _hint(found, complete)
    return offset, f"expected {expected}; found {_found(found)}{hint}"


def _expected(accepted: set[str], previous: Token | None) -> str:
    """What may stand at a place, in a designer's words, from the tokens that the parser would take."""
    after = f" after {str(previous)!r}" if previous is not None and previous.type != "_SEP" else ""
    if "NUMBER" in accepted:
        if "MODE" in accepted:
            return "a number, a counter or a reflection mode (~ | . : @) after '^'"
        return f"a number or a counter{after}"
    if "_ASSIGN" in accepted and "_CARET" not in accepted:
        return f"':='{after}, for what follows the control pattern is a substitution"
    if "_CARET" in accepted:
        rest = "')' or the end" if "_RPAR" in accepted else "';' or the end"
        return f"an operator, a symbol, {rest}"
    if "_LPAR" in accepted:
        return f"{_OPERAND}{after}"
    return "a substitution, such as m := AB"


def _found(found: str) -> str:
    if found == "":
        return "the end of the text"
    if found == "\n":
        return "the end of the line"
    return show(found)


def show(found: str) -> str:
    """A piece of text in quotation marks; a character that is not seen by itself by its number and name."""
    if len(found) == 1 and (not found.isprintable() or category(found)[0] == "M"):
        return f"U+{ord(found):04X} ({unicode_name(found, 'unnamed character').lower()})"
    return f'"{found}"' if "'" in found else f"'{found}'"


def _hint(found: str, complete: bool) -> str:
    """A word on what may have been meant."""
    if found in _HINTS and (complete or found not in "~@:-"):
        return f"; {_HINTS[found]}"
    if found.isdecimal():
        return "; a count is written with '^', such as A^2" if complete else ""
    if len(found) == 1 and not found.isascii() and category(found)[0] in "SP" and found not in "·∘⊙’′−":
        return "; only letters name symbols, other signs stand in angle brackets"
    return ""
