"""The grammar of patterns and what is said where a text breaks it (docs/patterns.md)."""

from __future__ import annotations

import re
from contextlib import suppress
from functools import lru_cache
from itertools import takewhile
from unicodedata import category, decomposition

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken
from lark.parsers.lalr_interactive_parser import InteractiveParser

from .errors import PatternError
from .lookalikes import described, is_unseen, meant, sign_classes
from .modes import MODES, SYNONYMS
from .text import fault_at

__all__ = ["read_tree", "refuse", "show", "token_ends"]

_HANGUL = "(?:[\u1100-\u115e\ua960-\ua97c][\u1161-\u11a7\ud7b0-\ud7c6]|[\uac00-\ud7a3])[\u11a8-\u11ff\ud7cb-\ud7fb]?"
"""A syllable, also where its letters are stored one by one."""


def _grammar() -> str:
    """The grammar in lark's form. Python's `re` has no classes for letters and marks of scripts: they are listed."""
    marks, foreign = sign_classes()
    digit = rf"(?:(?![{foreign}])\d)"
    letter = rf"(?:{_HANGUL}|(?![{foreign}])[^\W\d_])[{marks}]*"
    return rf"""
start: _SEP? alternation (_SEP substitution)* _SEP?
substitution: (SYMBOL | LONG) _ASSIGN alternation
?alternation: sequence (BAR sequence)*
?sequence: term (DOT? term)*
?term: atom (MIRROR | count)*
?atom: SYMBOL | LONG | EPSILON | group
group: _LPAR alternation? _RPAR
count: _CARET (MODE | BAR | DOT)? MINUS? (NUMBER | SYMBOL | BRACED)

EPSILON.2: /ε(?!{digit}|[{marks}])/
SYMBOL: /{letter}{digit}*/
LONG: /<[^<>\r\n]*>/
BRACED: /\{{[^{{}}\r\n]*\}}/
NUMBER: /{digit}+/
MIRROR: /['’′]/
BAR: "|"
DOT: "." | "·"
MODE: /:(?!=)|[{re.escape("".join(_MODE_SIGNS))}]/
MINUS: "-" | "−"
_ASSIGN: ":="
_LPAR: "("
_RPAR: ")"
_CARET: "^"
_SEP: /[;\r\n](?:[\s;]|#[^\r\n\ud800-\udfff]*)*/
%ignore /[^\S\r\n]+/
%ignore /#[^\r\n\ud800-\udfff]*/
"""


_MODE_SIGNS = [sign for sign in (*MODES, *SYNONYMS) if sign and sign not in "|.·:"]
"""Signs that are nothing but modes: the others are an alternative, a separator, or the beginning of ':='."""

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
    **{sign: f"a reflection mode stands after '^', such as A^{sign}k" for sign in _MODE_SIGNS},
    ":": "a reflection mode stands after '^', such as A^:k; a substitution is written with ':='",
    "-": "a minus sign stands after '^', such as A^-1; longer names stand in angle brackets",
    '"': "a mirrored instance is written with ', such as A'",
}
_SIGNS = f"^{''.join(MODES)}';-()<>{{}}#ε"
"""Signs of the language; ':=' is told as a whole."""
_SHOWN = 40
"""Most characters of a text that a sentence shows."""
_READ = "’′"
"""Signs that are read as another one, and may not be known to be."""


@lru_cache(maxsize=1)
def _parser() -> Lark:
    return Lark(_grammar(), parser="lalr", lexer="basic")


def read_tree(text: str) -> Tree[Token]:
    """The parse tree of a pattern text. Raises `PatternError` with line, column and caret."""
    try:
        return _parser().parse(text)
    except UnexpectedInput as error:
        stopped = error
    raise _explain(text, stopped)


def token_ends(text: str) -> dict[int, int]:
    """Where each token of a text that can be read ends, by where it begins."""
    return {token.start_pos or 0: token.end_pos or 0 for token in _parser().lex(text)}


def refuse(text: str, offset: int, message: str) -> PatternError:
    """The error of a text that is at fault at an offset."""
    return PatternError(fault_at(text, offset, message))


