"""The language of texture grammars: from text to statements (the texture paper's 3 and Figure 12; docs/texture.md).

    namespace office {
      width = 1.2                                   # a setting: a parameter of the namespace, with its default
      S -> RepeatX(2.5, Window)
      Window -> SplitX(Rel, 1, Skip, Abs, width, Pane(Fit:window1), Rel, 1, Skip)
    }
    namespace bank = office(width = 1.8)            // all its rules once more, with another width
    S -> SplitY(Abs, 4, bank.S, Rel, 1, office.S)
    Pane(tile, part = 1.0) -> Mat(Color, tile, 0, 0, 1, part)
    Skip -> Skip(0);

A statement that cannot be read is reported and left out, so that the faults of the others are found in the same go.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import isfinite
from typing import Any

from lark import Lark, Token, Transformer
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from ...design.characters import letters_in
from ...design.errors import cut, quoted
from ...design.grammar import show
from ...design.names import nfc

__all__ = [
    "Argument",
    "Binary",
    "Copy",
    "Expression",
    "Name",
    "Namespace",
    "Number",
    "Parameter",
    "Reading",
    "RuleText",
    "Setting",
    "Tile",
    "read",
    "tokens_of",
]

_GRAMMAR = r"""
start: (rule | setting | namespace | copy)*
namespace: NAMESPACE NAME "{" (rule | setting)* "}" _end
copy: NAMESPACE NAME "=" NAME [named] _end
setting: NAME "=" expression _end
rule: NAME parameters ARROW NAME arguments _end
_end: ";"*

parameters: ["(" [parameter ("," parameter)*] ")"]
parameter: NAME ["=" expression]
arguments: "(" [expression ("," expression)* ","?] ")"
named: "(" [argument ("," argument)* ","?] ")"
argument: NAME "=" expression
given: "(" [(argument | expression) ("," (argument | expression))* ","?] ")"

?expression: product | expression PLUS product -> binary | expression MINUS product -> binary
?product: factor | product TIMES factor -> binary | product OVER factor -> binary
?factor: MINUS factor -> negative | PLUS factor -> positive | atom
?atom: NUMBER -> number | TILE -> tile | reference | "(" expression ")" -> inner
reference: NAME ["." NAME] [given]