def _explain(text: str, error: UnexpectedInput) -> PatternError:
    """Read a faulty text again up to the place where it stops the parser, and say what stops it there.

    The parser that stopped has reduced its stack already for the token that it then refused; this one has not seen it.
    """
    parser = _parser().parse_interactive(text)
    tokens: list[Token] = []
    offset, found = error.pos_in_stream or 0, ""
    ended = isinstance(error, UnexpectedToken) and error.token.type == "$END"
    lexer = parser.lexer_thread.lex(parser.parser_state)  # type: ignore[no-untyped-call]  # lark leaves it unannotated
    with suppress(UnexpectedCharacters):
        for token in takewhile(lambda token: ended or token.start_pos < offset, lexer):
            parser.feed_token(token)
            tokens.append(token)
    if ended:
        offset = max((token.end_pos or 0 for token in tokens if token.type != "_SEP"), default=0)
    elif isinstance(error, UnexpectedToken):
        found = str(error.token)
    else:
        found = text[offset]
    return refuse(text, *_message(text, offset, _found_kind(text, offset, found), parser, tokens))


def _found_kind(text: str, offset: int, found: str) -> str:
    """What stands at the offset: a token's text, a newline for the end of a line, empty for the text's end."""
    if found[:1] in ("\r", "\n"):
        return "\n" if text[offset:].strip() else ""
    return ";" if found.startswith(";") else found


def _message(
    text: str, offset: int, found: str, parser: InteractiveParser, tokens: list[Token]
) -> tuple[int, str]:
    """Where to point, and what to say."""
    if found in ("<", "{"):
        closing = {"<": ">", "{": "}"}[found]
        rest = text[offset:].splitlines()[0]
        near = next((n for n, sign in enumerate(rest) if meant(sign) == closing), None)
        if near is not None:
            return offset + near, f"expected {closing!r}; found {show(rest[near])}; {_probably(closing)}"
        return offset, f"this {found!r} is not closed: expected {closing!r} before the end of the line"
    following = text[offset + 1 : offset + 2]
    if found == ":" and following and meant(following) == "=":
        return offset + 1, f"expected '=' after ':'; found {show(following)}; {_probably('=')}"
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
            return f"a number, a counter or a reflection mode ({' '.join(filter(None, MODES))}) after '^'"
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
    """A piece of text in quotation marks; a character that may be taken for another one with its number and name."""
    if len(found) != 1:
        return _quoted(found if len(found) <= _SHOWN else found[:_SHOWN] + "…")
    if not found.isprintable() or category(found)[0] == "M" or is_unseen(found):
        number, name = described(found).split(", ", 1)
        return f"{number} ({name})"
    return f"{_quoted(found)} ({described(found)})" if meant(found) and found not in "·−" else _quoted(found)


def _quoted(text: str) -> str:
    return f'"{text}"' if "'" in text else f"'{text}'"


def _probably(sign: str) -> str:
    return f"{_quoted(sign)} was probably meant"


def _hint(found: str, complete: bool) -> str:
    """A word on what may have been meant."""
    if len(found) == 1:
        if is_unseen(found) or found in "\u200c\u200d":
            return "; it is not seen: take it out"
        if found in _READ:
            return "; it is read as ', which stands after what it mirrors"
        sign = meant(found) if found not in "·−" else found.replace("−", "-")
        if sign and sign != found:
            return _hint_of(found, sign, complete)
    if found in _HINTS and (complete or found not in (*_MODE_SIGNS, ":", "-")):
        return f"; {_HINTS[found]}"
    if found.isdecimal():
        return "; a count is written with '^', such as A^2" if complete else ""
    if len(found) == 1 and not found.isascii() and found not in "·∘⊙−" and _is_sign(found):
        return "; only letters name symbols, other signs stand in angle brackets"
    return ""


def _is_sign(found: str) -> bool:
    return category(found)[0] in "SPN" or category(found) == "Lm"


def _hint_of(found: str, sign: str, complete: bool) -> str:
    """The same for a character that stands for another one."""
    if sign in _SIGNS or sign == ":=":
        return f"; {_probably(sign)}"
    if sign in _HINTS:
        return f"; {_HINTS[sign]}"
    if complete and decomposition(found).startswith("<super>") and sign.isalnum():
        return f"; a count is written with '^', such as A^{sign}"
    if "fraktur" in described(found):
        return f"; a mirrored {sign} is written {sign}'"
    return f"; {_probably(sign)}" if sign.isalnum() else ""