NAMESPACE.2: /namespace(?=\s+[^\W\d])/
TILE.3: /(?:Fit|Rep)[^\S\r\n]*[:>][^\S\r\n]*\w(?:[@.\-]*[@])?/
NUMBER: /(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?/
NAME: /[^\W\d][@]*/
ARROW.2: "->" | "→"
PLUS: "+"
MINUS: "-" | "−"
TIMES: "*"
OVER: "/"
%ignore /\s+/
%ignore /(?:#|\/\/)[^\r\n]*/
"""

_STATEMENT = r"^[^\S\r\n]*(?:namespace\s+)?([^\W\d][@]*)[^\S\r\n]*(?:\([^()\r\n]*\)[^\S\r\n]*)?(?:->|→|=|\{)"
_COMMENT = r"(?:#|//)[^\r\n]*"
_BRACKET = re.compile(rf"{_COMMENT}|[()]")
_LONG = 400_000  # characters
_MANY = 40  # statements that cannot be read: then this is some other text
_DEEP = 50  # parentheses inside each other
_AGAIN = 6  # so often, at most, a text is read because of statements that cannot be


@dataclass(frozen=True, slots=True)
class Number:
    """A number; as it was written where no float is as large."""

    value: float
    offset: int
    text: str = ""


@dataclass(frozen=True, slots=True)
class Tile:
    """``Fit:name`` or ``Rep:name``."""

    mode: str
    name: str
    offset: int


@dataclass(frozen=True, slots=True)
class Name:
    """A name: of a rule, perhaps of a namespace and with arguments, of a parameter, or a constant such as Abs."""

    text: str
    offset: int
    space: str = ""
    arguments: tuple[Argument, ...] | None = None

    def __str__(self) -> str:
        return f"{self.space}.{self.text}" if self.space else self.text


@dataclass(frozen=True, slots=True)
class Binary:
    """``left + right`` and the like; a minus sign alone is ``0 ± right``."""

    sign: str
    left: Expression
    right: Expression
    offset: int


Expression = Number | Tile | Name | Binary


@dataclass(frozen=True, slots=True)
class Argument:
    """What a parameter is given: by its name, or (empty) by its place."""

    name: str
    value: Expression
    offset: int


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of a rule, with its default."""

    name: str
    default: Expression | None
    offset: int


@dataclass(frozen=True, slots=True)
class RuleText:
    """``Rule(parameters) -> Operator(arguments)``."""

    name: str
    parameters: tuple[Parameter, ...]
    operator: str
    operator_offset: int
    arguments: tuple[Expression, ...]
    offset: int


@dataclass(frozen=True, slots=True)
class Setting:
    """``name = value``: a parameter of the grammar, or of the namespace it stands in."""

    name: str
    value: Expression
    offset: int


@dataclass(frozen=True, slots=True)
class Namespace:
    """``namespace name { … }``."""

    name: str
    items: tuple[RuleText | Setting, ...]
    offset: int


@dataclass(frozen=True, slots=True)
class Copy:
    """``namespace name = source(setting = value, …)``."""

    name: str
    source: str
    source_offset: int
    arguments: tuple[Argument, ...]
    offset: int


Statement = RuleText | Setting | Namespace | Copy


@dataclass(frozen=True, slots=True)
class Reading:
    """What was read.

    Attributes
    ----------
    statements
        Those that could be read, in file order.
    faults
        Offset and message of one for each that could not.
    unread
        Names that the others may have defined: that they are missing is no further fault.
    """

    statements: tuple[Statement, ...]
    faults: tuple[tuple[int, str], ...]
    unread: frozenset[str]


@lru_cache(maxsize=1)
def _parser() -> Lark:
    """The parser; it makes statements as it goes, so that no depth of a text is a depth of calls."""
    return Lark(
        letters_in(_GRAMMAR), parser="lalr", lexer="basic", maybe_placeholders=True, transformer=_Build()
    )


@lru_cache(maxsize=1)
def _head() -> re.Pattern[str]:
    return re.compile(letters_in(_STATEMENT), re.MULTILINE)


def _parsed(text: str) -> list[Statement]:
    found: list[Statement] = _parser().parse(text)  # type: ignore[assignment]  # by the transformer
    return found


def tokens_of(text: str) -> Iterator[tuple[str, str, int]]:
    """The kind, the text and the place of every token of a grammar that can be read."""
    for token in _parser().lex(text):
        yield token.type, str(token), token.start_pos or 0


def read(text: str) -> Reading:
    """Read a grammar's text, statement by statement."""
    if len(text) > _LONG:
        return Reading((), ((0, f"expected at most {_LONG} characters; found {len(text)}"),), frozenset())
    if (deep := _deep(text)) is not None:
        message = f"more than {_DEEP} parentheses stand inside each other here"
        return Reading((), ((deep, message),), frozenset())
    faults: list[tuple[int, str]] = []
    unread: set[str] = set()
    statements: list[Statement] = []
    left = f" {text[1:]}" if text.startswith("\ufeff") else text  # a byte-order mark
    heads: list[re.Match[str]] | None = None
    at = 0  # what stands before has been read
    passed = 0  # characters read so far
    while True:
        try:
            return Reading((*statements, *_parsed(_from(left, at))), tuple(faults), frozenset(unread))
        except UnexpectedInput as error:
            found = _head().finditer(left) if heads is None else heads
            heads = [head for head in found if not left[head.start() : head.end()].isspace()]
            message, offset, blamed = _explain(left, error, heads)
            faults.append((offset, message))
            start, end, outer, names = _statement(left, blamed, heads)
            unread |= names
            passed += max(end, blamed) - at
            if end <= start or len(faults) >= _MANY or passed > _AGAIN * _LONG:
                return Reading((), tuple(faults), frozenset(unread))
            left = left[:start] + re.sub(r"[^\r\n]", " ", left[start:end]) + left[end:]
        if outer > at:  # what is whole above need not be read once more
            try:
                statements += _parsed(_from(left[:outer], at))
                at = outer
            except UnexpectedInput:
                pass


def _from(text: str, at: int) -> str:
    """The text without what has been read, every place where it was."""
    return " " * at + text[at:]


def _deep(text: str) -> int | None:
    """Where more parentheses are open than can be read, if there are so many."""
    depth = 0
    for found in _BRACKET.finditer(text):
        depth += {"(": 1, ")": -1}.get(found[0], 0)
        if depth > _DEEP:
            return found.start()
        depth = max(depth, 0)
    return None


def _statement(text: str, offset: int, heads: Sequence[re.Match[str]]) -> tuple[int, int, int, set[str]]:
    """The stretch of text, around a place, that is left out; where what it stands in begins; what it may define."""
    before = [head for head in heads if head.start() <= offset]
    start = before[-1].start() if before else 0
    after = next((head.start() for head in heads if head.start() > max(offset, start)), None)
    end = len(text) if after is None else after
    piece = text[start:end]
    brace = piece.find("}", max(0, offset - start))
    inside = text.count("{", 0, start) > text.count("}", 0, start)
    if brace >= 0 and before and "{" not in piece[:brace] and inside:
        end = start + brace  # the end of the namespace that the statement stands in is kept
        if end <= offset:
            end = max(end, offset + 1)
    outer = start
    if inside:
        outer = next((head.start() for head in reversed(before[:-1]) if head[0].endswith("{")), 0)
    names = {head[1] for head in before[-1:]} | {head[1] for head in heads if start < head.start() < end}
    return start, end, outer, set(map(nfc, names))


def _explain(text: str, error: UnexpectedInput, heads: Sequence[re.Match[str]]) -> tuple[str, int, int]:
    """What stands where something else was expected, where, and a place in the statement that is to blame."""
    accepted: set[str] = set(getattr(error, "accepts", None) or ())
    if isinstance(error, UnexpectedCharacters):
        offset = error.pos_in_stream or 0
        found = text[offset]
    elif isinstance(error, UnexpectedToken) and error.token.type != "$END":
        offset, found = error.token.start_pos or 0, str(error.token)
    else:
        offset, found = len(text.rstrip()), ""
    unclosed = _unclosed(text, offset, heads)
    if unclosed is not None:
        return "this '(' is not closed: expected ')' before the next rule", unclosed, unclosed
    if text.startswith("...", offset) or found == "…":
        return "'...' stands for what has been left out: write it out, or leave it away", offset, offset
    what = show(cut(found)) if found else "the end of the text"
    if any(head.start(1) == offset for head in heads) and text[:offset].strip():
        what = f"the next rule, {quoted(found)}"
        offset = len(text[:offset].rstrip())
    hint = _HINTS.get(found, "")
    return f"expected {_expected(accepted, error)}; found {what}{hint}", offset, max(offset - 1, 0)


def _unclosed(text: str, offset: int, heads: Sequence[re.Match[str]]) -> int | None:
    """The parenthesis that the statement before the one at `offset` has left open, if it has."""
    heads = [head for head in heads if head.start() <= offset]
    if len(heads) < 2 or offset > heads[-1].end():
        return None
    opened: list[int] = []
    for bracket in _BRACKET.finditer(text, heads[-2].start(), heads[-1].start()):
        if bracket[0] == "(":
            opened.append(bracket.start())
        elif bracket[0] == ")" and opened:
            opened.pop()
    return opened[-1] if opened else None


_HINTS = {
    ":": "; a tile is written Fit:name or Rep:name",
    ">": "; a tile is written Fit:name or Rep:name",
    "[": "; parameters stand in ( )",
    "]": "; parameters stand in ( )",
    '"': "; names stand without quotation marks",
    "'": "; names stand without quotation marks",
}
_WORDS = {
    "NAME": "a name",
    "NUMBER": "a number",
    "TILE": "Fit:tile or Rep:tile",
    "ARROW": "'->'",
    "LPAR": "'('",
    "RPAR": "')'",
    "COMMA": "','",
    "EQUAL": "'='",
    "DOT": "'.'",
    "LBRACE": "'{'",
    "RBRACE": "'}'",
    "$END": "the end",
}


def _expected(accepted: set[str], error: UnexpectedInput) -> str:
    if isinstance(error, UnexpectedCharacters):
        return "a rule, such as Wall -> Mat(Color, Rep:wall1, 0, 0, 1, 1), or a part of one"
    if {"NUMBER", "TILE", "NAME"} <= accepted:
        words = ["a number, a name, or Fit:tile"]
        if "RPAR" in accepted:
            words.append("')'")
    elif "NAME" in accepted and "$END" in accepted:
        words = ["a rule, such as Wall -> Mat(Color, Rep:wall1, 0, 0, 1, 1)"]
    else:
        words = [word for kind, word in _WORDS.items() if kind in accepted]
    return " or ".join(words) or "a rule"


def _name(token: str) -> str:
    return nfc(str(token))


class _Build(Transformer[Token, Any]):
    """From lark's tree to statements."""

    def start(self, items: list[Any]) -> list[Any]:
        return items

    def rule(self, items: list[Any]) -> RuleText:
        name, parameters, _, operator, arguments = items
        return RuleText(
            _name(name), parameters, _name(operator), operator.start_pos or 0, arguments, name.start_pos or 0
        )

    def setting(self, items: list[Any]) -> Setting:
        return Setting(_name(items[0]), items[1], items[0].start_pos or 0)

    def namespace(self, items: list[Any]) -> Namespace:
        return Namespace(_name(items[1]), tuple(items[2:]), items[1].start_pos or 0)

    def copy(self, items: list[Any]) -> Copy:
        _, name, source, arguments = items
        return Copy(_name(name), _name(source), source.start_pos or 0, arguments or (), name.start_pos or 0)

    def parameters(self, items: list[Any]) -> tuple[Parameter, ...]:
        return tuple(item for item in items if item is not None)

    def parameter(self, items: list[Any]) -> Parameter:
        return Parameter(_name(items[0]), items[1], items[0].start_pos or 0)

    def arguments(self, items: list[Any]) -> tuple[Expression, ...]:
        return tuple(item for item in items if item is not None)

    def named(self, items: list[Any]) -> tuple[Argument, ...]:
        return tuple(item for item in items if item is not None)

    def argument(self, items: list[Any]) -> Argument:
        return Argument(_name(items[0]), items[1], items[0].start_pos or 0)

    def given(self, items: list[Any]) -> tuple[Argument, ...]:
        values = (item for item in items if item is not None)
        return tuple(v if isinstance(v, Argument) else Argument("", v, v.offset) for v in values)

    def binary(self, items: list[Any]) -> Binary:
        left, sign, right = items
        return Binary(str(sign).replace("−", "-"), left, right, left.offset)

    def negative(self, items: list[Any]) -> Expression:
        sign, value = items
        if isinstance(value, Number):
            return Number(-value.value, sign.start_pos or 0, value.text and f"-{value.text}")
        if isinstance(value, Binary) and value.sign == "±":
            return value.right  # of two signs nothing is left, however many there are
        return Binary("±", Number(0.0, sign.start_pos or 0), value, sign.start_pos or 0)

    def positive(self, items: list[Any]) -> Expression:
        value: Expression = items[1]
        return value

    def inner(self, items: list[Any]) -> Expression:
        value: Expression = items[0]
        return value

    def number(self, items: list[Any]) -> Number:
        return Number(
            float(items[0]), items[0].start_pos or 0, "" if isfinite(float(items[0])) else str(items[0])
        )

    def tile(self, items: list[Any]) -> Tile:
        mode, name = re.split(r"\s*[:>]\s*", str(items[0]), maxsplit=1)
        return Tile(mode, nfc(name), items[0].start_pos or 0)

    def reference(self, items: list[Any]) -> Name:
        first, second, given = items
        if second is None:
            return Name(_name(first), first.start_pos or 0, "", given)
        return Name(_name(second), first.start_pos or 0, _name(first), given)
